//! Radiance RGBE pictures, rows in runs of single components.

use super::rows::values;
use super::{Fault, Job};
use crate::imaging::shared_exponent::RGBE;
use crate::imaging::{Channels, Raster, Transfer};

/// Widths whose rows can have runs: their mark has 15 bits, and readers take shorter rows for the older coding.
const WIDTHS_WITH_RUNS: std::ops::RangeInclusive<u32> = 8..=32767;

/// A run costs two bytes, and breaking off literals for it one or two more.
const SHORTEST_RUN: usize = 4;

/// Negative values and NaN become 0, opacity is left out.
pub(super) fn write(raster: &Raster, job: &mut Job) -> Result<(), Fault> {
    let [width, height] = raster.size();
    write!(
        job.out,
        "#?RADIANCE\nSOFTWARE=sixfold\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    )?;
    let has_runs = WIDTHS_WITH_RUNS.contains(&width);
    let mut light = vec![0.0; width as usize * 3];
    let mut component = Vec::new();
    let mut bytes = Vec::new();
    for y in 0..height {
        values(raster, y, Channels::Rgb, Transfer::Linear, &mut light);
        let (colors, _) = light.as_chunks::<3>();
        let texels: Vec<[u8; 4]> = colors.iter().map(|color| rgbe(*color)).collect();
        bytes.clear();
        if has_runs {
            bytes.extend([2, 2, (width >> 8) as u8, width as u8]);
            for index in 0..4 {
                component.clear();
                component.extend(texels.iter().map(|texel| texel[index]));
                push_runs(&component, &mut bytes);
            }
        } else {
            // Here the mantissas (1, 1, 1) would be a mark for runs, and (2, 2) at the start one too. They come up only below
            // 2^-128, where no full mantissa is left.
            let is_full = |texel: &[u8; 4]| texel[..3].iter().any(|m| *m >= 128);
            for texel in texels {
                bytes.extend(if is_full(&texel) { texel } else { [0; 4] });
            }
        }
        job.out.write_all(&bytes)?;
        job.rows_done(1)?;
    }
    Ok(())
}

fn rgbe(color: [f32; 3]) -> [u8; 4] {
    let ([r, g, b], e) = RGBE.encode(color);
    if (r | g | b) == 0 {
        return [0; 4];
    }
    [r as u8, g as u8, b as u8, e as u8]
}

/// Runs (128 + length, value; length up to 127) and literals (length, values; length up to 128).
fn push_runs(values: &[u8], bytes: &mut Vec<u8>) {
    let run_at = |at: usize| {
        let same = values[at..].iter().take_while(|v| **v == values[at]);
        same.take(127).count()
    };
    let (mut at, mut literals_start) = (0, 0);
    while at < values.len() {
        let run = run_at(at);
        if run < SHORTEST_RUN {
            at += run;
            continue;
        }
        push_literals(&values[literals_start..at], bytes);
        bytes.extend([128 + run as u8, values[at]]);
        at += run;
        literals_start = at;
    }
    push_literals(&values[literals_start..], bytes);
}

fn push_literals(values: &[u8], bytes: &mut Vec<u8>) {
    for part in values.chunks(128) {
        bytes.push(part.len() as u8);
        bytes.extend(part);
    }
}
