//! How the environment is turned: by numbers, and by three rings around the object.
//!
//! Each ring turns one of the numbers and nothing else: the roll's ring stands upright, the pitch's is carried along by the roll, the
//! yaw's by both. On each ring a knob stands at its angle; it goes where the surroundings go.

use egui::{Align2, DragValue, Grid, Painter, Pos2, Rect, Sense, Ui, Vec2, vec2};
use glam::DVec3;

use super::action::Action;
use super::marks::{dot, edged_line, edged_text};
use super::model::Model;
use super::theme;
use crate::math::Rotation;
use crate::scene::Camera;

/// The angles' names, in the order of [`Rotation::degrees`].
const NAMES: [&str; 3] = ["yaw", "pitch", "roll"];
/// What a positive angle does, as `sixfold convert --rotate` has it.
const SENSES: [&str; 3] = [
    "turns the viewer to the right: ahead (+z) is then what was at the right (+x)",
    "turns the viewer upwards: ahead (+z) is then what was up (+y)",
    "turns the viewer clockwise: up (+y) is then what was at the right (+x)",
];
/// Axis of the world that a ring stands for, by its colour: y, x, z.
const COLORS: [usize; 3] = [1, 0, 2];
/// Points around a ring in which it can be grabbed.
const GRIP: f32 = 7.0;
/// Points of a ring's line: smooth at any size that a viewport has.
const RING_POINTS: usize = 96;
/// Radius of the rings over half the height of the screen, at the object's distance.
const RADIUS: f32 = 0.8;

/// The three numbers, and what takes them back to nothing.
pub fn rotation_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let rotation = model.state.rotation;
    ui.label("turn of the environment");
    let mut degrees = rotation.degrees();
    let mut changed = false;
    // A row for each: side by side, three angles of five digits are wider than the controls.
    Grid::new("turn").num_columns(2).show(ui, |ui| {
        for ((name, sense), angle) in NAMES.iter().zip(SENSES).zip(&mut degrees) {
            let label = ui.label(*name);
            let number = DragValue::new(angle).suffix("°").speed(0.5).max_decimals(2);
            let response = ui.add(number).labelled_by(label.id);
            changed |= response
                .on_hover_text(format!("{name} > 0 {sense}"))
                .changed();
            ui.end_row();
        }
    });
    if changed {
        model.push(Action::SetRotation(Rotation::from_degrees(degrees)));
    }
    ui.horizontal(|ui| {
        let mut overlays = model.state.overlays;
        let rings = ui.checkbox(&mut overlays.rings, "rings to turn it");
        if rings
            .on_hover_text("In the viewport: drag a ring")
            .changed()
        {
            model.push(Action::SetOverlays(overlays));
        }
        let straight = ui.add_enabled(!rotation.is_none(), egui::Button::new("Turn back"));
        if straight.clicked() {
            model.push(Action::SetRotation(Rotation::NONE));
        }
    });
}

/// One ring as it is seen.
#[derive(Clone, Copy)]
struct Ring {
    /// Which of the three angles it turns.
    index: usize,
    rotation: Rotation,
    camera: Camera,
    rect: Rect,
}

impl Ring {
    /// Where the knob lies when the ring's angle is `degrees`, the others as they are; `None` behind the eye.
    fn place(self, degrees: f64) -> Option<Pos2> {
        // A direction that its angle moves, another for each ring, so that no two knobs lie on each other untouched.
        let marker = [DVec3::Z, DVec3::Y, DVec3::X][self.index];
        let mut angles = self.rotation.degrees();
        angles[self.index] = degrees;
        angles[..self.index].fill(0.0);
        let rows = Rotation::from_degrees(angles).world_from_source();
        let camera = self.camera.sanitized();
        let radius = RADIUS * camera.distance * (0.5 * camera.fov_y_rad).tan();
        let at = rows.map(|row| DVec3::from(row).dot(marker) as f32);
        let at = radius * glam::Vec3::from(at);
        let size = self.rect.size();
        let (u, v) = camera.project(at, size.x / size.y)?;
        Some(self.rect.min + vec2(u, v) * size)
    }

    fn points(self) -> impl Iterator<Item = (f64, Pos2)> {
        let step = 360.0 / RING_POINTS as f64;
        (0..=RING_POINTS).filter_map(move |i| {
            let degrees = step * i as f64;
            Some((degrees, self.place(degrees)?))
        })
    }

    /// The angle of the point of the ring that is nearest on the screen, and how far away that is in points.
    fn nearest(self, pos: Pos2) -> Option<(f64, f32)> {
        let places = self
            .points()
            .map(|(degrees, at)| (degrees, at.distance(pos)));
        places.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Degrees by which a move of the pointer turns the ring that was grabbed at `degrees`.
    fn dragged(self, degrees: f64, delta: Vec2) -> f64 {
        const STEP_DEG: f64 = 1.0;
        let ends = [degrees - STEP_DEG, degrees + STEP_DEG].map(|d| self.place(d));
        let [Some(from), Some(to)] = ends else {
            return 0.0;
        };
        // Points of the screen in a degree. Where the ring is seen from its edge and turns towards the eye, it is never
        // taken for less than a tenth of what it has elsewhere, or a small move would be a wild turn.
        let along = (to - from) / (2.0 * STEP_DEG as f32);
        let least =
            0.1 * RADIUS * 0.5 * self.rect.height().min(self.rect.width()) * 1_f32.to_radians();
        let length = along.length().max(least);
        f64::from(delta.dot(along) / (length * length))
    }
}

/// The rings over the viewport; true while the pointer has one.
pub fn rings_ui(ui: &Ui, model: &mut Model<'_>, rect: Rect) -> bool {
    if !model.state.overlays.rings {
        return false;
    }
    let rings = [0, 1, 2].map(|index| Ring {
        index,
        rotation: model.state.rotation,
        camera: model.state.camera,
        rect,
    });
    let pointer = ui
        .input(|i| i.pointer.hover_pos())
        .filter(|at| rect.contains(*at));
    let near = pointer.and_then(|at| {
        let found = rings
            .iter()
            .filter_map(|ring| Some((ring.index, ring.nearest(at)?)));
        let found = found.filter(|(_, (_, distance))| *distance < GRIP);
        found
            .min_by(|a, b| a.1.1.total_cmp(&b.1.1))
            .map(|(index, _)| index)
    });
    let painter = ui.painter_at(rect);
    let mut is_held = false;
    for ring in rings {
        is_held |= ring_ui(
            ui,
            model,
            &painter,
            ring,
            pointer.filter(|_| near == Some(ring.index)),
        );
    }
    is_held
}

/// One ring; `pointer` is on it. What can be grabbed is the knob, and the place under the pointer anywhere on the ring.
fn ring_ui(
    ui: &Ui,
    model: &mut Model<'_>,
    painter: &Painter,
    ring: Ring,
    pointer: Option<Pos2>,
) -> bool {
    let angle = ring.rotation.degrees()[ring.index];
    let Some(knob) = ring.place(angle) else {
        return false;
    };
    let name = NAMES[ring.index];
    let grip = Rect::from_center_size(pointer.unwrap_or(knob), Vec2::splat(2.0 * GRIP));
    let id = ui.scope_id().with(("ring", ring.index));
    let response = ui.interact(grip.intersect(ring.rect), id, Sense::drag());
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::Role::Slider, true, format!("Ring: {name}"));
        info.value = Some(angle);
        info
    });
    let response = response.on_hover_and_drag_cursor(egui::CursorIcon::Grab);
    let is_held = response.hovered() || response.dragged();
    if response.dragged()
        && let Some(pos) = response.interact_pointer_pos()
        && let Some((grabbed, _)) = ring.nearest(pos - response.drag_delta())
    {
        let turned = ring.dragged(grabbed, response.drag_delta());
        if turned != 0.0 {
            let mut degrees = ring.rotation.degrees();
            degrees[ring.index] += turned;
            model.push(Action::SetRotation(Rotation::from_degrees(degrees)));
        }
    }
    let color = theme::AXES[COLORS[ring.index]];
    let width = if is_held { 3.0 } else { 1.5 };
    edged_line(
        painter,
        ring.points().map(|(_, at)| at).collect(),
        width,
        color,
    );
    dot(painter, knob, color);
    let text = format!("{name} {angle:.1}°");
    edged_text(
        painter,
        knob + vec2(0.0, -8.0),
        Align2::CENTER_BOTTOM,
        &text,
        color,
    );
    is_held
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(index: usize) -> Ring {
        Ring {
            index,
            rotation: Rotation::from_degrees([30.0, -20.0, 50.0]),
            camera: Camera {
                yaw_rad: 0.5,
                pitch_rad: 0.3,
                ..Camera::default()
            },
            rect: Rect::from_min_size(Pos2::ZERO, vec2(600.0, 400.0)),
        }
    }

    #[test]
    fn a_drag_along_a_ring_turns_it_as_far_as_the_knob_goes() {
        for index in 0..3 {
            let ring = ring(index);
            let angle = ring.rotation.degrees()[index];
            let (from, to) = (ring.place(angle).unwrap(), ring.place(angle + 5.0).unwrap());
            let turned = ring.dragged(angle, to - from);
            assert!((turned - 5.0).abs() < 0.7, "{index}: {turned}");
            assert!(ring.dragged(angle, from - to) < -4.0, "control");
            let (found, distance) = ring.nearest(from).unwrap();
            assert!(distance < 8.0, "{index}: {found} {distance}");
        }
    }

    #[test]
    fn no_drag_is_wild_where_a_ring_is_seen_from_its_edge() {
        for index in 0..3 {
            let ring = ring(index);
            for i in 0..360 {
                let turned = ring.dragged(f64::from(i), vec2(1.0, 1.0));
                assert!(turned.abs() < 8.0, "{index} at {i}: {turned}");
            }
        }
    }
}
