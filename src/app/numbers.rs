//! Numbers as text.

/// A positive number with three digits that count.
pub fn significant(x: f64) -> String {
    if (1e-3..1e4).contains(&x) {
        let places = (2 - x.log10().floor() as i32).max(0) as usize;
        format!("{x:.places$}")
    } else {
        format!("{x:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_that_count() {
        for (x, text) in [
            (0.001_234, "0.00123"),
            (0.5, "0.500"),
            (12.345, "12.3"),
            (1234.5, "1234"),
            (2.5e-7, "2.50e-7"),
            (65504.0, "6.55e4"),
        ] {
            assert_eq!(significant(x), text);
        }
    }
}
