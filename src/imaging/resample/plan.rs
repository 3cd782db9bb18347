//! What a conversion needs to know that depends on the shapes alone, and its runs.

use super::ResampleError;
use super::conversion::{Conversion, Filter, FilteredIn};
use super::encode::Encoder;
use super::filter::{Filtered, Sampler, reach};
use super::fused::Fused;
use super::general::{General, Way};
use super::geometry::Geometry;
use super::grid::Grid;
use super::gutter::Gutter;
use super::lane_places::LanePlaces;
use super::lookups::Places;
use super::report::{Report, Skipped};
use super::stored::{Decoder, Stored, Working};
use super::strips::{Kernel, Threads, fill};
use super::texels::Texels;
use crate::imaging::load::MOST_RASTER_BYTES;
use crate::imaging::{
    Channels, EnvironmentMap, MapShape, Progress, Raster, SampleKind, Samples, Stage, Transfer,
};
use crate::mapping::{Domain, Layout};
use crate::math::Isa;

/// Most texels along a side of a chart. Six of them beside each other are still counted in 32 bits with room to spare.
pub const MOST_SIDE: u32 = 1 << 16;

/// Most places along a side of a texel.
const MOST_SUPERSAMPLE: u32 = 64;

/// A conversion, prepared. Serves every map of the source's shape, so a film pays for it once.
#[derive(Clone, Debug)]
pub struct Plan {
    source: MapShape,
    target: MapShape,
    /// Sizes of the target's pictures.
    pictures: Vec<[u32; 2]>,
    conversion: Conversion,
    filter: Filter,
    geometry: Geometry,
    /// Places of many texels at once, where both mappings can.
    lanes: Option<LanePlaces>,
    gutter: Gutter,
    threads: Threads,
    largest_footprint: f64,
    outside: u64,
}

impl Plan {
    /// Prepares a conversion of maps of a shape.
    ///
    /// # Errors
    /// When the conversion makes no sense; see [`ResampleError`].
    pub fn new(source: &MapShape, conversion: &Conversion) -> Result<Self, ResampleError> {
        check(source.size)?;
        check(conversion.size)?;
        check_numbers(conversion)?;
        let target = conversion.target_shape(source)?;
        if target.charts.iter().all(Option::is_none) {
            let count = conversion.mapping.info().chart_count();
            return Err(ResampleError::BadNumber(format!(
                "none of the {count} charts of `{}` is wanted; name one",
                conversion.mapping
            )));
        }
        let pictures = match conversion.layout {
            Layout::Faces => vec![conversion.size; target.charts.iter().flatten().count()],
            layout => MapShape::raster_sizes(conversion.mapping, layout, conversion.size),
        };
        let threads = Threads::new(conversion.threads);
        let mut geometry = Geometry::new(source, &target, conversion);
        let survey = Survey::of(&geometry, &target, &threads);
        let filter = conversion.filter.unwrap_or(if survey.minifies {
            Filter::Area
        } else {
            Filter::Bicubic
        });
        if filter == Filter::Nearest {
            geometry.do_not_divide();
        }
        Ok(Self {
            source: source.clone(),
            pictures,
            conversion: conversion.clone(),
            filter,
            gutter: Gutter::new(&geometry.source, reach(filter), &threads),
            lanes: LanePlaces::new(
                &geometry,
                conversion.isa.unwrap_or(Isa::Avx512).available(),
                &threads,
            ),
            geometry,
            threads,
            largest_footprint: survey.largest,
            outside: outside_discs(&target),
            target,
        })
    }

    /// Shape of the map that comes out.
    pub const fn target(&self) -> &MapShape {
        &self.target
    }

    /// A black map of the target's shape, clear where it has opacity: something for [`Plan::run_into`] to fill.
    ///
    /// # Errors
    /// When there is no memory.
    pub fn black(&self) -> Result<EnvironmentMap, ResampleError> {
        let pictures = self.pictures.iter().map(|size| black(*size, &self.target));
        let rasters = pictures.collect::<Result<Vec<_>, _>>()?;
        EnvironmentMap::new(self.target.clone(), rasters)
            .map_err(|error| ResampleError::OtherShape(error.to_string()))
    }

    /// Converts one map.
    ///
    /// # Errors
    /// When it is cancelled, there is no memory, or the source has another shape than the plan's.
    pub fn run(
        &self,
        source: &EnvironmentMap,
        progress: &Progress,
    ) -> Result<(EnvironmentMap, Report), ResampleError> {
        let mut target = self.black()?;
        let report = self.run_into(source, &mut target, progress)?;
        Ok((target, report))
    }

    /// Converts one map into a map that is there already, whose charts are written over; what lies between charts stays.
    ///
    /// # Errors
    /// When it is cancelled, or one of the maps has another shape than the plan's.
    pub fn run_into(
        &self,
        source: &EnvironmentMap,
        target: &mut EnvironmentMap,
        progress: &Progress,
    ) -> Result<Report, ResampleError> {
        if source.shape() != &self.source {
            return Err(ResampleError::OtherShape(difference(
                source.shape(),
                &self.source,
            )));
        }
        if target.shape() != &self.target {
            return Err(ResampleError::OtherShape(difference(
                target.shape(),
                &self.target,
            )));
        }
        progress.enter(Stage::Converting);
        match (self.source.samples, self.source.channels) {
            (SampleKind::U8, Channels::Rgb) => self.run_from::<u8, 3>(source, target, progress),
            (SampleKind::U8, Channels::Rgba) => self.run_from::<u8, 4>(source, target, progress),
            (SampleKind::U16, Channels::Rgb) => self.run_from::<u16, 3>(source, target, progress),
            (SampleKind::U16, Channels::Rgba) => self.run_from::<u16, 4>(source, target, progress),
            (SampleKind::F32, Channels::Rgb) => self.run_from::<f32, 3>(source, target, progress),
            (SampleKind::F32, Channels::Rgba) => self.run_from::<f32, 4>(source, target, progress),
        }?;
        progress.enter(Stage::Done);
        Ok(self.report())
    }

    /// Fills a map by a kernel of its own.
    pub(super) fn fill_by<K>(
        &self,
        target: &mut EnvironmentMap,
        kernel: &K,
        progress: &Progress,
    ) -> Result<(), ResampleError>
    where
        K: Kernel<u8> + Kernel<u16> + Kernel<f32>,
    {
        match self.target.samples {
            SampleKind::U8 => fill::<u8>(target, kernel, &self.threads, progress),
            SampleKind::U16 => fill::<u16>(target, kernel, &self.threads, progress),
            SampleKind::F32 => fill::<f32>(target, kernel, &self.threads, progress),
        }
    }

    fn run_from<S: Stored, const N: usize>(
        &self,
        source: &EnvironmentMap,
        target: &mut EnvironmentMap,
        progress: &Progress,
    ) -> Result<(), ResampleError> {
        let decoder = Decoder::of(self.source.samples, self.source.transfer, self.working());
        let sampler = Filtered {
            texels: Texels::<S, N>::new(
                source,
                decoder,
                &self.gutter,
                self.filter == Filter::Nearest,
                &self.threads,
            ),
            filter: self.filter,
        };
        let encoder = self.encoder();
        if let (Some(places), true) = (&self.lanes, self.is_plain()) {
            let done = match (self.source.samples, self.target.samples) {
                (SampleKind::U8, SampleKind::U8) => Fused::new(places, source, &sampler, encoder)
                    .map(|kernel| fill::<u8>(target, &kernel, &self.threads, progress)),
                (SampleKind::F32, SampleKind::F32) => Fused::new(places, source, &sampler, encoder)
                    .map(|kernel| fill::<f32>(target, &kernel, &self.threads, progress)),
                _ => None,
            };
            if let Some(done) = done {
                return done;
            }
        }
        self.run_with(&sampler, target, progress)
    }

    /// Whether stored numbers are mixed and stored again: bilinear, three samples a pixel, nothing decoded, changed or hidden.
    fn is_plain(&self) -> bool {
        self.filter == Filter::Bilinear
            && self.conversion.supersample == 1
            && self.source.channels == Channels::Rgb
            && self.target.channels == Channels::Rgb
            && self.source.transfer == self.target.transfer
            && (self.source.transfer == Transfer::Linear
                || self.conversion.filtered_in == FilteredIn::Codes)
            && self.conversion.exposure_ev == 0.0
            && !self.conversion.dither
    }

    pub(super) const fn threads(&self) -> &Threads {
        &self.threads
    }

    pub(super) fn encoder(&self) -> Encoder {
        Encoder {
            working: self.working(),
            transfer: self.target.transfer,
            channels: self.target.channels,
            gain: self.conversion.exposure_ev.exp2() as f32,
            dither: self.conversion.dither,
        }
    }

    fn run_with(
        &self,
        sampler: &dyn Sampler,
        target: &mut EnvironmentMap,
        progress: &Progress,
    ) -> Result<(), ResampleError> {
        let places: &dyn Places = match &self.lanes {
            Some(lanes) => lanes,
            None => &self.geometry,
        };
        let kernel = General {
            way: match (self.filter, self.conversion.supersample) {
                (Filter::Area, _) => Way::Area(&self.geometry),
                (_, 1) => Way::Single(places),
                (_, count) => Way::Grid(&self.geometry, count),
            },
            sampler,
            encoder: self.encoder(),
        };
        self.fill_by(target, &kernel, progress)
    }

    pub(super) fn working(&self) -> Working {
        Working::of(self.source.transfer, self.conversion.filtered_in)
    }

    fn report(&self) -> Report {
        let wanted = self.target.charts.iter().flatten().count();
        let left_out = (self.target.charts.len() - wanted) as u32;
        let codes_are_light = self.source.transfer == Transfer::Linear;
        let skips = [
            (left_out > 0, Skipped::Charts(left_out)),
            (self.outside > 0, Skipped::OutsideDiscs(self.outside)),
            (
                codes_are_light || self.conversion.filtered_in == FilteredIn::Codes,
                Skipped::Decoding,
            ),
            (
                self.conversion.rotation == Conversion::UNTURNED,
                Skipped::Rotation,
            ),
        ];
        Report {
            filter: self.filter,
            threads: self.threads.count(),
            isa: self.lanes.as_ref().map_or(Isa::Baseline, |lanes| lanes.isa),
            largest_footprint_texels: self.largest_footprint,
            skipped: skips
                .into_iter()
                .filter_map(|(is_so, skipped)| is_so.then_some(skipped))
                .collect(),
        }
    }
}

/// A black picture.
fn black(size: [u32; 2], shape: &MapShape) -> Result<Raster, ResampleError> {
    fn zeros<T: Stored>(count: u64) -> Option<Samples> {
        let mut list = Vec::new();
        let count = usize::try_from(count).ok()?;
        list.try_reserve_exact(count).ok()?;
        list.resize(count, T::default());
        Some(T::samples(list))
    }
    let count = size.map(u64::from).iter().product::<u64>() * shape.channels.count() as u64;
    let bytes = count * shape.samples.bytes() as u64;
    if bytes > MOST_RASTER_BYTES {
        return Err(ResampleError::TooManyBytes { bytes });
    }
    let samples = match shape.samples {
        SampleKind::U8 => zeros::<u8>(count),
        SampleKind::U16 => zeros::<u16>(count),
        SampleKind::F32 => zeros::<f32>(count),
    };
    samples
        .and_then(|samples| Raster::new(size, shape.channels, shape.transfer, samples))
        .ok_or(ResampleError::OutOfMemory {
            bytes: count * shape.samples.bytes() as u64,
        })
}

fn check([width, height]: [u32; 2]) -> Result<(), ResampleError> {
    if width > MOST_SIDE || height > MOST_SIDE {
        return Err(ResampleError::TooLarge {
            width,
            height,
            most: MOST_SIDE,
        });
    }
    if width == 0 || height == 0 {
        return Err(ResampleError::BadNumber(format!(
            "a chart of {width} x {height} texels holds nothing; choose a size from 1 on"
        )));
    }
    Ok(())
}

fn check_numbers(conversion: &Conversion) -> Result<(), ResampleError> {
    let refuse = |why: String| Err(ResampleError::BadNumber(why));
    if !(1..=MOST_SUPERSAMPLE).contains(&conversion.supersample) {
        return refuse(format!(
            "{} places along a texel's side are not possible; choose 1 to {MOST_SUPERSAMPLE}",
            conversion.supersample
        ));
    }
    // Further, not even the smallest or the largest float is left.
    if !(-126.0..=126.0).contains(&conversion.exposure_ev) {
        return refuse(format!(
            "an exposure of {} stops leaves no light; choose -126 to 126",
            conversion.exposure_ev
        ));
    }
    let [a, b, c] = conversion.rotation;
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let is_turn = [
        (a, a, 1.0),
        (b, b, 1.0),
        (c, c, 1.0),
        (a, b, 0.0),
        (a, c, 0.0),
        (b, c, 0.0),
    ]
    .into_iter()
    .all(|(a, b, expected)| (dot(a, b) - expected).abs() < 1e-6);
    if !is_turn {
        return refuse("the rotation's rows are not at right angles and of length 1".to_owned());
    }
    Ok(())
}

fn difference(found: &MapShape, planned: &MapShape) -> String {
    let [width, height] = found.size;
    let [planned_width, planned_height] = planned.size;
    if found.size != planned.size {
        format!("{width} x {height} texels a chart instead of {planned_width} x {planned_height}")
    } else if found.mapping != planned.mapping {
        format!("`{}` instead of `{}`", found.mapping, planned.mapping)
    } else {
        "its charts lie or are stored in another way".to_owned()
    }
}

/// Texels of the wanted charts whose middles lie outside of their discs.
fn outside_discs(target: &MapShape) -> u64 {
    if target.mapping.info().domain == Domain::Square {
        return 0;
    }
    let grid = Grid::of(target);
    let [width, height] = target.size;
    let inside: u64 = (0..height as i32)
        .map(|row| grid.owned(row).len() as u64)
        .sum();
    let charts = target.charts.iter().flatten().count() as u64;
    charts * (u64::from(width) * u64::from(height) - inside)
}

/// How the target's texels lie over the source's, from a grid of them in each chart.
struct Survey {
    /// Most source texels along a side of a target texel.
    largest: f64,
    /// Whether most texels of the target cover more than two texels of the source: from there on lookups at texels' middles
    /// would leave some out (see `area`).
    minifies: bool,
}

impl Survey {
    fn of(geometry: &Geometry, target: &MapShape, threads: &Threads) -> Self {
        const SIDE: u32 = 24;
        let charts = target.charts.iter().enumerate();
        let wanted: Vec<u32> = charts
            .filter_map(|(chart, placement)| placement.as_ref().map(|_| chart as u32))
            .collect();
        let [across, down] = target.size.map(|n| n.min(SIDE) as usize);
        let mut footprints = vec![None; wanted.len() * across * down];
        threads.fill_each(&mut footprints, |index| {
            let (chart, index) = (wanted[index / (across * down)], index % (across * down));
            let at = [(index % across, across), (index / across, down)];
            // The middle of the texel that lies there.
            let at = [0, 1].map(|side| {
                let (index, steps) = at[side];
                let share = (index as f64 + 0.5) / steps as f64;
                (share * f64::from(target.size[side])).floor()
            });
            geometry.footprint(chart, at)
        });
        let (mut largest, mut many, mut all) = (0.0_f64, 0_u32, 0_u32);
        for footprint in footprints.into_iter().flatten() {
            let area = footprint.area();
            if !area.is_finite() {
                continue;
            }
            all += 1;
            many += u32::from(area > 2.0);
            let [a, b] = footprint.lengths();
            largest = largest.max(a).max(b);
        }
        Self {
            largest,
            minifies: 2 * many > all,
        }
    }
}
