//! Raw frames from standard input to standard output.

use std::io;

use super::error::ConvertError;
use super::pipeline;
use super::raw::{self, RawFrames};
use super::task::Task;
use super::work::Converter;
use crate::imaging::{EnvironmentMap, MapShape, OpenHints, Progress, Raster, Siting, Stored};
use crate::mapping::MappingId;

/// Converts frames until the input ends.
pub(super) fn run(
    task: &Task,
    frames: RawFrames,
    mapping: MappingId,
    hints: &OpenHints,
) -> Result<(), ConvertError> {
    let shape = shape(frames, mapping, hints)?;
    let mut converter = Converter::new(task);
    // Wrong options are told before the first frame comes.
    converter.prepare(&shape, stored(frames))?;
    let (mut number, mut input) = (0, io::stdin());
    let read = move |old: Option<EnvironmentMap>| {
        let mut map = match old {
            Some(map) => map,
            None => map_of(&shape, frames.black()?)?,
        };
        number += 1;
        let [raster] = map.rasters_mut() else {
            return Err(ConvertError::Broken);
        };
        Ok(raw::read(&mut input, raster, number)?.then_some(map))
    };
    let mut output = io::stdout();
    let write = move |map: &mut EnvironmentMap| {
        map.rasters()
            .iter()
            .try_for_each(|raster| raw::write(&mut output, raster))
            .map_err(ConvertError::Write)
    };
    let progress = Progress::new();
    pipeline::run(
        read,
        |map, old| converter.convert(map, old, &progress),
        write,
    )
}

fn stored(frames: RawFrames) -> Stored {
    match frames.format.kind().0 {
        crate::imaging::SampleKind::U8 => Stored::U8,
        crate::imaging::SampleKind::U16 => Stored::U16,
        crate::imaging::SampleKind::F32 => Stored::F32,
    }
}

fn map_of(shape: &MapShape, raster: Raster) -> Result<EnvironmentMap, ConvertError> {
    EnvironmentMap::new(shape.clone(), vec![raster])
        .map_err(|error| ConvertError::usage(error.to_string()))
}

/// What every frame is.
fn shape(
    frames: RawFrames,
    mapping: MappingId,
    hints: &OpenHints,
) -> Result<MapShape, ConvertError> {
    let usage = |line: String| ConvertError::usage(line);
    let layout = hints.layout.unwrap_or(mapping.info().layout);
    let [width, height] = frames.size;
    let [columns, rows] = layout.grid();
    if width % columns != 0 || height % rows != 0 {
        return Err(usage(format!(
            "{width} x {height} pixels are no {columns} x {rows} charts of `{mapping}`; check --raw and --from-layout"
        )));
    }
    let size = [width / columns, height / rows];
    let charts = MapShape::placements(mapping, layout, size).ok_or(ConvertError::Broken)?;
    let (samples, transfer, channels) = frames.format.kind();
    let mut shape = MapShape {
        mapping,
        size,
        charts,
        world_from_map: crate::mapping::Axes::IDENTITY,
        siting: Siting::Centre,
        channels,
        samples,
        transfer,
    };
    if let Some(frame) = hints.frame {
        let applied = shape.apply_frame(frame, layout);
        applied.map_err(|error| usage(error.to_string()))?;
    }
    if let Some(arrangement) = &hints.arrange {
        shape.arrange(arrangement);
    }
    if hints.mirrored {
        shape.mirror();
    }
    if let Some(siting) = hints.siting {
        shape.siting = siting;
    }
    Ok(shape)
}
