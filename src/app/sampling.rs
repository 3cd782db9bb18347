//! The pane with the cut through the horizon: how evenly two mappings part it into texels.

use egui::{Align2, Color32, FontId, Pos2, Sense, Slider, Ui, vec2};

use super::action::Action;
use super::lists::grouped_list_ui;
use super::model::Model;
use super::narrow::{picture_pane, slider_ui};
use super::state::{AppState, SamplingState};
use super::theme;
use crate::imaging::Progress;
use crate::lab::drawing::{Colour, Drawing, Shape};
use crate::lab::sampling::{QUARTERS, Sampling, drawing};
use crate::mapping::MappingId;

/// Which mappings are cut, and how fine they are.
#[derive(Clone, Debug, PartialEq)]
pub struct CutsWanted {
    maps: Vec<MappingId>,
    quarter: u32,
}

impl CutsWanted {
    /// The selected mapping, and the other one where it is another.
    pub fn new(state: &AppState) -> Self {
        let SamplingState { other, quarter, .. } = state.sampling;
        let mut maps = vec![state.mapping, other];
        maps.dedup();
        Self { maps, quarter }
    }

    /// Cuts them; nothing when cancelled.
    pub fn make(&self, progress: &Progress) -> Option<Vec<Sampling>> {
        let cut =
            |map: &MappingId| (!progress.is_cancelled()).then(|| Sampling::new(*map, self.quarter));
        self.maps.iter().map(cut).collect()
    }
}

/// The cuts on a sheet of `size` pixels.
pub fn sheet(state: &AppState, cuts: &[Sampling], size: [u32; 2]) -> Drawing {
    let probe = state.overlays.probe.then(|| state.probe_f64());
    drawing(cuts, probe, size)
}

/// Shows the pane in all the space there is.
pub fn sampling_ui(ui: &mut Ui, model: &mut Model<'_>) {
    picture_pane(ui, model, controls_ui, sheet_ui);
}

fn controls_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut sampling = model.state.sampling;
    ui.horizontal_wrapped(|ui| {
        ui.strong(model.state.mapping.info().name);
        let all = MappingId::ALL.iter().copied();
        let title = |map: &MappingId| map.info().name.to_owned();
        let family = |map: &MappingId| Some(map.info().family);
        grouped_list_ui(ui, "beside", &mut sampling.other, all, title, family);
        let label = ui.label("texels a quarter turn");
        let slider = Slider::new(&mut sampling.quarter, QUARTERS.0..=QUARTERS.1);
        slider_ui(ui, slider, label.id, "00");
    });
    if sampling != model.state.sampling {
        model.push(Action::SetSampling(sampling));
    }
}

/// The sheet alone, in all the space there is.
pub fn sheet_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let name = "Cut through the horizon, seen from above";
    let Some(response) = theme::picture_ui(ui, name, Sense::hover()) else {
        return;
    };
    let rect = response.rect;
    let painter = ui.painter_at(rect);
    theme::paint_ground(&painter, rect);
    let size = [rect.width() as u32, rect.height() as u32];
    model.cuts_wanted = Some(CutsWanted::new(model.state));
    if let Some((_, cuts)) = model.labs.sampling.shown() {
        for shape in sheet(model.state, cuts, size).shapes() {
            paint(&painter, rect.min, shape);
        }
    }
}

/// A shape of a drawing on the window's dark ground.
fn paint(painter: &egui::Painter, corner: Pos2, shape: &Shape) {
    let at = |[x, y]: [f64; 2]| corner + vec2(x as f32, y as f32);
    match shape {
        Shape::Line {
            points,
            width,
            colour,
        } => {
            let points = points.iter().copied().map(at).collect();
            painter.line(points, (*width as f32, on_dark(*colour)));
        }
        Shape::Disc {
            at: middle,
            radius,
            colour,
        } => {
            painter.circle_filled(at(*middle), *radius as f32, on_dark(*colour));
        }
        Shape::Words {
            at: corner,
            size,
            text,
            colour,
        } => {
            // A font's size is about 1.4 times the height of its capitals.
            let font = FontId::proportional(1.4 * *size as f32);
            painter.text(at(*corner), Align2::LEFT_TOP, text, font, on_dark(*colour));
        }
    }
}

/// Greys change places, so that ink is light; colours stay.
fn on_dark([r, g, b]: Colour) -> Color32 {
    if r == g && g == b {
        Color32::from_gray(255 - r)
    } else {
        Color32::from_rgb(r, g, b)
    }
}
