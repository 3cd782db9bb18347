//! The inspector: the probe's numbers, the sign table, and every formula with the numbers put in.

use egui::{Color32, Grid, RichText, Ui};

use super::action::Action;
use super::command::Command;
use super::laboratory;
use super::lists;
use super::model::Model;
use super::probe::texel_of;
use super::state::{InspectorState, Precision};
use super::theme;
use crate::gpu::GREAT_CIRCLE_COLORS;
use crate::mapping::cube_face::{
    FACES, GREAT_CIRCLES, SIGN_TABLE, great_circle_checks, meeting_faces, sign_table,
};
use crate::mapping::{ChartPoint, MappingId, Step};
use crate::math::{Rotation, Vec3, inputs::SIGN_PATTERNS, turned};

/// Shows the inspector, scrolled where it is too long.
pub fn inspector_ui(ui: &mut Ui, model: &mut Model<'_>) {
    egui::ScrollArea::vertical()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            section_ui(ui, "Probe", |ui| readout_ui(ui, model));
            section_ui(ui, "Which face: the sign table", |ui| {
                sign_table_ui(ui, model)
            });
            section_ui(ui, "Step by step", |ui| steps_ui(ui, model));
            section_ui(ui, "The same direction in every map", |ui| {
                all_maps_ui(ui, model)
            });
        });
}

fn section_ui(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(RichText::new(title).strong())
        .default_open(true)
        .show(ui, content);
}

fn mono(text: impl Into<String>) -> RichText {
    RichText::new(text).monospace()
}

/// A number with as many digits as f32 can tell apart, aligned at the point.
fn fixed(x: f64) -> String {
    format!("{x:+.6}")
}

/// Direction, chart, u, v, texel, colour and solid angle.
fn readout_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let dir = state.probe_f64();
    let mapping = state.mapping;
    let info = mapping.info();
    ui.horizontal_wrapped(|ui| {
        let mut follow = state.probe_follows;
        if ui
            .checkbox(&mut follow, "follows the pointer")
            .on_hover_text("A click in any view keeps the probe there; Esc lets it follow again")
            .changed()
        {
            model.push(Action::FollowPointer(follow));
        }
        place_menu_ui(ui, model);
    });
    Grid::new("readout")
        .num_columns(2)
        .spacing([10.0, 2.0])
        .show(ui, |ui| {
            let mut row = |name: &str, value: String| {
                ui.label(name);
                let label = egui::Label::new(mono(&value)).selectable(true);
                ui.add(label);
                ui.end_row();
            };
            row(
                "direction",
                format!("({}, {}, {})", fixed(dir.x), fixed(dir.y), fixed(dir.z)),
            );
            let longitude = f64::atan2(dir.x, dir.z).to_degrees();
            let latitude = f64::atan2(dir.y, dir.x.hypot(dir.z)).to_degrees();
            row(
                "longitude, latitude",
                format!("{longitude:+.3}°, {latitude:+.3}°"),
            );
            let Some(point) = mapping.forward(dir) else {
                return;
            };
            let size = model.map_size(mapping);
            let texel = texel_of(point, size);
            row("mapping", info.name.to_owned());
            row(
                "chart",
                format!("{} ({})", point.chart, info.charts[point.chart as usize]),
            );
            row("u, v", format!("{:.7}, {:.7}", point.u, point.v));
            row(
                "texel",
                format!("{}, {} of {}×{}", texel[0], texel[1], size[0], size[1]),
            );
            for (name, value) in laboratory::readout(model) {
                row(name, value);
            }
            let solid = mapping.texel_solid_angle_sr(point.chart, texel, size);
            row("solid angle", format!("{:.4} µsr", solid * 1e6));
            row("texel, linear light", color_text(model.texel_color));
            if let Some(original) = model
                .surroundings
                .and_then(|s| bad_original(s, model.state.rotation, dir))
            {
                row("in the file", original);
            }
            if !info.coverage.contains(dir.to_f64()) {
                row(
                    "note",
                    "this map has no texel of its own for this direction".to_owned(),
                );
            }
        });
}

fn color_text(color: Option<[f32; 3]>) -> String {
    match color {
        Some([r, g, b]) => format!("{r:.4}  {g:.4}  {b:.4}"),
        None => "…".to_owned(),
    }
}

/// What the file held where the probe looks, if it had to be replaced.
fn bad_original(
    surroundings: &super::model::Surroundings,
    rotation: Rotation,
    dir: Vec3<f64>,
) -> Option<String> {
    let point = MappingId::Latlong.forward(turned(rotation.source_from_world(), dir))?;
    let image = &surroundings.loaded.image;
    let (x, y) = image.texel_at(point.u, point.v);
    let [r, g, b] = surroundings.loaded.originals.get(image.index(x, y)?)?;
    // Exact digits would make the inspector as wide as the longest.
    Some(format!("{r:.2e}  {g:.2e}  {b:.2e}"))
}

/// Directions of interest: centres, edges' middles and corners of the cube, where ties are.
fn place_menu_ui(ui: &mut Ui, model: &mut Model<'_>) {
    ui.menu_button("Go to …", |ui| {
        for (title, ties) in [
            ("Face centres", 1),
            ("Edge middles (ties of two)", 2),
            ("Corners (ties of three)", 3),
        ] {
            ui.menu_button(title, |ui| {
                for pattern in SIGN_PATTERNS {
                    if pattern.iter().filter(|c| **c != 0).count() != ties {
                        continue;
                    }
                    let name = direction_name(pattern);
                    if ui.button(mono(&name)).clicked() {
                        let dir = pattern.map(f32::from);
                        model.push(Action::FollowPointer(false));
                        model.push(Action::SetProbe { dir, eye_ray: None });
                        ui.close();
                    }
                }
            });
        }
    });
}

/// "+x −y" for (1, -1, 0).
fn direction_name(pattern: [i8; 3]) -> String {
    let part = |(sign, axis): (&i8, &str)| match sign {
        0 => None,
        1 => Some(format!("+{axis}")),
        _ => Some(format!("-{axis}")),
    };
    pattern
        .iter()
        .zip(["x", "y", "z"])
        .filter_map(part)
        .collect::<Vec<_>>()
        .join(" ")
}

/// The paper's table with the dot products and the row that matches.
fn sign_table_ui(ui: &mut Ui, model: &Model<'_>) {
    let dir = model.state.probe_f64();
    let checks = great_circle_checks(dir);
    let face = sign_table(dir);
    Grid::new("sign table")
        .num_columns(7)
        .spacing([7.0, 3.0])
        .show(ui, |ui| {
            ui.label("circle");
            for (i, (name, _)) in GREAT_CIRCLES.iter().enumerate() {
                let [r, g, b] = GREAT_CIRCLE_COLORS[i];
                ui.label(
                    RichText::new(name.to_string())
                        .strong()
                        .color(Color32::from_rgb(r, g, b)),
                );
            }
            ui.end_row();
            ui.label("normal·√2");
            for (_, normal) in &GREAT_CIRCLES {
                ui.label(mono(direction_name(*normal)).small());
            }
            ui.end_row();
            ui.label("dot");
            for (_, normal) in &GREAT_CIRCLES {
                let normal = Vec3::<f64>::from_f64(normal.map(f64::from));
                let dot = normal.dot(dir) * std::f64::consts::FRAC_1_SQRT_2;
                ui.label(mono(format!("{dot:+.3}")).small());
            }
            ui.end_row();
            ui.label("> 0 ?");
            for check in checks {
                ui.label(mono(if check { "+" } else { "-" }).strong());
            }
            ui.end_row();
            for row in &SIGN_TABLE {
                sign_row_ui(
                    ui,
                    FACES[row.face as usize],
                    &row.checks,
                    checks,
                    row.face == face,
                );
            }
        });
    ui.label(format!("The row of {} matches.", FACES[face as usize]));
    tie_ui(ui, dir, face);
}

/// One row: every check that counts, dim where it fails.
fn sign_row_ui(ui: &mut Ui, name: &str, needed: &[Option<bool>; 6], checks: [bool; 6], lit: bool) {
    let paint = |text: RichText| {
        if lit {
            text.background_color(theme::LIT)
        } else {
            text
        }
    };
    ui.label(paint(
        mono(if lit {
            format!("▶ {name}")
        } else {
            format!("  {name}")
        })
        .strong(),
    ));
    for (need, check) in needed.iter().zip(checks) {
        let text = match need {
            Some(true) => "+",
            Some(false) => "-",
            None => "·",
        };
        let text = mono(format!("  {text}  "));
        let fails = need.is_some_and(|need| need != check);
        ui.label(paint(if fails {
            text.color(Color32::from_gray(120))
        } else {
            text.strong()
        }));
    }
    ui.end_row();
}

/// Why a tie falls as it does.
fn tie_ui(ui: &mut Ui, dir: Vec3<f64>, face: u32) {
    let faces = meeting_faces(dir);
    if faces.len() < 2 {
        return;
    }
    let names: Vec<&str> = faces.iter().map(|f| FACES[*f as usize]).collect();
    ui.colored_label(
        theme::TEXEL,
        format!(
            "A tie: {} meet here. A product of exactly 0 is not above 0, so it counts as negative. That puts the faces \
             in the order -y, -z, ±x, +z, +y, and {} comes first. (Hardware prefers z, then y, then x: {}.)",
            names.join(" and "),
            FACES[face as usize],
            FACES[crate::mapping::cube_face::largest_component(dir) as usize],
        ),
    );
}

/// The formula of one mapping, with the numbers put in.
fn steps_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut inspector = model.state.inspector;
    ui.horizontal_wrapped(|ui| {
        let label = ui.label("of");
        egui::ComboBox::from_id_salt("steps of")
            .selected_text(inspector.mapping.info().name)
            .height(lists::HEIGHT)
            .show_ui(ui, |ui| {
                lists::mapping_entries_ui(ui, &mut inspector.mapping)
            })
            .response
            .labelled_by(label.id);
        for (precision, name) in [
            (Precision::F32, "f32"),
            (Precision::F64, "f64"),
            (Precision::Both, "f32 | f64"),
        ] {
            ui.selectable_value(&mut inspector.precision, precision, name);
        }
    });
    let info = inspector.mapping.info();
    ui.horizontal_wrapped(|ui| {
        if !info.conventions.is_empty() {
            ui.checkbox(&mut inspector.conventions, "the seed's numbers");
        }
        if !info.errata.is_empty() {
            ui.checkbox(&mut inspector.errata, "printed and right");
        }
    });
    if inspector != model.state.inspector {
        model.push(Action::SetInspector(inspector));
    }
    ui.label(RichText::new(info.about).italics());
    let dir = model.state.probe_f64();
    let [x, y, z] = model.state.probe;
    let single = inspector.mapping.steps(Vec3::new(x, y, z));
    let double = inspector.mapping.steps(dir);
    let shown: Vec<Shown<'_>> = single
        .iter()
        .zip(&double)
        .map(|(a, b)| Shown {
            step: a,
            values: match inspector.precision {
                Precision::F32 => vec![a.with_numbers.clone()],
                Precision::F64 => vec![b.with_numbers.clone()],
                Precision::Both => {
                    vec![
                        format!("f32  {}", a.with_numbers),
                        format!("f64  {}", b.with_numbers),
                    ]
                }
            },
        })
        .collect();
    if ui.button("Copy all steps").clicked() {
        let lines: Vec<String> = shown.iter().map(Shown::text).collect();
        model.push(Command::CopyText(lines.join("\n")));
    }
    for (i, shown) in shown.iter().enumerate() {
        step_ui(ui, model, i, shown);
    }
    if inspector.conventions {
        conventions_ui(ui, model, inspector);
    }
    if inspector.errata {
        errata_ui(ui, model, inspector.mapping);
    }
}

/// A step with the numbers that are shown, in one or two number types.
struct Shown<'a> {
    step: &'a Step,
    values: Vec<String>,
}

impl Shown<'_> {
    /// As it is copied: the name unless the formula begins with it, the formula, the numbers.
    fn text(&self) -> String {
        let Step { name, formula, .. } = self.step;
        let name = if self.says_its_name() {
            String::new()
        } else {
            format!("{name}: ")
        };
        format!("{name}{formula}  →  {}", self.values.join("  |  "))
    }

    /// "u = ..." says its own name; "u: u = ..." would say it twice.
    fn says_its_name(&self) -> bool {
        self.step
            .formula
            .starts_with(&format!("{} =", self.step.name))
    }
}

/// One step: the formula, the numbers, and a button that copies them.
fn step_ui(ui: &mut Ui, model: &mut Model<'_>, index: usize, shown: &Shown<'_>) {
    ui.push_id(("step", index), |ui| {
        ui.horizontal_wrapped(|ui| {
            copy_button_ui(ui, model, || shown.text());
            if !shown.says_its_name() {
                ui.label(RichText::new(shown.step.name).strong());
            }
            ui.label(mono(shown.step.formula));
        });
        for value in &shown.values {
            ui.indent("numbers", |ui| {
                let text = mono(value).color(Color32::from_gray(190));
                ui.add(egui::Label::new(text).wrap());
            });
        }
    });
}

fn copy_button_ui(ui: &mut Ui, model: &mut Model<'_>, text: impl FnOnce() -> String) {
    let response = ui
        .small_button("copy")
        .on_hover_text("Copy this formula as text");
    if response.clicked() {
        model.push(Command::CopyText(text()));
    }
}

/// The seed's own numbers for the same direction.
fn conventions_ui(ui: &mut Ui, model: &mut Model<'_>, inspector: InspectorState) {
    let dir = model.state.probe_f64();
    let [x, y, z] = model.state.probe;
    for convention in inspector.mapping.info().conventions {
        let [index, s, t] = convention.columns;
        let line =
            |p: ChartPoint<String>| format!("{index} = {}, {s} = {}, {t} = {}", p.chart, p.u, p.v);
        let texts = [
            (convention.forward.0)(Vec3::new(x, y, z)).map(|p| ChartPoint {
                chart: p.chart,
                u: p.u.to_string(),
                v: p.v.to_string(),
            }),
            (convention.forward.1)(dir).map(|p| ChartPoint {
                chart: p.chart,
                u: p.u.to_string(),
                v: p.v.to_string(),
            }),
        ]
        .map(|p| p.map_or_else(|| "no direction".to_owned(), line));
        let shown: Vec<&str> = match inspector.precision {
            Precision::F32 => vec![&texts[0]],
            Precision::F64 => vec![&texts[1]],
            Precision::Both => vec![&texts[0], &texts[1]],
        };
        ui.horizontal_wrapped(|ui| {
            copy_button_ui(ui, model, || {
                format!("{}: {}", convention.id, shown.join("  |  "))
            });
            ui.label(RichText::new(format!("convention {}", convention.id)).strong());
        });
        ui.label(RichText::new(convention.about).small());
        for text in shown {
            ui.add(egui::Label::new(mono(text)).wrap());
        }
    }
}

/// Each equation as printed beside the right one, with both values.
fn errata_ui(ui: &mut Ui, model: &mut Model<'_>, mapping: MappingId) {
    let dir = model.state.probe_f64();
    for erratum in mapping.info().errata {
        let Some((printed, right)) = (erratum.values)(dir) else {
            continue;
        };
        let wrong = Color32::from_rgb(255, 150, 120);
        ui.horizontal_wrapped(|ui| {
            copy_button_ui(ui, model, || {
                format!(
                    "{}: printed {} = {printed}; right {} = {right}",
                    erratum.id, erratum.printed, erratum.right
                )
            });
            ui.label(RichText::new(erratum.id).strong());
        });
        ui.add(egui::Label::new(mono(format!("printed  {}", erratum.printed)).color(wrong)).wrap());
        ui.label(mono(format!("       = {printed:.7}")).color(wrong));
        ui.add(egui::Label::new(mono(format!("right    {}", erratum.right))).wrap());
        ui.label(mono(format!(
            "       = {right:.7}   (off by {:+.7})",
            printed - right
        )));
        ui.label(RichText::new(erratum.why).small());
    }
}

/// Chart, u, v and the texel's solid angle in each map.
fn all_maps_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let dir = model.state.probe_f64();
    Grid::new("all maps")
        .num_columns(5)
        .striped(true)
        .spacing([8.0, 2.0])
        .show(ui, |ui| {
            for title in ["map", "chart", "u", "v", "µsr"] {
                ui.label(RichText::new(title).strong().small());
            }
            ui.end_row();
            for &mapping in MappingId::ALL {
                let info = mapping.info();
                let Some(point) = mapping.forward(dir) else {
                    continue;
                };
                let name = RichText::new(info.name).small();
                let chosen = mapping == model.state.mapping;
                ui.label(if chosen { name.strong() } else { name });
                let size = model.map_size(mapping);
                let texel = texel_of(point, size);
                let solid = mapping.texel_solid_angle_sr(point.chart, texel, size) * 1e6;
                let cells = [
                    info.charts[point.chart as usize].to_owned(),
                    format!("{:.5}", point.u),
                    format!("{:.5}", point.v),
                    format!("{solid:.3}"),
                ];
                for cell in cells {
                    ui.label(mono(cell).small());
                }
                ui.end_row();
            }
        });
}
