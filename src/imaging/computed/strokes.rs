//! Letters and arrows as strokes: the distance to the nearest one is all that drawing needs.

/// A drawing in the plane, x to the right, y down.
pub(super) struct Strokes {
    segments: Vec<[[f64; 2]; 2]>,
    low: [f64; 2],
    high: [f64; 2],
}

/// Letters are 1 high and this wide.
const LETTER_WIDTH: f64 = 0.6;

/// From the left of one letter to the left of the next.
const ADVANCE: f64 = 0.9;

impl Strokes {
    pub(super) fn new() -> Self {
        Self {
            segments: Vec::new(),
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        }
    }

    /// Adds the lines through the points.
    pub(super) fn line(mut self, points: &[[f64; 2]]) -> Self {
        for pair in points.windows(2) {
            self.segments.push([pair[0], pair[1]]);
            for [x, y] in [pair[0], pair[1]] {
                self.low = [self.low[0].min(x), self.low[1].min(y)];
                self.high = [self.high[0].max(x), self.high[1].max(y)];
            }
        }
        self
    }

    /// Adds text of letter height `size` whose upper left corner is `at`.
    pub(super) fn text(mut self, text: &str, at: [f64; 2], size: f64) -> Self {
        for (index, letter) in text.chars().enumerate() {
            let left = at[0] + index as f64 * ADVANCE * size;
            for line in letter_lines(letter) {
                let points: Vec<_> = line
                    .iter()
                    .map(|[x, y]| [left + x * size, at[1] + y * size])
                    .collect();
                self = self.line(&points);
            }
        }
        self
    }

    /// Adds text with its middle at `at`.
    pub(super) fn centered_text(self, text: &str, at: [f64; 2], size: f64) -> Self {
        let width = text_width(text, size);
        self.text(text, [at[0] - width / 2.0, at[1] - size / 2.0], size)
    }

    /// Adds an arrow whose head has sides of `head`.
    pub(super) fn arrow(self, from: [f64; 2], to: [f64; 2], head: f64) -> Self {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        let (dx, dy) = (dx / length * head, dy / length * head);
        let left = [to[0] - dx - dy * 0.6, to[1] - dy + dx * 0.6];
        let right = [to[0] - dx + dy * 0.6, to[1] - dy - dx * 0.6];
        self.line(&[from, to]).line(&[left, to, right])
    }

    /// Distance of `p` from the nearest stroke, or infinity when it is farther than `reach`.
    pub(super) fn distance(&self, p: [f64; 2], reach: f64) -> f64 {
        let outside = (0..2)
            .any(|axis| p[axis] < self.low[axis] - reach || p[axis] > self.high[axis] + reach);
        if outside {
            return f64::INFINITY;
        }
        let squared = self
            .segments
            .iter()
            .fold(f64::INFINITY, |nearest, [from, to]| {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let (px, py) = (p[0] - from[0], p[1] - from[1]);
                let along = ((px * dx + py * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                let (ex, ey) = (px - along * dx, py - along * dy);
                nearest.min(ex * ex + ey * ey)
            });
        squared.sqrt()
    }
}

/// Width of a text of letter height `size`.
fn text_width(text: &str, size: f64) -> f64 {
    let letters = text.chars().count();
    (letters.saturating_sub(1) as f64 * ADVANCE + LETTER_WIDTH) * size
}

/// Lines of a letter in a box of 0.6 x 1, y down. A letter that is not drawn here is a space.
fn letter_lines(letter: char) -> &'static [&'static [[f64; 2]]] {
    match letter {
        '+' => &[&[[0.0, 0.5], [0.6, 0.5]], &[[0.3, 0.2], [0.3, 0.8]]],
        '-' => &[&[[0.0, 0.5], [0.6, 0.5]]],
        'X' => &[&[[0.0, 0.0], [0.6, 1.0]], &[[0.6, 0.0], [0.0, 1.0]]],
        'Y' => &[
            &[[0.0, 0.0], [0.3, 0.5], [0.6, 0.0]],
            &[[0.3, 0.5], [0.3, 1.0]],
        ],
        'Z' => &[&[[0.0, 0.0], [0.6, 0.0], [0.0, 1.0], [0.6, 1.0]]],
        'R' => &[&[
            [0.0, 1.0],
            [0.0, 0.0],
            [0.42, 0.0],
            [0.57, 0.1],
            [0.6, 0.25],
            [0.57, 0.4],
            [0.42, 0.5],
            [0.0, 0.5],
            [0.3, 0.5],
            [0.6, 1.0],
        ]],
        'u' => &[
            &[
                [0.05, 0.4],
                [0.05, 0.82],
                [0.15, 0.97],
                [0.3, 1.0],
                [0.45, 0.93],
                [0.55, 0.8],
            ],
            &[[0.55, 0.4], [0.55, 1.0]],
        ],
        'v' => &[&[[0.0, 0.4], [0.3, 1.0], [0.6, 0.4]]],
        '0' => &[&[
            [0.3, 0.0],
            [0.12, 0.08],
            [0.02, 0.28],
            [0.0, 0.5],
            [0.02, 0.72],
            [0.12, 0.92],
            [0.3, 1.0],
            [0.48, 0.92],
            [0.58, 0.72],
            [0.6, 0.5],
            [0.58, 0.28],
            [0.48, 0.08],
            [0.3, 0.0],
        ]],
        '1' => &[&[[0.1, 0.2], [0.35, 0.0], [0.35, 1.0]]],
        '2' => &[&[
            [0.02, 0.24],
            [0.08, 0.09],
            [0.22, 0.0],
            [0.4, 0.0],
            [0.54, 0.09],
            [0.58, 0.25],
            [0.52, 0.42],
            [0.0, 1.0],
            [0.6, 1.0],
        ]],
        '3' => &[&[
            [0.03, 0.1],
            [0.2, 0.0],
            [0.4, 0.0],
            [0.54, 0.08],
            [0.57, 0.24],
            [0.5, 0.4],
            [0.35, 0.47],
            [0.2, 0.47],
            [0.35, 0.47],
            [0.54, 0.55],
            [0.6, 0.72],
            [0.54, 0.9],
            [0.38, 1.0],
            [0.18, 1.0],
            [0.0, 0.88],
        ]],
        '4' => &[&[[0.45, 1.0], [0.45, 0.0], [0.0, 0.7], [0.6, 0.7]]],
        '5' => &[&[
            [0.54, 0.0],
            [0.09, 0.0],
            [0.05, 0.45],
            [0.3, 0.37],
            [0.5, 0.45],
            [0.6, 0.65],
            [0.55, 0.88],
            [0.38, 1.0],
            [0.18, 1.0],
            [0.0, 0.9],
        ]],
        '6' => &[&[
            [0.5, 0.05],
            [0.3, 0.0],
            [0.1, 0.18],
            [0.0, 0.5],
            [0.02, 0.8],
            [0.15, 0.96],
            [0.3, 1.0],
            [0.48, 0.95],
            [0.59, 0.78],
            [0.59, 0.62],
            [0.48, 0.47],
            [0.3, 0.42],
            [0.12, 0.48],
            [0.01, 0.65],
        ]],
        '7' => &[&[[0.0, 0.0], [0.6, 0.0], [0.2, 1.0]]],
        '8' => &[&[
            [0.3, 0.47],
            [0.1, 0.38],
            [0.05, 0.22],
            [0.12, 0.06],
            [0.3, 0.0],
            [0.48, 0.06],
            [0.55, 0.22],
            [0.5, 0.38],
            [0.3, 0.47],
            [0.08, 0.58],
            [0.0, 0.75],
            [0.09, 0.93],
            [0.3, 1.0],
            [0.51, 0.93],
            [0.6, 0.75],
            [0.52, 0.58],
            [0.3, 0.47],
        ]],
        '9' => &[&[
            [0.1, 0.95],
            [0.3, 1.0],
            [0.5, 0.82],
            [0.6, 0.5],
            [0.58, 0.2],
            [0.45, 0.04],
            [0.3, 0.0],
            [0.12, 0.05],
            [0.01, 0.22],
            [0.01, 0.38],
            [0.12, 0.53],
            [0.3, 0.58],
            [0.48, 0.52],
            [0.59, 0.35],
        ]],
        '°' => &[&[
            [0.15, 0.0],
            [0.02, 0.06],
            [0.0, 0.15],
            [0.02, 0.24],
            [0.15, 0.3],
            [0.28, 0.24],
            [0.3, 0.15],
            [0.28, 0.06],
            [0.15, 0.0],
        ]],
        _ => &[],
    }
}
