//! Maps from files: told, hinted, put together from six, refused.

use std::path::{Path, PathBuf};

use sixfold::imaging::load::Format;
use sixfold::imaging::save::{Content, SaveOptions, format_of_path, save};
use sixfold::imaging::{
    Channels, Container, EnvmapKind, Level, OpenHints, OpenedMap, Progress, Raster, Samples,
    Siting, Stored, Transfer, open_map,
};
use sixfold::mapping::{Layout, MappingId};
use sixfold::math::Vec3;

use crate::scenes::{Laid, in_8_bits, photograph};

fn write(path: &Path, content: Content, envmap: Option<EnvmapKind>) {
    let options = SaveOptions {
        envmap,
        ..SaveOptions::default()
    };
    let format = format_of_path(path).unwrap();
    save(path, true, content, format, &options, &Progress::new()).unwrap();
}

fn open(path: &Path, hints: &OpenHints) -> Result<OpenedMap, String> {
    open_map(&[path.to_owned()], hints, &Progress::new()).map_err(|error| error.to_string())
}

fn faces() -> Vec<Raster> {
    let laid = Laid::new(MappingId::Cube, Layout::Faces, 24);
    laid.draw(&laid.shape(), photograph)
}

#[test]
fn every_mapping_opens_in_every_layout_when_it_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    for mapping in MappingId::ALL.iter().copied() {
        let charts = mapping.info().chart_count();
        let layouts = Layout::ALL.into_iter();
        for layout in layouts.filter(|l| l.holds(charts) && *l != Layout::Faces) {
            let laid = Laid::new(mapping, layout, 24);
            let pictures = laid.draw(&laid.shape(), photograph);
            write(&path, Content::Raster(&pictures[0]), None);
            let hints = OpenHints {
                mapping: Some(mapping),
                layout: Some(layout),
                siting: Some(Siting::Centre),
                ..OpenHints::default()
            };
            let opened = open(&path, &hints).unwrap();
            assert_eq!(
                (opened.chosen.mapping, opened.chosen.layout),
                (mapping, layout)
            );
            assert_eq!(opened.map.rasters(), pictures);
            // Unsaid, a square picture is not told.
            let unsaid = open(&path, &OpenHints::default());
            if charts == 1 && laid.size[0] == laid.size[1] {
                let error = unsaid.unwrap_err();
                assert!(error.contains("may be") && !error.contains('\n'), "{error}");
            } else if mapping == MappingId::Latlong || mapping == MappingId::Cube {
                assert_eq!(
                    unsaid.unwrap().chosen.layout,
                    layout,
                    "{mapping} {layout:?}"
                );
            }
        }
    }
}

/// Two discs are told by their empty corners, whatever the format has made of their texels.
#[test]
fn two_discs_open_without_hints_from_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for layout in [Layout::Pair, Layout::PairColumn] {
        let laid = Laid::new(MappingId::Paraboloid, layout, 64);
        let light = laid.draw(&laid.shape(), photograph).remove(0);
        let codes = in_8_bits(&light);
        for (name, raster) in [
            ("a.exr", &light),
            ("a.hdr", &light),
            ("a.png", &codes),
            ("a.jpg", &codes),
        ] {
            let path = folder.path().join(name);
            write(&path, Content::Raster(raster), None);
            let opened = open(&path, &OpenHints::default()).unwrap();
            let found = (opened.chosen.mapping, opened.chosen.layout);
            assert_eq!(found, (MappingId::Paraboloid, layout), "{name}");
            // Right way round: the middle of the second disc looks back.
            let exact = photograph(Vec3::new(0.0, 0.0, -1.0));
            let shown = opened.map.light(1, [32, 32]);
            let off = (0..3).map(|c| (shown[c] - exact[c]).abs());
            assert!(
                off.fold(0.0, f32::max) < 0.05,
                "{name}: {shown:?}, {exact:?}"
            );
        }
        // Control: with light in all corners two squares are no discs.
        let path = folder.path().join("a.exr");
        write(&path, Content::Raster(&with_full_corners(&light)), None);
        let opened = open(&path, &OpenHints::default());
        assert!(opened.is_err() || opened.unwrap().chosen.mapping != MappingId::Paraboloid);
    }
}

/// The same picture with something in the corners of its squares.
fn with_full_corners(raster: &Raster) -> Raster {
    let [width, height] = raster.size();
    let side = width.min(height);
    let Samples::F32(mut samples) = raster.samples().clone() else {
        panic!("floats")
    };
    for (i, sample) in samples.iter_mut().enumerate() {
        let at = i as u32 / 3;
        let place =
            [at % width % side, at / width % side].map(|c| f64::from(c) / f64::from(side) - 0.5);
        if place[0].hypot(place[1]) > 0.5 {
            *sample = photograph(Vec3::new(
                place[0] * 5.0,
                place[1] * 5.0,
                f64::from(at) * 0.01,
            ))[i % 3];
        }
    }
    Raster::new(
        raster.size(),
        Channels::Rgb,
        Transfer::Linear,
        Samples::F32(samples),
    )
    .unwrap()
}

#[test]
fn openexr_and_containers_say_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    for (mapping, layout, kind) in [
        (MappingId::Latlong, Layout::Single, EnvmapKind::Latlong),
        (MappingId::Cube, Layout::Column, EnvmapKind::Cube),
    ] {
        let laid = Laid::new(mapping, layout, 24);
        let pictures = laid.draw(&laid.shape(), photograph);
        write(&path, Content::Raster(&pictures[0]), Some(kind));
        let opened = open(&path, &OpenHints::default()).unwrap();
        assert_eq!(opened.chosen.frame.map(|frame| frame.id), Some("openexr"));
        assert_eq!(opened.map.shape().siting, Siting::Edge);
        write(&path, Content::Raster(&pictures[0]), None);
        let plain = open(&path, &OpenHints::default()).unwrap();
        assert_eq!(plain.map.shape().siting, Siting::Centre);
    }
    for format in [Format::Ktx2, Format::Dds] {
        let path = folder.path().join(if format == Format::Dds {
            "a.dds"
        } else {
            "a.ktx2"
        });
        let container = Container {
            levels: vec![Level { rasters: faces() }],
            stored: Stored::F32,
            format,
        };
        write(&path, Content::Container(&container), None);
        let opened = open(&path, &OpenHints::default()).unwrap();
        assert_eq!(opened.chosen.layout, Layout::Faces);
        assert_eq!(opened.map.shape().charts.len(), 6);
        assert!(opened.notes.is_empty(), "{:?}", opened.notes);
    }
}

const SETS: [[&str; 6]; 7] = [
    ["px", "nx", "py", "ny", "pz", "nz"],
    ["PosX", "negx", "posy", "negy", "posz", "negz"],
    ["right", "left", "top", "bottom", "front", "back"],
    ["Right", "left", "up", "down", "front", "back"],
    ["+x", "-x", "+y", "-y", "+z", "-z"],
    ["rt", "lf", "up", "dn", "ft", "bk"],
    ["r", "l", "u", "d", "f", "b"],
];

fn write_set(folder: &Path, set: &[&str; 6]) -> Vec<PathBuf> {
    let paths = set
        .iter()
        .map(|face| folder.join(format!("sky_{face}.exr")));
    let paths: Vec<PathBuf> = paths.collect();
    for (path, face) in paths.iter().zip(faces()) {
        write(path, Content::Raster(&face), None);
    }
    paths
}

#[test]
fn six_files_are_found_by_their_names() {
    for set in &SETS {
        let folder = tempfile::tempdir().unwrap();
        let paths = write_set(folder.path(), set);
        let by_place = open(&folder.path().join("sky_%f.exr"), &OpenHints::default()).unwrap();
        assert_eq!(by_place.map.rasters(), faces());
        let by_one = open(&paths[3], &OpenHints::default());
        if set[0] == "r" {
            assert!(by_one.is_err(), "a letter is no name by itself");
        } else {
            assert_eq!(by_one.unwrap().map, by_place.map);
        }
        std::fs::remove_file(&paths[5]).unwrap();
        assert!(open(&paths[3], &OpenHints::default()).is_err());
        assert!(open(&folder.path().join("sky_%f.exr"), &OpenHints::default()).is_err());
    }
}

#[test]
fn faces_that_do_not_fit_are_noted_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let paths = write_set(folder.path(), &SETS[0]);
    let about = |opened: &OpenedMap| opened.notes.iter().any(|note| note.contains("as labelled"));
    let opened = open(&paths[0], &OpenHints::default()).unwrap();
    assert!(!about(&opened), "{:?}", opened.notes);
    write(&paths[0], Content::Raster(&faces()[2]), None);
    write(&paths[2], Content::Raster(&faces()[0]), None);
    let opened = open(&paths[0], &OpenHints::default()).unwrap();
    assert!(about(&opened), "{:?}", opened.notes);
    let small = Laid::new(MappingId::Cube, Layout::Faces, 12);
    let small = &small.draw(&small.shape(), photograph)[0];
    write(&paths[4], Content::Raster(small), None);
    let error = open(&paths[0], &OpenHints::default()).unwrap_err();
    assert!(error.contains("the faces differ: 12 x 12"), "{error}");
}

#[test]
fn what_is_said_of_the_faces_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let paths = write_set(folder.path(), &SETS[0]);
    let plain = open(&paths[0], &OpenHints::default()).unwrap();
    let exr = sixfold::mapping::Frame::from_id("openexr").unwrap();
    let mut hints = OpenHints {
        frame: Some(exr),
        transfer: Some(Transfer::Srgb),
        ..OpenHints::default()
    };
    let framed = open(&paths[0], &hints).unwrap();
    let (was, is) = (plain.map.shape(), framed.map.shape());
    assert_eq!((is.siting, is.transfer), (Siting::Edge, Transfer::Srgb));
    assert_eq!((is.charts[4], is.charts[5]), (was.charts[5], was.charts[4]));
    // An arrangement stands in place of the frame's own.
    hints.arrange = Some(sixfold::mapping::Arrangement::IDENTITY);
    let arranged = open(&paths[0], &hints).unwrap();
    assert_eq!(arranged.map.shape().charts, was.charts);
}
