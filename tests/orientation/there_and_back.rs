//! The labelled environment through every frame and layout: written as the program has it, and read back with its name.
//!
//! What each pixel of a file must show is computed here from the face table and the frame's axes alone, without the arrangements
//! and placements that the conversion uses.

use std::path::{Path, PathBuf};

use sixfold::imaging::computed::{Pattern, compute};
use sixfold::imaging::load::{Format, Opened, open};
use sixfold::imaging::resample::{Conversion, Filter, chart_size, resample};
use sixfold::imaging::save::{Content, SaveOptions, save};
use sixfold::imaging::{
    Channels, EnvironmentMap, Image, OpenHints, Progress, Raster, Samples, Siting, Transfer,
    open_map,
};
use sixfold::mapping::{ChartPoint, Frame, Layout, MappingId, Pictures};
use sixfold::math::Vec3;

use crate::scenes::smooth;

/// Texels of a face's side, and rows of any other map: the letters can still be told from their mirror images.
const SIZE: u32 = 32;
/// Rows of the source; no texel of a result looks at the border between two of its texels.
const ROWS: u32 = 250;
/// A mirrored face changes at least this share of its texels.
const FLIPPED: f64 = 0.5;

/// The labelled environment, faint before a sky that tells the seams: six even colours may be put together in any way, and reading
/// would try them all.
struct Labels(Image);

impl Labels {
    fn new() -> Self {
        let mut image = compute(Pattern::LabelledFaces, ROWS, &Progress::new()).unwrap();
        let [width, height] = [image.width(), image.height()].map(f64::from);
        for (i, texel) in image.pixels_mut().iter_mut().enumerate() {
            let (row, column) = (i as u32 / (2 * ROWS), i as u32 % (2 * ROWS));
            let (u, v) = (
                (f64::from(column) + 0.5) / width,
                (f64::from(row) + 0.5) / height,
            );
            let sky = smooth(
                MappingId::Latlong
                    .inverse(ChartPoint::new(0, u, v))
                    .unwrap(),
            );
            *texel = [0, 1, 2].map(|c| sky[c] + 0.05 * texel[c]);
        }
        Self(image)
    }

    fn at(&self, world: Vec3<f64>) -> [f32; 3] {
        let p = MappingId::Latlong.forward(world).unwrap();
        self.0.nearest(p.u, p.v)
    }

    /// Whether a texel holds something else. Any texel of the source's first row may stand for its pole.
    fn differs(&self, light: [f32; 4], world: Vec3<f64>) -> bool {
        let exact = self.at(world);
        world.y.abs() < 1.0 - 1e-12 && (0..3).any(|c| (light[c] - exact[c]).abs() > 1e-6)
    }

    fn map(&self) -> EnvironmentMap {
        let size = [self.0.width(), self.0.height()];
        let samples = Samples::F32(self.0.pixels().as_flattened().to_vec());
        let raster = Raster::new(size, Channels::Rgb, Transfer::Linear, samples).unwrap();
        EnvironmentMap::from_layout(MappingId::Latlong, Layout::Single, vec![raster]).unwrap()
    }
}

/// The direction in the world that a program shows at a place of its picture with this label.
fn shown(frame: &Frame, mapping: MappingId, label: u32, [u, v]: [f64; 2]) -> Option<Vec3<f64>> {
    let dir = mapping.inverse(ChartPoint::new(label, u, v))?;
    let program = match frame.cube.map(|cube| cube.pictures) {
        Some(Pictures::LookedUp(cube_from_program)) if mapping == MappingId::Cube => {
            cube_from_program.inverse().apply(dir)
        }
        // Its face table is ours with z the other way round, as is the world that it stands for.
        Some(Pictures::Drawn(_)) if mapping == MappingId::Cube => {
            let exchanged = [0, 1, 2, 3, 5, 4][label as usize];
            return mapping.inverse(ChartPoint::new(exchanged, u, v));
        }
        _ if frame.is_ours => dir,
        _ => {
            let (_, axes) = frame.program_from_map.iter().find(|(m, _)| *m == mapping)?;
            axes.apply(dir)
        }
    };
    Some(frame.world_from_program.apply(program))
}

/// The label in each cell of a layout, in the order of its cells.
fn labels(frame: &Frame, layout: Layout, charts: u32) -> Vec<u32> {
    match (frame.cube, layout) {
        (Some(cube), Layout::Row | Layout::Column | Layout::ThreeByTwo) if charts == 6 => {
            cube.order.map(|label| label as u32).to_vec()
        }
        _ => (0..charts).collect(),
    }
}

/// The largest share of wrong texels of a chart, when pictures are held against what the program shows.
fn wrong(
    labelled: &Labels,
    frame: &Frame,
    mapping: MappingId,
    layout: Layout,
    pictures: &[Raster],
) -> f64 {
    let size = chart_size(mapping, SIZE);
    let siting = if frame.is_edge_sited {
        Siting::Edge
    } else {
        Siting::Centre
    };
    let charts = mapping.info().chart_count();
    let mut worst: f64 = 0.0;
    for (k, label) in labels(frame, layout, charts).into_iter().enumerate() {
        let cell = layout.cell(k as u32);
        let (mut count, mut differ) = (0, 0);
        for row in 0..size[1] {
            for column in 0..size[0] {
                let place = [(column, size[0]), (row, size[1])]
                    .map(|(i, n)| siting.coordinate(f64::from(i), n));
                let Some(dir) = shown(frame, mapping, label, place) else {
                    continue;
                };
                let (picture, [x, y]) = match cell {
                    Some(cell) if layout != Layout::Faces => {
                        let [x, y] = cell.turn.cell_from_chart([column, row], size);
                        (0, [cell.at[0] * size[0] + x, cell.at[1] * size[1] + y])
                    }
                    _ => (label as usize, [column, row]),
                };
                let light = pictures[picture].light(x, y);
                count += 1;
                differ += u32::from(labelled.differs(light, dir));
            }
        }
        worst = worst.max(f64::from(differ) / f64::from(count));
    }
    worst
}

/// Left and right exchanged in one cell.
fn flip(raster: &Raster, origin: [u32; 2], size: [u32; 2]) -> Raster {
    let Samples::F32(samples) = raster.samples() else {
        panic!("not floats")
    };
    let mut flipped = samples.clone();
    let at = |x: u32, y: u32| 3 * (y * raster.width() + x) as usize;
    for y in origin[1]..origin[1] + size[1] {
        for x in 0..size[0] {
            let (to, from) = (at(origin[0] + x, y), at(origin[0] + size[0] - 1 - x, y));
            flipped[to..to + 3].copy_from_slice(&samples[from..from + 3]);
        }
    }
    Raster::new(
        raster.size(),
        Channels::Rgb,
        Transfer::Linear,
        Samples::F32(flipped),
    )
    .unwrap()
}

fn paths(folder: &Path, layout: Layout) -> Vec<PathBuf> {
    let names: &[&str] = match layout {
        Layout::Faces => &["px", "nx", "py", "ny", "pz", "nz"],
        _ => &["map"],
    };
    names
        .iter()
        .map(|name| folder.join(format!("{name}.exr")))
        .collect()
}

/// Every layout of every mapping that a frame knows.
fn everything() -> impl Iterator<Item = (&'static Frame, MappingId, Layout)> {
    Frame::ALL.iter().flat_map(|frame| {
        let maps = [
            MappingId::Cube,
            MappingId::Latlong,
            MappingId::Angular,
            MappingId::OctahedralEqualArea,
        ];
        maps.into_iter()
            .filter(|mapping| frame.knows(*mapping))
            .flat_map(move |mapping| {
                let layouts = Layout::ALL.into_iter();
                layouts
                    .filter(move |l| l.holds(mapping.info().chart_count()))
                    .map(move |layout| (frame, mapping, layout))
            })
    })
}

#[test]
fn every_frame_and_layout_shows_the_world_the_right_way_round() {
    let labelled = Labels::new();
    let source = labelled.map();
    let folder = tempfile::tempdir().unwrap();
    let (mut combinations, mut least_flipped) = (0, 1.0_f64);
    for (frame, mapping, layout) in
        everything().filter(|(_, m, l)| m.info().chart_count() == 6 || *l == Layout::Single)
    {
        let name = format!("{} {mapping} {}", frame.id, layout.id());
        let mut conversion = Conversion::new(mapping, chart_size(mapping, SIZE), source.shape());
        (conversion.layout, conversion.frame, conversion.filter) =
            (layout, Some(frame), Some(Filter::Nearest));
        if frame.is_edge_sited {
            conversion.siting = Siting::Edge;
        }
        let (made, _) = resample(&source, &conversion, &Progress::new()).unwrap();
        let paths = paths(folder.path(), layout);
        assert_eq!(paths.len(), made.rasters().len());
        for (path, raster) in paths.iter().zip(made.rasters()) {
            save(
                path,
                true,
                Content::Raster(raster),
                Format::Exr,
                &SaveOptions::default(),
                &Progress::new(),
            )
            .unwrap();
        }
        // What another program finds in the files.
        let pictures = paths
            .iter()
            .map(|path| match open(path, &Progress::new()).unwrap() {
                Opened::Raster(file) => file.raster,
                Opened::Container(_) => panic!("a picture was written"),
            });
        let mut pictures: Vec<Raster> = pictures.collect();
        let share = wrong(&labelled, frame, mapping, layout, &pictures);
        assert_eq!(share, 0.0, "{name}: {share}");

        // What comes back when the frame is named.
        let hints = OpenHints {
            mapping: Some(mapping),
            layout: Some(layout),
            frame: Some(frame),
            ..OpenHints::default()
        };
        let opened = open_map(&paths, &hints, &Progress::new()).unwrap();
        let shape = opened.map.shape();
        let (mut count, mut differ) = (0, 0);
        for chart in 0..mapping.info().chart_count() {
            for row in 0..shape.size[1] {
                for column in 0..shape.size[0] {
                    let place = [(column, shape.size[0]), (row, shape.size[1])];
                    let [u, v] = place.map(|(i, n)| shape.siting.coordinate(f64::from(i), n));
                    let Some(dir) = mapping.inverse(ChartPoint::new(chart, u, v)) else {
                        continue;
                    };
                    let light = opened.map.light(chart, [column, row]);
                    count += 1;
                    differ += u32::from(labelled.differs(light, shape.world_from_map.apply(dir)));
                }
            }
        }
        assert_eq!(differ, 0, "{name}: of {count}");

        // Control: one flipped face is seen.
        let placement = made.shape().charts[0].unwrap();
        let size = placement.turn.turned(made.shape().size);
        pictures[placement.raster] = flip(&pictures[placement.raster], placement.origin, size);
        let flipped = wrong(&labelled, frame, mapping, layout, &pictures);
        assert!(flipped > FLIPPED, "{name}: {flipped}");
        least_flipped = least_flipped.min(flipped);
        combinations += 1;
    }
    println!(
        "{combinations} combinations; with a face flipped {least_flipped:.2} of it are wrong, at least {FLIPPED}"
    );
    assert_eq!(combinations, 130);
}
