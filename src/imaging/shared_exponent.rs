//! Three mantissas with a common exponent: Radiance's RGBE and the GPU's RGB9E5.
//!
//! A colour is m * 2^(e - bias - bits), with a whole mantissa m of that many bits for each component. The exponent is the
//! smallest that holds the largest component once it is rounded (EXT_texture_shared_exponent, section 2.1.X; Ward's format
//! differs in rounding down, which loses a half step of every value).

/// A format of this kind.
pub(super) struct SharedExponent {
    /// Bits of a mantissa.
    bits: u32,
    /// What is taken from the stored exponent.
    bias: i32,
    /// The smallest exponent that is not set aside.
    lowest: u32,
    /// The largest exponent.
    highest: u32,
}

/// Radiance's texels; the exponent 0 is set aside for black.
pub(super) const RGBE: SharedExponent = SharedExponent {
    bits: 8,
    bias: 128,
    lowest: 1,
    highest: 255,
};

/// `E5B9G9R9_UFLOAT_PACK32`.
pub(super) const RGB9E5: SharedExponent = SharedExponent {
    bits: 9,
    bias: 15,
    lowest: 0,
    highest: 31,
};

impl SharedExponent {
    /// The colour of three mantissas and an exponent, exact: f32 has bits and exponents enough for both formats but for
    /// RGBE's brightest, which fits too (255 * 2^119 < 2^128).
    pub(super) fn decode(&self, mantissas: [u32; 3], exponent: u32) -> [f32; 3] {
        let unit = self.unit(exponent);
        mantissas.map(|m| (f64::from(m) * unit) as f32)
    }

    /// The nearest mantissas, halves up, and their exponent. What is negative or NaN becomes 0, what is too large the largest.
    pub(super) fn encode(&self, color: [f32; 3]) -> ([u32; 3], u32) {
        let largest_mantissa = (1_u32 << self.bits) - 1;
        let largest = f64::from(largest_mantissa) * self.unit(self.highest);
        // `max` drops NaN.
        let color = color.map(|c| f64::from(c).max(0.0).min(largest));
        let brightest = color[0].max(color[1]).max(color[2]);
        // 2^(k - 1) <= brightest < 2^k; every f32 is a normal f64, and 0 gets the lowest.
        let k = ((brightest.to_bits() >> 52) & 0x7ff) as i32 - 1022;
        let fitting = (k + self.bias).max(self.lowest as i32) as u32;
        let rounded = |exponent: u32| color.map(|c| (c / self.unit(exponent) + 0.5) as u32);
        let mantissas = rounded(fitting);
        if mantissas.iter().all(|m| *m <= largest_mantissa) {
            (mantissas, fitting)
        } else {
            // Rounded up to a power of two: one more exponent holds it, since the largest value was the limit.
            (rounded(fitting + 1), fitting + 1)
        }
    }

    /// What one step of a mantissa is worth.
    fn unit(&self, exponent: u32) -> f64 {
        // A normal f64: its exponent lies between -136 and 119.
        let power = exponent as i32 - self.bias - self.bits as i32;
        f64::from_bits(((power + 1023) as u64) << 52)
    }
}
