//! Appendix B (and its inverse, Appendix C) with the definitions filled in that the print lacks.
//!
//! On the y faces it is the shader's map (turned by half a turn on -y); on the x and z faces it puts the pole on another
//! axis, so a picture made by one form is up to 0.0191 of a face wrong under the other.

use super::{across_edge, along_edge, from_edge};
use crate::mapping::ChartPoint;
use crate::mapping::cube_face::sign_table;
use crate::math::{Real, Vec3};

/// The paper's case of each chart (+x -x +y -y +z -z).
const CASE_OF_CHART: [u32; 6] = [2, 3, 0, 1, 4, 5];

/// The components that play x, y and z of the first case: the cases step through them cyclically.
fn cycle<R: Real>(case: u32, Vec3 { x, y, z }: Vec3<R>) -> Vec3<R> {
    match case / 2 {
        0 => Vec3::new(x, y, z),
        1 => Vec3::new(z, x, y),
        _ => Vec3::new(y, z, x),
    }
}

/// The inverse of [`cycle`].
fn cycle_back<R: Real>(case: u32, Vec3 { x, y, z }: Vec3<R>) -> Vec3<R> {
    match case / 2 {
        0 => Vec3::new(x, y, z),
        1 => Vec3::new(y, z, x),
        _ => Vec3::new(z, x, y),
    }
}

/// (case, u, v): u = 1/2 - atan(p/(q sqrt 2))/(2 alpha), v = the latitude over the largest on this meridian, for the
/// components (p, q, r) of the case.
pub(super) fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let scaled = dir.scaled_direction()?;
    let case = CASE_OF_CHART[sign_table(dir) as usize];
    let Vec3 { x: p, y: q, z: r } = cycle(case, scaled);
    let (a, b) = (p / q, r / q.abs());
    Some(ChartPoint::new(case, along_edge(-a), across_edge(b, a)).clamped())
}

/// The direction of (case, u, v).
pub(super) fn inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    if !point.is_on(6) {
        return None;
    }
    let (minus_a, r, q) = from_edge(point.u, point.v);
    // Odd cases look along the negative axis: there p/q keeps its sign only if both turn round.
    let side = if point.chart.is_multiple_of(2) {
        R::one()
    } else {
        -R::one()
    };
    Some(cycle_back(
        point.chart,
        Vec3::new(-minus_a * side, q * side, r),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::inputs::Random;

    #[test]
    fn appendix_c_undoes_appendix_b() {
        let mut random = Random::new(3);
        for _ in 0..20_000 {
            let dir = Vec3::from_f64(random.adversarial().map(f64::from));
            let back = inverse::<f64>(forward(dir).unwrap()).unwrap();
            assert!(crate::math::angle_rad(back.to_f64(), dir.to_f64()) < 1e-14);
        }
    }

    #[test]
    fn examples_of_the_errata() {
        let near = |p: ChartPoint<f64>, case, u: f64, v: f64| {
            p.chart == case && (p.u - u).abs() < 5e-7 && (p.v - v).abs() < 5e-7
        };
        assert!(near(
            forward(Vec3::new(1.0, 0.0, 0.5)).unwrap(),
            2,
            0.223_925,
            0.5
        ));
        assert!(near(
            forward(Vec3::new(0.3, -1.0, 0.2)).unwrap(),
            1,
            0.669_813,
            0.623_892
        ));
        // The shader's form gives other numbers there.
        assert!(!near(
            crate::mapping::ccm::paper::forward(Vec3::new(1.0, 0.0, 0.5)).unwrap(),
            5,
            0.223_925,
            0.5
        ));
    }
}
