//! Centres and scales a model into the unit ball, and leaves out triangles without area.

use glam::{DVec3, Vec3};

use super::error::MeshProblem;
use super::raw::{Corner, Raw};

/// Positions are rounded to multiples of this, the spacing of f32 just below 1: within the unit ball that is as good as f32
/// gives everywhere, and corners that differ by rounding only (the poles of a sphere, where sin 180 degrees is 1e-16)
/// become one.
const SPACING: f64 = 1.0 / (1 << 24) as f64;

/// A triangle whose height is at most this has no direction: rounding moves its corners by up to half of it.
const THINNEST: f64 = 2.0 * SPACING;

/// The positions in the world's left-handed frame, centred and scaled; those of no triangle may lie anywhere. Triangles
/// without area are taken out of `raw`.
///
/// The box is that of the triangles that are kept, so the second round fits again without what the first one left out.
pub(super) fn fit(raw: &mut Raw) -> Result<Vec<Vec3>, MeshProblem> {
    let declared = raw.triangles.len();
    loop {
        let before = raw.triangles.len();
        let points = fitted(&raw.positions, &raw.triangles).ok_or_else(|| empty(raw, declared))?;
        raw.triangles.retain(|triangle| {
            let [a, b, c] = triangle.map(|corner| points[corner.position as usize].as_dvec3());
            !is_thin(a, b, c)
        });
        if raw.triangles.is_empty() {
            return Err(empty(raw, declared));
        }
        // A third round would only move what rounding moves.
        if raw.triangles.len() == before || before < declared {
            return Ok(points);
        }
    }
}

/// `None` when all corners lie in one place, or there are none.
///
/// All in f64, and divided by the half extent before any square: every size that f32 has fits.
fn fitted(positions: &[DVec3], triangles: &[[Corner; 3]]) -> Option<Vec<Vec3>> {
    let corners = || {
        let corners = triangles.iter().flatten();
        corners.map(|corner| positions[corner.position as usize])
    };
    let low = corners().reduce(DVec3::min)?;
    let high = corners().reduce(DVec3::max)?;
    let centre = (low + high) / 2.0;
    let half_extent = ((high - low) / 2.0).max_element();
    if half_extent <= 0.0 {
        return None;
    }
    let relative = |position: DVec3| (position - centre) / half_extent;
    let radius = corners()
        .map(|position| relative(position).length())
        .fold(0.0, f64::max);
    let rounded = |x: f64| (x / SPACING).round() * SPACING;
    // The one place where right-handed becomes left-handed: z changes its sign (and `Surface::welded` the winding).
    let world = |position: DVec3| relative(position) / radius * DVec3::new(1.0, 1.0, -1.0);
    // Adding zero makes negative zeros positive, so that equal positions have equal bits.
    let points = positions
        .iter()
        .map(|&p| world(p).map(rounded).as_vec3() + Vec3::ZERO);
    Some(points.collect())
}

/// Height over the longest edge, by twice the area.
fn is_thin(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).cross(c - a).length() <= longest * THINNEST
}

fn empty(raw: &Raw, declared: usize) -> MeshProblem {
    let what = match (declared, raw.skipped) {
        (0, 0) => "it has no faces".to_owned(),
        (0, skipped) => format!("it has {skipped} primitives of points or lines"),
        (declared, _) => format!("all of its {declared} have corners in one place or one line"),
    };
    MeshProblem::Empty { what }
}
