//! Colours of the microscope's pictures: told apart by every kind of colour vision, also in grey.

use super::microscope::Verdict;

/// Red, green and blue, 8 bits sRGB.
pub type Colour = [u8; 3];

/// Errors in radians at the ends of the scale, which is logarithmic: below the rounding of f32, and beyond any chart.
pub const SCALE_RAD: [f64; 2] = [1e-8, 1.0];

/// From the least error to the largest: cividis (Nuñez, Anderton and Renslow 2018), even in lightness, without its darkest
/// fifth, which holes would not be told from.
const ERRORS: [Colour; 8] = [
    [0x3b, 0x49, 0x6c],
    [0x57, 0x5d, 0x6d],
    [0x70, 0x71, 0x73],
    [0x8a, 0x86, 0x78],
    [0xa5, 0x9c, 0x74],
    [0xc3, 0xb3, 0x69],
    [0xe1, 0xcc, 0x55],
    [0xfe, 0xe8, 0x38],
];

/// The colour of an error in radians.
pub fn error_colour(rad: f64) -> Colour {
    colour_at(place_of(rad))
}

/// The colour at a place of the scale, in [0, 1].
pub fn colour_at(place: f64) -> Colour {
    between(&ERRORS, place)
}

/// The colour at a share, in [0, 1], of the way through colours in equal steps.
pub fn between(colours: &[Colour], share: f64) -> Colour {
    let last = colours.len().saturating_sub(1);
    let place = share.clamp(0.0, 1.0) * last as f64;
    let from = (place as usize).min(last.saturating_sub(1));
    let [a, b] = [from, last.min(from + 1)].map(|k| colours.get(k).copied().unwrap_or_default());
    std::array::from_fn(|k| {
        let [a, b] = [a[k], b[k]].map(f64::from);
        (a + (b - a) * (place - from as f64)).round() as u8
    })
}

/// Where an error stands on the scale, in [0, 1].
pub fn place_of(rad: f64) -> f64 {
    let [low, high] = SCALE_RAD.map(f64::log10);
    let place = (rad.max(SCALE_RAD[0]).log10() - low) / (high - low);
    place.clamp(0.0, 1.0)
}

/// The colour of a verdict, of an error of so many radians where it has one. The kinds of fault have Okabe and Ito's
/// vermilion, reddish purple and sky blue; a hole is black, as in the paper.
pub fn colour(verdict: Verdict, error_rad: f64) -> Colour {
    match verdict {
        Verdict::Hole => [0, 0, 0],
        Verdict::WrongChart => [213, 94, 0],
        Verdict::OutOfRange => [222, 140, 186],
        Verdict::NotFinite => [86, 180, 233],
        Verdict::Uncovered => [30, 30, 33],
        Verdict::TooFar | Verdict::Right => error_colour(error_rad),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE lightness, 0 to 100.
    fn lightness(colour: Colour) -> f64 {
        let linear = colour.map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.040_45 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        });
        let y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        116.0 * y.cbrt() - 16.0
    }

    #[test]
    fn the_scale_is_even_in_lightness_and_a_hole_is_far_below_it() {
        let steps: Vec<f64> = (0..=80)
            .map(|k| lightness(error_colour(10f64.powf(-8.0 + f64::from(k) / 10.0))))
            .collect();
        let mean = (steps[80] - steps[0]) / 80.0;
        for pair in steps.windows(2) {
            let step = pair[1] - pair[0];
            assert!(step > 0.4 * mean && step < 1.7 * mean, "{step} of {mean}");
        }
        let hole = lightness(colour(Verdict::Hole, 0.0));
        assert!(steps[0] - hole > 25.0, "{} {hole}", steps[0]);
        assert!(mean > 0.6);
    }

    #[test]
    fn the_scale_ends_where_it_says() {
        assert_eq!(error_colour(0.0), ERRORS[0]);
        assert_eq!(error_colour(f64::NAN), ERRORS[0]);
        assert_eq!(error_colour(9.0), ERRORS[7]);
        assert!((place_of(1e-4) - 0.5).abs() < 1e-12);
    }
}
