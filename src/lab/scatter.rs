//! Error over run time, both logarithmic, a field for each mapping, with the front.

use super::bench::{CPU, Row, SHADER, Way};
use super::drawing::{Colour, Drawing};
use super::inputs::Inputs;

/// Pixels of a field.
const FIELD: [f64; 2] = [640.0, 420.0];
/// Room around the axes: left, top, right, bottom.
const MARGIN: [f64; 4] = [58.0, 34.0, 90.0, 36.0];

const INK: Colour = [40, 40, 40];
const GRID: Colour = [225, 225, 225];
const FRONT: Colour = [200, 30, 60];

/// The colour of an evaluator, by the first letters of its name: shaders, own polynomials, tables, the literature's, one by one.
fn colour(row: &Row) -> Colour {
    if row.isa == SHADER {
        [140, 60, 170]
    } else if row.evaluator.starts_with("atan-") || row.evaluator == "lanes" {
        [20, 90, 200]
    } else if row.evaluator.starts_with("table-") {
        [60, 150, 70]
    } else if row.ns_latency.is_some() && row.isa == "baseline" {
        [120, 120, 120]
    } else {
        [230, 130, 20]
    }
}

/// The picture of the rows that were measured forwards, on random inputs, by one thread, few at a time, or by an adapter.
pub fn scatter(rows: &[Row]) -> Drawing {
    let shown = |row: &&Row| {
        row.direction == Way::Forward
            && row.inputs == Inputs::Random
            && row.is_comparable()
            && row.holes == 0
            && row.ns > 0.0
            && row.max_error_rad > 0.0
    };
    let shown: Vec<&Row> = rows.iter().filter(shown).collect();
    let mut maps: Vec<&str> = shown.iter().map(|row| row.mapping).collect();
    maps.dedup();
    let columns = (maps.len() as f64).sqrt().ceil().max(1.0);
    let lines = (maps.len() as f64 / columns).ceil().max(1.0);
    let mut drawing = Drawing::new([columns * FIELD[0], lines * FIELD[1]].map(|c| c as u32));
    for (k, map) in maps.iter().enumerate() {
        let corner = [
            k as f64 % columns * FIELD[0],
            (k as f64 / columns).floor() * FIELD[1],
        ];
        let rows: Vec<&Row> = shown
            .iter()
            .copied()
            .filter(|row| row.mapping == *map)
            .collect();
        let axes = [
            LogAxis::over(rows.iter().map(|row| row.ns)),
            LogAxis::over(rows.iter().map(|row| row.max_error_rad)),
        ];
        field(&mut drawing, corner, map, axes, &rows);
    }
    drawing
}

/// A logarithmic axis.
#[derive(Clone, Copy, Debug)]
pub struct LogAxis {
    /// Decimal logarithm of its lower end.
    pub low: f64,
    /// Decimal logarithm of its upper end.
    pub high: f64,
}

impl LogAxis {
    /// A little more than the values.
    pub fn over(values: impl Iterator<Item = f64> + Clone) -> Self {
        const ROOM: f64 = 0.1;
        let exponents = values.map(f64::log10);
        let low = exponents.clone().fold(f64::INFINITY, f64::min);
        let high = exponents.fold(f64::NEG_INFINITY, f64::max);
        if low > high {
            return Self {
                low: 0.0,
                high: 1.0,
            };
        }
        Self {
            low: low - ROOM,
            high: high + ROOM,
        }
    }

    /// Share of the axis.
    fn share(self, value: f64) -> f64 {
        (value.log10() - self.low) / (self.high - self.low)
    }

    /// Where lines are drawn.
    pub fn marks(self) -> Vec<f64> {
        log_marks([self.low, self.high].map(|exponent| 10_f64.powf(exponent)))
    }
}

/// Where a logarithmic axis from `low` to `high` is marked: at 1, 2 and 5 times the powers of ten, or at those alone where there are many.
pub fn log_marks([low, high]: [f64; 2]) -> Vec<f64> {
    const MANY: f64 = 1e3;
    let steps: &[f64] = if high > MANY * low {
        &[1.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let marks = powers.flat_map(|power| steps.iter().map(move |s| s * 10_f64.powi(power)));
    marks.filter(|mark| (low..=high).contains(mark)).collect()
}

/// Nanoseconds and radians of each.
pub fn costs(rows: &[&Row]) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [row.ns, row.max_error_rad]).collect()
}

fn field(
    drawing: &mut Drawing,
    corner: [f64; 2],
    map: &str,
    [time, error]: [LogAxis; 2],
    rows: &[&Row],
) {
    let [left, top, right, bottom] = MARGIN;
    let span = [FIELD[0] - left - right, FIELD[1] - top - bottom];
    let place = |ns: f64, rad: f64| {
        [
            corner[0] + left + time.share(ns) * span[0],
            corner[1] + top + (1.0 - error.share(rad)) * span[1],
        ]
    };
    let (ns, rad) = (
        [time.low, time.high].map(|c| 10_f64.powf(c)),
        [error.low, error.high].map(|c| 10_f64.powf(c)),
    );
    for mark in time.marks() {
        let ends = rad.map(|rad| place(mark, rad));
        drawing.line(&ends, 1.0, GRID);
        drawing.words(
            &mark.to_string(),
            [ends[0][0] - 6.0, ends[0][1] + 6.0],
            9.0,
            INK,
        );
    }
    for mark in error.marks() {
        let ends = ns.map(|ns| place(ns, mark));
        drawing.line(&ends, 1.0, GRID);
        drawing.words(
            &format!("{mark:.0e}"),
            [corner[0] + 10.0, ends[0][1] - 5.0],
            9.0,
            INK,
        );
    }
    drawing.words(map, [corner[0] + left, corner[1] + 8.0], 13.0, INK);
    drawing.words(
        "max error rad",
        [corner[0] + left + 0.5 * span[0], corner[1] + 12.0],
        9.0,
        INK,
    );
    drawing.words(
        "ns a direction",
        [
            corner[0] + left + 0.5 * span[0],
            corner[1] + FIELD[1] - 16.0,
        ],
        9.0,
        INK,
    );

    let front = |is_shader: bool| {
        let mut front: Vec<&Row> = rows.to_vec();
        front.retain(|row| row.on_front && (row.device != CPU) == is_shader);
        front.sort_by(|a, b| a.ns.total_cmp(&b.ns));
        front
    };
    // Of the processor, then of the adapter.
    let fronts = [false, true].map(front);
    for front in &fronts {
        let steps: Vec<[f64; 2]> = front_steps(&costs(front))
            .into_iter()
            .map(|[ns, rad]| place(ns, rad))
            .collect();
        drawing.line(&steps, 1.5, FRONT);
    }
    for row in rows {
        let radius = if row.on_front { 4.0 } else { 2.5 };
        drawing.disc(place(row.ns, row.max_error_rad), radius, colour(row));
    }
    for front in fronts {
        // From the top down, each name below the one before.
        let mut lowest = f64::NEG_INFINITY;
        for row in front {
            let [x, y] = place(row.ns, row.max_error_rad);
            let top = (y - 9.0).max(lowest);
            drawing.words(row.evaluator, [x + 7.0, top], 8.0, INK);
            lowest = top + 10.0;
        }
    }
}

/// The line through a front, in the order of its points. It is a stair: between two of the front nothing is nearer in the second than the
/// first of both.
pub fn front_steps(front: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let corner = |pair: &[[f64; 2]]| [pair[0], [pair[1][0], pair[0][1]], pair[1]];
    front.windows(2).flat_map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::log_marks;

    #[test]
    fn an_axis_is_marked_at_one_two_and_five_or_at_powers_where_there_are_many() {
        assert_eq!(log_marks([0.5, 20.0]), [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
        assert_eq!(log_marks([0.3, 2e3]), [1.0, 10.0, 100.0, 1e3]);
        assert!(log_marks([6.0, 9.0]).is_empty());
    }
}
