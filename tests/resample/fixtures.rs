//! Maps that are computed, and budgets.

use sixfold::imaging::resample::{Conversion, Filter, Plan, Report};
use sixfold::imaging::{
    Channels, EnvironmentMap, MapShape, Progress, Raster, SampleKind, Samples, Siting, Transfer,
};
use sixfold::mapping::{Axes, ChartPoint, Layout, MappingId};

/// A vector of doubles.
pub type Dir = [f64; 3];

/// Chart coordinate of texel `index` of `count`.
pub fn coordinate(siting: Siting, index: u32, count: u32) -> f64 {
    match siting {
        Siting::Centre => (f64::from(index) + 0.5) / f64::from(count),
        Siting::Edge => f64::from(index) / f64::from(count - 1),
    }
}

/// The direction in the world of a texel's middle; `None` off the disc.
pub fn direction(shape: &MapShape, chart: u32, [x, y]: [u32; 2]) -> Option<Dir> {
    let point = ChartPoint::new(
        chart,
        coordinate(shape.siting, x, shape.size[0]),
        coordinate(shape.siting, y, shape.size[1]),
    );
    let dir = shape.mapping.inverse(point)?;
    Some(shape.world_from_map.apply(dir).to_f64())
}

/// A shape of floats, three a pixel, in the mapping's own layout.
pub fn shape(mapping: MappingId, size: [u32; 2]) -> MapShape {
    let layout = mapping.info().layout;
    MapShape {
        mapping,
        size,
        charts: MapShape::placements(mapping, layout, size).unwrap(),
        world_from_map: Axes::IDENTITY,
        siting: Siting::Centre,
        channels: Channels::Rgb,
        samples: SampleKind::F32,
        transfer: Transfer::Linear,
    }
}

/// Every texel with a direction: chart, texel, direction.
pub fn texels(shape: &MapShape) -> impl Iterator<Item = (u32, [u32; 2], Dir)> + '_ {
    let [width, height] = shape.size;
    (0..shape.charts.len() as u32)
        .filter(|chart| shape.charts[*chart as usize].is_some())
        .flat_map(move |chart| (0..height).map(move |y| (chart, y)))
        .flat_map(move |(chart, y)| (0..width).map(move |x| (chart, [x, y])))
        .filter_map(|(chart, texel)| Some((chart, texel, direction(shape, chart, texel)?)))
}

/// A map of floats whose texels hold a function of their direction; 0 off the discs.
pub fn map_of(shape: &MapShape, light: impl Fn(Dir) -> [f32; 3]) -> EnvironmentMap {
    let layout = shape.mapping.info().layout;
    let sizes = MapShape::raster_sizes(shape.mapping, layout, shape.size);
    let mut pictures: Vec<Vec<f32>> = sizes
        .iter()
        .map(|[width, height]| vec![0.0; (width * height * 3) as usize])
        .collect();
    for (chart, texel, dir) in texels(shape) {
        let placement = shape.charts[chart as usize].unwrap();
        let [x, y] = placement.turn.cell_from_chart(texel, shape.size);
        let (x, y) = (placement.origin[0] + x, placement.origin[1] + y);
        let at = (y * sizes[placement.raster][0] + x) as usize * 3;
        pictures[placement.raster][at..at + 3].copy_from_slice(&light(dir));
    }
    let rasters = pictures.into_iter().zip(&sizes).map(|(samples, size)| {
        Raster::new(
            *size,
            Channels::Rgb,
            Transfer::Linear,
            Samples::F32(samples),
        )
        .unwrap()
    });
    EnvironmentMap::new(shape.clone(), rasters.collect()).unwrap()
}

/// The size of a chart of about `height` rows whose texels are as square as the mapping allows.
pub fn size_of(mapping: MappingId, height: u32) -> [u32; 2] {
    [
        (f64::from(height) * mapping.info().aspect).round() as u32,
        height,
    ]
}

/// A rotation without any symmetry: by 1 rad about x, then 0.7 about y, then 0.3 about z.
pub fn askew() -> [[f64; 3]; 3] {
    let turn = |angle: f64, i: usize, j: usize| {
        let mut m = Conversion::UNTURNED;
        let (sin, cos) = angle.sin_cos();
        (m[i][i], m[i][j], m[j][i], m[j][j]) = (cos, -sin, sin, cos);
        m
    };
    let product = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| {
        let entry = |i: usize, k: usize| (0..3).map(|j| a[i][j] * b[j][k]).sum();
        std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
    };
    product(turn(0.3, 0, 1), product(turn(0.7, 2, 0), turn(1.0, 1, 2)))
}

pub fn rotated(m: [[f64; 3]; 3], d: Dir) -> Dir {
    m.map(|row| row.iter().zip(d).map(|(a, b)| a * b).sum())
}

/// A conversion on one thread with a filter.
pub fn conversion(
    source: &MapShape,
    mapping: MappingId,
    size: [u32; 2],
    filter: Filter,
) -> Conversion {
    Conversion {
        filter: Some(filter),
        layout: mapping.info().layout,
        ..Conversion::new(mapping, size, source)
    }
}

pub fn run(source: &EnvironmentMap, conversion: &Conversion) -> (EnvironmentMap, Report) {
    Plan::new(source.shape(), conversion)
        .unwrap()
        .run(source, &Progress::new())
        .unwrap()
}

/// The layout with a picture for each chart.
pub const FACES: Layout = Layout::Faces;

/// Observed numbers beside their budgets.
#[derive(Default)]
pub struct Budgets {
    faults: Vec<String>,
}

impl Budgets {
    /// `observed` must not be above `budget`, nor a tenth of it.
    pub fn hold(&mut self, what: &str, observed: f64, budget: f64) {
        self.within(what, observed, budget);
        if observed * 10.0 < budget {
            self.faults
                .push(format!("{what}: {budget:.1e} is far above {observed:.3e}"));
        }
    }

    /// `observed` must not be above `budget`, but may be far below: a part of something else that holds it.
    pub fn within(&mut self, what: &str, observed: f64, budget: f64) {
        println!("{what:60} observed {observed:9.2e}  budget {budget:8.1e}");
        if observed.is_nan() || observed > budget {
            self.faults
                .push(format!("{what}: {observed:.3e} > {budget:.1e}"));
        }
    }

    /// Something broken on purpose must be above the budget.
    pub fn must_break(&mut self, what: &str, observed: f64, budget: f64) {
        println!("{what:60} observed {observed:9.2e}  must be above {budget:8.1e}");
        if observed <= budget {
            self.faults.push(format!(
                "{what} was not noticed: {observed:.3e} <= {budget:.1e}"
            ));
        }
    }

    pub fn check(self) {
        assert!(self.faults.is_empty(), "{}", self.faults.join("\n"));
    }
}
