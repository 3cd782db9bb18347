//! HEALPix's pixels where they were published, and its base pixels where they meet.

use sixfold::mapping::cube_face::Side;
use sixfold::mapping::{ChartPoint, MappingId, healpix};

/// sin latitude and longitude in degrees of the middle of HEALPix's pixel (x, y) of a base pixel with `side` pixels along an edge.
fn pixel(side: u32, base: u32, [x, y]: [u32; 2]) -> [f64; 2] {
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
    let point = ChartPoint::new(base, place(x), 1.0 - place(y));
    let dir = MappingId::Healpix.inverse(point).unwrap();
    [dir.y, dir.x.atan2(dir.z).to_degrees().rem_euclid(360.0)]
}

#[test]
fn pixels_of_healpix_lie_on_the_published_rings() {
    // Gorski et al. 2005, eq. 4 to 9, with i the ring and j the pixel on it.
    let mut seen = 0;
    for side in [1, 2, 4, 8] {
        let count = f64::from(side);
        for base in 0..12 {
            let (ring, k) = (base / 4, base % 4);
            for (x, y) in (0..side).flat_map(|x| (0..side).map(move |y| (x, y))) {
                let i = (ring + 2) * side - 1 - x - y;
                let [sine, longitude] = pixel(side, base, [x, y]);
                let mirrored = i.min(4 * side - i);
                let height = if mirrored < side {
                    1.0 - f64::from(mirrored).powi(2) / (3.0 * count * count)
                } else {
                    4.0 / 3.0 - 2.0 * f64::from(mirrored) / (3.0 * count)
                };
                let expected = if i > 2 * side { -height } else { height };
                assert!((sine - expected).abs() < 1e-14, "{side} {base} {x} {y}");
                // Pixels of a ring follow each other evenly; where they begin changes from ring to ring in the belt.
                let step = 90.0 / f64::from(mirrored.min(side));
                let is_half = mirrored < side || (mirrored - side) % 2 == 0;
                let begin = if is_half { 0.5 * step } else { 0.0 };
                let along = (longitude - begin) / step;
                assert!(
                    (along - along.round()).abs() < 1e-11,
                    "{side} {base} {x} {y}: {longitude}"
                );
                // The base pixel's own meridian.
                let middle = 90.0 * f64::from(k) + if ring == 1 { 0.0 } else { 45.0 };
                let off = (longitude - middle + 180.0).rem_euclid(360.0) - 180.0;
                assert!(off.abs() < 45.0 + 1e-9);
                assert_eq!(x == y, off.abs() < 1e-9, "{side} {base} {x} {y}: {off}");
                assert_eq!(x > y, off > 1e-9, "x leads to the east");
                seen += 1;
            }
        }
    }
    assert_eq!(seen, 12 * (1 + 4 + 16 + 64));
    // Control: another base pixel lies elsewhere.
    assert!((pixel(4, 0, [1, 2])[1] - pixel(4, 1, [1, 2])[1]).abs() > 1.0);
}

#[test]
fn base_pixels_meet_where_they_are_said_to() {
    let mut edges = 0;
    for (chart, side) in (0..12).flat_map(|chart| Side::ALL.map(|side| (chart, side))) {
        let there = healpix::across(chart, side);
        let back = healpix::across(there.face, there.side);
        assert_eq!(
            (back.face, back.side, back.is_reversed),
            (chart, side, there.is_reversed)
        );
        let dir_at = |chart, side: Side, along| {
            let [u, v] = side.place(along);
            MappingId::Healpix
                .inverse::<f64>(ChartPoint::new(chart, u, v))
                .unwrap()
        };
        for along in [0.0, 0.1, 0.4, 0.9, 1.0] {
            let other = if there.is_reversed {
                1.0 - along
            } else {
                along
            };
            let gap = dir_at(chart, side, along) - dir_at(there.face, there.side, other);
            assert!(gap.length() < 1e-15, "{chart} {side:?} {along}");
            // Control: the other way round they do not meet.
            let wrong = dir_at(chart, side, along) - dir_at(there.face, there.side, 1.0 - other);
            assert!(wrong.length() > 0.1, "{chart} {side:?} {along}");
        }
        edges += u32::from(chart < there.face);
        // In the picture they lie side by side, but for those around a pole and where the staircase begins and ends.
        let cells = MappingId::Healpix.info().layout.cells();
        let step = match side {
            Side::Left => [-1, 0],
            Side::Right => [1, 0],
            Side::Top => [0, -1],
            Side::Bottom => [0, 1],
        };
        let next = [0, 1].map(|k: usize| cells[chart as usize].at[k] as i32 + step[k]);
        if let Some(beside) = cells
            .iter()
            .position(|cell| cell.at.map(|c| c as i32) == next)
        {
            assert_eq!((beside as u32, there.is_reversed), (there.face, false));
        }
    }
    assert_eq!(edges, 24);
}
