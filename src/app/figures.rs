//! The seed articles' figures as scenes: one click, or `sixfold figure`.

mod optics;
mod paper;

pub use optics::Optics;
pub use paper::Paper;

use super::action::draw_formula;
use super::picture::What;
use super::state::{AppState, Overlays};

/// A scene with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Of the paper on the continuous cube map.
    Paper(Paper),
    /// Of the notes on cube mapping, and of optics.
    Optics(Optics),
}

impl Figure {
    /// Every figure, in the order of the menu.
    pub fn all() -> impl Iterator<Item = Self> {
        let paper = Paper::ALL.into_iter().map(Self::Paper);
        paper.chain(Optics::ALL.into_iter().map(Self::Optics))
    }

    /// The name on the command line.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Paper(figure) => figure.id(),
            Self::Optics(figure) => figure.id(),
        }
    }

    /// What the menu says.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Paper(figure) => figure.title(),
            Self::Optics(figure) => figure.title(),
        }
    }

    /// The figure of that name.
    #[must_use]
    pub fn from_id(id: &str) -> Option<Self> {
        Self::all().find(|figure| figure.id() == id)
    }

    /// Which part of the window the figure is.
    #[must_use]
    pub const fn what(self) -> What {
        match self {
            Self::Paper(figure) => figure.what(),
            Self::Optics(_) => What::Viewport,
        }
    }

    /// The figure as a picture has it: nothing is drawn over it but what belongs to it.
    #[must_use]
    pub fn bare(self) -> AppState {
        let mut state = AppState {
            overlays: Overlays::NONE,
            ..AppState::default()
        };
        self.show(&mut state);
        state
    }

    /// Turns a state into the figure.
    pub fn show(self, state: &mut AppState) {
        match self {
            Self::Paper(figure) => figure.show(state),
            Self::Optics(figure) => {
                figure.show(state);
                draw_formula(state);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_a_name_of_its_own_and_shows_something_else() {
        let mut shown: Vec<(AppState, What)> = Vec::new();
        for figure in Figure::all() {
            assert_eq!(Figure::from_id(figure.id()), Some(figure));
            let mut state = AppState::default();
            figure.show(&mut state);
            assert_eq!(state.clone().sanitized(), state, "{figure:?}");
            let view = (state, figure.what());
            assert!(!shown.contains(&view), "{figure:?} is shown twice");
            shown.push(view);
        }
        assert_eq!(Figure::from_id("notes-11"), None);
    }

    #[test]
    fn a_figure_is_seen_whatever_was_shown_alone() {
        for before in Figure::all() {
            for figure in Figure::all() {
                let mut state = AppState::default();
                before.show(&mut state);
                figure.show(&mut state);
                let shown = state.maximised;
                let is_seen = match figure.what() {
                    What::Viewport | What::Panels => shown.is_none(),
                    _ => shown.is_some_and(|pane| state.is_open(pane)),
                };
                assert!(is_seen, "{figure:?} after {before:?}: {shown:?}");
            }
        }
    }
}
