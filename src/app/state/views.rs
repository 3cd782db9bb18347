//! What is drawn over the pictures, how the panels are seen, what the inspector shows.

use serde::{Deserialize, Serialize};

use crate::lab::metrics::Quantity;
use crate::lab::metrics::tissot::SPACING_DEG;
use crate::mapping::MappingId;

/// Smallest and largest magnification of a panel: at the largest, a texel of the finest map fills the panel.
pub const ZOOM_RANGE: (f32, f32) = (0.5, 4096.0);

/// What is drawn over the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Overlays {
    /// The six great circles A to F.
    pub great_circles: bool,
    /// A tint for each face of the continuous cube map.
    pub face_tint: bool,
    /// Lines of equal u and v.
    pub grid: bool,
    /// Incident, normal and reflected vector.
    pub vectors: bool,
    /// The axes of the world.
    pub axes: bool,
    /// The probe's mark, the outline of its face and its texel.
    pub probe: bool,
    /// Names of charts and of compared mappings.
    pub names: bool,
    /// Rings over the viewport that turn the environment.
    pub rings: bool,
    /// A map's distortion in place of its light.
    pub heat: Option<Quantity>,
    /// What the mapping makes of equal circles of the sphere.
    pub ellipses: bool,
    /// How far those circles are from each other in degrees, in [`SPACING_DEG`].
    pub ellipses_deg: f32,
}

impl Default for Overlays {
    fn default() -> Self {
        Self {
            great_circles: false,
            face_tint: false,
            grid: false,
            vectors: true,
            axes: true,
            probe: true,
            names: true,
            rings: false,
            heat: None,
            ellipses: false,
            ellipses_deg: 20.0,
        }
    }
}

impl Overlays {
    /// Nothing over the pictures.
    pub const NONE: Self = Self {
        great_circles: false,
        face_tint: false,
        grid: false,
        vectors: false,
        axes: false,
        probe: false,
        names: false,
        rings: false,
        heat: None,
        ellipses: false,
        ellipses_deg: 20.0,
    };

    /// With every number in its range.
    pub fn sanitized(self) -> Self {
        let (least, most) = SPACING_DEG;
        let spacing = if self.ellipses_deg.is_finite() {
            self.ellipses_deg.clamp(least, most)
        } else {
            Self::NONE.ellipses_deg
        };
        Self {
            ellipses_deg: spacing,
            ..self
        }
    }
}

/// The panel of one mapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PanelState {
    /// The mapping it unfolds.
    pub mapping: MappingId,
    /// Shown at all.
    pub open: bool,
    /// Magnification; 1 fits the whole picture into the panel.
    pub zoom: f32,
    /// Picture coordinates of the panel's middle.
    pub center: [f32; 2],
}

impl PanelState {
    /// A panel that shows the whole picture.
    pub fn new(mapping: MappingId, open: bool) -> Self {
        Self {
            mapping,
            open,
            zoom: 1.0,
            center: [0.5, 0.5],
        }
    }
}

/// What the inspector shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct InspectorState {
    /// Shown at all.
    pub open: bool,
    /// In front of the controls where a narrow window has room for one of both.
    pub in_front: bool,
    /// The mapping whose steps are shown.
    pub mapping: MappingId,
    /// Numbers of which type.
    pub precision: Precision,
    /// The seed's own numbers beside the app's.
    pub conventions: bool,
    /// The equation as printed beside the right one.
    pub errata: bool,
}

impl Default for InspectorState {
    fn default() -> Self {
        Self {
            open: true,
            in_front: false,
            mapping: MappingId::Ccm,
            precision: Precision::F32,
            conventions: false,
            errata: false,
        }
    }
}

/// The number type of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// Single precision, as on the GPU.
    F32,
    /// Double precision, the reference.
    F64,
    /// Both beside one another.
    Both,
}
