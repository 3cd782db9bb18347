//! What of a folded map is the same however it is folded and wherever it is seen from: traced once, off the window's thread.

use super::lines::TracedLine;
use super::view::Corners;
use crate::app::map_lines::map_lines;
use crate::app::state::Overlays;
use crate::imaging::Progress;
use crate::mapping::{MappingId, Unfolding};

/// The pieces and the lines of a mapping.
pub struct Sheet {
    /// Corners of its pieces.
    pub corners: Corners,
    /// Its lines.
    pub lines: Vec<TracedLine>,
}

/// Which lines of which mapping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetWanted {
    /// The mapping.
    pub mapping: MappingId,
    /// What is switched on of its lines, and nothing else.
    lines: Overlays,
}

impl SheetWanted {
    /// With the lines that are switched on.
    pub fn new(mapping: MappingId, overlays: Overlays) -> Self {
        let mut lines = Overlays {
            grid: overlays.grid,
            great_circles: overlays.great_circles,
            ellipses: overlays.ellipses,
            ..Overlays::NONE
        };
        if lines.ellipses {
            lines.ellipses_deg = overlays.ellipses_deg;
        }
        Self { mapping, lines }
    }

    /// Traces the lines; nothing when cancelled.
    pub fn make(&self, progress: &Progress) -> Option<Sheet> {
        let unfolding = Unfolding::new(self.mapping);
        let trace = |line| (!progress.is_cancelled()).then(|| TracedLine::new(&unfolding, &line));
        let lines = map_lines(self.mapping, self.lines).into_iter();
        Some(Sheet {
            corners: Corners::new(self.mapping),
            lines: lines.map(trace).collect::<Option<_>>()?,
        })
    }
}
