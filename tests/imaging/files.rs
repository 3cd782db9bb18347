//! Environments by name, jobs, scenes in PNG text, files that appear whole.

use std::io::Cursor;

use sixfold::imaging::computed::{self, Pattern};
use sixfold::imaging::load::{self, LoadProblem, load_bytes};
use sixfold::imaging::{self, Environment, Image, Progress, Stage, atomic, png_out};

use super::fixtures::{crc32, flat_hdr, seeds};

#[test]
fn ids_and_scenes_name_every_environment() {
    let mut ids = Vec::new();
    for environment in Environment::ALL_BUILT_IN {
        let id = environment.id();
        assert_eq!(
            serde_json::to_string(&environment).unwrap(),
            format!("\"{id}\"")
        );
        assert_eq!(Environment::from_id(&id), environment);
        assert!(!environment.name().is_empty());
        ids.push(id);
    }
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), Environment::ALL_BUILT_IN.len());
    let file = Environment::from_id("some/room.exr");
    // Wherever it is opened again.
    let path = std::env::current_dir().unwrap().join("some/room.exr");
    assert_eq!(
        (file.name().as_str(), file.id()),
        ("room.exr", path.display().to_string())
    );
    assert_eq!(file, Environment::File(path.into()));
    let text = serde_json::to_string(&file).unwrap();
    assert_eq!(serde_json::from_str::<Environment>(&text).unwrap(), file);
}

#[test]
fn embedded_photographs_decode_as_the_reference_library_decodes_them() {
    // Negative texels and the mean of green (before replacing), by the reference OpenEXR library.
    let cases = [
        (Environment::Courtyard, 1188, 0.510_655_083),
        (Environment::Sunset, 5, 0.416_061_004),
    ];
    for (environment, negative, mean_green) in cases {
        let progress = Progress::new();
        let loaded = environment.image(&progress).unwrap();
        assert_eq!((loaded.image.width(), loaded.image.height()), (1024, 512));
        assert_eq!(loaded.bad.negative, negative, "{}", environment.id());
        assert_eq!(
            (loaded.bad.nan, loaded.bad.infinite, loaded.bad.too_bright),
            (0, 0, 0)
        );
        let green =
            |(i, p): (usize, &[f32; 3])| f64::from(loaded.originals.get(i).unwrap_or(*p)[1]);
        let sum: f64 = loaded.image.pixels().iter().enumerate().map(green).sum();
        let mean = sum / (1024.0 * 512.0);
        assert!((mean - mean_green).abs() < 2e-9, "{mean}");
        assert_eq!((progress.stage(), progress.fraction()), (Stage::Done, 1.0));
    }
}

#[test]
fn cancelled_loads_stop_and_files_open() {
    let folder = tempfile::tempdir().unwrap();
    for (index, (format, bytes)) in seeds().into_iter().enumerate() {
        let path = folder.path().join(format!("{index}.pic"));
        std::fs::write(&path, &bytes).unwrap();
        let progress = Progress::new();
        assert!(load::load(&path, &progress).is_ok(), "{format:?}");
        assert_eq!(progress.stage(), Stage::Done);
        progress.cancel();
        let error = load::load(&path, &progress).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::Cancelled),
            "{format:?}: {error}"
        );
        let error = load_bytes(&bytes, "memory", &progress).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::Cancelled),
            "{format:?}: {error}"
        );
    }
    let missing = folder.path().join("missing.hdr");
    let error = load::load(&missing, &Progress::new()).unwrap_err();
    assert!(error.to_string().ends_with("missing.hdr"), "{error}");
    let error = load::load(folder.path(), &Progress::new()).unwrap_err();
    assert!(error.to_string().contains("not a regular file"), "{error}");
    assert!(
        Environment::File(missing.into())
            .image(&Progress::new())
            .is_err()
    );
}

/// Opened like a file, a pipe to which nobody writes would hang this test.
#[cfg(unix)]
#[test]
fn a_pipe_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.png");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let refusals = [
        png_out::read_scene(&pipe).unwrap_err().to_string(),
        load::load(&pipe, &Progress::new()).unwrap_err().to_string(),
        imaging::open_regular(&pipe).unwrap_err().to_string(),
    ];
    for refusal in refusals {
        assert!(refusal.contains("not a regular file"), "{refusal}");
    }
    let file = folder.path().join("file.png");
    std::fs::write(&file, b"x").unwrap();
    assert!(imaging::open_regular(&file).is_ok());
}

#[test]
fn a_load_is_stopped_from_another_thread() {
    // Waits for the job to get going, then stops it; the job is long enough to notice at the next row.
    let progress = Progress::new();
    let result = std::thread::scope(|scope| {
        let job = scope.spawn(|| computed::compute(Pattern::LabelledFaces, 4096, &progress));
        while progress.fraction() == 0.0 {
            std::thread::yield_now();
        }
        progress.cancel();
        job.join().unwrap()
    });
    assert!(matches!(result, Err(LoadProblem::Cancelled)));
    assert!(progress.fraction() < 1.0);
}

#[test]
fn scenes_travel_in_pngs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shot.png");
    let scene = "{\"name\":\"R\u{e9}flexion \u{7403}\",\"x\":[1,2.5]}";
    let rgba: Vec<u8> = (0..2 * 3 * 4).map(|i| i * 9).collect();
    let bytes = png_out::encode_png(2, 3, &rgba, Some(scene)).unwrap();
    atomic::write_atomically(&path, false, &bytes).unwrap();
    assert_eq!(png_out::read_scene(&path).unwrap().as_deref(), Some(scene));
    // The pixels are untouched.
    let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
    let mut back = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut back).unwrap();
    assert_eq!(back, rgba);
    // No scene is not an error; no PNG is.
    let plain = png_out::encode_png(2, 3, &rgba, None).unwrap();
    assert_eq!(png_out::scene_from(Cursor::new(&plain)).unwrap(), None);
    assert!(png_out::scene_from(Cursor::new(flat_hdr())).is_err());
    assert!(png_out::encode_png(2, 2, &rgba, None).is_err());
    assert!(png_out::encode_png(0, 0, &[], None).is_err());
    let long = "x".repeat(png_out::MOST_SCENE_BYTES + 1);
    assert!(png_out::encode_png(2, 3, &rgba, Some(&long)).is_err());
    let longest = &long[1..];
    let bytes = png_out::encode_png(2, 3, &rgba, Some(longest)).unwrap();
    assert_eq!(
        png_out::scene_from(Cursor::new(&bytes)).unwrap().as_deref(),
        Some(longest)
    );
}

#[test]
fn hostile_scene_chunks_are_refused() {
    let chunk = |declared: u32, body: &[u8], sum: Option<u32>| {
        let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
        bytes.extend(declared.to_be_bytes());
        let start = bytes.len();
        bytes.extend(b"iTXt");
        bytes.extend(body);
        let sum = sum.unwrap_or_else(|| crc32(&bytes[start..]));
        bytes.extend(sum.to_be_bytes());
        bytes.extend(b"\0\0\0\0IEND\xae\x42\x60\x82");
        bytes
    };
    let body = |rest: &[u8]| [b"sixfold-scene\0".as_slice(), rest].concat();
    let read = |bytes: Vec<u8>| png_out::scene_from(Cursor::new(bytes));
    let good = body(b"\0\0\0\0{}");
    let length = good.len() as u32;
    assert_eq!(
        read(chunk(length, &good, None)).unwrap().as_deref(),
        Some("{}")
    );
    let compressed = body(b"\x01\0\0\0x\x9c{}");
    let cases = [
        (
            "compressed",
            chunk(compressed.len() as u32, &compressed, None),
        ),
        ("limit", chunk(i32::MAX as u32, &good, None)),
        ("declares", chunk(u32::MAX, &good, None)),
        ("check sum", chunk(length, &good, Some(0))),
        ("UTF-8", chunk(length, &body(b"\0\0\0\0\xff\xff"), None)),
        ("no text", chunk(length, &body(b"\0\0abcd"), None)),
        ("too short", chunk(15, &body(b"\0"), None)),
        ("breaks off", chunk(length + 500, &good, None)),
    ];
    for (word, bytes) in cases {
        let reason = read(bytes).unwrap_err();
        assert!(reason.contains(word), "{word}: {reason}");
    }
    // Another program's text, also one that is shorter than our key.
    assert_eq!(read(chunk(3, b"a\0b", None)).unwrap(), None);
    assert_eq!(
        read(chunk(20, b"sixfold-scenery\0\0\0\0\0", None)).unwrap(),
        None
    );
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.bin");
    let names = || std::fs::read_dir(folder.path()).unwrap().count();
    atomic::write_atomically(&path, false, b"one").unwrap();
    let error = atomic::write_atomically(&path, false, b"two").unwrap_err();
    assert!(matches!(error, atomic::WriteError::Exists(_)), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"one");
    atomic::write_atomically(&path, true, b"three").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"three");
    assert_eq!(names(), 1, "a temporary file is left");
    // A folder in the way: the rename fails and nothing is left.
    let blocked = folder.path().join("folder");
    std::fs::create_dir(&blocked).unwrap();
    std::fs::write(blocked.join("inside"), b"").unwrap();
    assert!(atomic::write_atomically(&blocked, true, b"four").is_err());
    assert_eq!(names(), 2);
    assert!(atomic::write_atomically(&folder.path().join("no/such/file"), true, b"").is_err());
    assert!(atomic::write_atomically("/".as_ref(), true, b"").is_err());
}

#[test]
fn every_number_names_a_texel() {
    let image = Image::new(4, 2, (0..8).map(|i| [i as f32; 3]).collect()).unwrap();
    assert!(Image::new(4, 2, vec![[0.0; 3]; 7]).is_err() && Image::new(0, 0, vec![]).is_err());
    assert_eq!(image.texel(3, 1), Some([7.0; 3]));
    assert_eq!((image.texel(4, 0), image.texel(0, 2)), (None, None));
    assert_eq!(image.nearest(0.99, 0.99)[0], 7.0);
    assert_eq!(
        (image.nearest(1.0, 1.0)[0], image.nearest(f64::NAN, -3.0)[0]),
        (7.0, 0.0)
    );
}
