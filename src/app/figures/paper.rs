//! The figures of Grimm and Niebruegge, *Continuous Cube Mapping*, as they come out of the mappings: each a view of the explorer, and lines.

use std::f32::consts::PI;

use crate::app::arrangement::{Arrangement, Pane, Share};
use crate::app::picture::What;
use crate::app::state::{AppState, FoldState, Overlays, PanelState, SamplingState};
use crate::imaging::Environment;
use crate::imaging::computed::icosahedron_vertices;
use crate::mapping::MappingId;
use crate::scene::Camera;

/// A figure of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// A latlong on the sphere, from above the pole.
    Pole,
    /// The same from above the equator.
    Equator,
    /// How evenly latlong and cube map part the horizon.
    Sampling,
    /// The sphere in six faces.
    Faces,
    /// The six great circles that part it.
    GreatCircles,
    /// Crosses on a latlong.
    LatlongCrosses,
    /// Crosses on a cube map.
    CubeCrosses,
    /// Crosses on a continuous cube map.
    ContinuousCrosses,
    /// One cross on both, enlarged.
    Cross,
}

impl Paper {
    /// Every figure, in the paper's order.
    pub const ALL: [Self; 9] = [
        Self::Pole,
        Self::Equator,
        Self::Sampling,
        Self::Faces,
        Self::GreatCircles,
        Self::LatlongCrosses,
        Self::CubeCrosses,
        Self::ContinuousCrosses,
        Self::Cross,
    ];

    /// The name on the command line.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Pole => "paper-2",
            Self::Equator => "paper-3",
            Self::Sampling => "paper-4",
            Self::Faces => "paper-7",
            Self::GreatCircles => "paper-8",
            Self::LatlongCrosses => "paper-11",
            Self::CubeCrosses => "paper-12",
            Self::ContinuousCrosses => "paper-13",
            Self::Cross => "paper-14",
        }
    }

    /// What the menu says.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Pole => "Paper, Figure 2: latlong, pole",
            Self::Equator => "Paper, Figure 3: latlong, equator",
            Self::Sampling => "Paper, Figure 4: sampling, latlong | cube",
            Self::Faces => "Paper, Figure 7: six faces of the sphere",
            Self::GreatCircles => "Paper, Figure 8: six great circles",
            Self::LatlongCrosses => "Paper, Figure 11: crosses, latlong",
            Self::CubeCrosses => "Paper, Figure 12: crosses, cube map",
            Self::ContinuousCrosses => "Paper, Figure 13: crosses, continuous cube map",
            Self::Cross => "Paper, Figure 14: a cross, cube | continuous",
        }
    }

    /// Which part of the window it is.
    #[must_use]
    pub const fn what(self) -> What {
        match self {
            Self::Pole | Self::Equator | Self::Faces | Self::GreatCircles => What::Fold,
            Self::Sampling => What::Sampling,
            Self::LatlongCrosses => What::Panel(MappingId::Latlong),
            Self::CubeCrosses => What::Panel(MappingId::Cube),
            Self::ContinuousCrosses => What::Panel(MappingId::Ccm),
            Self::Cross => What::Panels,
        }
    }

    /// Turns a state into the figure; object, material, light and the viewport's eye stay as they are.
    pub fn show(self, state: &mut AppState) {
        // The probe and its vectors are no part of a figure, and stay as they are.
        state.overlays = Overlays {
            great_circles: false,
            face_tint: false,
            grid: false,
            heat: None,
            ellipses: false,
            ..state.overlays
        };
        state.compare = None;
        match self {
            Self::Pole => sphere(state, MappingId::Latlong, [180.0, 89.0]),
            Self::Equator => sphere(state, MappingId::Latlong, [180.0, 0.0]),
            Self::Faces => sphere(state, MappingId::Ccm, [-30.0, 30.0]),
            Self::GreatCircles => sphere(state, MappingId::Ccm, [-36.0, 30.0]),
            Self::Sampling => {
                set_mapping(state, MappingId::Latlong);
                state.sampling = SamplingState {
                    open: true,
                    ..SamplingState::default()
                };
                state.maximised = Some(Pane::Sampling);
            }
            Self::LatlongCrosses => crosses(state, MappingId::Latlong),
            Self::CubeCrosses => crosses(state, MappingId::Cube),
            Self::ContinuousCrosses => crosses(state, MappingId::Ccm),
            Self::Cross => one_cross(state),
        }
        match self {
            // Seen from outside letters would be mirrored: surroundings without them.
            Self::Pole | Self::Equator => {
                state.environment = Environment::DirectionColor;
                state.overlays.grid = true;
            }
            Self::Faces => {
                state.overlays.grid = true;
                state.overlays.face_tint = true;
            }
            Self::GreatCircles => {
                state.environment = Environment::DirectionColor;
                state.overlays.great_circles = true;
            }
            _ => {}
        }
    }
}

fn set_mapping(state: &mut AppState, mapping: MappingId) {
    state.mapping = mapping;
    state.inspector.mapping = mapping;
}

/// The folded map alone, as a sphere seen from outside; yaw and pitch in degrees.
fn sphere(state: &mut AppState, mapping: MappingId, degrees: [f32; 2]) {
    set_mapping(state, mapping);
    let [yaw_rad, pitch_rad] = degrees.map(|angle| angle / 180.0 * PI);
    state.fold = FoldState {
        open: true,
        share: 1.0,
        camera: Camera {
            yaw_rad,
            pitch_rad,
            ..Camera::default()
        }
        .sanitized(),
        see_through: false,
        towards: None,
    };
    state.maximised = Some(Pane::Fold);
}

/// The panel of a mapping alone with the crosses on it.
fn crosses(state: &mut AppState, mapping: MappingId) {
    state.environment = Environment::IcosahedronCrosses;
    set_mapping(state, mapping);
    if let Some(panel) = state.panel_mut(mapping) {
        *panel = PanelState::new(mapping, true);
    }
    state.overlays.names = true;
    state.maximised = Some(Pane::Map(mapping));
}

/// One cross away from the middle of a face on both cube maps, equally enlarged.
fn one_cross(state: &mut AppState) {
    /// The picture is four faces wide, and a cross of 10 degrees a ninth of a face at most.
    const ZOOM: f32 = 22.0;
    const BOTH: [MappingId; 2] = [MappingId::Cube, MappingId::Ccm];
    state.environment = Environment::IcosahedronCrosses;
    set_mapping(state, MappingId::Ccm);
    // In front, above the middle: (0, 1, phi).
    let is_in_front = |dir: &crate::math::Vec3<f64>| dir.x == 0.0 && dir.y > 0.0 && dir.z > 0.0;
    let dir = icosahedron_vertices().into_iter().find(is_in_front);
    for panel in &mut state.panels {
        *panel = PanelState::new(panel.mapping, BOTH.contains(&panel.mapping));
        let layout = panel.mapping.info().layout;
        let point = dir.and_then(|dir| panel.mapping.forward(dir));
        if let Some([x, y]) = point.and_then(|point| layout.picture_from_chart(point)) {
            panel.center = [x, y].map(|c| c as f32);
            panel.zoom = ZOOM;
        }
    }
    // Only what is compared, with room.
    for pane in Pane::READ {
        if let Some(is_open) = state.open_mut(pane) {
            *is_open = false;
        }
    }
    let part = |share, content| Share { share, content };
    let both = BOTH.map(|mapping| part(1.0, Arrangement::Pane(Pane::Map(mapping))));
    state.arrangement = Some(Arrangement::Column(vec![
        part(0.5, Arrangement::Pane(Pane::Viewport)),
        part(1.0, Arrangement::Row(both.into())),
    ]));
    state.maximised = None;
}
