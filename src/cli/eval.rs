//! `sixfold eval`: a stream of directions to chart coordinates, or back, in constant memory.

use std::borrow::Cow;
use std::io::{self, BufReader, IsTerminal, Read, Write};
use std::mem::take;

use super::csv::{self, Line, Precision, ReadError};
use super::plan::{EvalOptions, Plan};
use super::{CliError, DONE, FAILED};
use crate::mapping::{ChartPoint, Device, Domain, EvaluatorError};

/// A direction and where it lands.
struct Row {
    dir: [f64; 3],
    point: ChartPoint<f64>,
}

/// A line that has been read and not yet been computed.
struct Waiting {
    /// Its number.
    line: u64,
    /// Its first cells as they came.
    cells: [String; 3],
    /// What they say, or why they say nothing.
    given: Result<Given, String>,
}

/// What a line asks for.
#[derive(Clone, Copy)]
enum Given {
    /// The chart point of a direction.
    Dir([f64; 3]),
    /// The direction of a chart point.
    Point(ChartPoint<f64>),
}

/// How many lines there were.
#[derive(Default)]
struct Counts {
    /// Lines of the input.
    lines: u64,
    /// Lines that hold a row, computed or not.
    rows: u64,
    /// Rows that could not be computed.
    bad: u64,
}

/// Reads the stream and writes the rows; `complaints` gets a line for each row that cannot be computed. The result is
/// the exit status.
pub(super) fn run(
    options: &EvalOptions,
    device: &dyn Device,
    input: impl Read,
    out: &mut impl Write,
    mut complaints: impl Write,
) -> Result<u8, CliError> {
    let plan = Plan::new(options, device)?;
    let task = Task {
        names: if options.inverse {
            plan.columns()
        } else {
            ["x", "y", "z"]
        },
        inverse: options.inverse,
        precision: options.precision,
        plan,
    };
    let mut counts = Counts::default();
    task.stream(input, out, &mut complaints, &mut counts)?;
    if counts.bad == 0 {
        return Ok(DONE);
    }
    let _ = writeln!(
        complaints,
        "sixfold: {} of {} lines could not be computed; their results were left empty",
        counts.bad, counts.rows
    );
    Ok(FAILED)
}

/// A plan and the shape of its input and output.
struct Task {
    plan: Plan,
    /// Names of the three columns that are read.
    names: [&'static str; 3],
    inverse: bool,
    precision: Precision,
}

impl Task {
    fn stream(
        &self,
        input: impl Read,
        out: &mut impl Write,
        complaints: &mut impl Write,
        counts: &mut Counts,
    ) -> Result<(), CliError> {
        if io::stdin().is_terminal() {
            let names = self.names.join(",");
            let _ = writeln!(complaints, "sixfold: type lines of {names}; Ctrl-D ends");
        }
        let columns = self.plan.columns().join(",");
        writeln!(out, "x,y,z,{columns}").map_err(CliError::Write)?;

        let mut input = BufReader::with_capacity(1 << 16, input);
        let mut buffer = Vec::new();
        let mut header_may_come = true;
        let mut waiting = Vec::new();
        loop {
            // Whoever waits for an answer before asking on gets it: nothing is held back while there is no input.
            let mut failed = None;
            let line = csv::read_line(&mut input, &mut buffer, || {
                failed = self
                    .answer(take(&mut waiting), out, complaints, counts)
                    .err();
                out.flush()
            });
            if let Some(error) = failed {
                return Err(error);
            }
            let line = line.map_err(|error| match error {
                ReadError::Input(error) => CliError::Read(error),
                ReadError::Output(error) => CliError::Write(error),
            })?;
            let text = match line {
                Line::End => return self.answer(waiting, out, complaints, counts),
                Line::TooLong => Cow::Borrowed(""),
                Line::Text => String::from_utf8_lossy(&buffer),
            };
            counts.lines += 1;
            let is_text = matches!(line, Line::Text);
            let text = match text.strip_prefix('\u{feff}') {
                Some(rest) if counts.lines == 1 => rest,
                _ => &text,
            };
            if is_text && text.trim().is_empty() {
                continue;
            }
            let (cells, count) = csv::first_cells(text);
            if std::mem::take(&mut header_may_come) && count == 3 && is_header(&cells) {
                continue;
            }
            counts.rows += 1;
            let given = if is_text {
                self.given(&cells, count)
            } else {
                Err(format!("longer than {} bytes", csv::LONGEST_LINE))
            };
            waiting.push(Waiting {
                line: counts.lines,
                cells: cells.map(Cow::into_owned),
                given,
            });
            if waiting.len() >= self.plan.lines {
                self.answer(take(&mut waiting), out, complaints, counts)?;
            }
        }
    }

    /// What the first cells of a line ask for, or why they ask for nothing.
    fn given(&self, cells: &[Cow<'_, str>; 3], count: usize) -> Result<Given, String> {
        if count < 3 {
            return Err(format!("{count} of the columns {}", self.names.join(",")));
        }
        if !self.inverse {
            let [x, y, z] = [0, 1, 2].map(|column| self.number(cells, column));
            return Ok(Given::Dir([x?, y?, z?]));
        }
        let chart = chart_index(&cells[0])
            .ok_or_else(|| format!("{} is no chart index: {:?}", self.names[0], cells[0]))?;
        let [u, v] = [1, 2].map(|column| self.number(cells, column));
        Ok(Given::Point(ChartPoint::new(chart, u?, v?)))
    }

    /// Computes the lines and writes their rows, in order.
    fn answer(
        &self,
        waiting: Vec<Waiting>,
        out: &mut impl Write,
        complaints: &mut impl Write,
        counts: &mut Counts,
    ) -> Result<(), CliError> {
        let mut rows = self.rows(&waiting)?.into_iter();
        for line in &waiting {
            let row = match &line.given {
                Ok(given) => rows.next().flatten().ok_or_else(|| self.why_none(*given)),
                Err(reason) => Err(reason.clone()),
            };
            match row {
                Ok(row) => self.write(out, &row),
                Err(reason) => {
                    counts.bad += 1;
                    let _ = writeln!(complaints, "sixfold: line {}: {reason}", line.line);
                    self.write_empty(out, &line.cells)
                }
            }
            .map_err(CliError::Write)?;
        }
        Ok(())
    }

    /// A row for each line that asks for something; `None` where nothing is found.
    fn rows(&self, waiting: &[Waiting]) -> Result<Vec<Option<Row>>, EvaluatorError> {
        let (mut dirs, mut points) = (Vec::new(), Vec::new());
        for line in waiting {
            match line.given {
                Ok(Given::Dir(dir)) => dirs.push(dir),
                Ok(Given::Point(point)) => points.push(point),
                Err(_) => {}
            }
        }
        let row = |(dir, point)| Some(Row { dir, point });
        if self.inverse {
            let found = self.plan.inverse(&points)?.into_iter().zip(points);
            return Ok(found.map(|(dir, point)| row((dir?, point))).collect());
        }
        let found = dirs.iter().copied().zip(self.plan.forward(&dirs)?);
        Ok(found.map(|(dir, point)| row((dir, point?))).collect())
    }

    /// Why a line has no result.
    fn why_none(&self, given: Given) -> String {
        match given {
            Given::Dir(dir) if dir.iter().any(|c| !c.is_finite()) => {
                "the direction is not finite".to_owned()
            }
            Given::Dir(dir) if dir == [0.0; 3] => "the zero vector is no direction".to_owned(),
            Given::Dir(_) => "this evaluator finds no chart for the direction (a hole)".to_owned(),
            Given::Point(_) => self.off_the_chart(),
        }
    }

    fn number(&self, cells: &[Cow<'_, str>; 3], column: usize) -> Result<f64, String> {
        let number = self.precision.parse(&cells[column]);
        number.ok_or_else(|| format!("{} is no number: {:?}", self.names[column], cells[column]))
    }

    fn off_the_chart(&self) -> String {
        let [chart, u, v] = self.names;
        let info = self.plan.info;
        let last = info.chart_count() - 1;
        let disc = match info.domain {
            Domain::Square => "",
            Domain::Disc => ", inside the disc",
        };
        format!("off the chart: {chart} must be 0 to {last}, {u} and {v} in [0, 1]{disc}")
    }

    fn write(&self, out: &mut impl Write, row: &Row) -> io::Result<()> {
        for component in row.dir {
            self.precision.write(out, component)?;
            out.write_all(b",")?;
        }
        write!(out, "{},", row.point.chart)?;
        self.precision.write(out, row.point.u)?;
        out.write_all(b",")?;
        self.precision.write(out, row.point.v)?;
        out.write_all(b"\n")
    }

    /// A row whose input stands as it came and whose results are empty.
    fn write_empty(&self, out: &mut impl Write, cells: &[String; 3]) -> io::Result<()> {
        if self.inverse {
            out.write_all(b",,,")?;
        }
        for (i, cell) in cells.iter().enumerate() {
            if i > 0 {
                out.write_all(b",")?;
            }
            csv::write_cell(out, cell)?;
        }
        if !self.inverse {
            out.write_all(b",,,")?;
        }
        out.write_all(b"\n")
    }
}

/// A line of names: none of its cells is a number and none is empty.
fn is_header(cells: &[Cow<'_, str>; 3]) -> bool {
    cells
        .iter()
        .all(|cell| !cell.is_empty() && cell.parse::<f64>().is_err())
}

/// A chart index; also as a whole decimal number, since tables with gaps store integers so.
fn chart_index(cell: &str) -> Option<u32> {
    cell.parse().ok().or_else(|| {
        let number: f64 = cell.parse().ok()?;
        let whole = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
        whole.then_some(number as u32)
    })
}
