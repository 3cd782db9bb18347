//! Lines, cells and numbers of comma-separated values, in constant memory.

use std::borrow::Cow;
use std::io::{self, BufRead, Write};

/// Longest line that is read, in bytes. Three numbers need less than a hundred, however they are written; a longer line
/// is passed over without being kept.
pub(super) const LONGEST_LINE: usize = 1 << 16;

/// One line of the input.
pub(super) enum Line {
    /// Its text, without the line end, is in the buffer.
    Text,
    /// It is longer than [`LONGEST_LINE`].
    TooLong,
    /// There is none: the input has ended.
    End,
}

/// Reads the next line into `buffer`. Calls `before_waiting` whenever the input may block.
pub(super) fn read_line(
    input: &mut io::BufReader<impl io::Read>,
    buffer: &mut Vec<u8>,
    mut before_waiting: impl FnMut() -> io::Result<()>,
) -> Result<Line, ReadError> {
    buffer.clear();
    let (mut length, mut ended) = (0, false);
    while !ended {
        if input.buffer().is_empty() {
            before_waiting().map_err(ReadError::Output)?;
        }
        let bytes = match input.fill_buf() {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(ReadError::Input(error)),
        };
        if bytes.is_empty() {
            if length == 0 {
                return Ok(Line::End);
            }
            break;
        }
        let end = bytes.iter().position(|&byte| byte == b'\n');
        ended = end.is_some();
        let part = &bytes[..end.unwrap_or(bytes.len())];
        let used = part.len() + usize::from(ended);
        buffer.extend_from_slice(&part[..part.len().min(LONGEST_LINE - buffer.len())]);
        // A lone line end counts as a line, though it leaves no text.
        length += used;
        input.consume(used);
    }
    let text = length - usize::from(ended);
    Ok(if text > LONGEST_LINE {
        Line::TooLong
    } else {
        Line::Text
    })
}

/// Which side of a stream failed.
pub(super) enum ReadError {
    /// Reading.
    Input(io::Error),
    /// Writing what was held back, before waiting.
    Output(io::Error),
}

/// The first three cells of a line, trimmed and without their quotes, and how many of them there are.
pub(super) fn first_cells(line: &str) -> ([Cow<'_, str>; 3], usize) {
    let mut cells = [const { Cow::Borrowed("") }; 3];
    let (mut rest, mut count) = (Some(line), 0);
    while let (Some(text), true) = (rest, count < 3) {
        (cells[count], rest) = next_cell(text);
        count += 1;
    }
    (cells, count)
}

/// The first cell of `text` and what follows its comma, if there is one.
fn next_cell(text: &str) -> (Cow<'_, str>, Option<&str>) {
    let Some(quoted) = text.trim_start().strip_prefix('"') else {
        return match text.split_once(',') {
            Some((cell, rest)) => (cell.trim().into(), Some(rest)),
            None => (text.trim().into(), None),
        };
    };
    // A doubled quote stands for one; the first single one closes the cell.
    let mut at = 0;
    let close = loop {
        match quoted[at..].find('"') {
            Some(found) if quoted[at + found + 1..].starts_with('"') => at += found + 2,
            Some(found) => break at + found,
            None => break quoted.len(),
        }
    };
    let after = quoted.get(close + 1..).unwrap_or("");
    let cell = quoted[..close].trim();
    let cell = if cell.contains('"') {
        cell.replace("\"\"", "\"").into()
    } else {
        cell.into()
    };
    (cell, after.split_once(',').map(|(_, rest)| rest))
}

/// Writes a cell of text, quoted where it has to be.
pub(super) fn write_cell(out: &mut impl Write, cell: &str) -> io::Result<()> {
    if cell.contains(['"', ',', '\r']) {
        write!(out, "\"{}\"", cell.replace('"', "\"\""))
    } else {
        out.write_all(cell.as_bytes())
    }
}

/// The number type of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Precision {
    /// Single precision
    F32,
    /// Double precision
    F64,
}

impl Precision {
    /// The number of this type nearest to a decimal; `None` for what is no number.
    pub(super) fn parse(self, cell: &str) -> Option<f64> {
        match self {
            Self::F32 => cell.parse::<f32>().ok().map(f64::from),
            Self::F64 => cell.parse().ok(),
        }
    }

    /// Writes the fewest digits that read back to the same number of this type, rounding `value` to it first.
    pub(super) fn write(self, out: &mut impl Write, value: f64) -> io::Result<()> {
        // Outside this range the zeros would outnumber the digits.
        let plain = value == 0.0 || (1e-5..1e16).contains(&value.abs());
        match (self, plain) {
            (Self::F32, true) => write!(out, "{}", value as f32),
            (Self::F32, false) => write!(out, "{:e}", value as f32),
            (Self::F64, true) => write!(out, "{value}"),
            (Self::F64, false) => write!(out, "{value:e}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(line: &str) -> (Vec<String>, usize) {
        let (cells, count) = first_cells(line);
        (cells.map(|cell| cell.into_owned()).to_vec(), count)
    }

    #[test]
    fn cells_are_trimmed_and_unquoted() {
        let three = |a: &str, b: &str, c: &str| (vec![a.to_owned(), b.to_owned(), c.to_owned()], 3);
        assert_eq!(cells("1,2,3"), three("1", "2", "3"));
        assert_eq!(cells(" 1 ,\t2,3 \r"), three("1", "2", "3"));
        assert_eq!(cells("1,2,3,4,\"5"), three("1", "2", "3"));
        assert_eq!(
            cells("\"1\", \"2\" ,\"a,\"\"b\"\"\",4"),
            three("1", "2", "a,\"b\"")
        );
        assert_eq!(
            cells("\"open, 2"),
            (vec!["open, 2".into(), "".into(), "".into()], 1)
        );
        assert_eq!(cells("1,2").1, 2);
        assert_eq!(cells("1,2,").1, 3);
        assert_eq!(cells(",,"), three("", "", ""));
    }

    #[test]
    fn numbers_read_back_and_are_short() {
        let written = |precision: Precision, value: f64| {
            let mut out = Vec::new();
            precision.write(&mut out, value).unwrap();
            String::from_utf8(out).unwrap()
        };
        let f32s = [0.1, 1e-7, 3.402_823_5e38, 1e-45, 16_777_216.0, -0.0, 0.5];
        for value in f32s.map(|v: f32| f64::from(v)) {
            let text = written(Precision::F32, value);
            let back = Precision::F32.parse(&text).unwrap();
            assert_eq!(back.to_bits(), value.to_bits(), "{text}");
            assert!(text.len() <= 13, "{text}");
        }
        assert_eq!(written(Precision::F32, f64::from(0.1_f32)), "0.1");
        assert_eq!(
            written(Precision::F64, f64::from(0.1_f32)),
            "0.10000000149011612"
        );
        assert_eq!(written(Precision::F64, 5e-324), "5e-324");
        assert_eq!(written(Precision::F64, 1.0), "1");
    }

    #[test]
    fn a_long_line_is_passed_over() {
        let long = "7".repeat(3 * LONGEST_LINE);
        let text = format!("a\n{long}\nb\r\n\nc");
        let mut input = io::BufReader::with_capacity(100, text.as_bytes());
        let (mut buffer, mut seen) = (Vec::new(), Vec::new());
        loop {
            match read_line(&mut input, &mut buffer, || Ok(())).ok().unwrap() {
                Line::Text => seen.push(String::from_utf8(buffer.clone()).unwrap()),
                Line::TooLong => seen.push("too long".to_owned()),
                Line::End => break,
            }
            assert!(buffer.capacity() <= 2 * LONGEST_LINE);
        }
        assert_eq!(seen, ["a", "too long", "b\r", "", "c"]);
    }
}
