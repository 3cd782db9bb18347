//! What one frame shows: plain data that the front end fills and the renderer compares with what it has drawn.

use glam::Vec3;

use super::overlay::Overlays;
use super::program::{Paths, Program};
use super::shared::Shared;
use super::tone::ToneCurve;
use crate::imaging::ball::BallPixels;
use crate::mapping::{MappingId, ShaderForm};
use crate::math::Rotation;
use crate::optics::Material;
use crate::scene::trace::Traced;
use crate::scene::{Camera, Target};

/// Exposures are clamped to this many stops up and down: the span of a half float.
pub const MAX_EXPOSURE_EV: f32 = 24.0;

/// Everything that is to be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Texels of each map, all charts together; see [`map_size`](super::map::map_size).
    pub texel_budget: u32,
    /// How the environment is turned.
    pub rotation: Rotation,
    /// Stops by which light is made brighter.
    pub exposure_ev: f32,
    /// How bright light is brought into the screen's range.
    pub tone: ToneCurve,
    /// The viewport; `None` while it is hidden.
    pub viewport: Option<ViewportFrame>,
    /// The panels that are seen, at most one for each mapping: of two the first counts.
    pub panels: Vec<PanelFrame>,
    /// Bake every map now, for exports and tests, instead of one map in each call.
    pub complete: bool,
    /// Compile missing shaders on other threads and leave what needs them pending, instead of waiting for them (not on GL).
    pub compile_aside: bool,
}

impl Default for Frame {
    /// Shows nothing.
    fn default() -> Self {
        Self {
            texel_budget: 6 * 256 * 256,
            rotation: Rotation::NONE,
            exposure_ev: 0.0,
            tone: ToneCurve::default(),
            viewport: None,
            panels: Vec::new(),
            complete: false,
            compile_aside: false,
        }
    }
}

/// What the object is made of, and what must be there to show it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjectFrame {
    /// Of what.
    pub material: Material,
    /// The picture of a sphere-map style; black while there is none.
    pub ball: Option<Shared<BallPixels>>,
    /// The paths through both surfaces in this very view; while they are missing one surface is shown.
    pub traced: Option<Shared<Traced>>,
}

/// A body that can be drawn and hit.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its mesh, prepared for rays.
    pub target: Shared<Target>,
    /// It stands for the unit ball: paths through it are known in closed form.
    pub is_ball: bool,
}

/// The object before its environment.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewportFrame {
    /// Width and height in pixels; nothing is drawn while one is 0.
    pub size_px: [u32; 2],
    /// From where it is seen.
    pub camera: Camera,
    /// What mirrors the environment.
    pub body: Body,
    /// Of what it is made.
    pub object: ObjectFrame,
    /// Of what it is made right of the divider, if of something else.
    pub right_object: Option<ObjectFrame>,
    /// The mapping that is looked up, or the one on the left.
    pub left: MappingId,
    /// The mapping on the right of the divider.
    pub right: Option<MappingId>,
    /// Where the divider stands, from 0 at the left border to 1 at the right one.
    pub divider: f32,
    /// What is painted over the environment.
    pub overlays: Overlays,
    /// The direction under study, a unit vector.
    pub probe: [f32; 3],
    /// Whether the probe is marked.
    pub show_probe: bool,
    /// The form in which the mappings' shaders are run; the precise one where a mapping does not have it.
    pub form: ShaderForm,
    /// Show how far the form is from the precise one, in texels times this, on a mirror and in the sky.
    pub form_difference: Option<f32>,
}

impl ViewportFrame {
    /// The same picture in the one form in which it is drawn: what has no effect is set to a fixed value, what is not
    /// finite to a harmless one.
    pub(super) fn normalized(self) -> Self {
        let probe = Vec3::from(self.probe).try_normalize();
        let right = self.right.filter(|id| *id != self.left);
        let divider = if self.divider.is_finite() {
            self.divider.clamp(0.0, 1.0)
        } else {
            0.5
        };
        let clean = |object: ObjectFrame| ObjectFrame {
            material: object.material.sanitized(),
            ..object
        };
        let right_object = self.right_object.clone().map(clean);
        let is_divided = right.is_some() || right_object.is_some();
        Self {
            camera: self.camera.sanitized(),
            object: clean(self.object.clone()),
            right_object,
            right,
            divider: if is_divided { divider } else { 1.0 },
            probe: probe
                .filter(|_| self.show_probe)
                .map_or([0.0; 3], |p| p.to_array()),
            show_probe: self.show_probe && probe.is_some(),
            form_difference: self.form_difference.filter(|factor| factor.is_finite()),
            ..self
        }
    }

    /// What is seen left of the divider, then right of it: mapping, object, and the program that shows it.
    pub(super) fn sides(&self) -> Vec<Side<'_>> {
        let side = |mapping: MappingId, object| Side {
            mapping,
            object,
            program: self.program(object),
            form: mapping.form_or_precise(self.form),
        };
        let left = side(self.left, &self.object);
        let right = self.is_divided().then(|| {
            let object = self.right_object.as_ref().unwrap_or(&self.object);
            side(self.right.unwrap_or(self.left), object)
        });
        std::iter::once(left).chain(right).collect()
    }

    /// True when there is a divider.
    fn is_divided(&self) -> bool {
        self.right.is_some() || self.right_object.is_some()
    }

    fn program(&self, object: &ObjectFrame) -> Program {
        if self.form_difference.is_some() {
            return Program::Mirror { printed: false };
        }
        let is_traced = object
            .traced
            .as_ref()
            .is_some_and(|traced| traced.size == self.size_px);
        let paths = match (self.body.is_ball, is_traced) {
            (true, _) => Paths::Ball,
            (false, true) => Paths::Traced,
            (false, false) => Paths::None,
        };
        Program::new(&object.material, paths)
    }

    /// The mappings that are looked up, left first.
    pub(super) fn mappings(&self) -> impl Iterator<Item = MappingId> {
        [Some(self.left), self.right].into_iter().flatten()
    }

    /// The pixel column at which the right mapping begins.
    pub(super) fn divider_px(&self) -> u32 {
        let width = self.size_px[0];
        if !self.is_divided() {
            return width;
        }
        ((self.divider * width as f32).round() as u32).min(width)
    }
}

/// One side of the divider.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    pub mapping: MappingId,
    pub object: &'a ObjectFrame,
    pub program: Program,
    pub form: ShaderForm,
}

/// One mapping's charts, unfolded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelFrame {
    /// Whose charts.
    pub mapping: MappingId,
    /// Width and height in pixels; nothing is drawn while one is 0.
    pub size_px: [u32; 2],
    /// The part of the unfolded picture that is shown: left, top, right and bottom in the picture's coordinates
    /// ([`Layout`](crate::mapping::Layout)); beyond 0 and 1 there is background.
    pub window: [f32; 4],
    /// What is painted over the charts.
    pub overlays: Overlays,
    /// Colour beside the charts, sRGB.
    pub background: [u8; 3],
}

impl PanelFrame {
    /// See [`ViewportFrame::normalized`].
    pub(super) fn normalized(self) -> Self {
        let [left, top, right, bottom] = self.window;
        let shows = self.window.iter().all(|x| x.is_finite()) && left != right && top != bottom;
        Self {
            window: if shows {
                self.window
            } else {
                [0.0, 0.0, 1.0, 1.0]
            },
            ..self
        }
    }
}

/// How light becomes colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// Factor on light.
    pub exposure: f32,
    pub tone: ToneCurve,
}

impl Frame {
    /// The same frame in the one form in which it is drawn; what has no pixels is left out.
    pub(super) fn normalized(&self) -> Self {
        let visible = |size: [u32; 2]| size[0] > 0 && size[1] > 0;
        let mut panels: Vec<PanelFrame> = Vec::with_capacity(self.panels.len());
        for panel in self.panels.iter().filter(|p| visible(p.size_px)) {
            if panels.iter().all(|p| p.mapping != panel.mapping) {
                panels.push(panel.normalized());
            }
        }
        let viewport = self.viewport.clone().filter(|v| visible(v.size_px));
        Self {
            rotation: self.rotation.sanitized(),
            viewport: viewport.map(ViewportFrame::normalized),
            panels,
            ..self.clone()
        }
    }

    /// How light becomes colour.
    pub(super) fn look(&self) -> Look {
        let ev = if self.exposure_ev.is_finite() {
            self.exposure_ev
        } else {
            0.0
        };
        Look {
            exposure: ev.clamp(-MAX_EXPOSURE_EV, MAX_EXPOSURE_EV).exp2(),
            tone: self.tone,
        }
    }

    /// Whether a mapping is looked up as a cube.
    pub(super) fn looks_up_cube(&self, id: MappingId) -> bool {
        let is_cube = |viewport: &ViewportFrame| {
            viewport.mappings().any(|shown| shown == id)
                && id.form_or_precise(viewport.form) == ShaderForm::CubeUnit
        };
        self.viewport.as_ref().is_some_and(is_cube)
    }

    /// The mappings that need a map: the viewport's, then the panels', each once.
    pub(super) fn mappings(&self) -> Vec<MappingId> {
        let mut shown: Vec<MappingId> = Vec::new();
        let viewport = self.viewport.iter().flat_map(ViewportFrame::mappings);
        for id in viewport.chain(self.panels.iter().map(|p| p.mapping)) {
            if !shown.contains(&id) {
                shown.push(id);
            }
        }
        shown
    }
}
