//! One map after another: converted by one plan, written in one format.

use std::path::PathBuf;
use std::time::Instant;

use super::ends::FilesOut;
use super::error::ConvertError;
use super::report::Times;
use super::source::Source;
use super::task::{Target, Task};
use crate::imaging::load::Format;
use crate::imaging::opacity::OpacityWay;
use crate::imaging::resample::{Conversion, Plan, Report, levels};
use crate::imaging::save::{Content, SaveOptions, save};
use crate::imaging::{Container, EnvironmentMap, MapShape, Progress, Stored};

/// Converts maps; a plan is remade only when the shape changes.
pub(super) struct Converter<'a> {
    task: &'a Task,
    current: Option<Current>,
    pub times: Times,
    /// Of the last map.
    pub report: Option<Report>,
}

/// What is prepared for maps of one shape.
struct Current {
    shape: MapShape,
    stored: Stored,
    target: Target,
    plan: Plan,
}

impl<'a> Converter<'a> {
    /// Nothing is prepared yet.
    pub fn new(task: &'a Task) -> Self {
        Self {
            task,
            current: None,
            times: Times::default(),
            report: None,
        }
    }

    /// Prepares for maps of this shape; says how they are converted.
    pub fn prepare(&mut self, shape: &MapShape, stored: Stored) -> Result<&Target, ConvertError> {
        let fits = |current: &Current| current.shape == *shape && current.stored == stored;
        if !self.current.as_ref().is_some_and(fits) {
            let start = Instant::now();
            let target = self.task.target(shape, stored)?;
            let plan = Plan::new(shape, &target.conversion)?;
            self.times.plan += start.elapsed();
            self.current = Some(Current {
                shape: shape.clone(),
                stored,
                target,
                plan,
            });
        }
        let current = self.current.as_ref().ok_or(ConvertError::Broken)?;
        Ok(&current.target)
    }

    /// Converts the map of a file, as [`Converter::convert`] does, for a file of the format `to`.
    pub fn convert_file(
        &mut self,
        source: &Source,
        to: Format,
        old: Option<EnvironmentMap>,
        progress: &Progress,
    ) -> Result<EnvironmentMap, ConvertError> {
        let current = self.current.as_ref().ok_or(ConvertError::Broken)?;
        let from = (source.format, source.map.shape());
        let way = OpacityWay::new(from, to, &current.target.conversion, &current.plan);
        let mut result = self.convert(&way.straight(&source.map), old, progress)?;
        way.finish(&mut result);
        Ok(result)
    }

    /// Converts a map of the shape that is prepared, into `old` where that has the result's shape.
    pub fn convert(
        &mut self,
        map: &EnvironmentMap,
        old: Option<EnvironmentMap>,
        progress: &Progress,
    ) -> Result<EnvironmentMap, ConvertError> {
        let plan = &self.current.as_ref().ok_or(ConvertError::Broken)?.plan;
        let old = old.filter(|old| old.shape() == plan.target());
        let mut result = old.map_or_else(|| plan.black(), Ok)?;
        for _ in 0..self.task.repeat() {
            let start = Instant::now();
            let report = plan.run_into(map, &mut result, progress)?;
            self.times.resample.push(start.elapsed());
            self.report = Some(report);
        }
        Ok(result)
    }
}

/// Everything about the files of a map but its pixels.
pub(super) struct Files {
    pub paths: Vec<PathBuf>,
    pub conversion: Conversion,
    pub save: SaveOptions,
}

impl FilesOut {
    /// Writes a map; what stays of it can be filled anew.
    pub fn write(
        &self,
        map: EnvironmentMap,
        files: &Files,
        mips: bool,
        progress: &Progress,
    ) -> Result<Option<EnvironmentMap>, ConvertError> {
        let write = |path: &PathBuf, content| {
            save(
                path,
                self.force,
                content,
                self.format,
                &files.save,
                progress,
            )
        };
        if !self.format.is_container() {
            for (path, raster) in files.paths.iter().zip(map.rasters()) {
                write(path, Content::Raster(raster))?;
            }
            return Ok(Some(map));
        }
        let maps = if mips {
            levels(map, &files.conversion, progress)?
        } else {
            vec![map]
        };
        let stored = files.save.stored.unwrap_or(Stored::F32);
        let container = Container::of_maps(maps, stored, self.format);
        for path in &files.paths {
            write(path, Content::Container(&container))?;
        }
        Ok(None)
    }
}
