//! Wavefront OBJ (Alias|Wavefront, *Advanced Visualizer Manual*, appendix B1): `v`, `vn` and `f`; of `o` and `g` the number.
//!
//! Own code (ARCHITECTURE.md says why). Nothing but the text is read: `mtllib` and `call` open no file.

use glam::{DVec3, Vec3};

use super::error::{MeshProblem, judge, quoted, stop_if_cancelled};
use super::raw::{Corner, Raw};
use super::{Format, MOST_TRIANGLES};
use crate::imaging::Progress;

/// As many as the corners of the most triangles: a normal for each is all that can be used.
const MOST_NORMALS: u64 = 3 * MOST_TRIANGLES;

/// Lines between two looks at the progress.
const LINES_PER_STEP: usize = 1 << 14;

pub(super) fn parse(bytes: &[u8], progress: &Progress) -> Result<Raw, MeshProblem> {
    let mut raw = Raw::default();
    let mut farthest = Farthest::default();
    let mut corners: Vec<Corner> = Vec::new();
    let (mut part_is_new, mut has_materials) = (true, false);
    let mut lines = Lines {
        bytes,
        at: 0,
        number: 0,
    };
    let mut count = 0_usize;
    while let Some((line, number)) = lines.next() {
        count += 1;
        if count.is_multiple_of(LINES_PER_STEP) {
            progress.step(lines.at, bytes.len());
            stop_if_cancelled(progress)?;
        }
        let mut words = words(line);
        match words.next().unwrap_or_default() {
            b"v" => {
                raw.judge_positions(1)?;
                // What may follow (a weight for curves, or a colour) is not used.
                let position = numbers(&mut words, number)?;
                if !raw.add_position(DVec3::from(position)) {
                    return Err(damaged(number, "a position is not a finite number"));
                }
            }
            b"vn" => {
                judge("normals", raw.normals.len() as u64 + 1, MOST_NORMALS)?;
                let normal = numbers(&mut words, number)?;
                raw.normals.push(Vec3::from(normal.map(|x| x as f32)));
            }
            b"f" => {
                corners.clear();
                for word in words {
                    // A polygon of n corners has n - 2 triangles.
                    raw.judge_triangles((corners.len() as u64).saturating_sub(1))?;
                    corners.push(corner(word, &raw, number, &mut farthest)?);
                }
                if corners.len() < 3 {
                    raw.skipped += 1;
                    continue;
                }
                // Cut as a fan from the first corner: right for convex polygons.
                let (first, rest) = (corners[0], &corners[1..]);
                let fan = rest.windows(2).map(|pair| [first, pair[0], pair[1]]);
                raw.triangles.extend(fan);
                raw.parts += usize::from(std::mem::take(&mut part_is_new));
            }
            b"o" | b"g" => part_is_new = true,
            b"usemtl" => has_materials = true,
            b"l" | b"p" | b"curv" | b"surf" => raw.skipped += 1,
            _ => {}
        }
    }
    farthest.judge(&raw)?;
    if has_materials {
        raw.notes.push("not used: materials".to_owned());
    }
    Ok(raw)
}

/// Positive numbers may name lines that follow, so the largest are judged when all lines are read.
#[derive(Default)]
struct Farthest {
    /// Largest number of a position and of a normal, counted from 1, each with its line.
    position: (u64, usize),
    normal: (u64, usize),
}

impl Farthest {
    fn judge(&self, raw: &Raw) -> Result<(), MeshProblem> {
        for (what, (number, line), count) in [
            ("v", self.position, raw.positions.len()),
            ("vn", self.normal, raw.normals.len()),
        ] {
            if number > count as u64 {
                let reason = format!("a face names {what} {number} of {count}");
                return Err(damaged(line, &reason));
            }
        }
        Ok(())
    }
}

/// A corner of a face: `v`, `v/vt`, `v//vn` or `v/vt/vn`. Texture coordinates are not looked at.
fn corner(
    word: &[u8],
    raw: &Raw,
    line: usize,
    farthest: &mut Farthest,
) -> Result<Corner, MeshProblem> {
    let mut parts = word.split(|&b| b == b'/');
    let position = parts.next().unwrap_or_default();
    let position = vertex_number(position, raw.positions.len(), line, &mut farthest.position)?;
    let normal = match parts.nth(1) {
        None | Some(b"") => None,
        Some(normal) => Some(vertex_number(
            normal,
            raw.normals.len(),
            line,
            &mut farthest.normal,
        )?),
    };
    Ok(Corner { position, normal })
}

/// The number, from 0, that a face means: from 1 upwards, or backwards from the last of the `count` lines before it.
fn vertex_number(
    word: &[u8],
    count: usize,
    line: usize,
    farthest: &mut (u64, usize),
) -> Result<u32, MeshProblem> {
    let refused = || damaged(line, &format!("a face has the number {}", shown(word)));
    let number: i64 = text(word).parse().map_err(|_| refused())?;
    let from_one = match number {
        1.. => number,
        0 => return Err(refused()),
        _ => match (count as i64).saturating_add(number) {
            before @ 0.. => before + 1,
            _ => return Err(refused()),
        },
    };
    if from_one as u64 > farthest.0 {
        *farthest = (from_one as u64, line);
    }
    // Too large for u32 is too large for `farthest` too.
    Ok(u32::try_from(from_one - 1).unwrap_or(u32::MAX))
}

/// Three numbers of a `v` or `vn` line.
fn numbers<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    line: usize,
) -> Result<[f64; 3], MeshProblem> {
    let mut numbers = [0.0; 3];
    for number in &mut numbers {
        let word = words.next().unwrap_or_default();
        *number = text(word)
            .parse()
            .map_err(|_| damaged(line, &format!("{} stands where a number must", shown(word))))?;
    }
    Ok(numbers)
}

/// Empty where it is no text: no number either then.
fn text(word: &[u8]) -> &str {
    str::from_utf8(word).unwrap_or_default()
}

fn shown(word: &[u8]) -> String {
    quoted(&String::from_utf8_lossy(&word[..word.len().min(64)]))
}

fn damaged(line: usize, reason: &str) -> MeshProblem {
    MeshProblem::Damaged {
        format: Format::Obj,
        reason: format!("line {line}: {reason}"),
    }
}

/// A line that ends in a backslash goes on in the next.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
}

impl<'a> Lines<'a> {
    /// The next whole line and the number, from 1, of its first row.
    fn next(&mut self) -> Option<(&'a [u8], usize)> {
        let (start, first) = (self.at, self.number + 1);
        if start >= self.bytes.len() {
            return None;
        }
        loop {
            let rest = &self.bytes[self.at..];
            let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
            let row = &rest[..length];
            self.at = (self.at + length + 1).min(self.bytes.len());
            self.number += 1;
            let goes_on = row.strip_suffix(b"\r").unwrap_or(row).ends_with(b"\\");
            if !goes_on || self.at == self.bytes.len() {
                return Some((&self.bytes[start..self.at], first));
            }
        }
    }
}

/// The words of a line; a comment ends it, and a backslash is what joins its rows.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
    line[..end]
        .split(|b| b.is_ascii_whitespace() || *b == b'\\')
        .filter(|word| !word.is_empty())
}
