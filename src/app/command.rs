//! What the panels ask for: changes of the state, and work that reaches beyond it.

use std::path::PathBuf;

use super::action::Action;
use super::picture::PictureRequest;
use crate::imaging::Environment;

/// One wish of the user.
#[derive(Clone, Debug)]
pub enum Command {
    /// Change the state.
    Do(Action),
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// Load surroundings in a job; the state changes when they are there.
    LoadEnvironment(Environment),
    /// Ask for a file to open, in a dialog of the system.
    AskOpen,
    /// Open a scene, a picture that holds a scene, or an environment.
    Open(PathBuf),
    /// Ask where to save the scene, in a dialog of the system.
    AskSaveScene,
    /// Save the scene.
    SaveScene(PathBuf),
    /// Draw a picture in a job, for a file or the clipboard.
    MakePicture(PictureRequest),
    /// Ask for the file of the picture dialog, in a dialog of the system.
    AskPicturePath,
    /// Show or hide the picture dialog.
    ShowPictureDialog(bool),
    /// Stop a running job.
    Cancel(u64),
    /// Take a message away.
    Dismiss(usize),
    /// Put text on the clipboard.
    CopyText(String),
    /// Every panel back to its first place.
    ResetArrangement,
    /// Show one panel alone, or all again.
    Maximise(Option<super::panes::Pane>),
    /// Close the window.
    Quit,
}

impl From<Action> for Command {
    fn from(action: Action) -> Self {
        Self::Do(action)
    }
}
