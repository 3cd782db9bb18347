//! What the window exports is what the equal command line makes, byte for byte.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::path::Path;
use std::process::Command;

use sixfold::app::export::{Export, Preset};
use sixfold::imaging::load::Format;
use sixfold::imaging::resample::{Filter, chart_size, equal_rows};
use sixfold::imaging::save::{Content, SaveOptions, save};
use sixfold::imaging::{
    Channels, Environment, OpenHints, Progress, Raster, Samples, Stored, Transfer,
};
use sixfold::mapping::{Layout, MappingId};
use sixfold::math::Rotation;

/// The files that an export writes, by name; none stays.
fn taken(export: &Export) -> Vec<Vec<u8>> {
    let take = |path: &std::path::PathBuf| {
        let bytes = std::fs::read(path).unwrap();
        std::fs::remove_file(path).unwrap();
        bytes
    };
    export.paths().iter().map(take).collect()
}

/// The files of the window's export.
fn written(export: &Export, environment: &Environment) -> Vec<Vec<u8>> {
    export.write(environment, &Progress::new()).unwrap();
    taken(export)
}

/// The files of the equal command line, as a shell runs it.
fn converted(export: &Export, environment: &Environment) -> Vec<Vec<u8>> {
    let line = export.command_line(&environment.id(), &environment.hints());
    let words = line.strip_prefix("sixfold ").unwrap();
    let shell = format!("'{}' {words}", env!("CARGO_BIN_EXE_sixfold"));
    let run = Command::new("sh").args(["-c", &shell]).output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{line}: {said}");
    taken(export)
}

/// The files, which are those of the equal line.
#[track_caller]
fn assert_equal(export: &Export, environment: &Environment) -> Vec<Vec<u8>> {
    let ours = written(export, environment);
    assert!(ours.iter().all(|bytes| bytes.len() > 100));
    let line = export.command_line(&environment.id(), &environment.hints());
    assert!(ours == converted(export, environment), "{line}");
    ours
}

/// Another size gives other files.
#[track_caller]
fn assert_told_apart(export: &Export, environment: &Environment) {
    let ours = assert_equal(export, environment);
    let other = Export {
        height: export.height + 2,
        ..export.clone()
    };
    assert!(ours != converted(&other, environment), "control");
}

/// A small latlong of floats in a folder.
fn sky(folder: &Path) -> Environment {
    let path = folder.join("sky.exr");
    let light = (0..64 * 32 * 3).map(|i| ((i * 37) % 101) as f32 / 40.0);
    let samples = Samples::F32(light.collect());
    let raster = Raster::new([64, 32], Channels::Rgb, Transfer::Linear, samples).unwrap();
    let options = SaveOptions::default();
    let content = Content::Raster(&raster);
    save(
        &path,
        true,
        content,
        Format::Exr,
        &options,
        &Progress::new(),
    )
    .unwrap();
    Environment::File(path.into())
}

/// Small files in a folder, turned by angles that are no round numbers.
fn small(folder: &Path, name: &str) -> Export {
    Export {
        height: 24,
        rotation: Rotation::from_degrees([33.3, -0.1, 171.7]),
        path: folder.join(name).display().to_string(),
        ..Export::default()
    }
}

#[test]
fn the_equal_line_makes_the_same_file_for_every_program() {
    let folder = tempfile::tempdir().unwrap();
    for preset in &Preset::ALL {
        let mut export = small(folder.path(), "it's for one program");
        export.set_preset(preset);
        assert_told_apart(&export, &Environment::Sunset);
    }
}

#[test]
fn openexr_maps_have_their_attribute_and_samples_on_the_borders() {
    let folder = tempfile::tempdir().unwrap();
    let environment = sky(folder.path());
    for (mapping, layout, is_marked) in [
        (MappingId::Latlong, Layout::Single, true),
        (MappingId::Cube, Layout::Column, true),
        (MappingId::Cube, Layout::Cross, false),
        (MappingId::Cube, Layout::Faces, false),
    ] {
        let mut export = Export {
            mapping,
            layout,
            frame: Some("openexr"),
            ..small(folder.path(), "map.exr")
        };
        export.mend();
        assert_told_apart(&export, &environment);
        let line = export.command_line("in", &OpenHints::default());
        assert_eq!(line.contains("--envmap"), is_marked, "{line}");
        let marked = |bytes: &[u8]| bytes.windows(7).any(|word| word == b"envmap\0");
        let files = written(&export, &environment);
        assert_eq!(files.iter().any(|bytes| marked(bytes)), is_marked);
        // Another program's file of this mapping is another one: control for what the frame does.
        let plain = Export {
            frame: None,
            ..export.clone()
        };
        assert!(written(&plain, &environment) != files);
    }
}

#[test]
fn every_choice_is_in_the_line() {
    let folder = tempfile::tempdir().unwrap();
    let plain = small(folder.path(), "map.exr");
    let environment = sky(folder.path());
    let first = written(&plain, &environment);
    for filter in Filter::ALL {
        let export = Export {
            filter: Some(filter),
            ..plain.clone()
        };
        // What is left to the plan is `bicubic` here.
        let is_same = assert_equal(&export, &environment) == first;
        assert_eq!(is_same, filter == Filter::Bicubic, "{filter:?}");
    }
    for (format, stored) in [
        (Format::Png, Stored::U8),
        (Format::Png, Stored::U16),
        (Format::Jpeg, Stored::U8),
        (Format::Dds, Stored::Rgb9e5),
        (Format::Ktx2, Stored::U8),
        (Format::Hdr, Stored::Rgbe),
    ] {
        let exports = [false, true].map(|dither| {
            let mut export = Export {
                format,
                stored,
                dither,
                has_levels: true,
                zstd: true,
                ..plain.clone()
            };
            export.mend();
            export
        });
        let files = exports.each_ref().map(|e| assert_equal(e, &environment));
        assert_eq!(files[0] != files[1], exports[1].can_dither(), "{format:?}");
    }
    let mut discs = Export {
        mapping: MappingId::Paraboloid,
        layout: Layout::Faces,
        ..plain
    };
    discs.mend();
    assert_eq!(discs.paths().len(), 2);
    assert_equal(&discs, &environment);
}

#[test]
fn files_and_fine_computed_maps_are_made_from_the_same_pixels() {
    let folder = tempfile::tempdir().unwrap();
    // Finer than the window shows it: computed anew.
    let fine = Export {
        mapping: MappingId::CylindricalEqualArea,
        layout: Layout::Single,
        height: 900,
        rotation: Rotation::NONE,
        ..small(folder.path(), "fine.hdr")
    };
    let mut fine = Export {
        format: Format::Hdr,
        ..fine
    };
    fine.mend();
    let computed = Environment::IcosahedronCrosses;
    let files = assert_equal(&fine, &computed);
    // As the window has it, it is another picture: control.
    let usual = computed.map(0, &Progress::new()).unwrap().0;
    let (shown, rows) = (usual.shape().size[1], 900);
    assert!(
        shown
            < equal_rows(
                MappingId::Latlong,
                fine.mapping,
                chart_size(fine.mapping, rows)
            )
    );
    assert_eq!(files.len(), 1);
    // A cross of bytes with opacity, which the window shows as a latlong of floats.
    let path = folder.path().join("cross with a space.png");
    let picture = image::RgbaImage::from_fn(64, 48, |x, y| {
        image::Rgba([(4 * x) as u8, (5 * y) as u8, (x * y) as u8, 255 - x as u8])
    });
    picture.save(&path).unwrap();
    let hints = OpenHints {
        mapping: Some(MappingId::Eac),
        ..OpenHints::default()
    };
    let mut file = sixfold::imaging::MapFile::from(path);
    file.hints = hints;
    let environment = Environment::File(file);
    for format in [Format::Png, Format::Exr, Format::Jpeg] {
        let mut export = Export {
            format,
            ..small(folder.path(), "again.png")
        };
        export.mend();
        assert_equal(&export, &environment);
    }
}
