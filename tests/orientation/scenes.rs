//! Surroundings as functions of the direction, and maps of them: every texel's value is the surroundings' at its own direction.

use sixfold::imaging::computed::{self, Pattern};
use sixfold::imaging::{
    Channels, EnvironmentMap, Image, MapShape, Progress, Raster, SampleKind, Samples, Siting,
    Transfer,
};
use sixfold::mapping::{Arrangement, Axes, ChartPoint, Layout, MappingId};
use sixfold::math::Vec3;

pub type Scene = fn(Vec3<f64>) -> [f32; 3];

/// Few and wide waves, without any symmetry of the cube.
pub fn smooth(d: Vec3<f64>) -> [f32; 3] {
    let Vec3 { x, y, z } = d;
    let r = 0.5 + 0.2 * x + 0.13 * y - 0.11 * z + 0.1 * x * y;
    let g = 0.5 - 0.17 * x + 0.21 * y + 0.07 * z + 0.09 * y * z - 0.08 * x * x;
    let b = 0.5 + 0.05 * x - 0.1 * y + 0.23 * z + 0.11 * x * z * y;
    [r, g, b].map(|c| c as f32)
}

/// A number in [0, 1) for a point of a lattice.
fn hashed(x: i64, y: i64, z: i64) -> f64 {
    let mut h = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f)
        ^ (z as u64).wrapping_mul(0x1656_67b1_9e37_79f9);
    h = (h ^ (h >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h = (h ^ (h >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (h >> 11) as f64 / (1_u64 << 53) as f64
}

/// Values at lattice points, smoothly mixed between.
fn noise(p: [f64; 3]) -> f64 {
    let cell = p.map(f64::floor);
    let at = [0, 1, 2].map(|i| {
        let t = p[i] - cell[i];
        t * t * (3.0 - 2.0 * t)
    });
    let mut sum = 0.0;
    for corner in 0..8 {
        let bit = [corner & 1, corner >> 1 & 1, corner >> 2];
        let weight: f64 = (0..3)
            .map(|i| if bit[i] == 1 { at[i] } else { 1.0 - at[i] })
            .product();
        let [x, y, z] = [0, 1, 2].map(|i| cell[i] as i64 + bit[i]);
        sum += weight * hashed(x, y, z);
    }
    sum
}

/// Like a photograph: detail at all sizes, a sky that grows brighter upwards and is nearly even overhead.
pub fn photograph(d: Vec3<f64>) -> [f32; 3] {
    let mut detail = [0.0; 3];
    let mut size = 1.5;
    for _ in 0..6 {
        for (channel, sum) in detail.iter_mut().enumerate() {
            let shift = 17.3 * channel as f64;
            *sum +=
                noise([d.x * size + shift, d.y * size - shift, d.z * size + 5.1]) / size.powf(0.8);
        }
        size *= 2.1;
    }
    let sky = (2.0 * d.y).clamp(0.0, 1.0);
    [0, 1, 2].map(|c| (0.1 + 0.3 * detail[c] * (1.0 - 0.8 * sky) + 0.4 * sky) as f32)
}

/// The same everywhere.
pub fn constant(_: Vec3<f64>) -> [f32; 3] {
    [0.3; 3]
}

/// The direction itself.
pub fn direction(d: Vec3<f64>) -> [f32; 3] {
    [d.x as f32, d.y as f32, d.z as f32]
}

/// The labelled environment, latlong.
pub fn labelled() -> Image {
    computed::compute(Pattern::LabelledFaces, 512, &Progress::new()).unwrap()
}

/// How a map is laid out.
#[derive(Clone, Copy)]
pub struct Laid {
    pub mapping: MappingId,
    pub layout: Layout,
    pub size: [u32; 2],
    pub siting: Siting,
}

impl Laid {
    pub fn new(mapping: MappingId, layout: Layout, height: u32) -> Self {
        let width = (f64::from(height) * mapping.info().aspect).round() as u32;
        Self {
            mapping,
            layout,
            size: [width, height],
            siting: Siting::Centre,
        }
    }

    /// The shape, plainly labelled.
    pub fn shape(&self) -> MapShape {
        MapShape {
            mapping: self.mapping,
            size: self.size,
            charts: MapShape::placements(self.mapping, self.layout, self.size).unwrap(),
            world_from_map: Axes::IDENTITY,
            siting: self.siting,
            channels: Channels::Rgb,
            samples: SampleKind::F32,
            transfer: Transfer::Linear,
        }
    }

    /// The pictures of a map of this shape; 0 where no chart is.
    pub fn draw(&self, shape: &MapShape, scene: impl Fn(Vec3<f64>) -> [f32; 3]) -> Vec<Raster> {
        let sizes = MapShape::raster_sizes(self.mapping, self.layout, self.size);
        let mut pictures: Vec<Vec<f32>> = sizes
            .iter()
            .map(|[w, h]| vec![0.0; (w * h * 3) as usize])
            .collect();
        for (chart, placement) in shape.charts.iter().enumerate() {
            let Some(placement) = placement else { continue };
            for row in 0..self.size[1] {
                for column in 0..self.size[0] {
                    let place = |i: u32, n: u32| match shape.siting {
                        Siting::Centre => (f64::from(i) + 0.5) / f64::from(n),
                        Siting::Edge => f64::from(i) / f64::from(n - 1),
                    };
                    let (u, v) = (place(column, self.size[0]), place(row, self.size[1]));
                    let Some(dir) = self.mapping.inverse(ChartPoint::new(chart as u32, u, v))
                    else {
                        continue;
                    };
                    let color = scene(shape.world_from_map.apply(dir));
                    let [x, y] = placement.turn.cell_from_chart([column, row], self.size);
                    let (x, y) = (placement.origin[0] + x, placement.origin[1] + y);
                    let at = ((y * sizes[placement.raster][0] + x) * 3) as usize;
                    pictures[placement.raster][at..at + 3].copy_from_slice(&color);
                }
            }
        }
        pictures
            .into_iter()
            .zip(sizes)
            .map(|(samples, size)| {
                let samples = Samples::F32(samples);
                Raster::new(size, Channels::Rgb, Transfer::Linear, samples).unwrap()
            })
            .collect()
    }

    /// A map whose pictures are not what their labels say, and the plain shape that a reader would take them for.
    pub fn arranged(&self, scene: Scene, arrangement: &Arrangement) -> (MapShape, Vec<Raster>) {
        let plain = self.shape();
        let mut truly = plain.clone();
        truly.arrange(arrangement);
        let pictures = self.draw(&truly, scene);
        (plain, pictures)
    }

    pub fn map(&self, scene: Scene) -> EnvironmentMap {
        let shape = self.shape();
        let pictures = self.draw(&shape, scene);
        EnvironmentMap::new(shape, pictures).unwrap()
    }
}

/// Codes of sRGB, 8 bits, of a picture that holds light.
pub fn in_8_bits(raster: &Raster) -> Raster {
    let Samples::F32(samples) = raster.samples() else {
        return raster.clone();
    };
    let code = |light: &f32| {
        (sixfold::imaging::srgb::srgb_from_linear(light.clamp(0.0, 1.0)) * 255.0).round() as u8
    };
    let codes = samples.iter().map(code).collect();
    Raster::new(
        raster.size(),
        Channels::Rgb,
        Transfer::Srgb,
        Samples::U8(codes),
    )
    .unwrap()
}
