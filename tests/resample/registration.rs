//! Every texel shows the direction where it belongs.

use crate::fixtures::*;
use sixfold::imaging::resample::Filter;
use sixfold::mapping::{ChartPoint, Domain, MappingId};
use sixfold::math::{Vec3, angle_rad};

/// Worst error of a conversion in texels of the source, where all four texels around the place are the chart's own, and where
/// not.
fn errors(
    from: MappingId,
    to: MappingId,
    from_height: u32,
    to_height: u32,
    filter: Filter,
) -> [f64; 2] {
    let source_shape = shape(from, size_of(from, from_height));
    let source = map_of(&source_shape, |d| d.map(|c| c as f32));
    let mut conversion = conversion(&source_shape, to, size_of(to, to_height), filter);
    conversion.rotation = askew();
    let (target, _) = run(&source, &conversion);
    let mut worst = [0.0_f64; 2];
    for (chart, texel, dir) in texels(target.shape()) {
        let dir = rotated(conversion.rotation, dir);
        let [x, y, z, _] = target.light(chart, texel).map(f64::from);
        let away = angle_rad([x, y, z], dir);
        let point = from.forward(Vec3::from_f64(dir)).unwrap();
        let texel_rad = texel_rad(from, source_shape.size, point);
        let at_seam = usize::from(is_at_seam(from, source_shape.size, point));
        worst[at_seam] = worst[at_seam].max(away / texel_rad);
    }
    worst
}

/// Side of a square of a texel's solid angle, on average over the map.
fn texel_rad(mapping: MappingId, size: [u32; 2], _: ChartPoint<f64>) -> f64 {
    let info = mapping.info();
    let share = if info.domain == Domain::Disc {
        std::f64::consts::FRAC_PI_4
    } else {
        1.0
    };
    let texels = f64::from(info.chart_count() * size[0] * size[1]) * share;
    (info.coverage.solid_angle_sr() / texels).sqrt()
}

fn is_at_seam(mapping: MappingId, size: [u32; 2], point: ChartPoint<f64>) -> bool {
    let place = [
        point.u * f64::from(size[0]) - 0.5,
        point.v * f64::from(size[1]) - 0.5,
    ];
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    corners.into_iter().any(|(x, y)| {
        let (x, y) = (place[0].floor() + x, place[1].floor() + y);
        let (u, v) = (
            (x + 0.5) / f64::from(size[0]),
            (y + 0.5) / f64::from(size[1]),
        );
        mapping
            .inverse(ChartPoint::new(point.chart, u, v))
            .is_none()
    })
}

#[test]
fn look() {
    for &from in &[MappingId::Paraboloid] {
        for &to in &[MappingId::Ccm] {
            for n in [31, 32, 33, 63, 64, 65, 66, 96, 100, 128, 200, 256] {
                let [inside, seam] = errors(from, to, n, 165, Filter::Bilinear);
                println!(
                    "{from:24} {to:24} {n:4} inside {inside:.5} seam {seam:.5} ratio {:.2}",
                    seam / inside
                );
            }
        }
    }
}
