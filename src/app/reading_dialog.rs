//! The dialog in which the user says how a file is read, and sees what comes of it.

use egui::{
    Align2, Color32, ComboBox, Grid, ProgressBar, Rect, RichText, ScrollArea, Sense, TextureId, Ui,
    Vec2, pos2, vec2,
};

use super::command::Command;
use super::dialogs::buttons_ui;
use super::export::quoted;
use super::export_dialog::{grouped_row_ui, line_ui, row_ui};
use super::marks::edged_text;
use super::model::Model;
use super::reading::{Reading, Shown, Taken};
use super::theme;
use crate::imaging::detect::{MEETS, Proposal};
use crate::imaging::solver::Solution;
use crate::imaging::{MapFile, OpenHints, Pictures, Siting, Transfer, short_name};
use crate::mapping::cube_face::FACES;
use crate::mapping::{Arrangement, Frame, Held, Layout, MappingId, Turn};

/// Points that the form needs, and the pictures beside it at most.
const FORM_WIDTH: f32 = 340.0;
const PICTURES_WIDTH: f32 = 560.0;
/// Between the two, and around the window.
const GAP: f32 = 10.0;
const AROUND: f32 = 48.0;

/// Height of what stands above and below the columns: two lines, progress, two lines about mirrors, the command line, buttons.
const OTHERS: f32 = 160.0;

/// Width of the dialog: both columns, as far as the window has room.
pub fn reading_width(ui: &Ui) -> f32 {
    let room = ui.ctx().content_rect().width() - AROUND;
    room.clamp(FORM_WIDTH, FORM_WIDTH + GAP + PICTURES_WIDTH)
}

/// The whole dialog; true when it is done with.
pub fn reading_ui(ui: &mut Ui, model: &mut Model<'_>, file: &mut MapFile) -> bool {
    ui.heading(format!("How to read {}", short_name(&file.path)));
    let reading = model.reading.filter(|reading| reading.is_of(file));
    let pictures = reading.and_then(Reading::pictures).cloned();
    let taken = reading.and_then(Reading::taken);
    ui.label(match &pictures {
        Some(pictures) => pictures.sentence(),
        None => file.path.display().to_string(),
    });
    let height = (ui.ctx().content_rect().height() - AROUND - OTHERS).clamp(60.0, 660.0);
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(FORM_WIDTH);
            ScrollArea::vertical()
                .id_salt("form")
                .max_height(height)
                .auto_shrink([false, true])
                .show(ui, |ui| match (&pictures, taken) {
                    (Some(pictures), Some(taken)) => {
                        form_ui(ui, pictures, taken, &mut file.hints);
                    }
                    (_, Some(Err(why))) => failure_ui(ui, why),
                    _ => {}
                });
        });
        ui.add_space(GAP);
        let size = vec2(ui.available_width(), height);
        let seen = taken.and_then(|taken| taken.as_ref().ok());
        let labelled = reading.and_then(Reading::labelled);
        ui.vertical(|ui| pictures_ui(ui, size, seen, labelled));
    });
    if let Some(job) = reading.and_then(Reading::job) {
        ui.add(
            ProgressBar::new(job.fraction)
                .desired_height(14.0)
                .text(RichText::new(job.title).small()),
        );
    } else {
        ui.add_space(14.0);
    }
    ui.label(
        RichText::new(
            "Is it mirrored? Seams cannot tell: a mirror image meets as well. Look for writing, or for something whose sides you \
             know: in the cross it must read like the names on the labelled faces, on the ball reversed as they are there.",
        )
        .small(),
    );
    let said = taken.and_then(|taken| Some(taken.as_ref().ok()?.chosen.hints(&file.hints)));
    reading_line_ui(ui, model, file, said.as_ref());
    let is_settled = reading.is_some_and(|reading| reading.job().is_none());
    let said = said.filter(|_| is_settled);
    let path = &file.path;
    buttons_ui(ui, "Open", said.is_some(), false, || {
        if let Some(hints) = said {
            let path = path.clone();
            model.push(Command::LoadFile(MapFile { path, hints }));
        }
    })
}

/// The command line that reads the file so.
fn reading_line_ui(ui: &mut Ui, model: &mut Model<'_>, file: &MapFile, said: Option<&OpenHints>) {
    let mut words = vec![
        "sixfold convert".to_owned(),
        quoted(&file.path.display().to_string()),
    ];
    words.push("OUT.exr".to_owned());
    for (name, value) in said.unwrap_or(&file.hints).options() {
        words.push(name.to_owned());
        words.extend(value.as_deref().map(quoted));
    }
    line_ui(ui, model, words.join(" "));
}

fn failure_ui(ui: &mut Ui, why: &str) {
    ui.label(RichText::new(why).color(Color32::from_rgb(255, 150, 120)));
}

fn form_ui(ui: &mut Ui, pictures: &Pictures, taken: &Result<Taken, String>, hints: &mut OpenHints) {
    let seen = taken.as_ref().ok();
    proposals_ui(ui, pictures.proposals(), seen, hints);
    if let Err(why) = taken {
        failure_ui(ui, why);
    }
    let chosen = seen.map(|taken| &taken.chosen);
    Grid::new("reading").num_columns(2).show(ui, |ui| {
        mapping_rows_ui(ui, chosen, hints);
        frame_row_ui(ui, chosen, hints);
        let mut siting = hints.siting.or(chosen.map(|chosen| chosen.siting));
        let sitings = [Siting::Centre, Siting::Edge].map(Some);
        let name = |siting: &Option<Siting>| match siting {
            Some(Siting::Edge) => "the outermost on the border".to_owned(),
            _ => "in the middle of their squares".to_owned(),
        };
        if row_ui(ui, "samples", &mut siting, &sitings, name) {
            hints.siting = siting;
        }
        let ways = [None, Some(Transfer::Linear), Some(Transfer::Srgb)];
        let name = |transfer: &Option<Transfer>| match transfer {
            None => "as its format has them".to_owned(),
            Some(Transfer::Linear) => "light".to_owned(),
            Some(Transfer::Srgb) => "codes of sRGB".to_owned(),
        };
        row_ui(ui, "numbers", &mut hints.transfer, &ways, name);
    });
    if let Some(frame) = said_frame(chosen, hints) {
        ui.label(RichText::new(format!("{}: {}", frame.name, frame.about)).small());
    }
    ui.checkbox(
        &mut hints.mirrored,
        "a mirror image: exchange left and right",
    );
    for note in seen.map_or(&[][..], |taken| &taken.notes) {
        ui.label(RichText::new(note).small());
    }
    if let Some(misfit) = seen.and_then(|taken| taken.misfit.as_ref()) {
        misfit_ui(ui, misfit, chosen, hints);
    }
    if let Some(chosen) = chosen.filter(|chosen| chosen.mapping.info().chart_count() == 6) {
        faces_ui(ui, chosen, hints);
    }
    let is_changed = !hints.is_empty();
    let back = ui.add_enabled(is_changed, egui::Button::new("As it was proposed"));
    if back.clicked() {
        *hints = OpenHints::default();
    }
}

/// What the file may be, the likeliest first, and what the score means.
fn proposals_ui(ui: &mut Ui, proposals: &[Proposal], seen: Option<&Taken>, hints: &mut OpenHints) {
    if proposals.is_empty() {
        return;
    }
    ui.label("It may be, the likeliest first:");
    for proposal in proposals {
        let is_taken = seen.is_some_and(|taken| {
            let chosen = &taken.chosen;
            let frame = chosen.frame.filter(|frame| !frame.is_ours);
            (chosen.mapping, chosen.layout, frame)
                == (proposal.mapping, proposal.layout, proposal.frame)
        });
        let row = ui.radio(is_taken, proposal_name(proposal));
        if row.on_hover_text(&proposal.why).clicked() && !is_taken {
            // Where another one lies alike, no frame would leave it open which of the two is meant.
            let is_framed = |other: &&Proposal| {
                other.frame.is_some()
                    && (other.mapping, other.layout) == (proposal.mapping, proposal.layout)
            };
            let other = proposals.iter().find(is_framed);
            *hints = OpenHints {
                frame: proposal.frame.or(other.and_then(|_| own_frame())),
                arrange: None,
                ..proposal.hints(hints)
            };
        }
    }
    ui.label(
        RichText::new(format!(
            "Seams: how much texels differ across them, over how much they differ beside them. Lower is better: 1 is as smooth \
             as inside, above {MEETS} the charts do not meet."
        ))
        .small(),
    );
}

/// "Cube map, cross, OpenEXR: seams 1.02".
fn proposal_name(proposal: &Proposal) -> String {
    let layout = match proposal.layout {
        Layout::Single => String::new(),
        layout => format!(", {}", layout.id()),
    };
    let frame = proposal
        .frame
        .map(|frame| format!(", {}", frame.name))
        .unwrap_or_default();
    let seams = proposal.score.map_or_else(
        || "seams tell nothing".to_owned(),
        |score| format!("seams {score:.2}"),
    );
    format!("{}{layout}{frame}: {seams}", proposal.mapping.info().name)
}

/// The mapping and its layout. What does not go with another mapping is no longer said.
fn mapping_rows_ui(ui: &mut Ui, chosen: Option<&Proposal>, hints: &mut OpenHints) {
    let mut mapping = hints.mapping.or(chosen.map(|chosen| chosen.mapping));
    let all: Vec<Option<MappingId>> = MappingId::ALL.iter().copied().map(Some).collect();
    let name = |mapping: &Option<MappingId>| {
        mapping
            .map_or("not said", |mapping| mapping.info().name)
            .to_owned()
    };
    let family = |mapping: &Option<MappingId>| mapping.map(|mapping| mapping.info().family);
    if grouped_row_ui(ui, "mapping", &mut mapping, &all, name, family)
        && let Some(mapping) = mapping
    {
        let charts = mapping.info().chart_count();
        hints.mapping = Some(mapping);
        hints.layout = hints.layout.filter(|layout| layout.holds(charts));
        hints.frame = hints.frame.filter(|frame| frame.knows(mapping));
        hints.arrange = hints.arrange.filter(|_| charts == 6);
        hints.siting = None;
    }
    let charts = mapping.map_or(1, |mapping| mapping.info().chart_count());
    let mut layout = hints.layout.or(chosen.map(|chosen| chosen.layout));
    let fits = |layout: &Layout| layout.holds(charts) && (charts > 1 || *layout != Layout::Faces);
    let layouts: Vec<Option<Layout>> = Layout::ALL.into_iter().filter(fits).map(Some).collect();
    let name = |layout: &Option<Layout>| layout.map_or("not said", Layout::id).to_owned();
    if row_ui(ui, "layout", &mut layout, &layouts, name) {
        (hints.mapping, hints.layout) = (mapping, layout);
        hints.siting = None;
    }
}

/// The program whose orientation the map has; Sixfold's own where nobody says otherwise.
fn frame_row_ui(ui: &mut Ui, chosen: Option<&Proposal>, hints: &mut OpenHints) {
    let Some(mapping) = hints.mapping.or(chosen.map(|chosen| chosen.mapping)) else {
        return;
    };
    let mut frame = said_frame(chosen, hints).or(own_frame());
    let known = Frame::ALL.iter().filter(|frame| frame.knows(mapping));
    let frames: Vec<Option<&'static Frame>> = known.map(Some).collect();
    let name = |frame: &Option<&'static Frame>| frame.map_or("", |frame| frame.name).to_owned();
    if row_ui(ui, "frame", &mut frame, &frames, name) {
        // Both say which face is which.
        (hints.frame, hints.arrange) = (frame, None);
        hints.siting = None;
    }
}

fn own_frame() -> Option<&'static Frame> {
    Frame::ALL.iter().find(|frame| frame.is_ours)
}

fn said_frame(chosen: Option<&Proposal>, hints: &OpenHints) -> Option<&'static Frame> {
    hints.frame.or(chosen.and_then(|chosen| chosen.frame))
}

/// How the six faces would meet.
fn misfit_ui(ui: &mut Ui, misfit: &Solution, chosen: Option<&Proposal>, hints: &mut OpenHints) {
    ui.horizontal_wrapped(|ui| {
        for (name, arrangement, sentence) in [
            (
                "Take this arrangement",
                misfit.arrangement,
                misfit.sentence(),
            ),
            (
                "Take its mirror image",
                misfit.mirrored,
                misfit.mirrored_sentence(),
            ),
        ] {
            if ui.button(name).on_hover_text(sentence).clicked()
                && let Some(chosen) = chosen
            {
                arrange(hints, chosen, arrangement);
            }
        }
    });
}

/// Says what each picture shows, instead of a frame, whose order of the pictures goes into it.
fn arrange(hints: &mut OpenHints, chosen: &Proposal, arrangement: Arrangement) {
    let order = chosen.frame.and_then(|frame| frame.order(chosen.layout));
    hints.arrange = Some(order.map_or(arrangement, |order| arrangement.by_place(order)));
    hints.frame = None;
    hints.siting = Some(chosen.siting);
}

/// What each of the six pictures shows, where the user says it.
fn faces_ui(ui: &mut Ui, chosen: &Proposal, hints: &mut OpenHints) {
    let mut by_face = hints.arrange.is_some();
    if ui
        .checkbox(&mut by_face, "say what each face shows")
        .changed()
    {
        if by_face {
            let framed = chosen.frame.and_then(Frame::arrangement);
            arrange(hints, chosen, framed.unwrap_or_default());
        } else {
            hints.arrange = None;
        }
    }
    let Some(arrangement) = &mut hints.arrange else {
        return;
    };
    Grid::new("faces").num_columns(3).show(ui, |ui| {
        for label in 0..FACES.len() {
            face_row_ui(ui, label, arrangement);
        }
    });
}

fn face_row_ui(ui: &mut Ui, label: usize, arrangement: &mut Arrangement) {
    let mut held = *arrangement.held();
    let (mut chart, mut turn) = (held[label].chart, held[label].turn);
    let face = |chart: u32| FACES.get(chart as usize).copied().unwrap_or("?");
    let text = ui.label(format!("picture {} shows", face(label as u32)));
    ComboBox::from_id_salt(("shows", label))
        .width(52.0)
        .selected_text(face(chart))
        .show_ui(ui, |ui| {
            for other in 0..FACES.len() as u32 {
                ui.selectable_value(&mut chart, other, face(other));
            }
        })
        .response
        .labelled_by(text.id);
    let name = |turn: Turn| {
        let degrees = 90 * u32::from(turn.quarters());
        match (turn.is_mirrored(), degrees) {
            (false, 0) => "upright".to_owned(),
            (false, _) => format!("turned by {degrees}°"),
            (true, 0) => "mirrored".to_owned(),
            (true, _) => format!("mirrored, {degrees}°"),
        }
    };
    let lies = ComboBox::from_id_salt(("lies", label))
        .width(110.0)
        .selected_text(name(turn))
        .show_ui(ui, |ui| {
            for other in Turn::all() {
                ui.selectable_value(&mut turn, other, name(other));
            }
        })
        .response;
    ui.ctx().accesskit_node_builder(lies.id, |node| {
        node.set_label(format!("picture {} lies", face(label as u32)));
    });
    ui.end_row();
    // Each face is shown once: the picture that showed it shows what this one did.
    if let Some(other) = arrangement.label_of(chart) {
        held[other].chart = held[label].chart;
    }
    held[label] = Held { chart, turn };
    if let Some(changed) = Arrangement::new(held) {
        *arrangement = changed;
    }
}

/// The map and the labelled environment, one below the other, each as a cross and on a ball.
fn pictures_ui(ui: &mut Ui, room: Vec2, seen: Option<&Taken>, labelled: Option<&Shown>) {
    /// Room for a line of text and the spaces around it.
    const TITLE: f32 = 24.0;
    // A cross is 4 to 3, and the ball beside it half as wide.
    let width = (room.x - GAP) / 1.5;
    let height = (room.y / 2.0 - TITLE).min(0.75 * width).max(24.0);
    let cross = vec2(height / 0.75, height);
    let seams = seen.and_then(|taken| taken.chosen.score);
    let title = seams.map_or_else(
        || "This map".to_owned(),
        |score| format!("This map, seams {score:.2}"),
    );
    let rows = [
        (title, seen.map(|taken| &taken.shown)),
        (
            "The labelled environment, the right way round".to_owned(),
            labelled,
        ),
    ];
    for (title, shown) in rows {
        ui.label(RichText::new(&title).strong());
        let whole = vec2(1.5 * cross.x + GAP, cross.y);
        let (rect, response) = ui.allocate_exact_size(whole, Sense::hover());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, shown.is_some(), &title));
        let Some(shown) = shown else { continue };
        cross_ui(ui, Rect::from_min_size(rect.min, cross), shown.cross.id());
        let ball = Rect::from_center_size(
            pos2(rect.right() - cross.x / 4.0, rect.center().y),
            Vec2::splat((cross.x / 2.0).min(cross.y)),
        );
        egui::Image::new((shown.ball.id(), ball.size()))
            .corner_radius(ball.width() / 2.0)
            .paint_at(ui, ball);
    }
}

/// The six faces of a cross, each with its name; nothing where no face is.
fn cross_ui(ui: &Ui, rect: Rect, texture: TextureId) {
    let [columns, rows] = Layout::Cross.grid().map(|count| count as f32);
    let side = vec2(rect.width() / columns, rect.height() / rows);
    for (cell, name) in Layout::Cross.cells().iter().zip(FACES) {
        let [column, row] = cell.at.map(|place| place as f32);
        let at = Rect::from_min_size(rect.min + vec2(column, row) * side, side);
        let uv = Rect::from_min_max(
            pos2(column / columns, row / rows),
            pos2((column + 1.0) / columns, (row + 1.0) / rows),
        );
        ui.painter().image(texture, at, uv, Color32::WHITE);
        let corner = at.right_top() + vec2(-3.0, 2.0);
        edged_text(ui.painter(), corner, Align2::RIGHT_TOP, name, theme::PROBE);
    }
}
