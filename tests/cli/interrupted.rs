//! Ctrl-C while `sixfold convert` runs.

#![cfg(unix)]

use std::fs::read_dir;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use super::sixfold;

/// Files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let names = read_dir(folder).unwrap();
    let mut names: Vec<String> = names
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn start(folder: &Path, words: &str) -> Child {
    let mut command = sixfold(&["convert"]);
    command.args(words.split(' ')).current_dir(folder);
    command.stdin(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn send(signal: &str, child: &Child) {
    let pid = child.id().to_string();
    let sent = Command::new("kill").args(["-s", signal, &pid]).status();
    assert!(sent.unwrap().success());
}

/// Waits until something is so; `false` when the process has ended before.
fn wait_until(child: &mut Child, is_so: impl Fn() -> bool) -> bool {
    loop {
        if is_so() {
            return true;
        }
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn ended(child: Child) -> (Option<i32>, String) {
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    (status.code(), String::from_utf8(stderr).unwrap())
}

/// Three million texels, whose compression takes many times longer than a signal does.
const LONG: &str = "small.exr large.exr --from latlong --to latlong --size 1200 --filter nearest";

#[test]
fn what_is_being_written_is_taken_away_again() {
    let folder = tempfile::tempdir().unwrap();
    let small = start(folder.path(), "direction-colour small.exr --size 16");
    assert_eq!(ended(small), (Some(0), String::new()));
    let is_writing = || names(folder.path()).iter().any(|n| n.ends_with(".tmp"));
    for signal in ["INT", "TERM"] {
        let mut child = start(folder.path(), LONG);
        assert!(wait_until(&mut child, is_writing), "it wrote nothing");
        send(signal, &child);
        let line = "sixfold: interrupted; no file is left half-written\n";
        assert_eq!(ended(child), (Some(130), line.to_owned()), "{signal}");
        assert_eq!(names(folder.path()), ["small.exr"], "{signal}");
    }
    // What no program can catch leaves the temporary file: it is the cleaning that the test sees above.
    let mut child = start(folder.path(), LONG);
    assert!(wait_until(&mut child, is_writing), "it wrote nothing");
    send("KILL", &child);
    assert_eq!(ended(child).0, None);
    assert_eq!(names(folder.path()).len(), 2);
}

/// True when every thread below /proc/PID/task is stopped.
#[cfg(target_os = "linux")]
fn all_stand_still(tasks: &Path) -> bool {
    let is_stopped = |task: std::fs::DirEntry| {
        // The state stands behind the program's name, which is in parentheses.
        let stat = std::fs::read_to_string(task.path().join("stat")).unwrap_or_default();
        stat.rsplit_once(") ")
            .is_some_and(|(_, state)| state.starts_with('T'))
    };
    std::fs::read_dir(tasks).unwrap().flatten().all(is_stopped)
}

/// Both come while it stands still, so that it has no time to obey the first.
#[cfg(target_os = "linux")]
#[test]
fn the_second_signal_ends_it_at_once() {
    // Two threads may take one signal each, and the second of them may have to wait for a core until the first signal was obeyed. A program
    // that knows no second signal would obey the first one every time.
    const MOST_TRIES: usize = 20;
    let folder = tempfile::tempdir().unwrap();
    let small = start(folder.path(), "direction-colour small.exr --size 16");
    assert_eq!(ended(small), (Some(0), String::new()));
    let is_writing = || names(folder.path()).iter().any(|n| n.ends_with(".tmp"));
    let ends_at_once = (0..MOST_TRIES).any(|_| {
        let mut child = start(folder.path(), LONG);
        assert!(wait_until(&mut child, is_writing), "it wrote nothing");
        send("STOP", &child);
        // It is told to stop before it has: until then a thread could still obey the first of both.
        let tasks = PathBuf::from(format!("/proc/{}/task", child.id()));
        assert!(wait_until(&mut child, || all_stand_still(&tasks)));
        for signal in ["INT", "TERM", "CONT"] {
            send(signal, &child);
        }
        let (status, said) = ended(child);
        assert_eq!(status, Some(130), "{said}");
        for name in names(folder.path()).iter().filter(|n| n.ends_with(".tmp")) {
            std::fs::remove_file(folder.path().join(name)).unwrap();
        }
        // No line: it did not come to say one.
        said.is_empty()
    });
    assert!(ends_at_once, "the second signal was not heard");
}
