//! From the state to what the renderer is asked for.

use super::map_panel::window_of;
use super::object::ObjectFrames;
use super::panel_view::rect_of_size;
use super::state::{AppState, FormState};
use super::theme::PICTURE_BACKGROUND;
use super::views::ViewKey;
use crate::gpu::{Frame, Overlays, PanelFrame, ViewportFrame, map_size};

/// The frame that shows `state`, in this form of the shaders, in the views that were laid out, with their sizes in pixels. A view that was not laid out
/// is not asked for, so that the renderer drops what only it needs.
pub fn frame_of(
    state: &AppState,
    form: FormState,
    object: ObjectFrames,
    laid_out: &[(ViewKey, [u32; 2])],
    complete: bool,
) -> Frame {
    let overlays = Overlays {
        great_circles: state.overlays.great_circles,
        face_tint: state.overlays.face_tint,
        grid: state.overlays.grid,
    };
    let mut frame = Frame {
        texel_budget: state.texel_budget,
        rotation: state.rotation,
        exposure_ev: state.exposure_ev,
        tone: state.tone,
        viewport: None,
        panels: Vec::new(),
        complete,
        compile_aside: !complete,
    };
    for &(key, size_px) in laid_out {
        match key {
            ViewKey::Viewport => {
                frame.viewport = Some(ViewportFrame {
                    size_px,
                    camera: state.camera,
                    body: object.body.clone(),
                    object: object.left.clone(),
                    right_object: object.right.clone(),
                    left: state.mapping,
                    right: state.compare,
                    divider: state.divider,
                    overlays,
                    probe: state.probe,
                    show_probe: state.overlays.probe,
                    form: form.form,
                    form_difference: form.difference.then(|| {
                        let rows = map_size(state.mapping, state.texel_budget)[1];
                        form.factor(state.mapping, rows) as f32
                    }),
                });
            }
            ViewKey::Panel(mapping) => {
                let rect = rect_of_size(size_px[0] as f32, size_px[1] as f32);
                frame.panels.push(PanelFrame {
                    mapping,
                    size_px,
                    window: window_of(&state.panel(mapping), rect).window(),
                    overlays,
                    background: PICTURE_BACKGROUND,
                });
            }
        }
    }
    frame
}
