//! The numbers of the equal texel budget: both maps as wholes, and how their texels lie in one direction.

use egui::{Grid, RichText, TextStyle, Ui};

use super::budget::{Shown, compared};
use super::budget_panel::NAMES;
use super::model::Model;
use super::narrow::text_width;
use super::numbers::significant;
use crate::lab::equal_budget::MapSize;
use crate::lab::texel_density::TexelDensity;
use crate::math::Vec3;

/// Width from which the numbers have the usual size of text.
const BODY_TEXT: f32 = 460.0;
/// Below this width each map's numbers stand by themselves.
pub const NARROW: f32 = 330.0;

/// Height of the numbers in a pane of that width, with all rows.
pub fn numbers_height(width: f32) -> f32 {
    match width {
        width if width < NARROW => 285.0,
        width if width < BODY_TEXT => 180.0,
        _ => 196.0,
    }
}

/// Both maps in numbers, as wholes and in the direction under the pointer, or in the probe's.
pub fn numbers_ui(ui: &mut Ui, model: &Model<'_>, pointed: Option<Vec3<f64>>) {
    let shown = model.labs.budget.shown();
    let maps = shown.map_or_else(|| compared(model.state), |(wanted, _)| wanted.maps);
    let dir = pointed.unwrap_or(model.state.probe_f64());
    let densities = maps.map(|map| TexelDensity::at(map.mapping, map.size, dir));
    let width = ui.available_width();
    let sized = |text: String| {
        let text = RichText::new(text);
        if width < BODY_TEXT {
            text.small()
        } else {
            text
        }
    };
    ui.spacing_mut().item_spacing.y = 2.0;
    // Rows of text alone need no room for buttons.
    ui.spacing_mut().interact_size.y = 0.0;
    let rows = rows(maps, densities, shown.map(|(_, shown)| shown));
    let names = [0, 1].map(|k| format!("{}  {}", NAMES[k], maps[k].mapping.info().name));
    let row_ui = |ui: &mut Ui, row: &Row, columns: &[usize]| {
        let (name, hover, values) = row;
        ui.label(sized((*name).to_owned())).on_hover_text(*hover);
        for column in columns {
            ui.label(sized(values[*column].clone()));
        }
        ui.end_row();
    };
    const GAP: f32 = 12.0;
    let grid = |column: usize| Grid::new(("equal texel budget", column)).spacing([GAP, 2.0]);
    if width < NARROW {
        for (column, name) in names.iter().enumerate() {
            ui.label(sized(name.clone()).strong());
            // Long numbers wrap.
            let grid = grid(column).max_col_width(0.5 * (width - GAP));
            grid.show(ui, |ui| {
                rows.iter().for_each(|row| row_ui(ui, row, &[column]))
            });
        }
    } else {
        // Long names wrap; the words before the rows do not.
        let style = if width < BODY_TEXT {
            TextStyle::Small
        } else {
            TextStyle::Body
        };
        let words = rows
            .iter()
            .map(|(name, ..)| text_width(ui, name, style.clone()));
        let words = words.fold(0.0, f32::max);
        let grid = grid(0).max_col_width((0.5 * (width - words) - GAP).max(words));
        grid.show(ui, |ui| {
            ui.label("");
            for name in names {
                ui.label(sized(name).strong());
            }
            ui.end_row();
            rows.iter().for_each(|row| row_ui(ui, row, &[0, 1]));
        });
    }
    let place = if pointed.is_some() {
        "under the pointer"
    } else {
        "at the probe"
    };
    let text = comparison_text(densities);
    ui.add(egui::Label::new(sized(format!("{place}: {text}"))).wrap());
    if let Some(text) = shown.and_then(|(_, shown)| verdict_text(shown.rms)) {
        ui.add(egui::Label::new(sized(text)).wrap());
    }
}

/// What is told of A and B: its name, what it means, and both values.
type Row = (&'static str, &'static str, [String; 2]);

fn rows(
    maps: [MapSize; 2],
    densities: [Option<TexelDensity>; 2],
    shown: Option<&Shown>,
) -> Vec<Row> {
    let told = |text: &dyn Fn(&TexelDensity) -> String| {
        densities.map(|density| {
            let none = || "none of its own here".to_owned();
            density.as_ref().map_or_else(none, text)
        })
    };
    let mut rows = vec![
        (
            "texels",
            "All texels of the picture count, also those beside a disc: they are stored too",
            maps.map(|map| size_text(&map)),
        ),
        (
            "off by (RMS)",
            "Root of the mean square difference from the environment itself, in linear light, over the object's pixels: \
             what is bright weighs most. In a larger picture the pixels are finer, and the number is another one",
            rms_texts(shown),
        ),
        (
            "per steradian",
            "Texels over the solid angle that they cover around this direction, by the exact Jacobian",
            told(&|density| count_text(density.per_sr)),
        ),
        (
            "per square degree",
            "The same in square degrees",
            told(&|density| count_text(density.per_square_degree())),
        ),
        (
            "extent, arcmin",
            "Shortest and longest extent of a texel here in minutes of arc: the singular values of the Jacobian. The longest \
             blurs most",
            told(&extents_text),
        ),
    ];
    let unused = maps.map(|map| map.unused());
    if unused != [0.0; 2] {
        let text = |unused: f64| format!("{:.0} %", 100.0 * unused);
        rows.insert(
            1,
            (
                "beside a disc",
                "The share of them that shows no direction",
                unused.map(text),
            ),
        );
    }
    rows
}

/// "6 × 48×48 = 13824".
fn size_text(map: &MapSize) -> String {
    let [width, height] = map.size;
    let charts = map.mapping.info().chart_count();
    let of_charts = if charts == 1 {
        String::new()
    } else {
        format!("{charts} × ")
    };
    format!("{of_charts}{width}×{height} = {}", map.texels())
}

fn rms_texts(shown: Option<&Shown>) -> [String; 2] {
    let rms = shown.map_or([None; 2], |shown| shown.rms);
    rms.map(|rms| rms.map_or_else(|| "…".to_owned(), number))
}

/// A number that may be 0.
fn number(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else {
        significant(x)
    }
}

/// More texels per solid angle than this, or more than another map has, are those of a pole, met to the rounding of f32.
const MOST: f64 = 1e12;

fn count_text(x: f64) -> String {
    if x < MOST {
        significant(x)
    } else {
        "no end: a pole".to_owned()
    }
}

fn extents_text(density: &TexelDensity) -> String {
    let [shortest, longest] = density.extents_arcmin().map(number);
    format!("{shortest} × {longest}")
}

/// Which of two maps is finer in a direction, and by what factor.
fn comparison_text(densities: [Option<TexelDensity>; 2]) -> String {
    let (a, b) = match densities {
        [Some(a), Some(b)] => (a, b),
        [None, None] => return "neither map has texels of its own".to_owned(),
        [None, _] => return format!("{} has no texel of its own", NAMES[0]),
        [_, None] => return format!("{} has no texel of its own", NAMES[1]),
    };
    // The finer one first.
    let (names, finer, coarser) = if a.per_sr >= b.per_sr {
        ([NAMES[0], NAMES[1]], a, b)
    } else {
        ([NAMES[1], NAMES[0]], b, a)
    };
    let density = finer.per_sr / coarser.per_sr;
    let longest = finer.extents_rad[1] / coarser.extents_rad[1];
    if is_even(density) && is_even(longest) {
        return "both are as fine".to_owned();
    }
    let [finer, coarser] = names;
    let texels = if is_even(density) {
        format!("{finer} and {coarser} have as many texels per solid angle")
    } else {
        match density < MOST {
            true => format!(
                "{finer} has {} × as many texels per solid angle as {coarser}",
                significant(density)
            ),
            false => format!("{finer} is at a pole, where its texels are crowded without end"),
        }
    };
    let sides = if is_even(longest) {
        "the longest extent of one is the same".to_owned()
    } else {
        format!("the longest extent of one is {} × as long", number(longest))
    };
    format!("{texels}; {sides}")
}

/// What reads 1.00.
fn is_even(ratio: f64) -> bool {
    (ratio - 1.0).abs() < 0.005
}

/// Which map comes nearer to the surroundings as a whole.
fn verdict_text(rms: [Option<f64>; 2]) -> Option<String> {
    let [a, b] = [rms[0]?, rms[1]?];
    let (nearer, farther) = if a <= b { (0, 1) } else { (1, 0) };
    let ratio = a.max(b) / a.min(b);
    Some(if a == b || is_even(ratio) {
        "over the object both come as near to the environment".to_owned()
    } else {
        format!(
            "over the object {} comes nearer to the environment: {} is off by {} × as much",
            NAMES[nearer],
            NAMES[farther],
            count_text(ratio)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn density(per_sr: f64, longest: f64) -> Option<TexelDensity> {
        Some(TexelDensity {
            per_sr,
            extents_rad: [0.5 * longest, longest],
        })
    }

    #[test]
    fn the_finer_map_is_named_first() {
        let text = comparison_text([density(100.0, 0.02), density(210.0, 0.026)]);
        assert_eq!(
            text,
            "B has 2.10 × as many texels per solid angle as A; the longest extent of one is 1.30 × as long"
        );
        let text = comparison_text([density(100.0, 0.02), density(100.0, 0.02)]);
        assert_eq!(text, "both are as fine");
        let text = comparison_text([density(100.0, 0.04), density(100.0, 0.02)]);
        assert!(text.starts_with("A and B have as many"), "{text}");
        assert!(
            comparison_text([density(f64::INFINITY, 0.1), density(9.0, 0.1)]).contains("at a pole")
        );
        assert_eq!(
            comparison_text([None, density(1.0, 1.0)]),
            "A has no texel of its own"
        );
    }

    #[test]
    fn the_nearer_map_is_named_first() {
        let text = verdict_text([Some(0.03), Some(0.01)]).unwrap();
        assert!(
            text.contains("B comes nearer") && text.contains("A is off by 3.00 ×"),
            "{text}"
        );
        assert!(
            verdict_text([Some(0.01), Some(0.01)])
                .unwrap()
                .contains("both")
        );
        assert!(
            verdict_text([Some(0.0), Some(0.0)])
                .unwrap()
                .contains("both")
        );
        assert_eq!(verdict_text([None, Some(1.0)]), None);
    }
}
