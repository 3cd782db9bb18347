//! A real window on a virtual screen: it opens, the probe is dragged, the picture changes, a still window draws nothing,
//! and it closes with status 0.

#![cfg(feature = "explorer")]
#![cfg(target_os = "linux")]
#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ClientMessageEvent, ConnectionExt,
    EventMask, ImageFormat, MOTION_NOTIFY_EVENT, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// Longest wait for anything: far above what a slow machine needs, so that only a fault runs into it.
const PATIENCE: Duration = Duration::from_secs(120);

/// A process that does not outlive the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // Gone already in the good case.
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

/// Asks again and again until there is an answer.
fn wait_for<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(start.elapsed() < PATIENCE, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// A virtual screen and a connection to it.
fn screen() -> (Running, String, RustConnection) {
    for number in 90..120 {
        let display = format!(":{number}");
        if std::path::Path::new(&format!("/tmp/.X11-unix/X{number}")).exists() {
            continue;
        }
        let server = Command::new("Xvfb")
            .args([&display, "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb must be installed: scripts/test does it");
        let server = Running(server);
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(20) {
            if let Ok((connection, _)) = RustConnection::connect(Some(&display)) {
                return (server, display, connection);
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }
    panic!("no virtual screen could be started");
}

/// The explorer's window and the process behind it.
struct Explorer<'a> {
    x: &'a RustConnection,
    root: Window,
    window: Window,
    process: Running,
}

impl<'a> Explorer<'a> {
    fn open(x: &'a RustConnection, display: &str) -> Self {
        let process = Command::new(env!("CARGO_BIN_EXE_sixfold"))
            .env("DISPLAY", display)
            .env_remove("WAYLAND_DISPLAY")
            .stdin(Stdio::null())
            .spawn()
            .unwrap();
        let mut process = Running(process);
        let root = x.setup().roots[0].root;
        let window = wait_for("the window", || {
            if let Some(status) = process.0.try_wait().unwrap() {
                panic!("the explorer ended by itself: {status}");
            }
            let children = x.query_tree(root).ok()?.reply().ok()?.children;
            children.into_iter().find(|window| {
                let name = x.get_property(false, *window, AtomEnum::WM_NAME, AtomEnum::ANY, 0, 64);
                name.ok()
                    .and_then(|n| n.reply().ok())
                    .is_some_and(|n| n.value == b"Sixfold")
            })
        });
        Self {
            x,
            root,
            window,
            process,
        }
    }

    /// The picture on the screen, as bytes.
    fn picture(&self) -> Vec<u8> {
        let image = self
            .x
            .get_image(ImageFormat::Z_PIXMAP, self.root, 0, 0, 1280, 800, !0);
        image.unwrap().reply().unwrap().data
    }

    /// Colour of a pixel, blue, green, red as the server stores it.
    fn pixel(picture: &[u8], x: usize, y: usize) -> [u8; 3] {
        let at = 4 * (y * 1280 + x);
        [picture[at], picture[at + 1], picture[at + 2]]
    }

    /// Waits until the picture has not changed for two seconds.
    fn settled(&self) -> Vec<u8> {
        let mut last = self.picture();
        let mut since = Instant::now();
        wait_for("the window to come to rest", || {
            let now = self.picture();
            if now != last {
                last = now;
                since = Instant::now();
            }
            (since.elapsed() > Duration::from_secs(2)).then(|| last.clone())
        })
    }

    fn event(&self, kind: u8, detail: u8, x: i16, y: i16) {
        self.x
            .xtest_fake_input(kind, detail, 0, self.root, x, y, 0)
            .unwrap();
        self.x.flush().unwrap();
        std::thread::sleep(Duration::from_millis(120));
    }

    fn drag(&self, from: (i16, i16), to: (i16, i16)) {
        self.event(MOTION_NOTIFY_EVENT, 0, from.0, from.1);
        self.event(BUTTON_PRESS_EVENT, 1, 0, 0);
        self.event(
            MOTION_NOTIFY_EVENT,
            0,
            (from.0 + to.0) / 2,
            (from.1 + to.1) / 2,
        );
        self.event(MOTION_NOTIFY_EVENT, 0, to.0, to.1);
        self.event(BUTTON_RELEASE_EVENT, 1, 0, 0);
    }

    /// Closes the window as a window manager would, and waits for the end of the process.
    fn close(mut self) -> ExitStatus {
        let atom = |name: &[u8]| {
            self.x
                .intern_atom(false, name)
                .unwrap()
                .reply()
                .unwrap()
                .atom
        };
        let (protocols, delete) = (atom(b"WM_PROTOCOLS"), atom(b"WM_DELETE_WINDOW"));
        let message = ClientMessageEvent::new(32, self.window, protocols, [delete, 0, 0, 0, 0]);
        self.x
            .send_event(false, self.window, EventMask::NO_EVENT, message)
            .unwrap();
        self.x.flush().unwrap();
        wait_for("the explorer to end", || self.process.0.try_wait().unwrap())
    }
}

#[test]
fn a_window_opens_follows_the_probe_rests_and_closes() {
    let (_server, display, connection) = screen();
    let explorer = Explorer::open(&connection, &display);
    // The panels are drawn: much of the screen differs from its first colour.
    wait_for("the first picture", || {
        let picture = explorer.settled();
        let pixels = (0..800).flat_map(|y| (0..1280).map(move |x| (x, y)));
        let seen: std::collections::HashSet<_> = pixels
            .map(|(x, y)| Explorer::pixel(&picture, x, y))
            .collect();
        (seen.len() > 500).then_some(())
    });
    let before = explorer.settled();
    // Still: the status bar counts frames, so a single frame more would change the picture.
    std::thread::sleep(Duration::from_secs(10));
    assert!(explorer.picture() == before, "a still window drew a frame");
    // In the latlong panel, lower left of the middle of the window.
    explorer.drag((260, 520), (340, 545));
    let after = explorer.settled();
    let changed = before
        .chunks(4)
        .zip(after.chunks(4))
        .filter(|(a, b)| a != b)
        .count();
    // The mark has moved in six panels and the numbers in the inspector with it.
    assert!(changed > 2000, "the drag changed {changed} pixels only");
    let status = explorer.close();
    assert!(status.success(), "closed with {status}");
}
