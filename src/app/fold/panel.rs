//! The pane: a slider from the flat picture to the sphere, and the surface.

use egui::epaint::{Mesh, Vertex};
use egui::{Align2, Color32, Pos2, RichText, Sense, Shape, Slider, Ui, pos2, vec2};

use super::lines::{letters, project};
use super::sheet::{Sheet, SheetWanted};
use super::view::{Quad, Surface, is_covered};
use crate::app::action::{Action, probe_at};
use crate::app::distortion::{HeatWanted, Seen, paint_legend};
use crate::app::kept::kept;
use crate::app::map_lines::Kind;
use crate::app::marks::{cross_mark, edged, edged_text};
use crate::app::model::Model;
use crate::app::narrow::{picture_pane, slider_ui};
use crate::app::state::FoldState;
use crate::app::theme;
use crate::app::viewport::{ORBIT_RAD_PER_POINT, aspect};
use crate::app::wheel::{ZOOM_PER_POINT, wheel_zoom};
use crate::gpu::GREAT_CIRCLE_COLORS;
use crate::imaging::FACE_COLORS;
use crate::mapping::cube_face::GREAT_CIRCLES;
use crate::mapping::{Borders, ChartPoint, MappingId};

/// Shows the pane in all the space there is.
pub fn fold_ui(ui: &mut Ui, model: &mut Model<'_>) {
    picture_pane(ui, model, controls_ui, surface_ui);
}

fn controls_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut fold = model.state.fold;
    let name = model.state.mapping.info().name;
    let between = crate::mapping::Unfolding::new(model.state.mapping).solid();
    let way = match between {
        Some(solid) => format!("{name}: flat, {}, sphere", solid.name()),
        None => format!("{name}: flat, sphere"),
    };
    ui.horizontal_wrapped(|ui| {
        let moves = fold.towards.is_some();
        let is_far = fold.share > 0.5;
        let title = match (moves, is_far) {
            (true, _) => "Stop",
            (false, false) => "Fold",
            (false, true) => "Unfold",
        };
        if ui.button(title).clicked() {
            fold.towards = (!moves).then_some(if is_far { 0.0 } else { 1.0 });
        }
        let label = ui.label(way);
        let slider = Slider::new(&mut fold.share, 0.0..=1.0).show_value(false);
        if slider_ui(ui, slider, label.id, "").changed() {
            fold.towards = None;
        }
        ui.checkbox(&mut fold.see_through, "see through")
            .on_hover_text("What is seen from outside lets through what lies behind it");
        ui.label(RichText::new("from outside every picture is mirrored").small());
    });
    if fold.towards.is_some() {
        fold = fold.after(ui.input(|i| i.stable_dt));
        ui.ctx().request_repaint();
    }
    if fold != model.state.fold {
        model.push(Action::SetFold(fold));
    }
}

/// The surface alone, in all the space there is.
pub fn surface_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let sense = Sense::click_and_drag();
    let Some(response) = theme::picture_ui(ui, "Folded map", sense) else {
        return;
    };
    let rect = response.rect;
    let state = model.state;
    let painter = ui.painter_at(rect);
    theme::paint_ground(&painter, rect);
    let mapping = state.mapping;
    let ground = ground_of(model);
    model.sheet_wanted = Some(SheetWanted::new(mapping, state.overlays));
    let surface = Surface::new(mapping, state.fold.share, state.fold.camera, aspect(rect));
    let on_screen = |at: [f32; 2]| rect.min + vec2(at[0], at[1]) * rect.size();
    let drawn = model.labs.fold.sheet_of(mapping).map(|(of, sheet)| {
        let key = (*of, state.fold, ground, rect);
        kept(ui, response.id, key, || {
            Drawn::new(&surface, sheet, state.fold, ground, on_screen)
        })
    });
    if let Some(drawn) = &drawn {
        painter.extend(drawn.shapes.iter().cloned());
        for &(index, at) in &drawn.letters {
            let name = GREAT_CIRCLES[index].0.to_string();
            let color = pen(Kind::GreatCircle(index)).1;
            let at = on_screen(at) + vec2(4.0, -4.0);
            edged_text(&painter, at, Align2::LEFT_BOTTOM, &name, color);
        }
    }
    // What lies behind an outside that lets nothing through.
    let is_hidden = |point: ChartPoint<f64>, at: [f32; 2]| {
        let quads = drawn.as_ref().map_or(&[][..], |drawn| &drawn.quads);
        !state.fold.see_through && !surface.is_outside(point) && is_covered(quads, at)
    };
    if state.overlays.names {
        paint_names(&painter, &surface, is_hidden, on_screen);
    }
    if state.overlays.probe
        && let Some(point) = state.mapping.forward(state.probe_f64())
        && let Some((at, _)) = surface.seen(point)
    {
        let color = if is_hidden(point, at) {
            Color32::GRAY
        } else {
            theme::PROBE
        };
        cross_mark(&painter, on_screen(at), color);
    }
    let clicked = response
        .interact_pointer_pos()
        .filter(|_| response.clicked());
    if let Some((pos, drawn)) = clicked.zip(drawn) {
        let place = (pos - rect.min) / rect.size();
        let hit = surface.hit(&drawn.quads, [place.x, place.y], state.fold.see_through);
        if let Some(action) = hit.and_then(|point| probe_at(state.mapping, point)) {
            model.push(action);
            model.push(Action::FollowPointer(false));
        }
    }
    paint_legend(&painter, model, state.mapping, rect);
    turn(ui, model, &response);
}

/// The surface with its lines, as it is drawn until it is folded, turned or shown elsewhere.
struct Drawn {
    quads: Vec<Quad>,
    shapes: Vec<Shape>,
    /// Where the great circles have their letters.
    letters: Vec<(usize, [f32; 2])>,
}

impl Drawn {
    fn new(
        surface: &Surface,
        sheet: &Sheet,
        fold: FoldState,
        ground: Option<Ground>,
        on_screen: impl Fn([f32; 2]) -> Pos2,
    ) -> Self {
        let quads = surface.quads_between(&sheet.corners);
        let lines = project(surface, &sheet.lines);
        let mut shapes = Vec::new();
        // The insides that are seen lie behind all outsides: on a closed surface, and on one that opens towards the eye.
        for is_outside in [false, true] {
            let lets_through = is_outside && fold.see_through;
            if let Some(ground) = ground {
                let tint = if lets_through {
                    Color32::from_white_alpha(70)
                } else {
                    Color32::WHITE
                };
                let own = quads.iter().filter(|quad| quad.is_outside == is_outside);
                shapes.push(mesh(surface.map(), ground, own, tint, &on_screen));
            }
            let strength = if lets_through { 0.45 } else { 1.0 };
            for line in lines.iter().filter(|line| line.is_outside == is_outside) {
                let points: Vec<Pos2> = line.at.iter().copied().map(&on_screen).collect();
                let (width, color) = pen(line.kind);
                shapes.extend(edged(points, width, color.gamma_multiply(strength)));
            }
        }
        Self {
            quads,
            shapes,
            letters: letters(&lines),
        }
    }
}

/// Drags turn, the wheel zooms, a double click goes back.
fn turn(ui: &Ui, model: &mut Model<'_>, response: &egui::Response) {
    let mut fold = model.state.fold;
    let drag = response.drag_delta();
    if drag != egui::Vec2::ZERO {
        let drag = drag * ORBIT_RAD_PER_POINT;
        fold.camera.orbit(drag.x, drag.y);
    }
    if let Some(factor) = wheel_zoom(ui, response, ZOOM_PER_POINT) {
        fold.camera.zoom(factor);
    }
    if response.double_clicked() {
        fold.camera = FoldState::default().camera;
    }
    if fold.camera != model.state.fold.camera {
        // Not beside what the slider has just said: the next frame takes its turn.
        model.push(Action::SetFoldCamera(fold.camera));
    }
}

/// What the surface shows.
#[derive(Clone, Copy, PartialEq)]
enum Ground {
    /// The map's picture: its light, or a heat map.
    Picture(egui::TextureId),
    /// The colours of the faces.
    Faces,
}

/// The faces where they are tinted and the map's charts are those of a cube, else the picture, once it is made.
fn ground_of(model: &mut Model<'_>) -> Option<Ground> {
    let mapping = model.state.mapping;
    let has_faces = mapping.info().borders == Borders::CubeEdges;
    if model.state.overlays.face_tint && has_faces {
        return Some(Ground::Faces);
    }
    picture_of(model, mapping).map(Ground::Picture)
}

/// The heat map that is switched on, or the light.
fn picture_of(model: &mut Model<'_>, mapping: MappingId) -> Option<egui::TextureId> {
    let Some(quantity) = model.state.overlays.heat else {
        model.folds = true;
        return model.labs.fold.light_of(mapping);
    };
    /// Height of the picture in pixels: the surface is seldom larger on the screen.
    const ROWS: f64 = 512.0;
    let info = mapping.info();
    let aspect = info.layout.picture_aspect(info.aspect);
    let wanted = HeatWanted {
        mapping,
        quantity,
        size: [(ROWS * aspect) as usize, ROWS as usize],
        seen: Seen::Surface,
    };
    model.heat_wanted.push(wanted);
    model.labs.heat.picture(mapping, Seen::Surface, quantity)
}

/// Half a texel of the light's picture, which has about 192 along a chart.
const INSIDE: f64 = 0.5 / 192.0;

fn mesh<'a>(
    mapping: MappingId,
    ground: Ground,
    quads: impl Iterator<Item = &'a Quad>,
    tint: Color32,
    on_screen: impl Fn([f32; 2]) -> Pos2,
) -> egui::Shape {
    let layout = mapping.info().layout;
    let mut mesh = match ground {
        Ground::Picture(picture) => Mesh::with_texture(picture),
        Ground::Faces => Mesh::default(),
    };
    for quad in quads {
        let first = mesh.vertices.len() as u32;
        for (corner, at) in quad.corners.into_iter().zip(quad.at) {
            let (uv, color) = match ground {
                Ground::Picture(_) => {
                    // Half a texel from its border, beyond which another chart or nothing lies.
                    let inside = |c: f64| c.clamp(INSIDE, 1.0 - INSIDE);
                    let corner = ChartPoint::new(corner.chart, inside(corner.u), inside(corner.v));
                    let [x, y] = layout.picture_from_chart(corner).unwrap_or_default();
                    (pos2(x as f32, y as f32), tint)
                }
                Ground::Faces => {
                    let face = FACE_COLORS.get(corner.chart as usize).copied();
                    let [r, g, b] = face.unwrap_or_default();
                    (egui::epaint::WHITE_UV, tint * Color32::from_rgb(r, g, b))
                }
            };
            let pos = on_screen(at);
            mesh.vertices.push(Vertex { pos, uv, color });
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    egui::Shape::mesh(mesh)
}

fn pen(kind: Kind) -> (f32, Color32) {
    match kind {
        Kind::Border => (1.5, Color32::from_gray(235)),
        Kind::Grid => (0.8, Color32::from_gray(200)),
        Kind::GreatCircle(index) => {
            let [r, g, b] = GREAT_CIRCLE_COLORS[index];
            (2.0, Color32::from_rgb(r, g, b))
        }
        Kind::Ellipse | Kind::Cross(_) => (1.2, theme::TEXEL),
    }
}

/// The name of each chart in its middle, where that is seen; darker where it is seen from outside.
fn paint_names(
    painter: &egui::Painter,
    surface: &Surface,
    is_hidden: impl Fn(ChartPoint<f64>, [f32; 2]) -> bool,
    on_screen: impl Fn([f32; 2]) -> Pos2,
) {
    let charts = surface.map().info().charts;
    if charts.len() < 2 {
        return;
    }
    for (chart, name) in charts.iter().enumerate() {
        let middle = ChartPoint::new(chart as u32, 0.5, 0.5);
        let seen = surface.seen(middle).map(|(at, _)| at);
        if let Some(at) = seen.filter(|at| !is_hidden(middle, *at)) {
            let is_outside = surface.is_outside(middle);
            let color = Color32::from_gray(if is_outside { 150 } else { 235 });
            edged_text(painter, on_screen(at), Align2::CENTER_CENTER, name, color);
        }
    }
}
