//! What the last call drew and what it could leave out.

use std::fmt;

use super::plan::Node;
use super::program::Work;

/// What the last [`draw`](super::Renderer::draw) did, and what there is now.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Drawn by the last call, in this order.
    pub ran: Vec<Node>,
    /// Seen, and right as they were.
    pub skipped: Vec<Node>,
    /// Seen, but left for the next call: draw again soon.
    pub pending: Vec<Node>,
    /// What a pixel of the object costs, left and right of the divider; empty while no object is seen.
    pub object: Vec<Work>,
    /// Sums over all calls.
    pub totals: Totals,
    /// Pipelines alive.
    pub pipelines: usize,
    /// Textures alive.
    pub textures: usize,
    /// What the textures alive take, in bytes.
    pub texture_bytes: u64,
}

/// Sums over all calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Calls that sent work to the device.
    pub submissions: u64,
    /// Maps filled.
    pub map_bakes: u64,
    /// Viewports drawn.
    pub viewport_draws: u64,
    /// Panels drawn.
    pub panel_draws: u64,
    /// Nodes that were seen and needed no work.
    pub skipped: u64,
}

impl Report {
    /// True when the next call has work left over from this one.
    #[must_use]
    pub fn is_pending(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Enters what a call did.
    pub(super) fn enter(&mut self, ran: Vec<Node>, skipped: Vec<Node>, pending: Vec<Node>) {
        for node in &ran {
            match node {
                Node::Map(_) => self.totals.map_bakes += 1,
                Node::Viewport => self.totals.viewport_draws += 1,
                Node::Panel(_) => self.totals.panel_draws += 1,
            }
        }
        self.totals.submissions += u64::from(!ran.is_empty());
        self.totals.skipped += skipped.len() as u64;
        (self.ran, self.skipped, self.pending) = (ran, skipped, pending);
    }
}

impl fmt::Display for Report {
    /// One line, such as `drew viewport; kept 7; 2 waiting; 9 pipelines, 12 textures, 34.1 MB`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("drew ")?;
        if self.ran.is_empty() {
            f.write_str("nothing")?;
        }
        for (i, node) in self.ran.iter().enumerate() {
            write!(f, "{}{node}", if i > 0 { ", " } else { "" })?;
        }
        write!(f, "; kept {}", self.skipped.len())?;
        for (i, work) in self.object.iter().enumerate() {
            write!(f, "{}{work}", if i > 0 { " | " } else { "; object: " })?;
        }
        if self.is_pending() {
            write!(f, "; {} waiting", self.pending.len())?;
        }
        write!(
            f,
            "; {} pipelines, {} textures, {:.1} MB",
            self.pipelines,
            self.textures,
            self.texture_bytes as f64 / 1e6
        )
    }
}
