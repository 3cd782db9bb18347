//! What is wanted of a conversion.

use serde::{Deserialize, Serialize};

use super::ResampleError;
use crate::imaging::{Channels, MapShape, SampleKind, Siting, Transfer};
use crate::mapping::{Axes, Frame, Layout, MappingId};
use crate::math::Isa;

/// How a value between texels is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")] // as [`Filter::id`]
pub enum Filter {
    /// The texel that contains the place.
    Nearest,
    /// Between the four texels around it.
    Bilinear,
    /// Catmull and Rom's cubic over 4 x 4 texels.
    Bicubic,
    /// Lanczos's windowed sinc with three lobes over 6 x 6 texels, adjusted so that it keeps quartics as they are.
    Lanczos,
    /// The mean over the texel's footprint, weighted by solid angle: neither aliases nor blurs more than it must.
    Area,
}

impl Filter {
    /// Every filter, from the fastest.
    pub const ALL: [Self; 5] = [
        Self::Nearest,
        Self::Bilinear,
        Self::Bicubic,
        Self::Lanczos,
        Self::Area,
    ];

    /// The name on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Bilinear => "bilinear",
            Self::Bicubic => "bicubic",
            Self::Lanczos => "lanczos",
            Self::Area => "area",
        }
    }

    /// The filter of that name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|filter| filter.id() == id)
    }
}

/// What is mixed when texels are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FilteredIn {
    /// The light: codes are decoded first and encoded last.
    #[default]
    Light,
    /// The stored codes, as most converters do. Darkens what is mixed.
    Codes,
}

/// One conversion, but for the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Conversion {
    /// The mapping that comes out.
    pub mapping: MappingId,
    /// Texels of each chart, [width, height].
    pub size: [u32; 2],
    /// How the charts are unfolded.
    pub layout: Layout,
    /// Bit c is set when chart c is wanted; the others are left out, or black in a common picture. With a frame: the picture
    /// with that chart's label.
    pub charts: u32,
    /// Rows of the rotation: the light that comes from `d` in the result came from `rotation * d` in the source's world.
    pub rotation: [[f64; 3]; 3],
    /// Axes of the result's own directions in the world.
    pub world_from_map: Axes,
    /// The program whose maps the result shall be like; takes the place of `world_from_map`.
    pub frame: Option<&'static Frame>,
    /// Where the result's samples sit.
    pub siting: Siting,
    /// How values between texels are found; `None`: [`Filter::Area`] when it minifies, else [`Filter::Bicubic`].
    pub filter: Option<Filter>,
    /// Places in each texel, along each side, at which the filter is asked; 1 is the texel's own place alone.
    pub supersample: u32,
    /// What is mixed.
    pub filtered_in: FilteredIn,
    /// Stops by which the light is changed; 0 leaves every bit.
    pub exposure_ev: f64,
    /// The number type of the result.
    pub samples: SampleKind,
    /// How its numbers become light.
    pub transfer: Transfer,
    /// With opacity or without.
    pub channels: Channels,
    /// Noise of one step before rounding, which hides steps in smooth skies.
    pub dither: bool,
    /// Threads; 0: as many as there are cores.
    pub threads: usize,
    /// Instructions to use; `None`: the best that the processor has.
    pub isa: Option<Isa>,
}

impl Conversion {
    /// No rotation.
    pub const UNTURNED: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The plain conversion: all charts, the mapping's own layout, nothing turned, the source's kind of samples.
    pub fn new(mapping: MappingId, size: [u32; 2], source: &MapShape) -> Self {
        Self {
            mapping,
            size,
            layout: mapping.info().layout,
            charts: u32::MAX,
            rotation: Self::UNTURNED,
            world_from_map: Axes::IDENTITY,
            frame: None,
            siting: Siting::Centre,
            filter: None,
            supersample: 1,
            filtered_in: FilteredIn::Light,
            exposure_ev: 0.0,
            samples: source.samples,
            transfer: source.transfer,
            channels: source.channels,
            dither: false,
            threads: 0,
            isa: None,
        }
    }

    /// The shape that comes out.
    ///
    /// # Errors
    /// When the mapping has no such layout, or a number makes no sense.
    pub fn target_shape(&self, _source: &MapShape) -> Result<MapShape, ResampleError> {
        let mut charts = MapShape::placements(self.mapping, self.layout, self.size).ok_or(
            ResampleError::NoSuchLayout {
                mapping: self.mapping,
                layout: self.layout.id(),
            },
        )?;
        let mut pictures = 0;
        for (chart, placement) in charts.iter_mut().enumerate() {
            if self.charts & (1 << chart.min(31)) == 0 {
                *placement = None;
            } else if let (Layout::Faces, Some(placement)) = (self.layout, placement) {
                // A picture for each chart that is wanted, none for the others.
                placement.raster = pictures;
                pictures += 1;
            }
        }
        let mut shape = MapShape {
            mapping: self.mapping,
            size: self.size,
            charts,
            world_from_map: self.world_from_map,
            siting: self.siting,
            channels: self.channels,
            samples: self.samples,
            transfer: self.transfer,
        };
        if let Some(frame) = self.frame {
            shape.apply_frame(frame, self.layout)?;
            shape.siting = self.siting;
        }
        Ok(shape)
    }
}
