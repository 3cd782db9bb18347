//! Measurements in words. Speed is never told without error, nor error without speed.

use super::Used;
use crate::app::model::Model;
use crate::app::numbers::significant;
use crate::lab::accuracy::Off;
use crate::lab::bench::Row;
use crate::lab::choice::{Choice, allowed_texels, reference_beside};
use crate::lab::filter::device_name;
use crate::mapping::MappingId;
use crate::mapping::evaluator::{REFERENCE, SINGLE};
use crate::math::Vec3;

/// Where there is nothing to tell.
pub const NOT_MEASURED: &str = "not measured yet on this machine";

/// "2.10 ns a direction, 3.1 times a copy, 0.05 times the reference".
pub fn time_text(row: &Row, measured: &[Row]) -> String {
    let reference = match reference_beside(measured, row) {
        Some(_) if row.evaluator == REFERENCE => String::new(),
        Some(reference) => format!(
            ", {} times the reference",
            significant(row.ns / reference.ns)
        ),
        None => String::new(),
    };
    format!(
        "{} ns a direction, {} times a copy{reference}",
        significant(row.ns),
        significant(row.copy_ratio)
    )
}

/// "largest error 1.20e-5 rad, 0.00400 texel; RMS 3.00e-6 rad", at so many rows; or its holes.
pub fn error_text(row: &Row, rows: u32) -> String {
    if row.holes > 0 {
        return format!("{} inputs without a result", row.holes);
    }
    let texels = row.error_texels_at(rows);
    let per = texels / row.max_error_rad;
    format!(
        "largest error {} rad, {} texel; RMS {} rad, {} texel",
        significant(row.max_error_rad),
        significant(texels),
        significant(row.rms_error_rad),
        significant(row.rms_error_rad * per)
    )
}

/// "worst towards +0.100 +0.200 +0.970".
pub fn worst_text(row: &Row) -> String {
    let [x, y, z] = row.worst;
    match row.direction {
        crate::lab::bench::Way::Forward => format!("worst towards {x:+.3} {y:+.3} {z:+.3}"),
        crate::lab::bench::Way::Inverse => format!("worst at chart {x:.0}, {y:.4}, {z:.4}"),
    }
}

/// All of it, as a point is called.
pub fn row_text(row: &Row, measured: &[Row], rows: u32) -> String {
    format!(
        "{} {} ({})\n{}\n{}\n{}",
        row.mapping,
        row.evaluator,
        device_name(row),
        time_text(row, measured),
        error_text(row, rows),
        worst_text(row)
    )
}

/// "2.10 ns, 0.00400 texel".
pub fn measured_text(choice: &Choice<'_>) -> String {
    let error = if choice.error_texels.is_finite() {
        format!("{} texel", significant(choice.error_texels))
    } else {
        "with holes".to_owned()
    };
    format!("{} ns, {error}", significant(choice.row.ns))
}

/// The evaluator that is used, in a few words.
pub fn used_text(map: MappingId, used: &Used<'_>) -> String {
    let measured = match &used.measured {
        Some(choice) => measured_text(choice),
        None => NOT_MEASURED.to_owned(),
    };
    let why = if used.by_budget { " (budget)" } else { "" };
    format!(
        "{} by {}{why}: {measured}",
        map.info().id,
        used.evaluator.id
    )
}

/// What the budget has found for the mapping that is looked up.
pub fn budget_text(model: &Model<'_>) -> String {
    let laboratory = &model.state.laboratory;
    let map = model.state.mapping;
    let name = map.info().name;
    let rows = model.labs.bench.rows();
    let allowed = allowed_texels(laboratory.budget_texels, model.pixels_per_texel);
    let within = if model.pixels_per_texel > 1.0 {
        format!(
            "within {} texel (a texel takes {} pixels)",
            significant(allowed),
            significant(model.pixels_per_texel)
        )
    } else {
        format!("within {} texel", significant(allowed))
    };
    let Some(used) = &model.used else {
        return String::new();
    };
    match &used.measured {
        Some(choice) if used.by_budget => {
            let reference = reference_beside(rows, choice.row)
                .map(|reference| reference.ns / choice.row.ns)
                .filter(|_| choice.row.evaluator != REFERENCE);
            let reference = reference.map_or(String::new(), |times| {
                format!(
                    "; the reference would cost {} times as much",
                    significant(times)
                )
            });
            format!(
                "{within}: {}, {}{reference}",
                used.evaluator.id,
                measured_text(choice)
            )
        }
        _ if rows.iter().any(|row| row.mapping == map.info().id) => format!(
            "{within}: no evaluator of the {name} is so near; {} is used",
            used.evaluator.id
        ),
        _ => format!(
            "the {name} is {NOT_MEASURED}: {} is used",
            used.evaluator.id
        ),
    }
}

/// What the used evaluator computes for the probe: names and values for the inspector, where that is a question. Without a
/// measured speed its error is not told either.
pub fn readout(model: &Model<'_>) -> Vec<(&'static str, String)> {
    let map = model.state.mapping;
    let is_asked = |used: &&Used<'_>| {
        let is_plain = used.evaluator.id == SINGLE && used.measured.is_none();
        model.state.laboratory.open || !is_plain
    };
    let Some(used) = model.used.as_ref().filter(is_asked) else {
        return Vec::new();
    };
    let Some(processor) = used.evaluator.processor() else {
        return Vec::new();
    };
    let why = if used.by_budget {
        ", by the budget"
    } else {
        ""
    };
    let mut lines = vec![("evaluator", format!("{}{why}", used.evaluator.id))];
    let dir = model.state.probe;
    let point = processor.forward_one(Vec3::new(dir[0], dir[1], dir[2]));
    let Some(point) = point else {
        lines.push(("its chart, u, v", "it finds none: a hole".to_owned()));
        return lines;
    };
    lines.push((
        "its chart, u, v",
        format!("{}, {:.7}, {:.7}", point.chart, point.u, point.v),
    ));
    let dir = dir.map(f64::from);
    let rows = model.map_size(map)[1];
    let exact = map.forward(Vec3::<f64>::from_f64(dir));
    let off = exact.and_then(|exact| Off::of(map, dir, exact, point, rows));
    let off = match (off, &used.measured) {
        (Some(off), Some(choice)) => format!(
            "{:.1e} rad, {:.1e} texel, {} ns",
            off.rad,
            off.texels,
            significant(choice.row.ns)
        ),
        _ => NOT_MEASURED.to_owned(),
    };
    lines.push(("off the reference", off));
    lines
}
