//! The bytes that a glTF file names: its own chunk, a data URI, or a file in its own folder. Nothing else is opened.

use std::cell::{Cell, OnceCell};
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::json;

use super::error::{MeshProblem, damaged_gltf as damaged, quoted};
use super::{Format, MOST_FILE_BYTES};
use crate::imaging::{Progress, ReadProblem, Stage, read_whole};

/// Exporters write the padding or leave it.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The buffers of one document, each read once and only when something in it is used.
pub(super) struct Buffers<'a> {
    declared: &'a [json::Buffer],
    chunk: Option<&'a [u8]>,
    path: &'a Path,
    progress: &'a Progress,
    read: Vec<OnceCell<Vec<u8>>>,
    /// Bytes that files beside the model may still have, all together.
    left: Cell<u64>,
}

impl<'a> Buffers<'a> {
    /// `chunk`: the binary part of a GLB; `path`: the model's.
    pub fn new(
        declared: &'a [json::Buffer],
        chunk: Option<&'a [u8]>,
        path: &'a Path,
        progress: &'a Progress,
    ) -> Self {
        Self {
            declared,
            chunk,
            path,
            progress,
            read: declared.iter().map(|_| OnceCell::new()).collect(),
            left: Cell::new(MOST_FILE_BYTES),
        }
    }

    /// The declared bytes of a buffer: no more, and all of them.
    pub fn bytes(&self, number: usize) -> Result<&[u8], MeshProblem> {
        let (Some(buffer), Some(cell)) = (self.declared.get(number), self.read.get(number)) else {
            return Err(damaged(format!(
                "it names buffer {number}, which is not there"
            )));
        };
        let bytes = match (&buffer.uri, cell.get()) {
            (None, _) => self
                .chunk
                .filter(|_| number == 0)
                .ok_or_else(|| damaged(format!("buffer {number} has no data, only a length")))?,
            (Some(_), Some(bytes)) => bytes,
            (Some(uri), None) => {
                let bytes = self.fetch(uri)?;
                cell.get_or_init(|| bytes)
            }
        };
        let declared = buffer.byte_length.0;
        usize::try_from(declared)
            .ok()
            .and_then(|length| bytes.get(..length))
            .ok_or_else(|| {
                let found = bytes.len();
                damaged(format!(
                    "buffer {number} declares {declared} bytes and has {found}"
                ))
            })
    }

    fn fetch(&self, uri: &str) -> Result<Vec<u8>, MeshProblem> {
        if let Some(data) = uri.strip_prefix("data:") {
            return decoded(data);
        }
        let path = within_folder(uri, self.path)?;
        let most = self.left.get();
        let bytes = read_whole(&path, most, self.progress).map_err(|problem| match problem {
            ReadProblem::Io(error) => MeshProblem::Buffer {
                uri: quoted(uri),
                reason: error.to_string(),
            },
            ReadProblem::TooLong(bytes) => MeshProblem::FileTooLong {
                bytes: bytes.saturating_add(MOST_FILE_BYTES - most),
            },
            other => other.into(),
        })?;
        self.left.set(most - bytes.len() as u64);
        self.progress.enter(Stage::Decoding);
        Ok(bytes)
    }
}

/// The bytes of a data URI behind its scheme: `[type];base64,...`. They are fewer than the text has.
fn decoded(data: &str) -> Result<Vec<u8>, MeshProblem> {
    let Some((head, body)) = data.split_once(',') else {
        return Err(damaged("a data URI has no comma".to_owned()));
    };
    if !head.ends_with(";base64") {
        return Err(MeshProblem::Unsupported {
            format: Format::Gltf,
            what: format!(
                "a data URI is {}, only base64 opens; export it as that or as a file",
                quoted(head)
            ),
        });
    }
    BASE64
        .decode(body)
        .map_err(|error| damaged(format!("a data URI is not base64: {error}")))
}

/// The file that a relative URI names, where it lies in the folder of `model`, links followed, or below it.
///
/// The text is judged first, so that nothing outside is even asked for: on some systems a question alone (to
/// `\\host\share`) sends the user's credentials.
fn within_folder(uri: &str, model: &Path) -> Result<PathBuf, MeshProblem> {
    let outside = |reason| MeshProblem::Outside {
        uri: quoted(uri),
        reason,
    };
    let relative = percent_decoded(uri).ok_or_else(|| outside("its % signs spell no text"))?;
    if relative.contains(':') {
        return Err(outside("a buffer has no scheme and no drive"));
    }
    if relative.contains('\\') {
        return Err(outside("a URI has no backslash"));
    }
    if relative.chars().any(char::is_control) {
        return Err(outside("its name has control characters"));
    }
    if relative.starts_with('/') {
        return Err(outside("its path is absolute"));
    }
    // Some systems drop dots and spaces at the end of a name: ".. " would be "..".
    let leaves = |part: &str| part.starts_with("..") && part.trim_matches(['.', ' ']).is_empty();
    if relative.split('/').any(leaves) {
        return Err(outside("its path leaves the model's folder"));
    }

    let unread = |error: std::io::Error| MeshProblem::Buffer {
        uri: quoted(uri),
        reason: error.to_string(),
    };
    let folder = match model.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let folder = folder.canonicalize().map_err(unread)?;
    let file = folder.join(relative).canonicalize().map_err(unread)?;
    if !file.starts_with(&folder) {
        return Err(outside("it is a link that leaves the model's folder"));
    }
    Ok(file)
}

/// `None` where a % sign is not followed by two hexadecimal digits, or the bytes are no UTF-8.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        if *first == b'%' {
            let [high, low, tail @ ..] = tail else {
                return None;
            };
            let digit = |b: u8| char::from(b).to_digit(16);
            bytes.push((16 * digit(*high)? + digit(*low)?) as u8);
            rest = tail;
        } else {
            bytes.push(*first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}
