//! The making of an export: the conversion, the file, and how fast a small one like it is made.

use std::time::Instant;

use super::Export;
use crate::imaging::atomic::check_name;
use crate::imaging::load::Format;
use crate::imaging::opacity::OpacityWay;
use crate::imaging::resample::{Conversion, Plan, equal_rows, levels};
use crate::imaging::save::{Content, SaveError, SaveOptions, encode, save};
use crate::imaging::{
    Channels, Container, Environment, EnvironmentMap, Image, MapShape, Progress, SampleKind,
    Siting, Stored, Transfer,
};
use crate::mapping::{Frame, MappingId};

impl Export {
    /// The same as `sixfold convert` makes of [`Export::command_line`].
    fn conversion(&self, source: &MapShape) -> Result<Conversion, String> {
        let frame = self.frame.map(Frame::from_id).transpose();
        let frame = frame.map_err(|error| error.to_string())?;
        let samples = self.stored.kind();
        let is_opaque = matches!(self.format, Format::Hdr | Format::Jpeg);
        let plain = Conversion::new(self.mapping, self.size(), source);
        Ok(Conversion {
            layout: self.layout,
            rotation: self.rotation.source_from_world(),
            frame,
            siting: match frame {
                Some(frame) if frame.is_edge_sited => Siting::Edge,
                _ => Siting::Centre,
            },
            filter: self.filter,
            dither: self.dither,
            samples,
            transfer: match samples {
                SampleKind::F32 => Transfer::Linear,
                SampleKind::U8 | SampleKind::U16 => Transfer::Srgb,
            },
            channels: if is_opaque || self.stored == Stored::Rgb9e5 {
                Channels::Rgb
            } else {
                source.channels
            },
            ..plain
        })
    }

    /// Converts the environment and writes the file, or the six files.
    ///
    /// # Errors
    /// One line that says what failed; the file is not there then, unless it was before.
    pub fn write(&self, environment: &Environment, progress: &Progress) -> Result<(), String> {
        for path in self.paths() {
            check_name(&path, self.force).map_err(|error| error.to_string())?;
        }
        let rows = equal_rows(MappingId::Latlong, self.mapping, self.size());
        let source = environment.map(rows, progress);
        let (source, from, _) = source.map_err(|error| error.to_string())?;
        let options = self.save_options();
        self.make(source, from, progress, |index, content| {
            let path = &self.paths()[index];
            save(path, self.force, content, self.format, &options, progress)
        })
    }

    fn save_options(&self) -> SaveOptions {
        SaveOptions {
            stored: Some(self.stored),
            zstd: self.zstd,
            envmap: self.envmap(),
            ..SaveOptions::default()
        }
    }

    /// Converts `source`, from a file of the format `from`, and gives what each file holds to `put`, with the file's index in [`Export::paths`].
    fn make(
        &self,
        source: EnvironmentMap,
        from: Format,
        progress: &Progress,
        mut put: impl FnMut(usize, Content<'_>) -> Result<(), SaveError>,
    ) -> Result<(), String> {
        let said = |error: &dyn std::fmt::Display| error.to_string();
        let conversion = self.conversion(source.shape())?;
        let plan = Plan::new(source.shape(), &conversion).map_err(|e| said(&e))?;
        let from = (from, source.shape());
        let way = OpacityWay::new(from, self.format, &conversion, &plan);
        let converted = plan.run(&way.straight(&source), progress);
        let (mut map, _) = converted.map_err(|e| said(&e))?;
        drop(source);
        way.finish(&mut map);
        if self.format.is_container() {
            let maps = if self.has_levels {
                levels(map, &conversion, progress).map_err(|e| said(&e))?
            } else {
                vec![map]
            };
            let container = Container::of_maps(maps, self.stored, self.format);
            return put(0, Content::Container(&container)).map_err(|e| said(&e));
        }
        for (index, raster) in map.rasters().iter().enumerate() {
            put(index, Content::Raster(raster)).map_err(|e| said(&e))?;
        }
        Ok(())
    }

    /// Texels a second at which such an export is made here, found by making a small one in memory. Its texels cover as many
    /// of the picture's as those of the whole one, so that the filter has as much to do.
    ///
    /// # Errors
    /// As [`Export::write`], for what the small one shares with the whole one.
    pub fn measured_rate(&self, image: &Image, progress: &Progress) -> Result<f64, String> {
        /// Texels of the small one: a few hundredths of a second's work, so that starting threads weighs little.
        const TEXELS: f64 = 4e5;
        /// Runs, of which the fastest counts: what else the machine does only makes them slower.
        const RUNS: usize = 2;
        let stride = (self.texels() as f64 / TEXELS).sqrt().ceil().max(1.0) as u32;
        let small = Self {
            height: (self.height / stride).max(1),
            ..self.clone()
        };
        let thin = thinned(image, stride).ok_or("the environment has no texels")?;
        let options = small.save_options();
        let mut least = f64::INFINITY;
        for _ in 0..RUNS {
            let source = EnvironmentMap::of_latlong(&thin).map_err(|error| error.to_string())?;
            let start = Instant::now();
            small.make(source, Format::Exr, progress, |_, content| {
                encode(content, small.format, &options, progress).map(drop)
            })?;
            least = least.min(start.elapsed().as_secs_f64());
        }
        Ok(small.texels() as f64 / least)
    }
}

/// Every `stride`-th texel of every `stride`-th row; `None` when none is left.
fn thinned(image: &Image, stride: u32) -> Option<Image> {
    let [columns, rows] = [image.width(), image.height()].map(|n| n / stride);
    let texels = (0..rows)
        .flat_map(|y| (0..columns).filter_map(move |x| image.texel(x * stride, y * stride)));
    Image::new(columns, rows, texels.collect()).ok()
}
