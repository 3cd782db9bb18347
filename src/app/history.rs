//! Undo and redo: a list of states.

use super::action::Action;
use super::state::AppState;
use crate::mapping::MappingId;

/// States kept; older ones are forgotten.
const DEPTH: usize = 200;

/// Earlier and later states.
#[derive(Clone, Debug, Default)]
pub struct History {
    earlier: Vec<Entry>,
    later: Vec<Entry>,
    last_kind: Option<Kind>,
}

type Kind = (&'static str, Option<MappingId>);

/// A state to go back to.
#[derive(Clone, Debug)]
struct Entry {
    state: AppState,
    /// Between it and its neighbour lies another scene, so the probe goes back too.
    is_whole: bool,
}

impl Entry {
    /// The state to show after `now`: undo moves no probe, and no arrangement, within a scene.
    fn after(self, now: &AppState) -> AppState {
        if self.is_whole {
            return self.state;
        }
        let same_object = self.state.object == now.object && self.state.model == now.model;
        AppState {
            probe: now.probe,
            probe_follows: now.probe_follows,
            // The ray that found the probe was mirrored by the object that is shown now.
            eye_ray: now.eye_ray.filter(|_| same_object),
            ..self.state
        }
    }
}

impl History {
    /// Remembers `before`, the state that `action` has changed. Actions of one kind in a row are taken back together.
    pub fn record(&mut self, before: AppState, action: &Action) {
        if action.is_transient() {
            return;
        }
        let kind = action.merges_as();
        if kind.is_none() || kind != self.last_kind {
            let is_whole = matches!(action, Action::Load(_));
            self.earlier.push(Entry {
                state: before,
                is_whole,
            });
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

    /// The state before, if there is one.
    pub fn undo(&mut self, now: &AppState) -> Option<AppState> {
        let found = self.earlier.pop()?;
        self.later.push(Entry {
            state: now.clone(),
            is_whole: found.is_whole,
        });
        self.last_kind = None;
        Some(found.after(now))
    }

    /// The state that undo took back.
    pub fn redo(&mut self, now: &AppState) -> Option<AppState> {
        let found = self.later.pop()?;
        self.earlier.push(Entry {
            state: now.clone(),
            is_whole: found.is_whole,
        });
        self.last_kind = None;
        Some(found.after(now))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::apply;

    fn run(history: &mut History, state: &mut AppState, action: Action) {
        let before = state.clone();
        apply(state, action.clone());
        history.record(before, &action);
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

    #[test]
    fn two_panels_are_two_steps_and_another_scene_goes_back_whole() {
        let mut history = History::default();
        let mut state = AppState::default();
        for mapping in [MappingId::Cube, MappingId::Ccm] {
            let view = crate::app::state::PanelState {
                zoom: 3.0,
                ..state.panel(mapping)
            };
            run(&mut history, &mut state, Action::SetPanelView(view));
        }
        let zoomed = history.undo(&state).unwrap();
        assert_eq!(zoomed.panel(MappingId::Cube).zoom, 3.0);
        assert_eq!(zoomed.panel(MappingId::Ccm).zoom, 1.0);
        let mut state = zoomed.clone();
        let other = AppState {
            probe: [0.0, 1.0, 0.0],
            ..AppState::default()
        };
        run(&mut history, &mut state, Action::Load(Box::new(other)));
        assert_eq!(history.undo(&state).unwrap(), zoomed);
    }
}
