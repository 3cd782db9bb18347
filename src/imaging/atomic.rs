//! Files that appear whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why nothing was written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// There is a file already.
    #[error("the file exists already; choose another name or allow replacing it (--force): {}", .0.display())]
    Exists(PathBuf),
    /// The path names no file.
    #[error("this names no file; give a file name: {}", .0.display())]
    NoFileName(PathBuf),
    /// The system refused.
    #[error("nothing was written ({cause}); check the folder, the rights and the space: {}", path.display())]
    Io {
        /// What the system said.
        cause: io::Error,
        /// The file that was to be written.
        path: PathBuf,
    },
}

/// Whether [`write_atomically`] would refuse the name: to be asked before long work, whose result could not be kept.
///
/// # Errors
/// [`WriteError::NoFileName`] or [`WriteError::Exists`].
pub fn check_name(path: &Path, force: bool) -> Result<(), WriteError> {
    if path.file_name().is_none() {
        Err(WriteError::NoFileName(path.to_owned()))
    } else if !force && path.symlink_metadata().is_ok() {
        Err(WriteError::Exists(path.to_owned()))
    } else {
        Ok(())
    }
}

/// A file that is written from anywhere to anywhere.
pub trait WriteSeek: Write + Seek {}

impl<T: Write + Seek> WriteSeek for T {}

/// Writes `bytes` to `path`, as [`write_atomically_with`] does.
///
/// # Errors
/// See [`WriteError`]; the temporary file is gone then.
pub fn write_atomically(path: &Path, force: bool, bytes: &[u8]) -> Result<(), WriteError> {
    write_atomically_with(path, force, |out| {
        out.write_all(bytes)
            .map_err(|cause| WriteError::of(cause, path))
    })
}

/// Lets `write` fill a temporary file beside `path`, which is flushed to the disk, then renamed. Whoever looks at `path` sees
/// the old state or all of the new one. An existing file is replaced only with `force`; without it the last step itself
/// fails when a file has appeared meanwhile.
///
/// # Errors
/// What `write` returns, and see [`WriteError`]; the temporary file is gone then.
pub fn write_atomically_with<E: From<WriteError>>(
    path: &Path,
    force: bool,
    write: impl FnOnce(&mut dyn WriteSeek) -> Result<(), E>,
) -> Result<(), E> {
    check_name(path, force)?;
    let failed = |cause: io::Error| WriteError::of(cause, path);
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".sixfold-").suffix(".tmp");
    // Temporary files are private by default; a picture gets the rights that any new file gets.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut temporary = builder.tempfile_in(folder).map_err(failed)?;
    let mut buffered = BufWriter::new(temporary.as_file_mut());
    write(&mut buffered)?;
    buffered.flush().map_err(failed)?;
    drop(buffered);
    temporary.as_file().sync_all().map_err(failed)?;
    let renamed = if force {
        temporary.persist(path)
    } else {
        temporary.persist_noclobber(path)
    };
    renamed.map_err(|failure| failed(failure.error))?;
    // The new name is safe once the folder is; where a folder cannot be opened as a file the rename has to do.
    if let Ok(folder) = File::open(folder) {
        folder.sync_all().ok();
    }
    Ok(())
}

impl WriteError {
    fn of(cause: io::Error, path: &Path) -> Self {
        if cause.kind() == io::ErrorKind::AlreadyExists {
            Self::Exists(path.to_owned())
        } else {
            Self::Io {
                cause,
                path: path.to_owned(),
            }
        }
    }
}
