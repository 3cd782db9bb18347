//! Which evaluator is used: the cheapest that is near enough for what is seen.

use std::collections::BTreeMap;

use super::accuracy::texel_rad;
use super::bench::Row;
use crate::mapping::MappingId;
use crate::mapping::evaluator::REFERENCE;

/// Screen pixels along a texel's side, of a map whose charts have `rows` rows, seen straight on in the middle of a picture
/// `height_px` pixels high with a vertical field of view of `fov_y_rad`. A pixel there is 2 tan(fov/2) / height wide, and the
/// texel is one of mean size. What a convex body mirrors is seen smaller than the sky beside it.
pub fn pixels_per_texel(map: MappingId, rows: u32, fov_y_rad: f64, height_px: f64) -> f64 {
    let pixel_rad = 2.0 * (0.5 * fov_y_rad).tan() / height_px;
    texel_rad(map, rows) / pixel_rad
}

/// The largest error, in texels, that a budget of so many texels allows where a texel takes so many pixels of the screen.
///
/// An error shifts what is looked up by a share of a texel. As long as a texel takes a pixel or less the budget is meant as
/// it is: what is shifted by a hundredth of a texel is shifted by no more of a pixel. Magnified, a texel takes p pixels
/// and the same error shifts its border by p times as much on the screen, so that a p-th of the budget is left. The budget
/// is thus a share of a texel or of a pixel, whichever is smaller. A texel smaller than a pixel allows no more, because the
/// map also has finer places than its mean texel and the filter does not average all of it.
pub fn allowed_texels(budget_texels: f64, pixels_per_texel: f64) -> f64 {
    budget_texels / pixels_per_texel.max(1.0)
}

/// An evaluator that is near enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice<'a> {
    /// Its time, few directions at a time by one thread.
    pub row: &'a Row,
    /// Its largest error in texels on everything that it was measured on; infinite where it has holes.
    pub error_texels: f64,
}

/// Each evaluator with each of its instructions, on charts of `rows` rows, among measurements of one mapping in one direction on
/// one device.
pub fn choices<'a>(measured: &[&'a Row], rows: u32) -> Vec<Choice<'a>> {
    let mut choices: BTreeMap<_, Choice<'a>> = BTreeMap::new();
    for &row in measured {
        let error_texels = match row.holes {
            0 => row.error_texels_at(rows),
            _ => f64::INFINITY,
        };
        let choice = choices
            .entry((row.evaluator, row.isa))
            .or_insert(Choice { row, error_texels });
        choice.error_texels = choice.error_texels.max(error_texels);
        let load = |row: &Row| (row.threads, row.n, row.inputs);
        if load(row) < load(choice.row) {
            choice.row = row;
        }
    }
    choices.into_values().collect()
}

/// The cheapest of these choices.
pub fn fastest<'a>(choices: impl IntoIterator<Item = Choice<'a>>) -> Option<Choice<'a>> {
    choices
        .into_iter()
        .min_by(|a, b| a.row.ns.total_cmp(&b.row.ns))
}

/// The cheapest evaluator whose error on charts of `rows` rows is at most `allowed_texels`, among measurements as for
/// [`choices`]. An evaluator must be near enough on all inputs that it was measured on, as a scene may hold any direction, and
/// one with holes never is. `None` where nothing is near enough.
pub fn cheapest<'a>(measured: &[&'a Row], rows: u32, allowed_texels: f64) -> Option<Choice<'a>> {
    let is_near = |choice: &Choice<'_>| {
        choice.error_texels.is_finite() && choice.error_texels <= allowed_texels
    };
    fastest(choices(measured, rows).into_iter().filter(is_near))
}

/// The reference's measurement under the same circumstances as `row`, where there is one.
pub fn reference_beside<'a>(measured: &'a [Row], row: &Row) -> Option<&'a Row> {
    measured
        .iter()
        .find(|other| other.evaluator == REFERENCE && other.circumstances() == row.circumstances())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::bench::Way;
    use crate::lab::inputs::Inputs;

    fn row(evaluator: &'static str, ns: f64, max_error_texels: f64) -> Row {
        Row {
            mapping: "ccm",
            evaluator,
            direction: Way::Forward,
            inputs: Inputs::Random,
            device: "cpu".to_owned(),
            isa: "baseline",
            threads: 1,
            n: 1024,
            ns,
            ns_latency: Some(ns),
            spread: 0.0,
            copy_ratio: ns,
            max_error_rad: max_error_texels * 1e-3,
            rms_error_rad: max_error_texels * 1e-4,
            max_error_ulp: 1.0,
            max_error_texels,
            texels: 1024,
            worst: [0.0, 0.0, 1.0],
            holes: 0,
            on_front: false,
        }
    }

    fn chosen(rows: &[Row], texels: u32, allowed: f64) -> Option<(&'static str, f64)> {
        let all: Vec<&Row> = rows.iter().collect();
        let choice = cheapest(&all, texels, allowed)?;
        Some((choice.row.evaluator, choice.error_texels))
    }

    #[test]
    fn the_cheapest_that_is_near_enough_is_chosen() {
        let rows = [
            row("coarse", 1.0, 0.5),
            row("middle", 2.0, 0.02),
            row("slow", 9.0, 0.02),
            row("fine", 4.0, 0.001),
        ];
        assert_eq!(chosen(&rows, 1024, 1.0), Some(("coarse", 0.5)));
        assert_eq!(chosen(&rows, 1024, 0.02), Some(("middle", 0.02)));
        // Control: a hair less, and it is too far off.
        assert_eq!(chosen(&rows, 1024, 0.0199), Some(("fine", 0.001)));
        assert_eq!(chosen(&rows, 1024, 0.0005), None);
        // On charts twice as fine the same error is twice as many texels.
        assert_eq!(chosen(&rows, 2048, 0.02), Some(("fine", 0.002)));
        assert_eq!(chosen(&[], 1024, 1.0), None);
        assert_eq!(chosen(&rows, 1024, f64::NAN), None);
    }

    #[test]
    fn it_must_be_near_enough_on_all_inputs_and_without_holes() {
        let mut rows = vec![row("fast", 1.0, 0.01), row("sound", 2.0, 0.01)];
        assert_eq!(chosen(&rows, 1024, 0.02), Some(("fast", 0.01)));
        let hard = Row {
            inputs: Inputs::Adversarial,
            ..row("fast", 0.5, 0.3)
        };
        rows.push(hard.clone());
        assert_eq!(chosen(&rows, 1024, 0.02), Some(("sound", 0.01)));
        // Its time is the one on random inputs, wherever its error is larger.
        let all: Vec<&Row> = rows[..1].iter().chain([&hard]).collect();
        let choice = cheapest(&all, 1024, 1.0).unwrap();
        assert_eq!((choice.row.ns, choice.error_texels), (1.0, 0.3));
        // Control: the same with a hole is no answer at any budget.
        rows[1].holes = 1;
        assert_eq!(
            chosen(&rows[1..2], 1024, f64::INFINITY),
            None::<(&str, f64)>
        );
    }

    #[test]
    fn the_reference_is_found_under_the_same_circumstances_only() {
        let many = Row {
            n: 1 << 20,
            ..row("atan-9", 1.0, 0.1)
        };
        let rows = [row(REFERENCE, 40.0, 1e-4), row("atan-9", 2.0, 0.1), many];
        let beside = |k: usize| reference_beside(&rows, &rows[k]).map(|r| r.ns);
        assert_eq!(
            [beside(0), beside(1), beside(2)],
            [Some(40.0), Some(40.0), None]
        );
    }

    #[test]
    fn what_is_magnified_needs_more() {
        for (pixels, allowed) in [(0.1, 0.01), (1.0, 0.01), (4.0, 0.0025), (f64::NAN, 0.01)] {
            assert!(
                (allowed_texels(0.01, pixels) - allowed).abs() < 1e-15,
                "{pixels}"
            );
        }
        // A cube face of 90 degrees of 90 rows in a picture of 90 degrees, 90 pixels high: pixels in the middle are 1/45 wide,
        // and a texel of mean size is the root of 4 pi / 6 over 90.
        let quarter = std::f64::consts::FRAC_PI_2;
        let same = pixels_per_texel(MappingId::Cube, 90, quarter, 90.0);
        let mean = (4.0 * std::f64::consts::PI / 6.0).sqrt() / 90.0 * 45.0;
        assert!((same - mean).abs() < 1e-12, "{same} is not {mean}");
        // Half the rows make texels twice as wide; a narrower view makes them wider, too.
        let coarse = pixels_per_texel(MappingId::Cube, 45, quarter, 90.0);
        assert!((coarse - 2.0 * same).abs() < 1e-12);
        assert!(pixels_per_texel(MappingId::Cube, 90, 0.1 * quarter, 90.0) > 10.0 * same);
    }
}
