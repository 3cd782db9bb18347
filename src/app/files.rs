//! Files that the window opens: scenes, pictures that hold a scene, environments.

use std::io::Read;
use std::path::{Path, PathBuf};

use super::dialogs::{Dialog, PictureDialog, SaveDialog};
use super::state::AppState;
use crate::imaging::png_out::{self, MOST_SCENE_BYTES};
use crate::imaging::{Environment, open_regular};

/// What a file turned out to be.
#[derive(Debug)]
pub enum Opened {
    /// A scene.
    Scene(Box<AppState>),
    /// Something to be loaded as surroundings.
    Environment(Environment),
    /// A model.
    Model(PathBuf),
}

/// Looks into a file: a scene as text or inside a PNG, else an environment. What the file holds decides, not its name.
///
/// # Errors
/// One line that says what is wrong with the file.
pub fn open(path: &Path) -> Result<Opened, String> {
    let scene = |text: &str| {
        AppState::from_json(text)
            .map(|state| Opened::Scene(Box::new(state)))
            .map_err(|error| format!("{error}: {}", path.display()))
    };
    let failed =
        |error: std::io::Error| format!("the file cannot be read ({error}): {}", path.display());
    let mut start = Vec::new();
    let file = open_regular(path).map_err(failed)?;
    file.take(SNIFFED_BYTES)
        .read_to_end(&mut start)
        .map_err(failed)?;
    if start.starts_with(b"\x89PNG") {
        // A PNG without a scene may still be an environment, and a damaged one is reported by whoever decodes it.
        return match png_out::read_scene(path) {
            Ok(Some(text)) => scene(&text),
            _ => Ok(environment(path)),
        };
    }
    // A glTF text is JSON like a scene, and an OBJ is any text: here the name decides.
    let is_model = |e: &std::ffi::OsStr| {
        let model = ["obj", "gltf", "glb"];
        model.iter().any(|name| e.eq_ignore_ascii_case(name))
    };
    if path.extension().is_some_and(is_model) || start.starts_with(b"glTF") {
        return Ok(Opened::Model(absolute(path)));
    }
    let is_json = start.iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'{');
    let says_json = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json"));
    if is_json || says_json {
        scene(&read_text(path)?)
    } else {
        Ok(environment(path))
    }
}

/// Bytes from which the kind of a file is told.
const SNIFFED_BYTES: u64 = 64;

/// The scene in a file.
///
/// # Errors
/// One line that says why there is none.
pub fn open_scene(path: &Path) -> Result<AppState, String> {
    match open(path)? {
        Opened::Scene(state) => Ok(*state),
        Opened::Model(path) => Ok(AppState {
            model: Some(path),
            ..AppState::default()
        }),
        Opened::Environment(environment) => Ok(AppState {
            environment,
            ..AppState::default()
        }),
    }
}

fn environment(path: &Path) -> Opened {
    Opened::Environment(Environment::File(absolute(path).into()))
}

/// A path of its own: a scene that is opened from elsewhere must find the file again.
pub(super) fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

fn read_text(path: &Path) -> Result<String, String> {
    let describe =
        |error: std::io::Error| format!("the scene cannot be read ({error}): {}", path.display());
    let file = open_regular(path).map_err(describe)?;
    let mut text = String::new();
    file.take(MOST_SCENE_BYTES as u64 + 1)
        .read_to_string(&mut text)
        .map_err(describe)?;
    if text.len() > MOST_SCENE_BYTES {
        return Err(format!(
            "a scene has at most {MOST_SCENE_BYTES} bytes, this file has more: {}",
            path.display()
        ));
    }
    Ok(text)
}

/// Asks for a path in a dialog of the system; waits for the answer, so it runs on a thread of its own. `None` when the user
/// declined or the system has no dialog.
pub fn ask(dialog: &Dialog) -> Option<PathBuf> {
    let files = rfd::FileDialog::new();
    match dialog {
        Dialog::Open(_) => files
            .add_filter(
                "environments, models and scenes",
                &[
                    "hdr", "exr", "png", "jpg", "jpeg", "ktx2", "dds", "obj", "gltf", "glb", "json",
                ],
            )
            .pick_file(),
        Dialog::OpenBall(_) => files
            .add_filter("pictures", &["png", "jpg", "jpeg", "hdr", "exr"])
            .pick_file(),
        Dialog::Export(export) => files.set_file_name(&export.path).save_file(),
        Dialog::SaveScene(_) => files.set_file_name(SaveDialog::default().path).save_file(),
        Dialog::SaveBench(_) => files.pick_folder(),
        Dialog::Reading(_) => None,
        Dialog::Picture(_) => files
            .set_file_name(PictureDialog::default().path)
            .save_file(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_comes_back_from_text_and_from_a_picture() {
        let folder = tempfile::tempdir().unwrap();
        let state = AppState {
            divider: 0.25,
            ..AppState::default()
        };
        let text = folder.path().join("no extension");
        std::fs::write(&text, state.to_json().unwrap()).unwrap();
        assert_eq!(open_scene(&text).unwrap(), state);
        let picture = folder.path().join("b.png");
        let json = state.to_json().unwrap();
        let bytes = png_out::encode_png(1, 1, &[1, 2, 3, 255], Some(&json)).unwrap();
        std::fs::write(&picture, bytes).unwrap();
        assert_eq!(open_scene(&picture).unwrap(), state);
    }

    #[test]
    fn other_files_are_environments_or_refused_in_one_line() {
        let folder = tempfile::tempdir().unwrap();
        let bad = folder.path().join("bad.json");
        std::fs::write(&bad, "{ not a scene").unwrap();
        let why = open(&bad).unwrap_err();
        assert!(why.contains("bad.json") && !why.contains('\n'), "{why}");
        assert!(open(&folder.path().join("missing.json")).is_err());
        let sky = folder.path().join("sky.exr");
        std::fs::write(&sky, b"v/1\x01").unwrap();
        let other = open(&sky).unwrap();
        assert!(matches!(other, Opened::Environment(Environment::File(_))));
    }
}
