//! What is painted over the environment, and its colours.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use crate::imaging::FACE_COLORS;
use crate::mapping::cube_face::GREAT_CIRCLES;

/// Colours of the great circles A to F, sRGB. The palette of Okabe and Ito (Color universal design, 2008), which people
/// with any kind of colour blindness can tell apart, without its black and its dark blue.
pub const GREAT_CIRCLE_COLORS: [[u8; 3]; 6] = [
    [230, 159, 0],   // A orange
    [86, 180, 233],  // B sky blue
    [0, 158, 115],   // C bluish green
    [240, 228, 66],  // D yellow
    [213, 94, 0],    // E vermilion
    [204, 121, 167], // F reddish purple
];

/// What is painted over the environment; all off by default. The axes, the probe's vectors and all text are the front end's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct Overlays {
    /// The six great circles in [`GREAT_CIRCLE_COLORS`].
    pub great_circles: bool,
    /// The tint of the face that the sign table picks, in [`FACE_COLORS`].
    pub face_tint: bool,
    /// Lines of equal u and v of the mapping that is looked up, at every eighth.
    pub grid: bool,
}

impl Overlays {
    /// As the panels' shader reads it: great circles, face tint, grid.
    pub(super) fn switches(self) -> [f32; 4] {
        let on = |switch: bool| f32::from(u8::from(switch));
        [
            on(self.great_circles),
            on(self.face_tint),
            on(self.grid),
            0.0,
        ]
    }
}

/// What `shaders/overlay.wgsl` takes from here. Written out instead of arrays: an index into an array of constants makes
/// some compilers copy the array for each pixel.
pub(super) fn wgsl_constants() -> String {
    let vector = |[x, y, z]: [f32; 3]| format!("vec3f({x:?}, {y:?}, {z:?})");
    let color = |c: [u8; 3]| vector(c.map(|x| f32::from(x) / 255.0));
    let mut text = String::from("fn face_color(face: u32) -> vec3f {\n    switch face {\n");
    for (face, tint) in FACE_COLORS.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "        case {face}u: {{ return {}; }}", color(*tint));
    }
    text += "        default: { return vec3f(0.0); }\n    }\n}\n\n\
             fn paint_great_circles(under: vec3f, dir: vec3f, right: vec3f, down: vec3f) -> vec3f {\n    \
             var color = under;\n";
    for ((_, normal), paint) in GREAT_CIRCLES.iter().zip(GREAT_CIRCLE_COLORS) {
        let normal = normal.map(|x| f32::from(x) * std::f32::consts::FRAC_1_SQRT_2);
        let _ = writeln!(
            text,
            "    color = paint_great_circle(color, {}, {}, dir, right, down);",
            color(paint),
            vector(normal)
        );
    }
    text + "    return color;\n}\n"
}
