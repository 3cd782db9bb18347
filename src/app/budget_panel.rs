//! The pane of the equal texel budget: two pictures of the object side by side, a magnifier at the same place in both, and how
//! the texels of each map lie there.

use egui::{Align2, Color32, Pos2, Rect, ScrollArea, Sense, Slider, Ui, Vec2, pos2, vec2};

use super::action::Action;
use super::budget::{Lens, MOST_PIXELS, View};
use super::budget_numbers::{NARROW, numbers_height, numbers_ui};
use super::lists::{grouped_list_ui, list_ui};
use super::marks::{edged_line, edged_text};
use super::model::Model;
use super::narrow::slider_ui;
use super::state::{AppState, BudgetState, COMPARED_TEXELS, EyeRay, MAGNIFIERS, Overlays};
use super::theme;
use super::viewport::{aspect, view_pointer};
use crate::mapping::MappingId;
use crate::math::{Vec3, angle_rad};
use crate::scene::{Ray, Target, mirror::seen};

/// Names of the pictures.
pub(super) const NAMES: [&str; 3] = ["A", "B", "environment"];
/// Between pictures, in points.
const GAP: f32 = 4.0;
/// A picture is at least as wide as high, so that the camera's height of view shows all of the object, and not much wider.
const WIDEST: f32 = 1.5;
/// Below this width the text scrolls.
const LEAST_WIDTH: f32 = 170.0;
/// Below this height pictures show too little: then everything scrolls.
const LOW_PICTURES: f32 = 200.0;
/// Width from which a picture has room for its mapping's name.
const NAMED: f32 = 170.0;

/// Shows the pane in all the space there is.
pub fn budget_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::pane_frame(ui).show(ui, |ui| {
        let size = ui.available_size();
        let scroll = ScrollArea::both().auto_shrink([false, false]);
        scroll.show(ui, |ui| {
            ui.set_max_width(size.x.max(LEAST_WIDTH));
            let (top, width) = (ui.cursor().top(), ui.available_width());
            choices_ui(ui, model);
            let left = size.y - (ui.cursor().top() - top) - numbers_height(width);
            let picture = vec2(width, left.max(LOW_PICTURES.min(size.y)));
            let column = egui::Layout::top_down(egui::Align::Min);
            let pictures = ui.allocate_ui_with_layout(picture, column, |ui| pictures_ui(ui, model));
            numbers_ui(ui, model, pictures.inner);
        });
    });
}

/// What is compared.
fn choices_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let mut budget = state.budget;
    let map_ui = |ui: &mut Ui, index: usize, map: &mut Option<MappingId>| {
        let options = std::iter::once(None).chain(MappingId::ALL.iter().copied().map(Some));
        let title = |map: &Option<MappingId>| {
            let usual = || usual_text(state, index);
            map.map_or_else(usual, |map| map.info().name.to_owned())
        };
        let family = |map: &Option<MappingId>| map.map(|map| map.info().family);
        grouped_list_ui(ui, NAMES[index], map, options, title, family);
    };
    if ui.available_width() < NARROW {
        // A list would be parted from its name.
        for (index, map) in budget.maps.iter_mut().enumerate() {
            ui.horizontal(|ui| map_ui(ui, index, map));
        }
    } else {
        ui.horizontal_wrapped(|ui| {
            for (index, map) in budget.maps.iter_mut().enumerate() {
                map_ui(ui, index, map);
            }
        });
    }
    let width = ui.available_width();
    let texels_ui = |ui: &mut Ui, texels: &mut u32| {
        let label = ui.label("texels");
        let slider = Slider::new(texels, COMPARED_TEXELS.0..=COMPARED_TEXELS.1);
        let most = COMPARED_TEXELS.1.to_string();
        ui.spacing_mut().slider_width = 110.0;
        slider_ui(ui, slider.logarithmic(true), label.id, &most)
            .on_hover_text("Of each of the two maps: it gets the size nearest to this number");
    };
    let seen_ui = |ui: &mut Ui, magnifier: &mut u32, shows_surroundings: &mut bool| {
        let title = |factor: &u32| format!("× {factor}");
        list_ui(ui, "magnifier", magnifier, MAGNIFIERS, title);
        ui.checkbox(shows_surroundings, "environment")
            .on_hover_text("What is seen without a map, beside the two");
    };
    let (magnifier, shows) = (&mut budget.magnifier, &mut budget.shows_surroundings);
    if width < NARROW {
        ui.horizontal(|ui| texels_ui(ui, &mut budget.texels));
        ui.horizontal_wrapped(|ui| seen_ui(ui, magnifier, shows));
    } else {
        ui.horizontal_wrapped(|ui| {
            texels_ui(ui, &mut budget.texels);
            seen_ui(ui, magnifier, shows);
        });
    }
    set(model, budget);
}

fn set(model: &mut Model<'_>, budget: BudgetState) {
    if budget != model.state.budget {
        model.push(Action::SetBudget(budget));
    }
}

/// What stands in the list where no mapping was chosen.
fn usual_text(state: &AppState, index: usize) -> String {
    let map = state.compared_maps()[index];
    let is_viewports = map == state.mapping || Some(map) == state.compare;
    if is_viewports && state.budget.maps[index].is_none() {
        "the viewport's".to_owned()
    } else {
        "the usual".to_owned()
    }
}

/// The largest pictures that have room beside and below each other, all of one size.
fn cells(rect: Rect, count: usize) -> Vec<Rect> {
    let of_columns = |columns: usize| {
        let rows = count.div_ceil(columns);
        let side = |length: f32, n: usize| (length - GAP * (n as f32 - 1.0)) / n as f32;
        let cell = vec2(side(rect.width(), columns), side(rect.height(), rows));
        let height = cell.y.min(cell.x).max(1.0);
        let width = cell.x.min(WIDEST * height).max(1.0);
        (columns, vec2(width, height).floor().max(Vec2::splat(1.0)))
    };
    let (columns, size) = (1..=count)
        .rev()
        .map(of_columns)
        .max_by(|a, b| a.1.y.total_cmp(&b.1.y))
        .unwrap_or((1, rect.size()));
    let cell = |index: usize| {
        let at = vec2((index % columns) as f32, (index / columns) as f32);
        Rect::from_min_size(rect.min + at * (size + Vec2::splat(GAP)), size)
    };
    (0..count).map(cell).collect()
}

/// The pictures in all the space there is; gives back the direction that is seen under the pointer.
pub fn pictures_ui(ui: &mut Ui, model: &mut Model<'_>) -> Option<Vec3<f64>> {
    let whole = theme::picture_room(ui)?;
    theme::paint_ground(ui.painter(), whole);
    let count = if model.state.budget.shows_surroundings {
        3
    } else {
        2
    };
    let cells = cells(whole, count);
    let first = *cells.first()?;
    let mut pointed = None;
    for (rect, name) in cells.iter().zip(NAMES) {
        let id = ui.scope_id().with(("budget", name));
        let response = ui.interact(*rect, id, Sense::click_and_drag());
        let label = format!("Picture: {name}");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
        view_pointer(ui, model, *rect, &response, |model, _, ray| {
            (seen(model.target, ray).dir, ray.into())
        });
        if let Some(pos) = response.hover_pos().filter(|pos| rect.contains(*pos)) {
            pointed = Some((pos - rect.min) / rect.size());
        }
    }
    let overlays = model.state.overlays;
    let probed = || probe_place(model, first).filter(|_| overlays.probe);
    let magnifier = pointed
        .or_else(probed)
        .filter(|_| overlays != Overlays::NONE)
        .map(|place| Magnifier::new(first.size(), place, model.state.budget.magnifier));
    model.budget_view = Some(View {
        size: pixels(ui, first.size()),
        lens: magnifier.map(|magnifier| magnifier.lens(ui, first.size())),
    });
    for (index, rect) in cells.iter().enumerate() {
        paint_picture(ui, model, *rect, index, magnifier);
    }
    ui.advance_cursor_after_rect(Rect::from_min_max(whole.min, cells.last()?.max));
    pointed.map(|place| dir_of(model.target, ray_at(model.state, place, first)))
}

/// A square of a picture, and the larger one in which it is shown enlarged, both in points from the picture's upper left corner.
#[derive(Clone, Copy)]
struct Magnifier {
    part: Rect,
    lens: Rect,
}

impl Magnifier {
    /// In the lower corner on the side where the place is not.
    fn new(picture: Vec2, place: Vec2, factor: u32) -> Self {
        /// Side of the enlarged square over the picture's height.
        const SHARE: f32 = 0.42;
        let whole = Rect::from_min_size(Pos2::ZERO, picture);
        let side = (SHARE * picture.y).floor();
        let half = 0.5 * side / factor as f32;
        // Within the picture, so that nothing beyond it is asked for.
        let center = whole.shrink(half).clamp((place * picture).to_pos2());
        let is_left = place.x >= 0.5;
        let x = if is_left { 0.0 } else { picture.x - side };
        let lens = Rect::from_min_size(pos2(x, picture.y - side), Vec2::splat(side));
        Self {
            part: Rect::from_center_size(center, Vec2::splat(2.0 * half)),
            lens: lens.shrink(4.0),
        }
    }

    /// The part over the whole picture, as shares from 0 to 1.
    fn uv(&self, picture: Vec2) -> Rect {
        let share = |at: Pos2| (at.to_vec2() / picture).to_pos2();
        Rect::from_min_max(share(self.part.min), share(self.part.max))
    }

    fn lens(&self, ui: &Ui, picture: Vec2) -> Lens {
        let uv = self.uv(picture);
        Lens {
            place: uv.center().into(),
            share: uv.size().into(),
            size: pixels(ui, self.lens.size()),
        }
    }
}

/// Pixels of a picture of that size in points.
fn pixels(ui: &Ui, size: Vec2) -> [u32; 2] {
    let pixels = size * ui.ctx().pixels_per_point();
    let coarser = (pixels.x * pixels.y / MOST_PIXELS as f32).sqrt().max(1.0);
    [pixels.x, pixels.y].map(|length| ((length / coarser).round() as u32).max(1))
}

fn ray_at(state: &AppState, place: Vec2, rect: Rect) -> Ray {
    state.camera.ray((place.x, place.y), aspect(rect))
}

fn dir_of(target: &Target, ray: Ray) -> Vec3<f64> {
    Vec3::from_f64(seen(target, ray).dir.to_array().map(f64::from))
}

/// Where the probe is seen in a picture, from 0 to 1 each way; `None` where its direction is not what is seen there.
fn probe_place(model: &Model<'_>, rect: Rect) -> Option<Vec2> {
    /// As far as an f32 probe and the way to it may be off; a pixel is wider.
    const NEAR_RAD: f64 = 1e-3;
    let (state, probe) = (model.state, model.state.probe_f64());
    let aspect = aspect(rect);
    let hit = state
        .eye_ray
        .map(EyeRay::ray)
        .and_then(|ray| model.target.cast(ray));
    let (u, v) = match hit {
        Some(hit) => state.camera.project(hit.point, aspect),
        None => state.camera.project_direction(state.probe.into(), aspect),
    }?;
    let place = vec2(u, v);
    let dir = dir_of(model.target, ray_at(state, place, rect));
    (angle_rad(dir.to_f64(), probe.to_f64()) < NEAR_RAD).then_some(place)
}

fn paint_picture(
    ui: &Ui,
    model: &Model<'_>,
    rect: Rect,
    index: usize,
    magnifier: Option<Magnifier>,
) {
    let painter = ui.painter_at(rect);
    let Some((wanted, shown)) = model.labs.budget.shown() else {
        let (at, text) = (rect.center(), "comparing …");
        edged_text(&painter, at, Align2::CENTER_CENTER, text, theme::PROBE);
        return;
    };
    let texture = shown.pictures[index].id();
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    painter.image(texture, rect, whole, Color32::WHITE);
    if model.state.overlays == Overlays::NONE {
        return;
    }
    let title = match wanted.maps.get(index) {
        Some(map) if rect.width() >= NAMED => {
            format!("{}  {}", NAMES[index], map.mapping.info().name)
        }
        _ => NAMES[index].to_owned(),
    };
    let at = rect.left_top() + vec2(6.0, 5.0);
    edged_text(&painter, at, Align2::LEFT_TOP, &title, theme::PROBE);
    let Some(magnifier) = magnifier else {
        return;
    };
    let on_screen = |part: Rect| part.translate(rect.min.to_vec2());
    let lens = on_screen(magnifier.lens);
    let enlarged = model.labs.budget.enlarged(magnifier.lens(ui, rect.size()));
    match enlarged {
        Some(pictures) => painter.image(pictures[index].id(), lens, whole, Color32::WHITE),
        // Until it is there, the picture's own pixels.
        None => painter.image(texture, lens, magnifier.uv(rect.size()), Color32::WHITE),
    };
    outline(&painter, on_screen(magnifier.part));
    outline(&painter, lens);
}

fn outline(painter: &egui::Painter, rect: Rect) {
    let corners = [
        rect.left_top(),
        rect.right_top(),
        rect.right_bottom(),
        rect.left_bottom(),
        rect.left_top(),
    ];
    edged_line(painter, corners.to_vec(), 1.5, theme::TEXEL);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_as_large_as_they_can_be_and_lie_within() {
        for (size, count, columns) in [
            (vec2(800.0, 400.0), 2, 2),
            (vec2(300.0, 800.0), 2, 1),
            (vec2(900.0, 300.0), 3, 3),
            (vec2(500.0, 500.0), 3, 2),
        ] {
            let rect = Rect::from_min_size(pos2(7.0, 9.0), size);
            let cells = cells(rect, count);
            let in_a_row = cells.iter().filter(|c| c.top() == cells[0].top()).count();
            assert_eq!(in_a_row, columns, "{size:?}: {cells:?}");
            assert!(cells.iter().all(|cell| cell.size() == cells[0].size()));
            assert!(
                cells.iter().all(|cell| rect.contains_rect(*cell)),
                "{cells:?}"
            );
            let shape = aspect(cells[0]);
            assert!((0.99..=WIDEST + 0.01).contains(&shape), "{shape}");
        }
        // Where there is no room, nothing fails.
        assert_eq!(
            cells(Rect::from_min_size(pos2(7.0, 9.0), vec2(1.0, 1.0)), 3).len(),
            3
        );
    }
}
