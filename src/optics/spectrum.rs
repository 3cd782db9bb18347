//! From wavelengths to colour.

use super::material::Dispersion;

/// One wavelength's part in a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// In micrometres.
    pub wavelength_um: f64,
    /// Weights on linear sRGB red, green and blue; they sum to 1 over all lines, so that white stays white. A weight may be
    /// negative: a pure colour lies outside what a screen can show.
    pub rgb: [f64; 3],
}

/// `count` wavelengths evenly spread over the visible range, each with its weights.
#[must_use]
pub fn lines(count: u32) -> Vec<Line> {
    let count = count.max(1);
    (0..count)
        .map(|i| Line {
            wavelength_um: 0.4 + 0.3 * (f64::from(i) + 0.5) / f64::from(count),
            rgb: [1.0 / f64::from(count); 3],
        })
        .collect()
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
