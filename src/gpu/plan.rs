//! What a frame makes necessary: a pure comparison of what was drawn with what is to be seen.
//!
//! The graph is environment -> maps -> viewport and panels. A node runs only when something that it depends on has changed
//! and something visible needs it.

use std::collections::BTreeMap;
use std::fmt;

use super::frame::{Frame, Look, PanelFrame, ViewportFrame};
use super::map::map_size;
use crate::mapping::MappingId;
use crate::math::Rotation;

/// Something that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    /// One mapping's texture, filled from the environment.
    Map(MappingId),
    /// The mirror object before its environment.
    Viewport,
    /// One mapping's charts, unfolded.
    Panel(MappingId),
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Map(id) => write!(f, "map {id}"),
            Self::Viewport => f.write_str("viewport"),
            Self::Panel(id) => write!(f, "panel {id}"),
        }
    }
}

/// What a map's texels depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MapKey {
    /// Number of the environment.
    pub environment: u64,
    /// Width and height of a chart in texels.
    pub size: [u32; 2],
    /// How the environment is turned.
    pub rotation: Rotation,
    /// Whether it is a cube, too.
    pub as_cube: bool,
}

/// What the viewport's pixels depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ViewportKey {
    frame: ViewportFrame,
    look: Look,
    samples: u32,
    maps: Vec<MapKey>,
}

/// What a panel's pixels depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PanelKey {
    frame: PanelFrame,
    look: Look,
    map: MapKey,
}

/// What has been drawn, each with what it depended on.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawn {
    pub maps: BTreeMap<MappingId, MapKey>,
    pub viewport: Option<ViewportKey>,
    pub panels: BTreeMap<MappingId, PanelKey>,
}

/// Puts back what stood under `id` before.
fn restore<T: Clone>(
    now: &mut BTreeMap<MappingId, T>,
    before: &BTreeMap<MappingId, T>,
    id: MappingId,
) {
    match before.get(&id) {
        Some(old) => {
            now.insert(id, old.clone());
        }
        None => {
            now.remove(&id);
        }
    }
}

/// What a frame makes necessary.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    /// To be drawn now, in this order.
    pub run: Vec<Node>,
    /// Seen, and right as they are.
    pub skipped: Vec<Node>,
    /// Seen, but left for a later call.
    pub pending: Vec<Node>,
    /// What will have been drawn after this; what is not seen is missing from it.
    pub drawn: Drawn,
}

impl Plan {
    /// Compares. `frame` is normalized, `samples` the viewport's in a pixel; without an environment nothing can be drawn.
    pub fn new(drawn: &Drawn, frame: &Frame, samples: u32, environment: Option<u64>) -> Self {
        let mut plan = Self::default();
        let Some(environment) = environment else {
            return plan;
        };
        plan.maps(drawn, frame, environment);
        let look = frame.look();
        if let Some(viewport) = frame.viewport.clone() {
            plan.viewport(drawn, viewport, samples, look);
        }
        for panel in &frame.panels {
            plan.panel(drawn, *panel, look);
        }
        plan
    }

    fn maps(&mut self, drawn: &Drawn, frame: &Frame, environment: u64) {
        let mut room = if frame.complete { usize::MAX } else { 1 };
        for id in frame.mappings() {
            let node = Node::Map(id);
            let wanted = MapKey {
                environment,
                size: map_size(id, frame.texel_budget),
                rotation: frame.rotation,
                as_cube: frame.looks_up_cube(id),
            };
            let present = drawn.maps.get(&id).copied();
            let list = if present == Some(wanted) {
                &mut self.skipped
            } else if room > 0 {
                room -= 1;
                &mut self.run
            } else {
                &mut self.pending
            };
            list.push(node);
            // A map that must wait is shown as it was.
            let will_be = if self.pending.last() == Some(&node) {
                present
            } else {
                Some(wanted)
            };
            if let Some(key) = will_be {
                self.drawn.maps.insert(id, key);
            }
        }
    }

    /// Takes nodes back whose shaders are still being compiled: they stay as they were `drawn` and are pending.
    pub fn hold_back(&mut self, held: &[Node], drawn: &Drawn) {
        self.run.retain(|node| !held.contains(node));
        for node in held {
            match node {
                Node::Map(id) => restore(&mut self.drawn.maps, &drawn.maps, *id),
                Node::Viewport => self.drawn.viewport.clone_from(&drawn.viewport),
                Node::Panel(id) => restore(&mut self.drawn.panels, &drawn.panels, *id),
            }
            self.pending.push(*node);
        }
    }

    fn viewport(&mut self, drawn: &Drawn, frame: ViewportFrame, samples: u32, look: Look) {
        let maps: Option<Vec<MapKey>> = frame
            .mappings()
            .map(|id| self.drawn.maps.get(&id).copied())
            .collect();
        let Some(maps) = maps else {
            self.pending.push(Node::Viewport);
            self.drawn.viewport.clone_from(&drawn.viewport);
            return;
        };
        let key = Some(ViewportKey {
            frame,
            look,
            samples,
            maps,
        });
        let list = if key == drawn.viewport {
            &mut self.skipped
        } else {
            &mut self.run
        };
        list.push(Node::Viewport);
        self.drawn.viewport = key;
    }

    fn panel(&mut self, drawn: &Drawn, frame: PanelFrame, look: Look) {
        let id = frame.mapping;
        let before = drawn.panels.get(&id);
        let Some(&map) = self.drawn.maps.get(&id) else {
            self.pending.push(Node::Panel(id));
            return;
        };
        let key = PanelKey { frame, look, map };
        let list = if Some(&key) == before {
            &mut self.skipped
        } else {
            &mut self.run
        };
        list.push(Node::Panel(id));
        self.drawn.panels.insert(id, key);
    }
}
