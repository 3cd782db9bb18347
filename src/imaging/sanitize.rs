//! Every value finite and in the range of half floats, and a record of what was not.
//!
//! One NaN texel spreads through every level of a mip pyramid, so nothing is built from raw data.

use super::{Image, Raster, Samples};

/// The largest half float: the maps on the GPU are rgba16float.
pub const LARGEST: f32 = 65504.0;

/// At most this many originals are kept (16 bytes each): a file of nothing but NaN must not double its memory.
pub const MOST_ORIGINALS: usize = 1 << 20;

/// How many texels had at least one component that was ... (a texel may count in several).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BadTexels {
    /// not a number (replaced by 0);
    pub nan: u64,
    /// infinite (+ replaced by 65504, - by 0);
    pub infinite: u64,
    /// finite and below zero (replaced by 0);
    pub negative: u64,
    /// finite and above 65504 (replaced by that).
    pub too_bright: u64,
}

impl BadTexels {
    /// Whether nothing was replaced.
    pub fn is_clean(&self) -> bool {
        *self == Self::default()
    }

    /// For the status bar, such as `texels replaced: 3 NaN, 2 negative`, or nothing when clean.
    pub fn summary(&self) -> Option<String> {
        let kinds = [
            (self.nan, "NaN"),
            (self.infinite, "infinite"),
            (self.negative, "negative"),
            (self.too_bright, "too bright"),
        ];
        let found: Vec<String> = kinds
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, kind)| format!("{count} {kind}"))
            .collect();
        (!found.is_empty()).then(|| format!("texels replaced: {}", found.join(", ")))
    }
}

impl std::ops::AddAssign for BadTexels {
    fn add_assign(&mut self, other: Self) {
        self.nan += other.nan;
        self.infinite += other.infinite;
        self.negative += other.negative;
        self.too_bright += other.too_bright;
    }
}

/// What replaced texels held, for the readout.
#[derive(Clone, Debug, Default)]
pub struct Originals {
    /// (index, colour), index ascending.
    kept: Vec<(u32, [f32; 3])>,
}

impl Originals {
    /// The colour that texel `index` (of [`Image::pixels`]) had in the file, when it was replaced and kept.
    pub fn get(&self, index: usize) -> Option<[f32; 3]> {
        let index = u32::try_from(index).ok()?;
        let at = self
            .kept
            .binary_search_by_key(&index, |entry| entry.0)
            .ok()?;
        Some(self.kept[at].1)
    }

    /// How many originals are kept.
    pub fn len(&self) -> usize {
        self.kept.len()
    }

    /// Whether none is kept.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Keeps one more, of a texel after all that are kept, while there is room.
    fn keep(&mut self, index: usize, original: [f32; 3]) {
        if self.kept.len() < MOST_ORIGINALS
            && let Ok(index) = u32::try_from(index)
        {
            self.kept.push((index, original));
        }
    }

    /// These, which were replaced first, and `later` ones of the same picture.
    pub(super) fn before(&self, later: Self) -> Self {
        let mut kept = self.kept.clone();
        kept.extend(later.kept);
        // Stable: of a texel that was replaced twice the first one stays.
        kept.sort_by_key(|entry| entry.0);
        kept.dedup_by_key(|entry| entry.0);
        kept.truncate(MOST_ORIGINALS);
        Self { kept }
    }
}

/// Counts and replaces every component that is NaN, infinite, negative or above [`LARGEST`]. -0 stays.
pub fn sanitize(image: &mut Image) -> (BadTexels, Originals) {
    let (mut bad, mut originals) = (BadTexels::default(), Originals::default());
    for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
        // The usual texel costs three comparisons; NaN fails them.
        if pixel.iter().all(|&c| (0.0..=LARGEST).contains(&c)) {
            continue;
        }
        let original = *pixel;
        let any = |test: fn(f32) -> bool| u64::from(original.iter().any(|&c| test(c)));
        bad.nan += any(f32::is_nan);
        bad.infinite += any(f32::is_infinite);
        bad.negative += any(|c| c.is_finite() && c < 0.0);
        bad.too_bright += any(|c| c.is_finite() && c > LARGEST);
        *pixel = original.map(replaced);
        originals.keep(index, original);
    }
    (bad, originals)
}

/// Counts and replaces what no filter may meet: NaN by 0, +infinity by [`LARGEST`], -infinity by 0. Every finite value stays
/// as it is, however large or negative, and codes are always finite.
pub fn sanitize_raster(raster: &mut Raster) -> (BadTexels, Originals) {
    let (mut bad, mut originals) = (BadTexels::default(), Originals::default());
    let count = raster.channels().count();
    if let Samples::F32(samples) = raster.samples_mut() {
        for (index, texel) in samples.chunks_exact_mut(count).enumerate() {
            if texel.iter().all(|c| c.is_finite()) {
                continue;
            }
            bad.nan += u64::from(texel.iter().any(|c| c.is_nan()));
            bad.infinite += u64::from(texel.iter().any(|c| c.is_infinite()));
            originals.keep(index, [texel[0], texel[1], texel[2]]);
            for c in texel.iter_mut().filter(|c| !c.is_finite()) {
                *c = replaced(*c);
            }
        }
    }
    (bad, originals)
}

fn replaced(c: f32) -> f32 {
    if c.is_nan() {
        0.0
    } else {
        c.clamp(0.0, LARGEST)
    }
}
