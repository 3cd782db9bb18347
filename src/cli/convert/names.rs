//! File names that stand for many: `%f` for the faces, `%04d` for the frames of a film.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A path whose file name may hold `%f` and `%d`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    path: PathBuf,
    /// The file name in parts; empty where it is no Unicode, and then nothing stands for anything.
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    Face,
    /// At least so many digits, filled up with zeros.
    Number(usize),
}

impl Name {
    /// The name as it was written. What begins with `%` but is neither `%f` nor `%d` with its digits is itself.
    pub fn new(path: &Path) -> Self {
        let name = path.file_name().and_then(|name| name.to_str());
        Self {
            path: path.to_owned(),
            parts: name.map(parts).unwrap_or_default(),
        }
    }

    /// The path as it was written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it stands for a file of each face.
    pub fn has_face(&self) -> bool {
        self.parts.contains(&Part::Face)
    }

    /// Whether it stands for a file of each frame.
    pub fn has_number(&self) -> bool {
        let is_number = |part: &Part| matches!(part, Part::Number(_));
        self.parts.iter().any(is_number)
    }

    /// The file of a face of a frame; what the name does not tell apart is not looked at.
    pub fn file(&self, face: &str, frame: u64) -> PathBuf {
        if self.parts.is_empty() {
            return self.path.clone();
        }
        let part = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Face => face.to_owned(),
            Part::Number(width) => format!("{frame:0width$}"),
        };
        let name: String = self.parts.iter().map(part).collect();
        self.path.with_file_name(name)
    }

    /// The same name of one face.
    pub fn of_face(&self, face: &str) -> Self {
        let mut name = self.clone();
        for part in &mut name.parts {
            if *part == Part::Face {
                *part = Part::Text(face.to_owned());
            }
        }
        name
    }

    /// The numbers of the frames that there are, in their order.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn frames(&self) -> std::io::Result<Vec<u64>> {
        let folder = match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut frames = Vec::new();
        for entry in std::fs::read_dir(folder)? {
            frames.extend(self.frame_of(&entry?.file_name()));
        }
        frames.sort_unstable();
        frames.dedup();
        Ok(frames)
    }

    /// The frame whose file has this name.
    fn frame_of(&self, name: &OsString) -> Option<u64> {
        let name = name.to_str()?;
        let number = self
            .parts
            .iter()
            .position(|p| matches!(p, Part::Number(_)))?;
        let before: usize = self.parts[..number]
            .iter()
            .map(|part| match part {
                Part::Text(text) => text.len(),
                _ => 0,
            })
            .sum();
        let digits = name.get(before..)?;
        let end = digits.find(|c: char| !c.is_ascii_digit());
        let frame = digits[..end.unwrap_or(digits.len())].parse().ok()?;
        // Whatever else it takes to be that file: other texts, too few digits, a second number.
        (self.file("", frame).file_name()? == name).then_some(frame)
    }
}

fn parts(name: &str) -> Vec<Part> {
    let (mut parts, mut text, mut rest) = (Vec::new(), String::new(), name);
    while let Some(at) = rest.find('%') {
        let after = &rest[at + 1..];
        let found = if let Some(after) = after.strip_prefix('f') {
            Some((Part::Face, after))
        } else {
            number(after)
        };
        text.push_str(&rest[..at]);
        match found {
            Some((part, after)) => {
                if !text.is_empty() {
                    parts.push(Part::Text(std::mem::take(&mut text)));
                }
                parts.push(part);
                rest = after;
            }
            None => {
                text.push('%');
                rest = after;
            }
        }
    }
    text.push_str(rest);
    if !text.is_empty() {
        parts.push(Part::Text(text));
    }
    parts
}

/// `d` or `04d`, and what follows.
fn number(text: &str) -> Option<(Part, &str)> {
    /// More digits than any frame number has.
    const MOST_DIGITS: usize = 20;
    let (digits, after) = text.split_once('d')?;
    let width = match digits {
        "" => 1,
        _ => digits.strip_prefix('0')?.parse().ok()?,
    };
    (width <= MOST_DIGITS).then_some((Part::Number(width), after))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(text: &str) -> Name {
        Name::new(Path::new(text))
    }

    #[test]
    fn names_stand_for_faces_and_frames() {
        let both = name("a/%f_%04d.png");
        assert!(both.has_face() && both.has_number());
        assert_eq!(both.file("px", 7), Path::new("a/px_0007.png"));
        let right = both.of_face("px");
        assert!(!right.has_face());
        assert_eq!(right.file("", 7), Path::new("a/px_0007.png"));
        assert_eq!(name("%d.png").file("", 123), Path::new("123.png"));
        for plain in ["100%.png", "a%g.png", "%4d.png", "%0999d.png", "x%"] {
            let plain = name(plain);
            assert!(!plain.has_face() && !plain.has_number());
            assert_eq!(plain.file("px", 7), plain.path());
        }
        // In the folder's name it is text.
        assert!(!name("%f/a.png").has_face());
    }

    #[test]
    fn frames_are_those_that_there_are_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        for file in [
            "f_0010.png",
            "f_0009.png",
            "f_10000.png",
            "f_8.png",
            "f_0011.exr",
            "g_0012.png",
            "f_00013.png",
            "f_0x14.png",
        ] {
            std::fs::write(folder.path().join(file), "").unwrap();
        }
        let frames = |text: &str| Name::new(&folder.path().join(text)).frames().unwrap();
        assert_eq!(frames("f_%04d.png"), [9, 10, 10_000]);
        assert_eq!(frames("f_%d.png"), [8, 10_000]);
        assert_eq!(frames("h_%d.png"), [0; 0]);
        assert!(name("no/such/%d.png").frames().is_err());
    }
}
