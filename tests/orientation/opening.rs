//! Maps from files: told, hinted, put together from six, refused.

use std::path::{Path, PathBuf};

use sixfold::imaging::load::{Format, LoadProblem};
use sixfold::imaging::save::{Content, SaveOptions, format_of_path, save};
use sixfold::imaging::srgb::linear_from_srgb8;
use sixfold::imaging::{
    Channels, Container, Environment, EnvmapKind, FACE_COLORS, Level, MapFile, OpenHints,
    OpenedMap, Pictures, Preview, Progress, Raster, Samples, Siting, Stored, Transfer, face_name,
    open_map,
};
use sixfold::mapping::{Arrangement, Frame, Layout, MappingId};
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

/// The mapping's name is enough for a picture as an export lays it, and for a file of each chart.
#[test]
fn a_named_mapping_opens_as_it_is_exported() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, part) = (
        folder.path().join("map.exr"),
        folder.path().join("m_%f.exr"),
    );
    for mapping in MappingId::ALL.iter().copied() {
        let info = mapping.info();
        let hints = OpenHints {
            mapping: Some(mapping),
            siting: Some(Siting::Centre),
            ..OpenHints::default()
        };
        let laid = Laid::new(mapping, info.layout, 24);
        let pictures = laid.draw(&laid.shape(), photograph);
        write(&whole, Content::Raster(&pictures[0]), None);
        let opened = open(&whole, &hints).unwrap();
        assert_eq!(opened.chosen.layout, info.layout, "{mapping}");
        assert_eq!(opened.map.rasters(), pictures);
        if info.charts.len() == 1 {
            continue;
        }
        let laid = Laid::new(mapping, Layout::Faces, 24);
        let pictures = laid.draw(&laid.shape(), photograph);
        let files = info.charts.iter().map(|chart| {
            let name = format!("m_{}.exr", face_name(chart));
            folder.path().join(name)
        });
        let files: Vec<PathBuf> = files.collect();
        for (file, picture) in files.iter().zip(&pictures) {
            write(file, Content::Raster(picture), None);
        }
        let opened = open(&part, &hints).unwrap();
        assert_eq!(opened.chosen.layout, Layout::Faces, "{mapping}");
        assert_eq!(opened.map.rasters(), pictures);
        // Control: without the last chart's file it is said which one is missing.
        let last = files.last().unwrap();
        std::fs::remove_file(last).unwrap();
        let error = open(&part, &hints).unwrap_err();
        let name = last.file_name().unwrap().to_str().unwrap();
        assert!(
            error.contains("one is not there") && error.contains(name),
            "{error}"
        );
    }
    // Control: what has not the shape is refused.
    let laid = Laid::new(MappingId::Paraboloid, Layout::Pair, 24);
    write(
        &whole,
        Content::Raster(&laid.draw(&laid.shape(), photograph)[0]),
        None,
    );
    for mapping in [MappingId::Healpix, MappingId::Cube] {
        let hints = OpenHints {
            mapping: Some(mapping),
            ..OpenHints::default()
        };
        let error = open(&whole, &hints).unwrap_err();
        assert!(
            error.contains(&format!("cannot be `{mapping}`;")),
            "{error}"
        );
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

#[test]
fn pictures_are_decoded_once_and_taken_in_any_way() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    let laid = Laid::new(MappingId::Octahedral, Layout::Single, 48);
    let pictures = laid.draw(&laid.shape(), photograph);
    write(&path, Content::Raster(&pictures[0]), None);
    let paths = [path.clone()];
    let nothing = OpenHints::default();
    let read = Pictures::read(&paths, &nothing, &Progress::new()).unwrap();
    std::fs::remove_file(&path).unwrap();
    // A window and the command line say what to do about it in their own words.
    let error = read.taken(&nothing).unwrap_err();
    assert!(matches!(error.problem, LoadProblem::Untold(_)), "{error}");
    assert!(!error.to_string().contains("--"), "{error}");
    for proposal in read.proposals() {
        let said = proposal.hints(&nothing);
        let opened = read.taken(&said).unwrap();
        assert_eq!(opened.chosen.mapping, proposal.mapping);
        // What was chosen, said in full, is chosen again.
        let again = read.taken(&opened.chosen.hints(&said)).unwrap();
        assert_eq!(again.map, opened.map);
        assert!(read.are_of(&paths, &said));
    }
    let coded = OpenHints {
        transfer: Some(Transfer::Srgb),
        ..nothing
    };
    assert!(!read.are_of(&paths, &coded), "it is decoded in another way");
    let six = write_set(folder.path(), &SETS[0]);
    let all = Pictures::read(&six[..1], &nothing, &Progress::new()).unwrap();
    let alone = OpenHints {
        mapping: Some(MappingId::Octahedral),
        ..nothing
    };
    assert!(all.are_of(&six[3..4], &nothing) && !all.are_of(&six[..1], &alone));
}

#[test]
fn an_order_goes_into_the_arrangement() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("row.exr");
    let laid = Laid::new(MappingId::Cube, Layout::Row, 16);
    let pictures = laid.draw(&laid.shape(), photograph);
    write(&path, Content::Raster(&pictures[0]), None);
    let frame = Frame::from_id("py360convert").unwrap();
    let arrangement: Arrangement = "+z,-x,+y:180,-y,+x:mirrored:90,-z".parse().unwrap();
    let charts = |frame, arrange| {
        let hints = OpenHints {
            frame,
            arrange: Some(arrange),
            ..OpenHints::default()
        };
        open(&path, &hints).unwrap().map.shape().charts.clone()
    };
    let both = charts(Some(frame), arrangement);
    let order = frame.order(Layout::Row).unwrap();
    assert_eq!(charts(None, arrangement.by_place(order)), both);
    assert_ne!(charts(None, arrangement), both);
    assert_eq!(frame.order(Layout::Cross), None);
}

#[test]
fn a_mirror_image_shows_at_no_seam_but_in_the_pictures_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let paths = write_set(folder.path(), &SETS[0]);
    let read = Pictures::read(&paths, &OpenHints::default(), &Progress::new()).unwrap();
    let opened = |mirrored| {
        let hints = OpenHints {
            mapping: Some(MappingId::Cube),
            mirrored,
            ..OpenHints::default()
        };
        read.taken(&hints).unwrap()
    };
    let (right, mirrored) = (opened(false), opened(true));
    assert!(right.is_sure() && mirrored.is_sure());
    assert_eq!(right.chosen.score, mirrored.chosen.score);
    let cross = |opened: &OpenedMap| Preview::of(&opened.map, &Progress::new()).unwrap().cross;
    let (right, mirrored) = (cross(&right), cross(&mirrored));
    let [width, _] = right.size();
    let face = width / 4;
    // The middle column of four cells is ahead; what is left of it in one is right of it in the other.
    let mut differ = 0.0f32;
    for (x, y) in [(20, 20), (70, 30), (10, 80)] {
        let ahead = |x| face + x;
        let here = right.light(ahead(x), face + y);
        let there = mirrored.light(ahead(face - 1 - x), face + y);
        let same = mirrored.light(ahead(x), face + y);
        for i in 0..3 {
            assert!((here[i] - there[i]).abs() < 0.01, "{here:?} {there:?}");
            differ = differ.max((here[i] - same[i]).abs());
        }
    }
    assert!(differ > 0.05, "{differ}");
}

#[test]
fn the_labelled_pictures_have_each_face_in_its_place() {
    let preview = Preview::labelled(&Progress::new()).unwrap();
    let face = preview.cross.size()[0] / 4;
    for (cell, color) in Layout::Cross.cells().iter().zip(FACE_COLORS) {
        // Between the letters and the border.
        let at = cell.at.map(|place| place * face + face * 2 / 5);
        let light = preview.cross.light(at[0], at[1] - face / 4);
        let expected = linear_from_srgb8(color);
        for i in 0..3 {
            assert!((light[i] - expected[i]).abs() < 0.03, "{:?}", cell.at);
        }
    }
    // The ball's middle shows what is behind the viewer, its right what is at the right.
    let ball = &preview.ball;
    let side = ball.size()[0];
    let near = |light: [f32; 4], face: usize| {
        let expected = linear_from_srgb8(FACE_COLORS[face]);
        (0..3).all(|i| (light[i] - expected[i]).abs() < 0.1)
    };
    let at =
        |x: f64, y: f64| ball.light((x * f64::from(side)) as u32, (y * f64::from(side)) as u32);
    assert!(near(at(0.5, 0.4), 5) && near(at(0.8, 0.4), 0) && near(at(0.4, 0.2), 2));
    assert!(!near(at(0.2, 0.4), 0));
}

#[test]
fn what_is_shown_of_a_file_is_what_it_was_taken_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    let shown = |hints| {
        let path = path.clone();
        Environment::File(MapFile { path, hints }).image(&Progress::new())
    };
    // A latlong keeps its texels, and what was wrong with them.
    let laid = Laid::new(MappingId::Latlong, Layout::Single, 24);
    let mut picture = laid.draw(&laid.shape(), photograph).remove(0);
    if let Samples::F32(samples) = picture.samples_mut() {
        (samples[5], samples[7]) = (f32::NAN, -1.0);
    }
    write(&path, Content::Raster(&picture), None);
    let loaded = shown(OpenHints::default()).unwrap();
    assert_eq!((loaded.bad.nan, loaded.bad.negative), (1, 1));
    assert!(loaded.originals.get(1).unwrap()[2].is_nan());
    assert_eq!(loaded.originals.get(2).unwrap()[1], -1.0);
    let kept = picture.light(30, 11);
    assert_eq!(
        loaded.image.texel(30, 11).unwrap(),
        [kept[0], kept[1], kept[2]]
    );
    // What the file says of its axes holds, unless the user knows better.
    let openexr = Frame::from_id("openexr").unwrap();
    let mut truly = laid.shape();
    truly.apply_frame(openexr, Layout::Single).unwrap();
    let picture = laid.draw(&truly, photograph).remove(0);
    write(&path, Content::Raster(&picture), Some(EnvmapKind::Latlong));
    let apart = |hints| {
        let image = shown(hints).unwrap().image;
        let mut worst = 0.0f32;
        for pattern in sixfold::math::inputs::SIGN_PATTERNS {
            let dir = Vec3::from_f64(pattern.map(f64::from)).normalized();
            let point = MappingId::Latlong.forward(dir).unwrap();
            let (found, wanted) = (image.nearest(point.u, point.v), photograph(dir));
            worst = (0..3).fold(worst, |worst, i| worst.max((found[i] - wanted[i]).abs()));
        }
        worst
    };
    let ours = OpenHints {
        frame: Frame::from_id("sixfold").ok(),
        ..OpenHints::default()
    };
    let (right, wrong) = (apart(OpenHints::default()), apart(ours));
    assert!(right < 0.05 && wrong > 2.0 * right, "{right} {wrong}");
    // Two discs are no panorama, although they are twice as wide as high.
    let discs = Laid::new(MappingId::Paraboloid, Layout::Pair, 48);
    let picture = discs.draw(&discs.shape(), photograph).remove(0);
    write(&path, Content::Raster(&picture), None);
    let as_said = |mapping| OpenHints {
        mapping: Some(mapping),
        ..OpenHints::default()
    };
    let (right, wrong) = (
        apart(as_said(MappingId::Paraboloid)),
        apart(as_said(MappingId::Latlong)),
    );
    assert!(right < 0.05 && wrong > 2.0 * right, "{right} {wrong}");
}
