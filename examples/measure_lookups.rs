//! What a picture of lookups costs on the graphics adapter, beside a plain cube lookup of the same size: `ccm` through the cube
//! unit and by own arithmetic, with the errors of each.
//!
//! `cargo run --release --example measure_lookups [WIDTHxHEIGHT]`; without a size 3840x2160, on a software adapter 640x360, where
//! the times say how the ways compare on that processor and nothing of a GPU.

use std::error::Error;
use std::io::Write;
use std::time::Duration;

use sixfold::gpu::lookups::Lookups;
use sixfold::gpu::{EnvironmentSource, Gpu, ShaderDevice};
use sixfold::imaging::Progress;
use sixfold::lab::bench::{Plan, Way, bench};
use sixfold::lab::devices::Devices;
use sixfold::mapping::{ChartPoint, MappingId, ShaderForm};

/// Faces of 1024 x 1024.
const TEXEL_BUDGET: u32 = 6 * 1024 * 1024;
/// Width and height of the latlong that the maps are filled from.
const ENVIRONMENT: [u32; 2] = [1024, 512];
const SAMPLES: usize = 21;
const SHORTEST: Duration = Duration::from_millis(5);

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::headless()?;
    let is_software = gpu.adapter_info.device_type == wgpu::DeviceType::Cpu;
    let usual = if is_software { "640x360" } else { "3840x2160" };
    let size = std::env::args().nth(1).unwrap_or_else(|| usual.to_owned());
    let (width, height) = size.split_once('x').ok_or("a size is WIDTHxHEIGHT")?;
    let size_px = [width.parse()?, height.parse()?];

    let device = ShaderDevice::on(gpu.clone());
    let maps = vec![MappingId::Cube, MappingId::Ccm];
    let plan = Plan {
        maps,
        devices: Devices::Gpu,
        ..Plan::quick()
    };
    let errors = bench(&plan, &device, &Progress::new());
    if let Some(fault) = errors.faults.first() {
        return Err(fault.clone().into());
    }

    let [columns, rows] = ENVIRONMENT;
    let pixel = |k: u32| {
        let at = |k: u32, n: u32| (f64::from(k) + 0.5) / f64::from(n);
        let place = ChartPoint::new(0, at(k % columns, columns), at(k / columns, rows));
        let dir = MappingId::Latlong.inverse(place);
        dir.map_or([0.0; 3], |dir| dir.to_f64().map(|c| (0.5 + 0.5 * c) as f32))
    };
    let pixels: Vec<[f32; 3]> = (0..columns * rows).map(pixel).collect();
    let environment = EnvironmentSource {
        width: columns,
        height: rows,
        pixels: &pixels,
    };
    let name = gpu.name();
    let mut out = std::io::stdout().lock();
    let mut lookups = Lookups::new(gpu, environment, TEXEL_BUDGET, size_px)?;
    writeln!(out, "{name}, {size}: medians of {SAMPLES}")?;
    writeln!(
        out,
        "map   form             ns/pixel  times the plain lookup  max error in texels of 1024"
    )?;
    let plain = (MappingId::Cube, ShaderForm::CubeUnit);
    for id in [MappingId::Cube, MappingId::Ccm] {
        for form in id.forms() {
            let times = lookups.time([(id, form), plain], SAMPLES, SHORTEST)?;
            let ns = median(times.iter().map(|time| time.work_ns));
            let ratio = median(times.iter().map(|time| time.work_ns / time.copy_ns));
            let own = errors.rows.iter().find(|row| {
                let is_forward = row.direction == Way::Forward;
                is_forward && row.mapping == id.info().id && row.evaluator == form.id()
            });
            let error = own.map_or(f64::NAN, |row| row.max_error_texels);
            let ns = ns / lookups.pixels() as f64;
            writeln!(
                out,
                "{id:<5} {form:<15} {ns:>9.3} {ratio:>23.2} {error:>28.1e}",
                id = id.to_string(),
                form = form.id()
            )?;
        }
    }
    Ok(())
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
