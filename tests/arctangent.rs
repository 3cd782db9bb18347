//! The project's own arctangent, sine and cosine: derived constants, errors, and what is built on them.
//!
//! Every budget stands beside the value observed, and a budget over 1.5 times the observed value fails too, so that an
//! improvement is written down. Every kind of comparison is shown to fail for a wrong input.

#[allow(dead_code, reason = "its `main` prints what the tests only compare")]
#[path = "../examples/derive_arctangent.rs"]
mod derive;

use std::f32::consts::FRAC_PI_4;
use std::f64::consts::TAU;

use derive::{ALONG, ATAN, COS, Fit, QUARTERS, REACH, SIN, ulp_error};
use sixfold::math::approximation::LEVELS;
use sixfold::math::inputs::Random;
use sixfold::math::ulp::ulp_distance;
use sixfold::math::{
    ATAN_COEFFICIENTS, COS_QUARTER_COEFFICIENTS, Dual, Real, SIN_QUARTER_COEFFICIENTS, atan_unit,
    sin_cos_turns,
};

/// Holds a largest error seen to what is allowed, and what is allowed to what was seen.
#[allow(clippy::print_stdout, reason = "`--nocapture` lists the errors seen")]
fn within(name: &str, observed: f64, budget: f64) {
    println!("{name}: observed {observed:.4e}, budget {budget:.4e}");
    assert!(
        observed <= budget,
        "{name}: {observed:e} is over {budget:e}"
    );
    assert!(
        budget <= 1.5 * observed,
        "{name}: {budget:e} is far over {observed:e}"
    );
}

/// A polynomial, its constants and function in the source, and its budgets: ULP and absolute, none and all fused.
struct Case {
    fit: Fit,
    constants: &'static [f32],
    function: fn(f32) -> f32,
    budgets: [(f64, f64); 2],
}

/// Observed over every float of the upper half and every 64th of the lower, unfused and fused: atan 1.249 ULP, 7.44e-8
/// and 1.072 ULP, 6.39e-8; sine 1.220 ULP, 5.84e-8 and 0.979 ULP, 4.68e-8; cosine 1.130 ULP, 6.73e-8 and 0.874 ULP,
/// 5.21e-8. Over every float only the sine's ULP are more: 1.234 and 0.985.
const CASES: [Case; 3] = [
    Case {
        fit: ATAN,
        constants: &ATAN_COEFFICIENTS,
        function: atan_unit,
        budgets: [(1.3, 7.7e-8), (1.15, 6.6e-8)],
    },
    Case {
        fit: SIN,
        constants: &SIN_QUARTER_COEFFICIENTS,
        function: |x| sin_cos_turns(0.25 * x).0,
        budgets: [(1.3, 6.0e-8), (1.05, 5.0e-8)],
    },
    Case {
        fit: COS,
        constants: &COS_QUARTER_COEFFICIENTS,
        function: |x| sin_cos_turns(0.25 * x).1,
        budgets: [(1.2, 7.0e-8), (0.9, 5.4e-8)],
    },
];

#[test]
fn constants_are_what_the_program_derives() {
    for Case { fit, constants, .. } in CASES {
        assert_eq!(
            fit.derive(fit.chosen),
            constants,
            "{} should be:\n{}",
            fit.constant,
            fit.source()
        );
        let fewer = fit.chosen - 1;
        assert_ne!(fit.derive(fewer), constants[..fewer], "{}", fit.constant);
    }
}

/// Largest errors in quarter turns of the arctangents of [`LEVELS`], every product and sum fused.
const LEVEL_ERRORS: [f64; 7] = [3.9e-4, 5.2e-5, 7.4e-6, 1.2e-6, 2.2e-7, 7.7e-8, 6.1e-8];

#[test]
fn levels_are_what_the_program_derives() {
    for (level, budget) in LEVELS.iter().zip(LEVEL_ERRORS) {
        for (fit, coefficients) in [
            (QUARTERS, level.quarters),
            (ALONG, level.along),
            (REACH, level.reach),
            (SIN, level.sin),
            (COS, level.cos),
        ] {
            let (name, derived) = (fit.constant, fit.derive(coefficients.len()));
            assert_eq!(derived, coefficients, "{} of {}", name, level.id);
            let mut moved = coefficients.to_vec();
            moved[0] = moved[0].next_up();
            assert_ne!(derived, moved);
        }
        assert_eq!(level.id, format!("atan-{}", 2 * level.quarters.len() - 1));
        let error = QUARTERS.measure(&[level.quarters.to_vec()], [4093, 67])[0][1].0;
        within(level.id, error, budget);
    }
}

#[test]
fn budgets_bind_on_both_sides() {
    within("just", 1.0, 1.1);
    for budget in [0.9, 1.6, f64::NAN] {
        assert!(std::panic::catch_unwind(|| within("control", 1.0, budget)).is_err());
    }
}

#[test]
fn errors_stay_within_their_budgets() {
    for Case {
        fit,
        constants,
        budgets,
        ..
    } in CASES
    {
        let observed = fit.measure(&[constants.to_vec()], [64, 1])[0];
        for (rounding, observed, budget) in [
            ("unfused", observed[0], budgets[0]),
            ("fused", observed[1], budgets[1]),
        ] {
            within(
                &format!("{} {rounding} absolute", fit.constant),
                observed.0,
                budget.1,
            );
            within(
                &format!("{} {rounding} ULP", fit.constant),
                observed.1,
                budget.0,
            );
        }
    }
}

#[test]
fn the_program_measures_what_the_source_computes() {
    for Case {
        fit,
        constants,
        function,
        ..
    } in CASES
    {
        for x in fit.floats([251; 2]) {
            // A quarter of a subnormal may not be a float; the sine and cosine are asked for quarter turns.
            if x == 0.0 || x > 4.0 * f32::MIN_POSITIVE {
                assert_eq!(
                    (fit.evaluate[0])(constants, x),
                    function(x),
                    "{} at {x:e}",
                    fit.constant
                );
            }
        }
    }
}

#[test]
fn a_moved_coefficient_or_a_lower_degree_exceeds_the_budget() {
    // As much as two ULP of a value in [1/2, 1], far above the budgets' slack.
    const SHIFT: f64 = 2.0 * f32::EPSILON as f64;
    for Case {
        fit,
        constants,
        budgets,
        ..
    } in CASES
    {
        let fewer = fit.derive(fit.chosen - 1);
        let mut wrong = vec![fewer];
        for i in 0..constants.len() {
            let power = i32::try_from(2 * i + 3).unwrap();
            let mut moved = constants.to_vec();
            moved[i] += (SHIFT / f64::from(fit.end).powi(power)) as f32;
            wrong.push(moved);
        }
        for (coefficients, observed) in wrong.iter().zip(fit.measure(&wrong, [1021; 2])) {
            for ((absolute, ulp), (ulp_budget, absolute_budget)) in
                observed.into_iter().zip(budgets)
            {
                assert!(ulp > ulp_budget, "{}: {coefficients:?} {ulp}", fit.constant);
                assert!(
                    absolute > absolute_budget,
                    "{}: {coefficients:?} {absolute}",
                    fit.constant
                );
            }
        }
    }
}

/// Over every float of [1/2, 1]: the most ULP by which `function` falls below a value it had further left, and its
/// largest value.
fn largest_fall(function: impl Fn(f32) -> f32) -> (u32, f32) {
    let mut highest = f32::MIN;
    let mut fall = 0;
    for bits in 0.5f32.to_bits()..=1f32.to_bits() {
        let value = function(f32::from_bits(bits));
        if value < highest {
            fall = fall.max(ulp_distance(value, highest));
        }
        highest = highest.max(value);
    }
    (fall, highest)
}

#[test]
fn arctangent_never_falls_by_more_than_one_ulp() {
    // Nowhere above its value at 1, so that a chart coordinate made of it stays in the chart.
    assert_eq!(largest_fall(atan_unit), (1, FRAC_PI_4));
    let fused = |t| (ATAN.evaluate[1])(&ATAN_COEFFICIENTS, t);
    assert_eq!(largest_fall(fused), (0, FRAC_PI_4));
    // Control: a step down by two ULP in the middle is seen.
    let broken = |t: f32| if t < 0.75 { t } else { t - 1.5 * f32::EPSILON };
    assert_eq!(largest_fall(broken).0, 2);
}

#[test]
fn arctangent_is_odd_and_exact_at_its_ends() {
    assert_eq!(atan_unit(0.0).to_bits(), 0);
    assert_eq!(atan_unit(1.0), FRAC_PI_4);
    assert_eq!((ATAN.evaluate[1])(&ATAN_COEFFICIENTS, 1.0), FRAC_PI_4);
    for bits in (0..=1f32.to_bits()).rev().step_by(64) {
        let t = f32::from_bits(bits);
        // By value: the sign of -0 is lost.
        assert_eq!(atan_unit(-t), -atan_unit(t));
    }
}

/// Sizes from the smallest subnormal to the largest float.
const SIZES: [f32; 12] = [
    0.0,
    1e-45,
    1e-40,
    f32::MIN_POSITIVE,
    1e-30,
    1e-9,
    0.3,
    1.0,
    1.000_000_1,
    7e8,
    1e30,
    f32::MAX,
];

/// Points of every quadrant, axis and size, then random ones whose components differ by up to 2^30 either way.
fn plane_points() -> impl Iterator<Item = (f32, f32)> {
    let fixed = SIZES
        .iter()
        .flat_map(|&y| SIZES.iter().map(move |&x| (y, x)));
    let mut random = Random::new(14);
    let random = (0..500_000).map(move |_| {
        let mut size = |step: u32| {
            let exponent = random.below(step) as i32 - (step / 2) as i32;
            (0.5 + 0.5 * random.unit()) as f32 * 2f32.powi(exponent)
        };
        (size(4), size(60))
    });
    fixed
        .chain(random)
        .flat_map(|(y, x)| [(y, x), (y, -x), (-y, x), (-y, -x)])
}

/// Largest absolute error and largest ULP error (of results that are normal numbers) of an atan2.
fn atan2_errors(atan2: impl Fn(f32, f32) -> f32) -> (f64, f64) {
    let (mut absolute, mut ulp) = (0f64, 0f64);
    for (y, x) in plane_points() {
        // +0.0 takes the sign off a zero: on the cut at -x, the angle is +pi for both zeros, and 0 at the origin.
        let exact = f64::from(y + 0.0).atan2(f64::from(x + 0.0));
        let value = atan2(y, x);
        assert!(value.is_finite(), "atan2({y:e}, {x:e}) = {value}");
        absolute = absolute.max((f64::from(value) - exact).abs());
        if exact.abs() >= f64::from(f32::MIN_POSITIVE) {
            ulp = ulp.max(ulp_error(value, exact));
        }
    }
    (absolute, ulp)
}

#[test]
fn atan2_holds_in_every_quadrant_and_at_every_size() {
    let (absolute, ulp) = atan2_errors(<f32 as Real>::atan2);
    // Observed: 2.77e-7 (an ULP of pi is 2.38e-7) and 1.96 ULP (pi/2 is itself 0.73 ULP off, next to 1).
    within("atan2 absolute", absolute, 3.0e-7);
    within("atan2 ULP", ulp, 2.1);
    // Control: the quotient alone loses the quadrant.
    assert!(atan2_errors(|y, x| if x == 0.0 { 0.0 } else { (y / x).atan() }).0 > 3.0);
}

/// Angles in turns, even over [-1, 1] with a step that is no float's multiple, and floats of every small size.
fn turns() -> impl Iterator<Item = f32> {
    const STEPS: i32 = 2_000_003;
    let even = (-STEPS..=STEPS).map(|i| (f64::from(i) / f64::from(STEPS)) as f32);
    let small = (0..=1f32.to_bits()).step_by(1021).map(f32::from_bits);
    even.chain(small.flat_map(|t| [t, -t]))
}

/// Largest absolute error of either function, and largest distance of sin^2 + cos^2 from 1.
fn sin_cos_errors(function: impl Fn(f32) -> (f32, f32)) -> (f64, f64) {
    let (mut worst, mut circle) = (0f64, 0f64);
    for turns in turns() {
        let (sin, cos) = function(turns);
        let (sin, cos) = (f64::from(sin), f64::from(cos));
        let exact = (TAU * f64::from(turns)).sin_cos();
        worst = worst.max((sin - exact.0).abs()).max((cos - exact.1).abs());
        circle = circle.max((sin * sin + cos * cos - 1.0).abs());
    }
    (worst, circle)
}

#[test]
fn sine_and_cosine_hold_over_the_whole_circle() {
    let (worst, circle) = sin_cos_errors(sin_cos_turns);
    // Observed: 6.58e-8 and 1.52e-7.
    within("sin_cos_turns absolute", worst, 7.0e-8);
    within("sin^2 + cos^2 - 1", circle, 1.7e-7);
    // Control: an angle rounded to radians first is worse, and a sine too large by 2e-7 leaves the circle.
    assert!(sin_cos_errors(|turns| (turns * std::f32::consts::TAU).sin_cos()).0 > 2.0 * worst);
    let large = |turns| {
        let (sin, cos) = sin_cos_turns(turns);
        (sin * (1.0 + 2e-7), cos)
    };
    assert!(sin_cos_errors(large).1 > 1.5 * circle);
}

#[test]
fn eighths_of_a_turn_are_exact() {
    const HALF_ROOT: f32 = std::f32::consts::FRAC_1_SQRT_2;
    const EXPECTED: [(f32, f32); 8] = [
        (0.0, 1.0),
        (HALF_ROOT, HALF_ROOT),
        (1.0, 0.0),
        (HALF_ROOT, -HALF_ROOT),
        (0.0, -1.0),
        (-HALF_ROOT, -HALF_ROOT),
        (-1.0, 0.0),
        (-HALF_ROOT, HALF_ROOT),
    ];
    for eighth in -16..=16i32 {
        let expected = EXPECTED[eighth.rem_euclid(8) as usize];
        assert_eq!(sin_cos_turns(eighth as f32 / 8.0), expected, "{eighth}/8");
    }
    assert_eq!(0.125f32.tan_turns(), 1.0);
    assert_eq!((-0.125f32).tan_turns(), -1.0);
}

#[test]
fn no_input_panics() {
    for x in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        1e-45,
        -0.0,
    ] {
        atan_unit(x);
        sin_cos_turns(x);
        for y in [f32::NAN, f32::INFINITY, 0.0, 1.0] {
            <f32 as Real>::atan2(x, y);
            <f32 as Real>::atan2(y, x);
        }
    }
}

/// Largest difference between a dual number's derivatives and central differences of the same text in f64, relative to
/// derivatives above 1, over points with 0.2 <= |x|, |y| <= 1.
fn derivative_error(
    dual: impl Fn(Dual<f64, 2>, Dual<f64, 2>) -> Dual<f64, 2>,
    plain: impl Fn(f64, f64) -> f64,
) -> f64 {
    // Large enough for the cut-off third derivative, not rounding, to be the difference: the same on every machine.
    const STEP: f64 = 1e-4;
    let mut random = Random::new(7);
    let mut worst = 0f64;
    for _ in 0..5000 {
        let mut coordinate = || {
            let size = 0.2 + 0.8 * random.unit();
            if random.below(2) == 0 { size } else { -size }
        };
        let (x, y) = (coordinate(), coordinate());
        let value = dual(Dual::variable(x, 0), Dual::variable(y, 1));
        assert_eq!(value.value, plain(x, y));
        let slopes = [
            (plain(x + STEP, y) - plain(x - STEP, y)) / (2.0 * STEP),
            (plain(x, y + STEP) - plain(x, y - STEP)) / (2.0 * STEP),
        ];
        for (exact, slope) in value.derivative.into_iter().zip(slopes) {
            worst = worst.max((exact - slope).abs() / exact.abs().max(1.0));
        }
    }
    worst
}

/// One text for dual numbers and for f64.
macro_rules! derivative_error {
    (|$x:ident, $y:ident| $text:expr) => {
        derivative_error(|$x, $y| $text, |$x: f64, $y: f64| $text)
    };
}

#[test]
fn dual_derivatives_agree_with_central_differences() {
    // Observed: 2.58e-9, 6.58e-8, 6.58e-8, 2.10e-8, 4.62e-8, 2.50e-7, 3.12e-8.
    within(
        "atan_unit",
        derivative_error!(|x, y| Real::atan_unit(x * y)),
        3.0e-9,
    );
    within(
        "sine",
        derivative_error!(|x, y| Real::sin_cos_turns(x * y).0),
        7.0e-8,
    );
    within(
        "cosine",
        derivative_error!(|x, y| Real::sin_cos_turns(x * y).1),
        7.0e-8,
    );
    within("hypot", derivative_error!(|x, y| Real::hypot(x, y)), 2.5e-8);
    within("atan2", derivative_error!(|x, y| Real::atan2(x, y)), 5.0e-8);
    within("division", derivative_error!(|x, y| x / y), 2.7e-7);
    within(
        "sqrt",
        derivative_error!(|x, y| Real::sqrt(Real::abs(x * y))),
        3.5e-8,
    );
    // Control: a slope wrong by one part in 10^5 is over every budget above.
    let (dual, plain) = (|x: Dual<f64, 2>, _| x, |x: f64, _: f64| x);
    assert!(derivative_error(dual, plain) < 1e-11);
    let scaled = |x: Dual<f64, 2>, _: Dual<f64, 2>| Dual {
        value: x.value,
        derivative: x.derivative.map(|d| d * (1.0 + 1e-5)),
    };
    assert!(derivative_error(scaled, plain) > 9e-6);
}
