//! Six files for the six faces, found by their usual names, and a file for each chart of any mapping.

use std::fs::read_dir;
use std::io;
use std::path::{Path, PathBuf};

use crate::mapping::cube_face::FACES;

/// What stands for the face in the name of a file.
const PLACE: &str = "%f";

/// What comes between a file's own name and the face's.
const SEPARATORS: [char; 4] = ['_', '-', '.', ' '];

/// The usual names in the order +x -x +y -y +z -z; in front is +z.
const SETS: [[&str; 6]; 6] = [
    ["px", "nx", "py", "ny", "pz", "nz"],
    ["posx", "negx", "posy", "negy", "posz", "negz"],
    ["right", "left", "top", "bottom", "front", "back"],
    ["right", "left", "up", "down", "front", "back"],
    ["+x", "-x", "+y", "-y", "+z", "-z"],
    ["rt", "lf", "up", "dn", "ft", "bk"],
];

/// One letter is too little to tell a face from a file's own name, unless its place is given.
const LETTERS: [&str; 6] = ["r", "l", "u", "d", "f", "b"];

/// The name of a chart in a file's name: `px` for `+x`.
pub fn face_name(chart: &str) -> String {
    match chart.split_at_checked(1) {
        Some(("+", axis)) => format!("p{axis}"),
        Some(("-", axis)) => format!("n{axis}"),
        _ => chart.to_owned(),
    }
}

/// What a path stands for.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// Six files.
    Six([PathBuf; 6]),
    /// Itself.
    One,
    /// Itself, although it is named like a face: so a file of the set would be called that is not there.
    Alone(String),
    /// Nothing: its `%f` fits no six files. These of the set that it fits best are not there; none where it fits none.
    Missing(Vec<String>),
}

/// The six files of a path with `%f`, or those beside a file that is named like one of six faces.
///
/// # Errors
/// When the folder of a path with `%f` cannot be read.
pub(super) fn named(path: &Path) -> io::Result<Named> {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
        return Ok(Named::One);
    };
    if let Some((before, after)) = name.split_once(PLACE) {
        let folder = Folder::of(path)?;
        let mut best = Vec::new();
        for set in SETS.iter().chain([&LETTERS]) {
            let missing = folder.missing(before, set, after);
            if missing.is_empty()
                && let Ok(six) = folder.six(before, set, after)
            {
                return Ok(Named::Six(six));
            }
            let is_better = best.is_empty() || missing.len() < best.len();
            if missing.len() < set.len() && is_better {
                best = missing;
            }
        }
        return Ok(Named::Missing(best));
    }
    let (stem, ending) = name.rfind('.').map_or((name, ""), |dot| name.split_at(dot));
    let mut alone = Named::One;
    for set in &SETS {
        let Some((before, label)) = face_in(stem, set) else {
            continue;
        };
        // Where the folder cannot be listed, its file may still open.
        let Ok(folder) = Folder::of(path) else {
            return Ok(Named::One);
        };
        match folder.six(before, set, ending) {
            Ok(mut six) => {
                path.clone_into(&mut six[label]);
                return Ok(Named::Six(six));
            }
            Err(missing) if alone == Named::One => alone = Named::Alone(missing),
            Err(_) => {}
        }
    }
    Ok(alone)
}

/// The files of a path with `%f` for these charts, by the names that an export gives them, or the names of those that are not there;
/// `None` for a path without `%f`.
///
/// # Errors
/// When the folder cannot be read.
pub(super) fn of_charts(
    path: &Path,
    charts: &[&str],
) -> io::Result<Option<Result<Vec<PathBuf>, Vec<String>>>> {
    let name = path.file_name().and_then(|name| name.to_str());
    let Some((before, after)) = name.and_then(|name| name.split_once(PLACE)) else {
        return Ok(None);
    };
    let folder = Folder::of(path)?;
    let (mut files, mut missing) = (Vec::new(), Vec::new());
    for chart in charts.iter().map(|chart| face_name(chart)) {
        match folder.find(before, &chart, after) {
            Some(name) => files.push(folder.path.join(name)),
            None => missing.push(format!("{before}{chart}{after}")),
        }
    }
    Ok(Some(if missing.is_empty() {
        Ok(files)
    } else {
        Err(missing)
    }))
}

/// What stands before a face's name at the end of a stem, and the face.
fn face_in<'a>(stem: &'a str, set: &[&str; 6]) -> Option<(&'a str, usize)> {
    (0..FACES.len()).find_map(|label| {
        let (before, face) = stem.split_at_checked(stem.len().checked_sub(set[label].len())?)?;
        let is_apart = before.is_empty() || before.ends_with(SEPARATORS);
        (is_apart && face.eq_ignore_ascii_case(set[label])).then_some((before, label))
    })
}

/// The names of the files in a folder.
struct Folder<'a> {
    path: &'a Path,
    names: Vec<String>,
}

impl<'a> Folder<'a> {
    fn of(file: &'a Path) -> io::Result<Self> {
        let path = file.parent().unwrap_or(Path::new(""));
        let read = if path.as_os_str().is_empty() {
            Path::new(".")
        } else {
            path
        };
        let names = read_dir(read)?.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut names: Vec<String> = names.collect();
        names.sort_unstable();
        Ok(Self { path, names })
    }

    /// The files of a set, or the name of the first that is missing. Capitals do not matter in the face's name.
    fn six(&self, before: &str, set: &[&str; 6], after: &str) -> Result<[PathBuf; 6], String> {
        let mut six = [const { PathBuf::new() }; 6];
        for (path, face) in six.iter_mut().zip(set) {
            let found = self.find(before, face, after);
            let name = found.ok_or_else(|| format!("{before}{face}{after}"))?;
            *path = self.path.join(name);
        }
        Ok(six)
    }

    /// The names of a set that are not there.
    fn missing(&self, before: &str, set: &[&str; 6], after: &str) -> Vec<String> {
        let faces = set.iter();
        let missing = faces.filter(|face| self.find(before, face, after).is_none());
        missing
            .map(|face| format!("{before}{face}{after}"))
            .collect()
    }

    /// The file of a face.
    fn find(&self, before: &str, face: &str, after: &str) -> Option<&String> {
        self.names.iter().find(|name| {
            let inner = name
                .strip_prefix(before)
                .and_then(|n| n.strip_suffix(after));
            inner.is_some_and(|inner| inner.eq_ignore_ascii_case(face))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_become_letters() {
        assert_eq!(face_name("+x"), "px");
        assert_eq!(face_name("-z"), "nz");
        assert_eq!(face_name("front"), "front");
    }

    #[test]
    fn charts_are_found_by_their_names_and_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("a_back.png"), b"").unwrap();
        let charts = ["front", "back"];
        let missing = of_charts(&path("a_%f.png"), &charts).unwrap();
        assert_eq!(missing, Some(Err(vec!["a_front.png".to_owned()])));
        std::fs::write(path("a_front.png"), b"").unwrap();
        let both = ["a_front.png", "a_back.png"].map(path).to_vec();
        let found = of_charts(&path("a_%f.png"), &charts).unwrap();
        assert_eq!(found, Some(Ok(both)));
        assert_eq!(of_charts(&path("a_front.png"), &charts).unwrap(), None);
    }

    #[test]
    fn what_is_missing_is_of_the_set_that_fits_best() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky_%f.png");
        assert_eq!(named(&path).unwrap(), Named::Missing(Vec::new()));
        for face in ["px", "nx", "py", "pz", "nz", "right"] {
            std::fs::write(folder.path().join(format!("sky_{face}.png")), b"").unwrap();
        }
        let missing = vec!["sky_ny.png".to_owned()];
        assert_eq!(named(&path).unwrap(), Named::Missing(missing));
        std::fs::write(folder.path().join("sky_NY.png"), b"").unwrap();
        assert!(matches!(named(&path).unwrap(), Named::Six(_)));
    }
}
