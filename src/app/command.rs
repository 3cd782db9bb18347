//! What the panels ask for: changes of the state, and work that reaches beyond it.

use std::path::PathBuf;

use super::action::Action;
use super::dialogs::Dialog;
use super::export::Export;
use super::figures::Figure;
use super::picture::PictureRequest;
use crate::imaging::{Environment, MapFile};

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
    /// Load the map of a file as the dialog that is shown has it, in a job.
    LoadFile(MapFile),
    /// Show a dialog in the window.
    ShowDialog(Dialog),
    /// Ask for the path of the dialog that is shown, in a dialog of the system.
    Browse,
    /// Open a scene, a picture that holds a scene, or an environment.
    Open(PathBuf),
    /// Show a figure.
    ShowFigure(Figure),
    /// Save the scene.
    SaveScene {
        /// The file.
        path: PathBuf,
        /// Replace it if it is there.
        force: bool,
    },
    /// Draw a picture in a job, for a file or the clipboard.
    MakePicture(PictureRequest),
    /// Show the dialog that exports the environment, as it was used last.
    ShowExport,
    /// Write the environment for another program, in a job.
    Export(Box<Export>),
    /// Stop a running job.
    Cancel(u64),
    /// Measure again what was given up.
    MeasureLoss,
    /// Ask every evaluator of the selected mapping where it breaks, in a job.
    MeasureStability,
    /// Measure run time and error of the evaluators that the laboratory shows, in a job.
    MeasureEvaluators,
    /// Measure on what of the ranking is missing, after it was cancelled.
    MeasureRanking,
    /// Write what was measured into a folder, in a job.
    SaveBench {
        /// The folder.
        folder: PathBuf,
        /// Replace files that are there.
        force: bool,
    },
    /// Take a message away.
    Dismiss(usize),
    /// Put text on the clipboard.
    CopyText(String),
    /// Every panel back to its first place.
    ResetArrangement,
    /// Close the window.
    Quit,
}

impl From<Action> for Command {
    fn from(action: Action) -> Self {
        Self::Do(action)
    }
}
