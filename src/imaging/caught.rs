//! Panics of a decoder or parser on bad files: caught, and kept off standard error.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether this thread runs a decoder whose panics are caught.
    static IS_DECODING: Cell<bool> = const { Cell::new(false) };
}

/// What `run` returns, `None` when it panics. Nothing is printed then: the caller reports a damaged file, and that is all
/// there is to say. Panics elsewhere are printed as ever. `AssertUnwindSafe`: after a panic everything it touched must be
/// dropped.
pub(crate) fn caught<T>(run: impl FnOnce() -> T) -> Option<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !IS_DECODING.get() {
                usual(info);
            }
        }));
    });
    let outer = IS_DECODING.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(run));
    IS_DECODING.set(outer);
    result.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hook belongs to the whole process, so the test looks at a process of its own: itself once more.
    #[test]
    fn only_a_decoder_panics_in_silence() {
        const CHILD: &str = "SIXFOLD_TEST_CHILD";
        if std::env::var_os(CHILD).is_some() {
            assert_eq!(caught(|| 7), Some(7));
            assert_eq!(caught(|| assert_eq!(1, 2, "unheard")), None);
            panic::catch_unwind(|| panic!("heard after it")).unwrap_err();
            let elsewhere = || std::thread::spawn(|| panic!("heard beside it")).join();
            assert!(caught(elsewhere).unwrap().is_err());
            return;
        }
        let name = format!("{}::only_a_decoder_panics_in_silence", module_path!());
        let output = std::process::Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                name.trim_start_matches("sixfold::"),
                "--nocapture",
            ])
            .env(CHILD, "1")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}");
        assert!(!said.contains("unheard"), "{said}");
        assert!(
            said.contains("heard after it") && said.contains("heard beside it"),
            "{said}"
        );
    }
}
