//! Undo and redo: a list of states.

use super::action::Action;
use super::state::AppState;

/// States kept; older ones are forgotten.
const DEPTH: usize = 200;

/// Earlier and later states.
#[derive(Clone, Debug, Default)]
pub struct History {
    earlier: Vec<AppState>,
    later: Vec<AppState>,
    last_kind: Option<&'static str>,
}

impl History {
    /// Remembers `before`, the state that `action` is about to change. Actions of one kind in a row are taken back together.
    pub fn record(&mut self, before: &AppState, action: &Action) {
        if action.is_transient() {
            return;
        }
        let kind = action.merges_as();
        if kind.is_none() || kind != self.last_kind {
            self.earlier.push(before.clone());
            if self.earlier.len() > DEPTH {
                self.earlier.remove(0);
            }
        }
        self.last_kind = kind;
        self.later.clear();
    }

    /// Ends a run of like actions: the next one is taken back by itself.
    pub fn end_run(&mut self) {
        self.last_kind = None;
    }

    /// The state before, if there is one; the probe stays where it is.
    pub fn undo(&mut self, now: &AppState) -> Option<AppState> {
        let found = self.earlier.pop()?;
        self.later.push(now.clone());
        self.last_kind = None;
        Some(with_probe_of(found, now))
    }

    /// The state that undo took back.
    pub fn redo(&mut self, now: &AppState) -> Option<AppState> {
        let found = self.later.pop()?;
        self.earlier.push(now.clone());
        self.last_kind = None;
        Some(with_probe_of(found, now))
    }

    /// True when there is something to take back.
    pub fn can_undo(&self) -> bool {
        !self.earlier.is_empty()
    }

    /// True when there is something to make again.
    pub fn can_redo(&self) -> bool {
        !self.later.is_empty()
    }
}

fn with_probe_of(mut state: AppState, now: &AppState) -> AppState {
    state.probe = now.probe;
    state.eye_ray = now.eye_ray;
    state.arrangement.clone_from(&now.arrangement);
    state
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::apply;
    use crate::mapping::MappingId;

    fn run(history: &mut History, state: &mut AppState, action: Action) {
        history.record(state, &action);
        apply(state, action);
    }

    #[test]
    fn a_drag_is_taken_back_at_once_and_made_again() {
        let mut history = History::default();
        let mut state = AppState::default();
        let first = state.clone();
        for _ in 0..5 {
            run(
                &mut history,
                &mut state,
                Action::Orbit {
                    dx_rad: 0.1,
                    dy_rad: 0.0,
                },
            );
        }
        let turned = state.clone();
        run(
            &mut history,
            &mut state,
            Action::SetMapping(MappingId::Cube),
        );
        state = history.undo(&state).unwrap();
        assert_eq!(state, turned);
        state = history.undo(&state).unwrap();
        assert_eq!(state, first);
        assert!(history.undo(&state).is_none());
        state = history.redo(&state).unwrap();
        assert_eq!(state, turned);
        run(&mut history, &mut state, Action::SetMapping(MappingId::Eac));
        assert!(
            !history.can_redo(),
            "a new change ends what could be made again"
        );
    }

    #[test]
    fn moves_of_the_probe_are_not_undone() {
        let mut history = History::default();
        let mut state = AppState::default();
        run(
            &mut history,
            &mut state,
            Action::SetMapping(MappingId::Cube),
        );
        run(
            &mut history,
            &mut state,
            Action::SetProbe {
                dir: [1.0, 0.0, 0.0],
                eye_ray: None,
            },
        );
        state = history.undo(&state).unwrap();
        assert_eq!(state.probe, [1.0, 0.0, 0.0]);
        assert_ne!(state.mapping, MappingId::Cube);
    }
}
