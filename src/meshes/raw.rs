//! What a file holds before it is mended: points, normals and triangles in the file's own right-handed frame.

use glam::{DVec3, Vec3};

use super::error::{MeshProblem, judge};
use super::{MOST_TRIANGLES, MOST_VERTICES};

/// One corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    /// Number of its position.
    pub position: u32,
    /// Number of its normal, where it has one.
    pub normal: Option<u32>,
}

/// A model as read. Its vectors grow only through the judged methods, so that limits hold for every format.
#[derive(Debug, Default)]
pub(super) struct Raw {
    /// Finite, within the range of f32.
    pub positions: Vec<DVec3>,
    /// As they stand in the file: not judged, not unit.
    pub normals: Vec<Vec3>,
    /// Counter-clockwise as seen from outside, as both formats have it.
    pub triangles: Vec<[Corner; 3]>,
    /// Meshes or objects that brought triangles.
    pub parts: usize,
    /// Points, lines and other primitives that are no triangles.
    pub skipped: usize,
    /// What else the user should know.
    pub notes: Vec<String>,
}

impl Raw {
    /// Makes sure that `count` more positions stay within the limit.
    pub fn judge_positions(&self, count: u64) -> Result<(), MeshProblem> {
        let count = (self.positions.len() as u64).saturating_add(count);
        judge("vertices", count, MOST_VERTICES)
    }

    /// Makes sure that `count` more triangles stay within the limit.
    pub fn judge_triangles(&self, count: u64) -> Result<(), MeshProblem> {
        let count = (self.triangles.len() as u64).saturating_add(count);
        judge("triangles", count, MOST_TRIANGLES)
    }

    /// Adds a position; false when it is not finite as an f32. Judge the count first.
    #[must_use]
    pub fn add_position(&mut self, position: DVec3) -> bool {
        // NaN fails the comparison.
        let is_finite = position.abs().max_element() <= f64::from(f32::MAX) && !position.is_nan();
        if is_finite {
            self.positions.push(position);
        }
        is_finite
    }
}
