//! The viewport: the mirror object before its surroundings, turned by the pointer, with its marks.

use egui::{Align2, Color32, PointerButton, Pos2, Rect, Response, Sense, Ui, Vec2, pos2, vec2};
use glam::Vec3;

use super::action::Action;
use super::marks::{arrow, beyond, edged_line, edged_text, footprint};
use super::model::Model;
use super::probe::texel_outline;
use super::state::{EyeRay, Overlays};
use super::story::{self, Arrow, dir_of, point_of};
use super::theme;
use super::turning::rings_ui;
use super::views::ViewKey;
use super::wheel::wheel_zoom;
use crate::gpu::GREAT_CIRCLE_COLORS;
use crate::mapping::cube_face::GREAT_CIRCLES;
use crate::mapping::{MappingId, ShaderForm};
use crate::optics::Material;
use crate::scene::{Camera, Ray, Target};

/// Radians that the camera turns for a drag over one point.
pub(super) const ORBIT_RAD_PER_POINT: f32 = 0.008;
/// Logarithm of the factor by which a point of scrolling brings the camera nearer.
const STAGE_ZOOM_PER_POINT: f32 = 0.004;
/// Points around the divider in which it can be grabbed.
const DIVIDER_GRIP: f32 = 8.0;

/// Half the space of an arrow's name, in points.
const NAME_SPACE: Vec2 = vec2(34.0, 9.0);

/// Shows the viewport in all the space there is.
pub fn viewport_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let sense = Sense::click_and_drag();
    let Some(response) = theme::picture_ui(ui, "The viewport", sense) else {
        return;
    };
    let rect = response.rect;
    model.view_ui(ui, ViewKey::Viewport, rect);
    let on_divider = divider_ui(ui, model, rect);
    let on_ring = rings_ui(ui, model, rect);
    if !on_divider && !on_ring {
        pointer(ui, model, rect, &response);
    }
    paint_marks(ui, model, rect);
}

/// Width over height.
pub(super) fn aspect(rect: Rect) -> f32 {
    rect.width() / rect.height()
}

/// What the pointer does in the viewport: what is seen there depends on the material on that side of the divider.
fn pointer(ui: &Ui, model: &mut Model<'_>, rect: Rect, response: &Response) {
    view_pointer(ui, model, rect, response, |model, place, ray| {
        let state = model.state;
        let eye_ray = EyeRay {
            is_right: state.is_divided() && place.x > state.divider,
            ..ray.into()
        };
        let dir = looked_up(model.target, ray, state.material_at(eye_ray.is_right));
        (dir, eye_ray)
    });
}

/// What the pointer does over a view through the camera: turns, zooms, and finds directions. `look` tells the direction that is
/// seen at a place, from 0 to 1 each way, along a ray from the eye.
pub(super) fn view_pointer(
    ui: &Ui,
    model: &mut Model<'_>,
    rect: Rect,
    response: &Response,
    look: impl FnOnce(&Model<'_>, Vec2, Ray) -> (Vec3, EyeRay),
) {
    if response.dragged_by(PointerButton::Primary) {
        let drag = response.drag_delta() * ORBIT_RAD_PER_POINT;
        if drag != Vec2::ZERO {
            model.push(Action::Orbit {
                dx_rad: drag.x,
                dy_rad: drag.y,
            });
        }
        return;
    }
    if let Some(factor) = wheel_zoom(ui, response, STAGE_ZOOM_PER_POINT) {
        model.push(Action::Zoom(factor));
    }
    let Some(pos) = response.hover_pos().or(response.interact_pointer_pos()) else {
        return;
    };
    let moved = ui.input(|i| i.pointer.delta() != Vec2::ZERO || i.pointer.any_pressed());
    let dragged = response.dragged_by(PointerButton::Secondary);
    let clicked = response.clicked();
    let wanted = clicked || dragged || (model.state.probe_follows && moved);
    if wanted && rect.contains(pos) {
        let place = (pos - rect.min) / rect.size();
        let ray = model.state.camera.ray((place.x, place.y), aspect(rect));
        let (dir, eye_ray) = look(model, place, ray);
        model.push(Action::SetProbe {
            dir: dir.to_array(),
            eye_ray: Some(eye_ray),
        });
    }
    if clicked && model.state.probe_follows {
        model.push(Action::FollowPointer(false));
    }
}

/// The direction in which the map is asked along a ray from the eye: as the material says where the object is hit, else straight on.
pub fn looked_up(target: &Target, ray: Ray, material: &Material) -> Vec3 {
    target.cast(ray).map_or(ray.dir, |hit| {
        point_of(material.looked_up(dir_of(ray.dir), dir_of(hit.normal)))
    })
}

/// The divider between the two mappings; true while the pointer is on it.
fn divider_ui(ui: &mut Ui, model: &mut Model<'_>, rect: Rect) -> bool {
    if !model.state.is_divided() {
        return false;
    }
    let compare = model.state.compare.unwrap_or(model.state.mapping);
    let x = rect.min.x + model.state.divider * rect.width();
    let grip = Rect::from_min_max(
        pos2(x - DIVIDER_GRIP, rect.min.y),
        pos2(x + DIVIDER_GRIP, rect.max.y),
    );
    let response = ui.interact(grip, ui.scope_id().with("divider"), Sense::drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Slider, true, "Divider between the mappings")
    });
    let response = response.on_hover_and_drag_cursor(egui::CursorIcon::ResizeHorizontal);
    if response.dragged()
        && let Some(pos) = response.interact_pointer_pos()
    {
        model.push(Action::SetDivider((pos.x - rect.min.x) / rect.width()));
    }
    let painter = ui.painter_at(rect);
    let line = vec![pos2(x, rect.min.y), pos2(x, rect.max.y)];
    edged_line(&painter, line, 1.5, Color32::WHITE);
    let sides = [
        (model.state.mapping, Align2::RIGHT_TOP, -1.0),
        (compare, Align2::LEFT_TOP, 1.0),
    ];
    for (mapping, anchor, side) in sides.into_iter().filter(|_| model.state.overlays.names) {
        let text = side_name(model, mapping, side > 0.0);
        edged_text(
            &painter,
            pos2(x + 8.0 * side, rect.min.y + 6.0),
            anchor,
            &text,
            Color32::WHITE,
        );
    }
    response.hovered() || response.dragged()
}

/// What is seen on one side of the divider: what differs between the two.
fn side_name(model: &Model<'_>, mapping: MappingId, is_right: bool) -> String {
    let state = model.state;
    let [w, h] = model.map_size(mapping);
    let charts = mapping.info().chart_count();
    let map = format!("{}  {charts} × {w}×{h}", mapping.info().name);
    if state.compare_material.is_none() {
        return map;
    }
    let material = state.material_at(is_right);
    if state.compare.is_some() {
        format!("{}\n{map}", material.title())
    } else {
        material.title()
    }
}

/// Axes, vectors and the legend of the circles.
fn paint_marks(ui: &Ui, model: &Model<'_>, rect: Rect) {
    let painter = ui.painter_at(rect);
    let overlays = model.state.overlays;
    if overlays.axes {
        paint_axes(&painter, model.state.camera, rect);
    }
    if let Some(step) = model.painted_step() {
        paint_arrows(&painter, model.state.camera, rect, &step.arrows);
    } else if overlays.vectors
        && let Some(ray) = model.state.eye_ray.map(EyeRay::ray)
        && let Some(hit) = model.target.cast(ray)
    {
        let mut arrows = story::vectors(ray, &hit).to_vec();
        arrows.extend(story::refracted_vector(
            ray,
            &hit,
            model.state.pointed_material(),
        ));
        paint_arrows(&painter, model.state.camera, rect, &arrows);
    }
    if overlays.probe {
        paint_footprint(&painter, model, rect);
    }
    if overlays.great_circles {
        for (i, (name, _)) in GREAT_CIRCLES.iter().enumerate() {
            let [r, g, b] = GREAT_CIRCLE_COLORS[i];
            let at = rect.min + vec2(12.0 + 18.0 * i as f32, 8.0);
            let color = Color32::from_rgb(r, g, b);
            edged_text(&painter, at, Align2::CENTER_TOP, &name.to_string(), color);
        }
    }
    if model.state.form.difference && overlays != Overlays::NONE {
        paint_difference_legend(&painter, model, rect);
    }
    if model.surroundings.is_none() {
        let text = "Loading the environment …";
        edged_text(
            &painter,
            rect.center(),
            Align2::CENTER_CENTER,
            text,
            Color32::WHITE,
        );
    }
}

/// What black and white mean where the error of a form is shown, in the lower right corner.
fn paint_difference_legend(painter: &egui::Painter, model: &Model<'_>, rect: Rect) {
    const BAR: Vec2 = vec2(96.0, 10.0);
    const STEPS: u8 = 12;
    let (shown, mapping) = (model.form, model.state.mapping);
    let form = mapping.form_or_precise(shown.form);
    let factor = shown.factor(mapping, model.map_size(mapping)[1]);
    let bar = Rect::from_min_size(rect.right_bottom() - BAR - vec2(12.0, 26.0), BAR);
    painter.rect_filled(bar.expand(1.0), 0.0, theme::PROBE_EDGE);
    let step = vec2(BAR.x / f32::from(STEPS), 0.0);
    for k in 0..STEPS {
        let corner = bar.min + step * f32::from(k);
        let part = Rect::from_min_size(corner, vec2(step.x, BAR.y));
        let grey = (u16::from(k) * 255 / u16::from(STEPS - 1)) as u8;
        painter.rect_filled(part, 0.0, Color32::from_gray(grey));
    }
    let white = match factor {
        1 => "1 texel".to_owned(),
        factor => format!("1/{factor} texel"),
    };
    for (at, anchor, text) in [
        (bar.left_bottom(), Align2::LEFT_TOP, "0"),
        (bar.right_bottom(), Align2::RIGHT_TOP, &*white),
        (
            bar.right_top() - vec2(0.0, 4.0),
            Align2::RIGHT_BOTTOM,
            &*format!("{form} against {}", ShaderForm::Precise),
        ),
    ] {
        edged_text(painter, at + vec2(0.0, 2.0), anchor, text, Color32::WHITE);
    }
}

/// The world's axes in the lower left corner, as the camera sees them from far away.
fn paint_axes(painter: &egui::Painter, camera: Camera, rect: Rect) {
    const LENGTH: f32 = 30.0;
    let origin = rect.left_bottom() + vec2(52.0, -52.0);
    let frame = camera.ray_frame(1.0);
    let (right, up) = (
        frame.right.normalize_or_zero(),
        frame.up.normalize_or_zero(),
    );
    let mut axes: Vec<(f32, Pos2, usize)> = [Vec3::X, Vec3::Y, Vec3::Z]
        .iter()
        .enumerate()
        .map(|(i, axis)| {
            let tip = vec2(axis.dot(right), -axis.dot(up)) * LENGTH;
            (axis.dot(frame.forward), origin + tip, i)
        })
        .collect();
    // The farthest first, so that nearer arrows lie over it.
    axes.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, tip, i) in axes {
        arrow(painter, origin, tip, theme::AXES[i], ["x", "y", "z"][i]);
    }
}

/// The probe's texel where it is seen directly, in the sky beside the object.
fn paint_footprint(painter: &egui::Painter, model: &Model<'_>, rect: Rect) {
    let camera = model.state.camera;
    let place = |dir: Vec3| camera.project_direction(dir, aspect(rect));
    let at = place(model.state.probe.into());
    let is_hidden = |(u, v)| {
        model
            .target
            .cast(camera.ray((u, v), aspect(rect)))
            .is_some()
    };
    if at.is_none_or(is_hidden) {
        return;
    }
    let size = model.map_size(model.state.mapping);
    let outline = texel_outline(model.state.mapping, size, model.state.probe_f64());
    let on_screen = outline.iter().filter_map(|dir| {
        let (u, v) = place(dir.to_f64().map(|c| c as f32).into())?;
        Some(rect.min + vec2(u * rect.width(), v * rect.height()))
    });
    footprint(painter, vec![on_screen.collect()]);
}

/// Arrows of the world over the picture, with their names.
fn paint_arrows(painter: &egui::Painter, camera: Camera, rect: Rect, arrows: &[Arrow]) {
    let screen = |point: Vec3| {
        let (u, v) = camera.project(point, aspect(rect))?;
        Some(rect.min + vec2(u * rect.width(), v * rect.height()))
    };
    for Arrow {
        from,
        to,
        name,
        color,
        arrives,
    } in arrows
    {
        let (Some(from), Some(to)) = (screen(*from), screen(*to)) else {
            continue;
        };
        let (root, free) = if *arrives { (to, from) } else { (from, to) };
        // Seen along itself, as the incident vector right after pointing, an arrow is a point: turn the camera to see it.
        if from.distance(to) < 8.0 {
            painter.circle_filled(root, 4.0, *color);
            let at = root + vec2(-10.0, 12.0);
            edged_text(painter, at, Align2::RIGHT_CENTER, name, *color);
        } else {
            arrow(painter, from, to, *color, "");
            let at = beyond(free, free - root, name);
            // A name is read in whole also at the border, where its arrow may be cut.
            let at = at.max(rect.min + NAME_SPACE).min(rect.max - NAME_SPACE);
            edged_text(painter, at, Align2::CENTER_CENTER, name, *color);
        }
    }
}
