//! An environment map as it lies in memory: which mapping, and where each chart lies in which picture.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Channels, Image, Raster, SampleKind, Samples, Transfer};
use crate::mapping::{Arrangement, Axes, Frame, FrameError, Layout, MappingId, Turn};

/// Where the samples of a chart of n texels sit, along each side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Siting {
    /// Texel i at (i + 1/2)/n: in the middle of its square. The rule here and nearly everywhere.
    #[default]
    Centre,
    /// Texel i at i/(n - 1): the outermost samples lie on the chart's border (OpenEXR's environment maps).
    Edge,
}

impl Siting {
    /// The chart coordinate in [0, 1] of a place along a side of `count` texels: k is the middle of texel k.
    pub fn coordinate(self, place: f64, count: u32) -> f64 {
        match self {
            Self::Centre => (place + 0.5) / f64::from(count),
            // A single sample has no two ends: it sits in the middle.
            Self::Edge if count == 1 => 0.5 + place,
            Self::Edge => place / (f64::from(count) - 1.0),
        }
    }
}

/// Where a chart lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// Index of the picture.
    pub raster: usize,
    /// Left upper pixel of the chart's cell there.
    pub origin: [u32; 2],
    /// How the chart is turned in its cell.
    pub turn: Turn,
}

/// Everything about an environment map but its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct MapShape {
    /// The mapping.
    pub mapping: MappingId,
    /// Texels of a chart, [width, height].
    pub size: [u32; 2],
    /// Where each chart lies; `None` for a chart that is not there.
    pub charts: Vec<Option<Placement>>,
    /// Axes of the map's own directions in the world.
    pub world_from_map: Axes,
    /// Where the samples sit.
    pub siting: Siting,
    /// What stands in a pixel.
    pub channels: Channels,
    /// The number type of the samples.
    pub samples: SampleKind,
    /// How they become light.
    pub transfer: Transfer,
}

impl MapShape {
    /// Size of each picture that the layout needs, [width, height].
    pub fn raster_sizes(mapping: MappingId, layout: Layout, size: [u32; 2]) -> Vec<[u32; 2]> {
        let charts = mapping.info().chart_count();
        match layout {
            Layout::Faces => vec![size; charts as usize],
            _ => {
                let [columns, rows] = layout.grid();
                vec![[columns * size[0], rows * size[1]]]
            }
        }
    }

    /// Where the layout puts each chart of `size` texels; `None` for a layout that this number of charts does not have.
    pub fn placements(
        mapping: MappingId,
        layout: Layout,
        size: [u32; 2],
    ) -> Option<Vec<Option<Placement>>> {
        let charts = mapping.info().chart_count();
        (0..charts)
            .map(|chart| {
                let cell = layout.cell(chart).filter(|_| layout.holds(charts))?;
                Some(Some(match layout {
                    Layout::Faces => Placement {
                        raster: chart as usize,
                        origin: [0, 0],
                        turn: cell.turn,
                    },
                    _ => Placement {
                        raster: 0,
                        origin: [cell.at[0] * size[0], cell.at[1] * size[1]],
                        turn: cell.turn,
                    },
                }))
            })
            .collect()
    }

    /// Takes each picture, until now the chart of its label, for what the arrangement says that it is. For six charts; a map
    /// of fewer stays as it is.
    pub fn arrange(&mut self, arrangement: &Arrangement) {
        let Ok(labelled) = <[Option<Placement>; 6]>::try_from(self.charts.as_slice()) else {
            return;
        };
        for (held, placement) in arrangement.held().iter().zip(labelled) {
            self.charts[held.chart as usize] = placement.map(|placement| Placement {
                turn: held.turn.then(placement.turn),
                ..placement
            });
        }
    }

    /// Takes what the map shows to be a mirror image: left and right are exchanged all around.
    pub fn mirror(&mut self) {
        self.world_from_map = self.world_from_map.then(Axes::MIRROR);
    }

    /// Takes the pictures in a row, a column or two rows to be in a program's order. Where the cells stand for the labels, as
    /// in a cross or six files, the order says nothing.
    pub fn apply_order(&mut self, frame: &Frame, layout: Layout) {
        if let Some(order) = frame.order(layout)
            && self.charts.len() == 6
        {
            let in_order = self.charts.clone();
            for (label, placement) in order.into_iter().zip(in_order) {
                self.charts[label] = placement;
            }
        }
    }

    /// Takes a map that was laid out plainly for one that a program has laid out in its own way.
    ///
    /// # Errors
    /// When nothing is known of that program's maps of this mapping.
    pub fn apply_frame(&mut self, frame: &Frame, layout: Layout) -> Result<(), FrameError> {
        let unknown = || frame.unknown(self.mapping);
        if !frame.knows(self.mapping) {
            return Err(unknown());
        }
        if let Some(arrangement) = frame.arrangement()
            && self.charts.len() == 6
        {
            self.apply_order(frame, layout);
            self.arrange(&arrangement);
        } else {
            self.world_from_map = frame.world_from_map(self.mapping).ok_or_else(unknown)?;
        }
        if frame.is_edge_sited {
            self.siting = Siting::Edge;
        }
        Ok(())
    }
}

/// An environment map with its pixels. Charts are looked at where they lie: nothing is cut out or turned beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    shape: MapShape,
    rasters: Arc<Vec<Raster>>,
}

/// Pictures that do not fit the shape that is said of them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the pictures do not fit the map: {0}")]
pub struct ShapeError(pub String);

impl EnvironmentMap {
    /// A map from its pictures.
    ///
    /// # Errors
    /// When a chart lies outside of its picture, a picture is of another kind than the shape says, or no chart is there.
    pub fn new(shape: MapShape, rasters: Vec<Raster>) -> Result<Self, ShapeError> {
        Self::shared(shape, Arc::new(rasters))
    }

    /// A map from pictures that others look at too: the same ones taken in several ways are not copied.
    ///
    /// # Errors
    /// As [`EnvironmentMap::new`].
    pub fn shared(shape: MapShape, rasters: Arc<Vec<Raster>>) -> Result<Self, ShapeError> {
        let refuse = |why: String| Err(ShapeError(why));
        let charts = shape.mapping.info().chart_count() as usize;
        if shape.charts.len() != charts {
            return refuse(format!("{} charts instead of {charts}", shape.charts.len()));
        }
        if shape.size.contains(&0) || shape.charts.iter().all(Option::is_none) {
            return refuse("it has no texels".to_owned());
        }
        for raster in rasters.iter() {
            let is_same = raster.channels() == shape.channels
                && raster.samples().kind() == shape.samples
                && raster.transfer() == shape.transfer;
            if !is_same {
                return refuse("they differ in channels, bits or transfer".to_owned());
            }
        }
        for placement in shape.charts.iter().flatten() {
            let Some(raster) = rasters.get(placement.raster) else {
                return refuse(format!("there is no picture {}", placement.raster));
            };
            let size = placement.turn.turned(shape.size);
            let fits = (0..2).all(|k| {
                u64::from(placement.origin[k]) + u64::from(size[k]) <= u64::from(raster.size()[k])
            });
            if !fits {
                let [width, height] = raster.size();
                return refuse(format!("a chart reaches beyond {width} x {height}"));
            }
        }
        Ok(Self { shape, rasters })
    }

    /// The map of a latlong picture.
    ///
    /// # Errors
    /// As [`EnvironmentMap::new`].
    pub fn of_latlong(image: &Image) -> Result<Self, ShapeError> {
        Self::from_latlong(image.clone())
    }

    /// As [`EnvironmentMap::of_latlong`], without a copy.
    ///
    /// # Errors
    /// As [`EnvironmentMap::new`].
    pub fn from_latlong(image: Image) -> Result<Self, ShapeError> {
        let size = [image.width(), image.height()];
        let samples = Samples::F32(image.into_pixels().into_flattened());
        let raster = Raster::new(size, Channels::Rgb, Transfer::Linear, samples);
        Self::from_layout(
            MappingId::Latlong,
            Layout::Single,
            raster.into_iter().collect(),
        )
    }

    /// A map whose charts lie in `layout`, upright as the mapping draws them.
    ///
    /// # Errors
    /// As [`EnvironmentMap::new`], and when the mapping has no such layout or the pictures have not its shape.
    pub fn from_layout(
        mapping: MappingId,
        layout: Layout,
        rasters: Vec<Raster>,
    ) -> Result<Self, ShapeError> {
        let refuse = |why: &str| ShapeError(why.to_owned());
        let first = rasters.first().ok_or_else(|| refuse("there is none"))?;
        let [columns, rows] = match layout {
            Layout::Faces => [1, 1],
            _ => layout.grid(),
        };
        if first.width() % columns != 0 || first.height() % rows != 0 {
            return Err(refuse("the layout's cells are no whole texels"));
        }
        let size = [first.width() / columns, first.height() / rows];
        let charts = MapShape::placements(mapping, layout, size)
            .ok_or_else(|| refuse("the mapping has no such layout"))?;
        let shape = MapShape {
            mapping,
            size,
            charts,
            world_from_map: Axes::IDENTITY,
            siting: Siting::Centre,
            channels: first.channels(),
            samples: first.samples().kind(),
            transfer: first.transfer(),
        };
        Self::new(shape, rasters)
    }

    /// Everything but the pixels.
    pub const fn shape(&self) -> &MapShape {
        &self.shape
    }

    /// The pictures.
    pub fn rasters(&self) -> &[Raster] {
        &self.rasters
    }

    /// The pictures, to change in place; copied first where others look at them. What they are of cannot be changed through
    /// it without breaking the map.
    pub fn rasters_mut(&mut self) -> &mut [Raster] {
        Arc::make_mut(&mut self.rasters).as_mut_slice()
    }

    /// Shape and pictures; copied where others look at them.
    pub fn into_parts(self) -> (MapShape, Vec<Raster>) {
        (self.shape, Arc::unwrap_or_clone(self.rasters))
    }

    /// Colour in linear light and opacity of texel (column, row) of a chart; black and clear where there is none. For
    /// tests and readouts, one texel at a time.
    pub fn light(&self, chart: u32, texel: [u32; 2]) -> [f32; 4] {
        let placement = self.shape.charts.get(chart as usize).copied().flatten();
        let Some(placement) = placement else {
            return [0.0; 4];
        };
        let [x, y] = placement.turn.cell_from_chart(texel, self.shape.size);
        self.rasters[placement.raster].light(placement.origin[0] + x, placement.origin[1] + y)
    }

    /// Bytes of all pixels.
    pub fn bytes(&self) -> u64 {
        self.rasters.iter().map(Raster::bytes).sum()
    }
}
