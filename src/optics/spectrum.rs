//! From wavelengths to colour.

use super::glass::{SODIUM_UM, VISIBLE_UM};
use super::material::{Dispersion, WAVELENGTHS_RANGE};

/// One wavelength's part in a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// In micrometres.
    pub wavelength_um: f64,
    /// Weights on linear sRGB red, green and blue; they sum to 1 over all lines, so that white stays white. A weight may be
    /// negative: a pure colour lies outside what a screen can show.
    pub rgb: [f64; 3],
}

/// `count` wavelengths spread over the visible range, from short to long, each with its weights; the nearest count of
/// [`WAVELENGTHS_RANGE`] is taken.
///
/// The range of 0.40 to 0.70 is cut into equal bands, and what lies beyond goes to the outer ones. A line has the weights of its
/// whole band, so that few lines make colours too: three are about blue, green and red. A single one is grey, at the sodium
/// line where indices are quoted.
#[must_use]
pub fn lines(count: u32) -> Vec<Line> {
    let (fewest, most) = WAVELENGTHS_RANGE;
    let count = count.clamp(fewest, most);
    if count == 1 {
        return vec![Line {
            wavelength_um: SODIUM_UM,
            rgb: [1.0; 3],
        }];
    }
    let bands: Vec<Band> = (0..count).map(|i| Band::new(i, count)).collect();
    let whole = bands.iter().fold([0.0; 3], |sum, band| add(sum, band.rgb));
    let line = |band: &Band| Line {
        wavelength_um: band.wavelength_um,
        rgb: std::array::from_fn(|c| band.rgb[c] / whole[c]),
    };
    bands.iter().map(line).collect()
}

/// The colour that stands for a wavelength on a screen: linear sRGB in [0, 1], the largest 1. Pure colours lie outside what a
/// screen can show; what would be negative is cut off.
#[must_use]
pub fn line_color(wavelength_um: f64) -> [f64; 3] {
    let (shortest, longest) = VISIBLE_UM;
    let rgb = linear_srgb(observer(wavelength_um.max(shortest).min(longest)));
    let largest = rgb.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    rgb.map(|c| (c / largest).clamp(0.0, 1.0))
}

/// Between these, in micrometres, the bands are equal.
const BANDS_UM: (f64, f64) = (0.40, 0.70);
/// Sample points of a band's integral: at least every 2 nm, a tenth of the observer's narrowest lobe.
const BAND_SAMPLES: u32 = 120;

/// What the eye sees of a range of wavelengths.
struct Band {
    /// The mean, weighted by what is seen.
    wavelength_um: f64,
    /// Its integral; only ratios between bands mean anything.
    rgb: [f64; 3],
}

impl Band {
    fn new(index: u32, count: u32) -> Self {
        let (shortest, longest) = VISIBLE_UM;
        let border = |i: u32| match i {
            0 => shortest,
            i if i == count => longest,
            i => BANDS_UM.0 + (BANDS_UM.1 - BANDS_UM.0) * f64::from(i) / f64::from(count),
        };
        let (from, to) = (border(index), border(index + 1));
        let step = (to - from) / f64::from(BAND_SAMPLES);
        let (mut xyz, mut seen, mut moment) = ([0.0; 3], 0.0, 0.0);
        for sample in 0..BAND_SAMPLES {
            let wavelength_um = from + (f64::from(sample) + 0.5) * step;
            let part = observer(wavelength_um).map(|response| response * step);
            let weight: f64 = part.iter().sum();
            xyz = add(xyz, part);
            seen += weight;
            moment += weight * wavelength_um;
        }
        Self {
            wavelength_um: moment / seen,
            rgb: linear_srgb(xyz),
        }
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| a[c] + b[c])
}

/// The CIE 1931 colour matching functions x, y and z, to about 1 % of their peaks: C. Wyman, P.-P. Sloan and P. Shirley,
/// "Simple analytic approximations to the CIE XYZ color matching functions", JCGT 2(2), 1-11 (2013), the multi-lobe fit.
fn observer(wavelength_um: f64) -> [f64; 3] {
    let nm = wavelength_um * 1000.0;
    // A Gaussian with its own steepness, 1/nm, on each side.
    let lobe = |peak: f64, middle: f64, below: f64, above: f64| {
        let t = (nm - middle) * if nm < middle { below } else { above };
        peak * (-0.5 * t * t).exp()
    };
    [
        lobe(0.362, 442.0, 0.0624, 0.0374)
            + lobe(1.056, 599.8, 0.0264, 0.0323)
            + lobe(-0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

/// From CIE XYZ to linear sRGB (IEC 61966-2-1).
fn linear_srgb([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ]
}

/// What Ramires' shader adds to eta from one colour to the next.
pub const ETA_STEP: f32 = 0.01;

/// eta for red, green and blue by the three offsets. In the right order red has the largest eta, hence the smallest index of
/// refraction, and is bent least; as printed blue is (erratum R5).
#[must_use]
pub fn offset_etas(eta: f32, dispersion: Dispersion) -> [f32; 3] {
    let [first, second, third] = [eta, eta + ETA_STEP, eta + 2.0 * ETA_STEP];
    match dispersion {
        Dispersion::PrintedOffsets => [first, second, third],
        Dispersion::Offsets | Dispersion::Spectral => [third, second, first],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_observer_is_the_cies() {
        // CIE 15, the 2 degree observer of 1931.
        let mut worst = 0.0_f64;
        for (wavelength_um, xyz) in [
            (0.45, [0.3362, 0.0380, 1.7721]),
            (0.50, [0.0049, 0.3230, 0.2720]),
            (0.55, [0.4334, 0.9950, 0.0087]),
            (0.60, [1.0622, 0.6310, 0.0008]),
            (0.65, [0.2835, 0.1070, 0.0000]),
        ] {
            for (found, table) in std::iter::zip(observer(wavelength_um), xyz) {
                worst = worst.max((found - table).abs());
            }
            let shifted = observer(wavelength_um + 0.01);
            assert!((0..3).any(|c| (shifted[c] - xyz[c]).abs() > 0.05));
        }
        assert!(worst < 0.04, "{worst}");
    }

    #[test]
    fn white_has_no_colour_and_the_primaries_have_one() {
        // D65 (IEC 61966-2-1), to the digits of the matrix.
        let white = linear_srgb([0.9505, 1.0, 1.089]);
        assert!(white.iter().all(|c| (c - 1.0).abs() < 1e-3), "{white:?}");
        let red = linear_srgb([0.4124, 0.2126, 0.0193]);
        assert!((red[0] - 1.0).abs() < 1e-3 && red[1].abs() < 1e-3 && red[2].abs() < 1e-3);
    }
}
