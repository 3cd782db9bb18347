//! Direction to chart and back: one file a mapping, and the registry.
//!
//! # Frames
//!
//! The world frame is left-handed: +x right, +y up, +z forward (into the screen). It is the frame in which cube maps have
//! always been defined, so a face seen from inside is not mirrored. A direction points from the centre outwards and may
//! have any finite length but zero.
//!
//! A mapping sends a direction to a chart and to (u, v) in [0, 1]^2 there: u grows to the right, v *downwards*, and texel
//! (i, j) of a W x H chart has its centre at ((i + 0.5)/W, (j + 0.5)/H), row 0 at the top of the file.

#[macro_use]
mod registry;
mod arrangement;
mod axes;
mod chart;
mod chart_integral;
mod convention;
pub mod cube_face;
mod device;
pub mod evaluator;
mod face_map;
mod family;
mod frame;
mod jacobian;
mod lane_forms;
mod lanes;
mod layout;
mod seed_forms;
mod shader_form;
mod slices;
mod turn;
mod unfolding;

pub use arrangement::{Arrangement, ArrangementError, Held};
pub use axes::Axes;
pub use chart::{
    Borders, ChartPoint, Claims, Coverage, Domain, Mapping, MappingInfo, Step, WeakSpot,
};
pub use chart_integral::integrate;
pub use convention::{Convention, Erratum, ForwardFn, InverseFn};
pub use device::{Adapter, Device, DeviceTime, NoDevice, Shader, Work};
pub use evaluator::{Evaluator, EvaluatorError, EvaluatorInfo, Processor, Runs};
pub use family::Family;
pub use frame::{CubeFrame, Founded, Frame, FrameError, Pictures, UnknownFrame};
pub use jacobian::Jacobian;
pub use lanes::{AngleLanes, DirLanes, LANES, Lane, Line, PointLanes};
pub use layout::{Cell, Layout};
pub use shader_form::ShaderForm;
pub use slices::{DirList, Dirs, DirsMut, NOWHERE, PointList, Points, PointsMut};
pub use turn::Turn;
pub use unfolding::{Folded, Solid, Unfolding, Way};

use crate::math::{Real, Vec3};

// The only list of mappings in the project. Tests, panels, shaders, the command line and the tables all expand it.
registry! {
    Latlong in latlong,
    Sphere in sphere,
    Matcap in matcap,
    Paraboloid in paraboloid,
    Cube in cube,
    Ccm in ccm,
    Eac in eac,
    Tangent in tangent,
    S2Quadratic in s2_quadratic,
    Everitt in everitt,
    Algebraic in algebraic,
    Unicube in unicube,
    Nowell in nowell,
    Outerra in outerra,
    Cobe in cobe,
    Arvo in arvo,
    Qsc in qsc,
    Octahedral in octahedral,
    OctahedralEqualArea in octahedral_equal_area,
    Angular in angular,
    Fisheye in fisheye,
    Equisolid in equisolid,
    Stereographic in stereographic,
    CylindricalEqualArea in cylindrical_equal_area,
    Mercator in mercator,
    Healpix in healpix,
}

impl MappingId {
    /// The mapping with this id.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|m| m.info().id == id)
    }

    /// The chart point of a direction; `None` also where the mapping has no image of its own for it.
    pub fn own_point(self, dir: Vec3<f64>) -> Option<ChartPoint<f64>> {
        let is_own = self.info().coverage.contains(dir.to_f64());
        self.forward(dir).filter(|_| is_own)
    }
}

impl std::fmt::Display for MappingId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.info().id)
    }
}

impl std::str::FromStr for MappingId {
    type Err = UnknownMapping;

    fn from_str(id: &str) -> Result<Self, Self::Err> {
        Self::from_id(id).ok_or_else(|| UnknownMapping(id.to_owned()))
    }
}

/// No mapping has this id.
#[derive(Debug, thiserror::Error)]
#[error("no mapping is called `{0}`; `sixfold maps` lists them")]
pub struct UnknownMapping(String);
