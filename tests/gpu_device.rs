//! The device: found on every driver, lost and refused without a panic.

#![cfg(feature = "explorer")]

use std::path::Path;

use sixfold::gpu::{Gpu, GpuEvaluator};
use sixfold::mapping::{DirList, Evaluator, MappingId, PointList};

#[test]
fn every_driver_of_this_machine_is_tested() {
    let gpus = Gpu::on_every_adapter().unwrap();
    let names: Vec<String> = gpus.iter().map(Gpu::name).collect();
    println!("adapters: {names:?}");
    assert!(!names.is_empty());
    for gpu in &gpus {
        let side = gpu.device.limits().max_texture_dimension_2d;
        assert!((8192..=16_384).contains(&side), "{}: {side}", gpu.name());
    }
    let has = |backend| gpus.iter().any(|g| g.adapter_info.backend == backend);
    for (folder, backend) in [
        ("/usr/share/vulkan/icd.d", wgpu::Backend::Vulkan),
        ("/usr/share/glvnd/egl_vendor.d", wgpu::Backend::Gl),
    ] {
        // WGPU_BACKEND narrows the choice, and then only what it names must be there.
        let asked = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::all());
        if !asked.contains(wgpu::Backends::from(backend)) {
            assert!(
                !has(backend),
                "{backend} was found although it was not asked for"
            );
            continue;
        }
        let installed = Path::new(folder)
            .read_dir()
            .is_ok_and(|mut files| files.next().is_some());
        assert!(
            !installed || has(backend),
            "{folder} has a driver, but {backend} has no adapter"
        );
    }
}

#[test]
fn no_adapter_ends_in_advice() {
    let error = Gpu::open(&[wgpu::Backends::empty()])
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("install") && error.contains("WGPU_BACKEND"),
        "{error}"
    );
    assert!(!error.contains('\n'));
}

#[test]
fn a_lost_device_ends_in_an_error() {
    let gpu = Gpu::headless().unwrap();
    let shader = GpuEvaluator::new(&gpu, MappingId::Cube).unwrap();
    let dirs = DirList::from_iter([[1.0, 2.0, 3.0]; 64]);
    let mut found = PointList::zeros(64);
    shader.forward(dirs.view(), found.view_mut()).unwrap();
    assert!(!gpu.is_lost());
    gpu.device.destroy();
    assert!(shader.forward(dirs.view(), found.view_mut()).is_err());
    assert!(gpu.is_lost() && gpu.clone().is_lost());
    assert!(GpuEvaluator::new(&gpu, MappingId::Cube).is_err());
    assert!(!Gpu::headless().unwrap().is_lost());
}

#[test]
fn an_error_that_nobody_catches_is_kept() {
    let gpu = Gpu::headless().unwrap();
    assert_eq!(gpu.take_error(), None);
    let too_large = |side| wgpu::TextureDescriptor {
        label: Some("too large"),
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let _ = gpu.device.create_texture(&too_large(1 << 20));
    assert!(gpu.take_error().unwrap().contains("too large"));
    assert_eq!(gpu.take_error(), None);
    assert!(
        gpu.checked(|device| device.create_texture(&too_large(1 << 20)))
            .is_err()
    );
    assert_eq!(gpu.take_error(), None, "caught before");
    assert!(
        gpu.checked(|device| device.create_texture(&too_large(1 << 4)))
            .is_ok()
    );
    assert!(!gpu.is_lost());
}
