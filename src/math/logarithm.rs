//! The project's own logarithm and exponential for f32, shared by the CPU and every shader.
//!
//! The shading language allows a built-in logarithm an error of 2^-21 around 1, sixteen times the last digit, and a built-in exponential
//! of 6 one of 15 ULP. These use only sums, products and one quotient. Powers of two are exact, so a series is asked
//! for the rest alone: its coefficients are Taylor's, and the terms left out are below a sixteenth of the last digit.

/// ln 2 in two parts: the product of the first with a whole number below 2^14 is exact.
pub const LN_2_PARTS: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];

/// ln(1 + t) for t >= 0, as long as t has a reciprocal.
///
/// Largest error up to 1000: 1.91 ULP.
pub(super) fn ln_1p(t: f32) -> f32 {
    // 1 + t is 2^k m with m in [1/sqrt 2, sqrt 2], and ln m = 2 artanh(s) with s = (m - 1)/(m + 1), |s| < 0.172.
    let mut k = 0.0;
    let mut power = 1.0;
    while 1.0 + t > std::f32::consts::SQRT_2 * power && power < 1e30 {
        k += 1.0;
        power *= 2.0;
    }
    let s = (t - (power - 1.0)) / (t + (1.0 + power));
    let q = s * s;
    let series = q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))));
    k * LN_2_PARTS[0] + (k * LN_2_PARTS[1] + 2.0 * (s + s * series))
}

/// e^x - 1 for |x| <= 40.
///
/// Largest error: 1.73 ULP.
pub(super) fn exp_m1(x: f32) -> f32 {
    let k = (x * std::f32::consts::LOG2_E).round();
    let f = (x - k * LN_2_PARTS[0]) - k * LN_2_PARTS[1];
    let series = 1.0 / 2.0
        + f * (1.0 / 6.0
            + f * (1.0 / 24.0 + f * (1.0 / 120.0 + f * (1.0 / 720.0 + f * (1.0 / 5040.0)))));
    let rest = f + f * f * series;
    let power = 2f32.powi(k as i32);
    (power - 1.0) + power * rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error in units of the last place of the result.
    fn worst(ours: fn(f32) -> f32, exact: fn(f64) -> f64, from: f32, to: f32) -> f64 {
        let step = (to - from) / 1e6;
        let mut worst = 0.0_f64;
        for i in 0..1_000_000 {
            let x = from + step * i as f32;
            let exact = exact(f64::from(x));
            let ulp =
                f64::from(f32::EPSILON) * 2f64.powi(exact.abs().max(1e-30).log2().floor() as i32);
            worst = worst.max((f64::from(ours(x)) - exact).abs() / ulp);
        }
        worst
    }

    #[test]
    fn errors_are_as_documented() {
        let logarithms = [(0.0, 1e-3), (0.0, 1.0), (0.0, 25.0), (0.0, 1000.0)]
            .map(|(from, to)| worst(ln_1p, f64::ln_1p, from, to));
        let exponentials = [(-1e-3, 1e-3), (-1.0, 1.0), (0.0, 6.3), (-40.0, 40.0)]
            .map(|(from, to)| worst(exp_m1, f64::exp_m1, from, to));
        println!("ln(1 + t): {logarithms:?} ULP, exp(x) - 1: {exponentials:?} ULP");
        for observed in logarithms.into_iter().chain(exponentials) {
            assert!(observed < 2.0, "{observed}");
        }
        // Control: a term less is noticed.
        let short = |x: f32| exp_m1(x) - x.powi(7) / 5040.0;
        assert!(
            worst(short, f64::exp_m1, -0.3, 0.3) > 2.0 || worst(short, f64::exp_m1, 0.9, 1.0) > 2.0
        );
        assert_eq!((ln_1p(0.0), exp_m1(0.0)), (0.0, 0.0));
    }
}
