//! Opening what may be anything.

use std::fs::File;
use std::io;
use std::path::Path;

/// Opens a file for reading, and nothing else: a pipe would wait for ever when opened, and a device may never end.
///
/// # Errors
/// What the system says, or [`io::ErrorKind::InvalidInput`] when there is something that is no regular file.
pub fn open_regular(path: &Path) -> io::Result<File> {
    // The kind is asked for first: opening is what waits.
    if std::fs::metadata(path)?.is_file() {
        File::open(path)
    } else {
        let kind = io::ErrorKind::InvalidInput;
        Err(io::Error::new(kind, "it is not a regular file"))
    }
}
