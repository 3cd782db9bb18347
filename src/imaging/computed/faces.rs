//! The cube's faces with their names: tells which way every map turns its picture.

use super::super::environment::FACE_COLORS;
use super::super::srgb::linear_from_srgb8;
use super::strokes::Strokes;
use super::{blend, coverage};
use crate::mapping::cube_face::{largest_component, to_frame};
use crate::math::Vec3;

/// In the order of the charts.
const NAMES: [&str; 6] = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];

/// On the gnomonic plane, where a face reaches from -1 to 1.
const NAME_HALF_WIDTH: f64 = 0.045;
const MARK_HALF_WIDTH: f64 = 0.02;
const GRID_HALF_WIDTH: f64 = 0.004;
const BORDER_WIDTH: f64 = 0.02;

pub(super) struct Faces {
    names: [Strokes; 6],
    /// Arrows, their letters and the R: the same on every face.
    marks: Strokes,
    colors: [[f32; 3]; 6],
    inks: [[f32; 3]; 6],
}

impl Faces {
    pub(super) fn new() -> Self {
        let colors = FACE_COLORS.map(linear_from_srgb8);
        Self {
            names: NAMES.map(|name| Strokes::new().centered_text(name, [0.0, 0.05], 0.62)),
            marks: Strokes::new()
                .arrow([-0.8, -0.8], [-0.25, -0.8], 0.09)
                .text("u", [-0.18, -0.94], 0.2)
                .arrow([-0.8, -0.8], [-0.8, -0.25], 0.09)
                .text("v", [-0.86, -0.27], 0.2)
                .text("R", [0.62, 0.5], 0.32),
            colors,
            // Black or white, whichever differs more from the face (the luminance where both do alike is 0.18).
            inks: colors.map(|[r, g, b]| {
                let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                if luminance > 0.18 {
                    [0.005; 3]
                } else {
                    [1.0; 3]
                }
            }),
        }
    }

    pub(super) fn color(&self, dir: Vec3<f64>, texel_rad: f64) -> [f32; 3] {
        let face = largest_component(dir);
        let (sc, tc, ma) = to_frame(face, dir);
        let (face, a, b) = (face as usize, sc / ma, tc / ma);
        // An angle dt at distance r from the axis, r^2 = 1 + a^2 + b^2, covers between r dt and r^2 dt of the plane.
        let texel = texel_rad * (1.0 + a * a + b * b).powf(0.75);
        let mut color = self.colors[face];
        let ink = self.inks[face];

        let grid = [a, b].map(|c| ((c * 4.0).round() / 4.0 - c).abs());
        let grid = coverage(grid[0].min(grid[1]), GRID_HALF_WIDTH, texel);
        color = blend(color, ink, 0.3 * grid);

        let reach = NAME_HALF_WIDTH + texel;
        let name = coverage(
            self.names[face].distance([a, b], reach),
            NAME_HALF_WIDTH,
            texel,
        );
        let mark = coverage(self.marks.distance([a, b], reach), MARK_HALF_WIDTH, texel);
        color = blend(color, ink, name.max(mark));

        let border = 1.0 - a.abs().max(b.abs());
        blend(color, [0.005; 3], coverage(border, BORDER_WIDTH, texel))
    }
}
