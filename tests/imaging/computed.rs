//! Computed environments lie where the spec puts them.

use std::f64::consts::{PI, TAU};

use sixfold::imaging::computed::{self, Pattern, dodecahedron_vertices, icosahedron_vertices};
use sixfold::imaging::load::{self, LoadProblem};
use sixfold::imaging::srgb::linear_from_srgb8;
use sixfold::imaging::{FACE_COLORS, Image, Progress};
use sixfold::math::Vec3;

fn picture(pattern: Pattern, height: u32) -> Image {
    computed::compute(pattern, height, &Progress::new()).unwrap()
}

/// The spec's forward map, written here again.
fn uv([x, y, z]: [f64; 3]) -> (f64, f64) {
    let n = (x * x + y * y + z * z).sqrt();
    (0.5 + x.atan2(z) / TAU, (y / n).acos() / PI)
}

#[test]
fn labelled_faces_lie_where_latlong_puts_them() {
    let image = picture(Pattern::LabelledFaces, 256);
    // Off the axis, where no letter stands: a = 0.1, b = 0.65 or the like.
    let probes = [
        [1.0, 0.1, 0.62],
        [-1.0, 0.1, 0.62],
        [0.1, 1.0, -0.62],
        [0.1, -1.0, -0.62],
        [0.1, -0.62, 1.0],
        [0.1, -0.62, -1.0],
    ];
    let count_right = |flip: bool| {
        (0..6)
            .filter(|&face| {
                let (u, v) = uv(probes[face]);
                let color = image.nearest(if flip { 1.0 - u } else { u }, v);
                color == linear_from_srgb8(FACE_COLORS[face])
            })
            .count()
    };
    assert_eq!(count_right(false), 6);
    // Mirrored, +x and -x change places, so four stay at most.
    assert!(count_right(true) <= 4, "the mirrored control looks alike");
    // The brief form of the same: the middle is +z, a quarter to the right is +x.
    let middle = |u: f64| image.nearest(u, 0.37);
    assert_eq!(middle(0.53), linear_from_srgb8(FACE_COLORS[4]));
    assert_eq!(middle(0.78), linear_from_srgb8(FACE_COLORS[0]));
    assert_ne!(middle(0.78), linear_from_srgb8(FACE_COLORS[1]));
}

/// Whether (a, b) of a face, a to the right and b down as seen from inside, is white (+z) or black (all others).
fn has_ink(image: &Image, face: usize, a: f64, b: f64) -> bool {
    let dir = [
        [1.0, -b, -a],
        [-1.0, -b, a],
        [a, 1.0, b],
        [a, -1.0, -b],
        [a, -b, 1.0],
        [-a, -b, -1.0],
    ];
    let (u, v) = uv(dir[face]);
    let [r, g, _] = image.nearest(u, v);
    if face == 4 { r > 0.5 } else { r + g < 0.1 }
}

#[test]
fn letters_read_correctly_from_inside() {
    let image = picture(Pattern::LabelledFaces, 512);
    for face in 0..6 {
        // The R: its stem is on the left, its bowl on the upper right, and right of its waist is nothing.
        let (left, top, size) = (0.62, 0.5, 0.32);
        let at = |x: f64, y: f64| has_ink(&image, face, left + x * size, top + y * size);
        let is_r =
            |x: &dyn Fn(f64) -> f64| at(x(0.0), 0.75) && at(x(0.6), 0.25) && !at(x(0.6), 0.7);
        assert!(is_r(&|x| x), "face {face}");
        assert!(
            !is_r(&|x| 0.6 - x),
            "the mirrored letter reads as well on face {face}"
        );
        // The u arrow runs right from the upper left corner, the v arrow down.
        let ink = |a, b| has_ink(&image, face, a, b);
        assert!(ink(-0.5, -0.8) && ink(-0.8, -0.5), "face {face}");
        assert!(!ink(0.5, -0.8) && !ink(-0.8, 0.5), "face {face}");
    }
}

#[test]
fn direction_color_is_the_inverse_of_latlong() {
    let image = picture(Pattern::DirectionColor, 64);
    let worst = |flip_v: bool| {
        let mut worst = 0.0_f64;
        for y in 0..64 {
            for x in 0..128 {
                let rgb = image.texel(x, y).unwrap();
                let dir = rgb.map(|c| 2.0 * f64::from(c) - 1.0);
                let (u, v) = uv(dir);
                let v = if flip_v { 1.0 - v } else { v };
                let du = u - (f64::from(x) + 0.5) / 128.0;
                let dv = v - (f64::from(y) + 0.5) / 64.0;
                worst = worst.max(du.abs()).max(dv.abs());
            }
        }
        worst
    };
    // f32 storage: half an ULP of 1 in each component, over the sine of the first row's colatitude (0.025) and 2 pi.
    // Observed 5.2e-7.
    let observed = worst(false);
    assert!(observed < 2e-6, "{observed}");
    assert!(
        observed > 2e-8,
        "the budget is far above the error: {observed}"
    );
    assert!(worst(true) > 0.4);
}

#[test]
fn crosses_stand_at_dual_vertices() {
    let [twelve, twenty] = [icosahedron_vertices(), dodecahedron_vertices()]
        .map(|vertices| vertices.into_iter().map(Vec3::to_f64).collect::<Vec<_>>());
    assert_eq!((twelve.len(), twenty.len()), (12, 20));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // Circumradius over inradius of the icosahedron: three corners at cosine 0.79465 around each face's middle.
    let around = |a: &[[f64; 3]], b: [f64; 3], cosine: f64| {
        a.iter()
            .filter(|a| (dot(**a, b) - cosine).abs() < 1e-12)
            .count()
    };
    let inradius = ((5.0 + 2.0 * 5.0_f64.sqrt()) / 15.0).sqrt();
    assert!(twenty.iter().all(|v| around(&twelve, *v, inradius) == 3));
    assert!(twelve.iter().all(|v| around(&twenty, *v, inradius) == 5));
    // The other orientation of the dodecahedron, (0, ±1/phi, ±phi), is not dual.
    assert!(
        !twenty
            .iter()
            .all(|&[x, y, z]| around(&twelve, [y, x, z], inradius) == 3)
    );

    let image = picture(Pattern::IcosahedronCrosses, 512);
    let is = |dir: [f64; 3], channel: usize| {
        let (u, v) = uv(dir);
        let rgb = image.nearest(u, v);
        rgb[channel] > 0.5 && rgb[2 - channel] < 0.1
    };
    assert!(twelve.iter().all(|v| is(*v, 0)) && twenty.iter().all(|v| is(*v, 2)));
    assert!(!twelve.iter().any(|v| is(*v, 2)) && !twenty.iter().any(|v| is(*v, 0)));
    // Equal angular size: ink reaches 4.8 degrees from the centre up and to the side, not 5.3.
    let reaches = |degrees: f64| {
        twelve.iter().chain(&twenty).all(|&[x, y, z]| {
            let east = [z, 0.0, -x].map(|c| c / x.hypot(z));
            let angle = degrees.to_radians();
            let side = [0, 1, 2].map(|i| [x, y, z][i] * angle.cos() + east[i] * angle.sin());
            let up = (y.asin() + angle).sin_cos();
            let up = [x / x.hypot(z) * up.1, up.0, z / x.hypot(z) * up.1];
            [side, up].iter().all(|dir| {
                let (u, v) = uv(*dir);
                image.nearest(u, v)[1] < 0.4
            })
        })
    };
    assert!(reaches(4.8) && !reaches(5.4));
}

#[test]
fn the_graticule_has_its_lines() {
    let image = picture(Pattern::Graticule, 720);
    let dark = |lon: f64, lat: f64| {
        let rgb = image.nearest(0.5 + lon / 360.0, 0.5 - lat / 180.0);
        rgb[1] < 0.6
    };
    for step in -5..=5 {
        let line = f64::from(step) * 15.0;
        assert!(dark(52.5, line), "parallel {line}");
        assert!(dark(line + 0.01, 52.5), "meridian {line}");
        assert!(
            !dark(line + 7.5, 52.5) && !dark(52.5, line + 7.5),
            "off the lines at {line}"
        );
    }
    let prime = image.nearest(0.5, 0.3);
    assert!(prime[2] > 3.0 * prime[0], "meridian 0 is blue");
    let equator = image.nearest(0.52, 0.5);
    assert!(equator[0] > 3.0 * equator[2], "the equator is vermilion");
    let date_line = image.nearest(0.0, 0.3);
    assert!(
        date_line[2] < 1.5 * date_line[0],
        "the date line is not meridian 0"
    );
}

#[test]
fn sizes_out_of_range_and_cancelling_end_in_messages() {
    let fresh = Progress::new();
    for height in [0, load::MOST_HEIGHT + 1, u32::MAX] {
        let result = computed::compute(Pattern::DirectionColor, height, &fresh);
        assert!(
            matches!(result, Err(LoadProblem::TooLarge { .. })),
            "{height}"
        );
    }
    assert!(computed::compute(Pattern::Graticule, 1, &fresh).is_ok());
    let cancelled = Progress::new();
    cancelled.cancel();
    let result = computed::compute(Pattern::Graticule, 64, &cancelled);
    assert!(matches!(result, Err(LoadProblem::Cancelled)));
}
