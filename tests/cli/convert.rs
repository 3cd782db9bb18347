//! `sixfold convert`: files, films, pipes, and what is refused.

use std::io::{Read, Write};
use std::path::Path;

use serde_json::Value;

use sixfold::imaging::load::{self, Format, Opened};
use sixfold::imaging::save::{Content, SaveOptions, save};
use sixfold::imaging::{Channels, Progress, Raster, Samples, Transfer};

use super::{Run, piped, run, sixfold};

/// Runs `sixfold convert` with these words in a folder.
fn convert(folder: &Path, words: &str) -> Run {
    let mut command = sixfold(&["convert"]);
    command.args(words.split_whitespace()).current_dir(folder);
    let output = command.stdin(std::process::Stdio::null()).output().unwrap();
    Run {
        status: output.status.code().expect("ended by a signal"),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn done(folder: &Path, words: &str) -> String {
    let run = convert(folder, words);
    assert_eq!(run.status, 0, "{words}: {}", run.err);
    run.out
}

/// A folder with `small.exr`, a latlong of 64 x 32.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    done(folder.path(), "direction-colour small.exr --size 32");
    folder
}

fn files(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = names
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn every_option_does_something() {
    let folder = folder();
    let at = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let base = "small.exr OUT --from latlong --to cube --size 16 --filter bilinear --depth 16";
    done(folder.path(), &base.replace("OUT", "plain.png"));
    let plain = at("plain.png");
    done(folder.path(), &base.replace("OUT", "again.png"));
    assert_eq!(at("again.png"), plain, "the same twice is not the same");
    for option in [
        "--rotate -90,0,0",
        "--rotate 0,30,-15",
        "--exposure -1",
        "--supersample 3",
        "--samples edge",
        "--from-samples edge",
        "--from-mirrored",
        "--layout row",
        "--layout 3x2-turned",
        "--faces -z,+x",
        "--to-frame threejs",
        "--dither",
    ] {
        done(
            folder.path(),
            &format!("{} {option} --force", base.replace("OUT", "other.png")),
        );
        assert!(at("other.png") != plain, "{option}");
    }
    // What must not change the picture.
    for option in ["--threads 1", "--rotate 360,0,-360", "--from-layout single"] {
        done(
            folder.path(),
            &format!("{} {option} --force", base.replace("OUT", "other.png")),
        );
        assert!(at("other.png") == plain, "{option}");
    }
    for (one, other) in [
        ("--filter nearest --size 9", "--filter lanczos --size 9"),
        ("--depth 8", "--depth 16"),
        ("--to eac", "--to ccm"),
        ("--size 8", "--size 9"),
    ] {
        done(folder.path(), &format!("small.exr one.png {one} --force"));
        done(folder.path(), &format!("small.exr two.png {other} --force"));
        assert!(at("one.png") != at("two.png"), "{one} {other}");
    }
    // Mixed codes are darker than mixed light.
    done(folder.path(), "small.exr codes.png --depth 8");
    for transfer in ["linear", "raw"] {
        done(
            folder.path(),
            &format!("codes.png {transfer}.png --size 4 --transfer {transfer}"),
        );
    }
    assert!(at("linear.png") != at("raw.png"));
    // Codes taken for light are brighter than what they stand for.
    for (words, name) in [("", "untold"), ("--from-transfer srgb", "told")] {
        done(folder.path(), &format!("codes.png {name}.exr {words}"));
    }
    done(folder.path(), "codes.png light.exr --from-transfer linear");
    assert!(at("untold.exr") == at("told.exr"));
    assert!(at("untold.exr") != at("light.exr"));
}

#[test]
fn faces_that_meet_alike_in_many_ways_are_believed() {
    let folder = tempfile::tempdir().unwrap();
    for (environment, said) in [
        ("labelled-faces", "every face may be where its name says"),
        ("courtyard", "every face is where its name says"),
    ] {
        done(
            folder.path(),
            &format!("{environment} cross.png --to cube --layout cross --size 64 --force"),
        );
        let out = done(folder.path(), "cross.png --inspect");
        assert!(out.contains(said), "{environment}: {out}");
    }
}

/// The one raster of a file.
fn raster(path: &Path) -> Raster {
    match load::open(path, &Progress::new()).unwrap() {
        Opened::Raster(file) => file.raster,
        Opened::Container(_) => panic!("a container: {}", path.display()),
    }
}

#[test]
fn opacity_neither_darkens_nor_changes_what_stays() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| raster(&folder.path().join(name));
    let pixels = (0..64 * 32).flat_map(|i| [200, 90, 30, [255, 128, 40][i % 3]]);
    let codes = Samples::U8(pixels.collect());
    let half = Raster::new([64, 32], Channels::Rgba, Transfer::Srgb, codes).unwrap();
    let path = folder.path().join("half.png");
    let (content, options) = (Content::Raster(&half), SaveOptions::default());
    save(
        &path,
        false,
        content,
        Format::Png,
        &options,
        &Progress::new(),
    )
    .unwrap();
    // OpenEXR holds the product.
    done(folder.path(), "half.png half.exr --depth float");
    let (straight, product) = (half.light(1, 0), at("half.exr").light(1, 0));
    assert!((product[3] - 128.0 / 255.0).abs() < 1e-6);
    for (whole, part) in straight.iter().zip(product).take(3) {
        assert!((whole * product[3] - part).abs() < 1e-6, "{whole} {part}");
    }
    // And gives the colours back, on the way to another mapping too.
    done(folder.path(), "half.exr back.png --depth 8");
    assert_eq!(at("back.png").samples(), half.samples());
    done(
        folder.path(),
        "half.exr turned.exr --to octahedral --size 16",
    );
    for source in ["half.exr", "turned.exr"] {
        done(
            folder.path(),
            &format!(
                "{source} cube.png --from {} --to cube --size 8 --layout row --depth 8 --force",
                if source == "half.exr" {
                    "latlong"
                } else {
                    "octahedral"
                }
            ),
        );
        let cube = at("cube.png");
        let Samples::U8(codes) = cube.samples() else {
            panic!("not 8 bits");
        };
        for texel in codes.as_chunks::<4>().0 {
            assert_eq!(texel[..3], [200, 90, 30], "{source}");
        }
    }
    // What is only copied keeps every bit.
    done(folder.path(), "half.exr copy.exr");
    assert_eq!(at("copy.exr"), at("half.exr"));
}

#[test]
fn every_format_is_written_by_its_name() {
    let folder = folder();
    let starts: [(&str, &[u8]); 6] = [
        ("a.hdr", b"#?"),
        ("a.exr", b"\x76\x2f\x31\x01"),
        ("a.png", b"\x89PNG"),
        ("a.jpg --quality 80", b"\xff\xd8\xff"),
        ("a.ktx2 --mips --zstd", b"\xabKTX 20"),
        ("a.dds --mips --depth half", b"DDS "),
    ];
    for (words, start) in starts {
        done(
            folder.path(),
            &format!("small.exr {words} --to cube --size 8"),
        );
        let name = words.split(' ').next().unwrap();
        let bytes = std::fs::read(folder.path().join(name)).unwrap();
        assert!(bytes.starts_with(start), "{name}");
    }
    done(folder.path(), "small.exr marked.exr --envmap");
    let marked = std::fs::read(folder.path().join("marked.exr")).unwrap();
    assert!(marked.windows(6).any(|word| word == b"envmap"));
}

#[test]
fn faces_have_their_names_and_a_film_its_numbers() {
    let folder = folder();
    done(folder.path(), "small.exr f_%f.png --to cube --size 4");
    done(
        folder.path(),
        "small.exr g_%f.png --to cube --size 4 --faces -y --face-names r,l,u,d,f,b",
    );
    for frame in [3, 7, 12] {
        let words = format!("small.exr in_{frame:04}.exr --exposure {}", frame - 8);
        done(folder.path(), &words);
    }
    done(
        folder.path(),
        "in_%04d.exr out_%04d.png --from latlong --to octahedral --size 8",
    );
    let expected = [
        "f_nx.png",
        "f_ny.png",
        "f_nz.png",
        "f_px.png",
        "f_py.png",
        "f_pz.png",
        "g_d.png",
        "in_0003.exr",
        "in_0007.exr",
        "in_0012.exr",
        "out_0003.png",
        "out_0007.png",
        "out_0012.png",
        "small.exr",
    ];
    assert_eq!(files(folder.path()), expected);
    // Each frame of the film is what it is alone.
    done(
        folder.path(),
        "in_0007.exr alone.png --from latlong --to octahedral --size 8",
    );
    let at = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(at("out_0007.png") == at("alone.png"));
    assert!(at("out_0003.png") != at("alone.png"));
}

#[test]
fn the_report_has_its_fields_and_faces_cost_their_share() {
    let folder = folder();
    let report = |words: &str| -> Value {
        let line = done(folder.path(), &format!("{words} --json --force"));
        assert_eq!(line.lines().count(), 1);
        serde_json::from_str(&line).unwrap()
    };
    let all = report("small.exr f_%f.png --to cube --size 8 --repeat 3 --threads 2");
    assert_eq!(
        (&all["from"], &all["to"]),
        (&"latlong".into(), &"cube".into())
    );
    assert_eq!(all["size"], serde_json::json!([8, 8]));
    assert_eq!((&all["threads"], &all["texels"]), (&2.into(), &384.into()));
    let stages = all["stages"].as_array().unwrap();
    let names: Vec<&str> = stages
        .iter()
        .map(|stage| stage["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["read", "plan", "resample", "write"]);
    assert!(
        stages
            .iter()
            .all(|stage| stage["ms"].as_f64().unwrap() >= 0.0)
    );
    assert!(stages[2]["spread_ms"].as_f64().unwrap() >= 0.0 && stages[0]["spread_ms"].is_null());
    assert!(all["copy_ratio"].as_f64().unwrap() > 0.0);
    for word in ["filter", "isa"] {
        assert!(all[word].is_string(), "{word}");
    }
    if cfg!(target_os = "linux") {
        assert!(all["peak_bytes"].as_u64().unwrap() > 1 << 20);
    }
    let one = report("small.exr f_%f.png --to cube --size 8 --faces +y");
    assert_eq!(
        one["texels"].as_u64().unwrap() * 6,
        all["texels"].as_u64().unwrap()
    );
    assert!(
        one["skipped"]
            .as_array()
            .unwrap()
            .contains(&"5 charts not asked for".into())
    );
}

#[test]
fn what_makes_no_sense_is_refused_with_one_line() {
    let folder = folder();
    let before = files(folder.path());
    let cases = [
        ("small.exr a.png --size 0", "1..=65536"),
        ("small.exr a.png --size 70000", "65536"),
        ("small.exr a.png --rotate 1,2", "three angles"),
        ("small.exr a.png --exposure inf", "stops"),
        ("small.exr a.png --to cubic", "`sixfold maps`"),
        ("small.exr a.png --to cube --layout pair", "3x2-turned"),
        ("small.exr a.png --to cube --layout faces", "%f"),
        ("small.exr a_%f.png --to latlong", "one chart"),
        (
            "small.exr a_%f.png --to cube --layout row",
            "leave --layout or %f out",
        ),
        ("small.exr a.png --to cube --faces +w", "it has: +x"),
        ("small.exr a.png --to cube --face-names a,b", "%f"),
        (
            "small.exr a_%f.png --to cube --face-names a,b",
            "one for each",
        ),
        ("small.exr a.ktx2 --to cube --layout row", "holds six faces"),
        ("small.exr a.ktx2 --to cube --faces +x", "--faces"),
        ("small.exr a.png --mips", ".ktx2 or .dds"),
        ("small.exr a.dds --zstd", ".ktx2"),
        ("small.exr a.png --quality 90", ".jpg"),
        ("small.exr a.png --envmap", ".exr"),
        ("small.exr a.exr --to cube --layout row --envmap", "column"),
        ("small.exr a.png --depth half", "8 or 16"),
        ("small.exr a.exr --dither", "no steps"),
        ("small.exr a.bmp", ".hdr, .exr"),
        (
            "small.exr a.png --filter area --supersample 4",
            "--supersample",
        ),
        ("small.exr a.png --from-frame maya", "openexr"),
        (
            "small.exr a.png --from-frame unity --arrange +x,-x,+y,-y,+z,-z",
            "leave one out",
        ),
        ("small.exr a.png --from cube --arrange +x", "no arrangement"),
        ("small.exr a.png --from-layout row", "--from MAP"),
        ("small.exr a_%04d.png", "leave the number out"),
        ("in_%04d.exr a.png", "%04d"),
        ("small.exr --inspect --to cube", "--inspect"),
        ("- a.png", "--raw"),
        ("small.exr - --raw rgb24 2x2 --from latlong", "`- -`"),
        ("- - --raw rgb24 4x2", "--from MAP"),
        ("- - --raw rgb25 4x2 --from latlong", "rgb48le"),
        ("- - --raw rgb24 4x2 --from cube", "charts"),
        ("- - --raw rgb24 90000x90000 --from latlong", "no size"),
        ("- - --raw rgb24 4x2 --from latlong --json", "--json"),
        ("labelled-faces a.png --from cube", "built in"),
        ("labelled-faces a.png --from-mirrored", "built in"),
        ("labelled-faces a.png --from-transfer srgb", "built in"),
        ("labeled-faces a.png", "courtyard, sunset, labelled-faces"),
        (
            "- - --raw rgb24 4x2 --from latlong --from-transfer srgb",
            "leave --from-transfer out",
        ),
    ];
    for (words, help) in cases {
        let run = convert(folder.path(), words);
        assert_eq!(
            (run.status, run.out.as_str()),
            (2, ""),
            "{words}: {}",
            run.err
        );
        assert_eq!(run.err.lines().count(), 1, "{words}: {}", run.err);
        assert!(
            run.err.starts_with("sixfold: ") && run.err.contains(help),
            "{words}: {}",
            run.err
        );
    }
    assert_eq!(files(folder.path()), before);
}

#[test]
fn what_fails_leaves_nothing_behind_and_what_is_there_stays() {
    let folder = folder();
    std::fs::write(folder.path().join("old.png"), "old").unwrap();
    std::fs::write(folder.path().join("bad.png"), "\u{89}no").unwrap();
    std::fs::write(folder.path().join("empty.exr"), "").unwrap();
    for face in ["px", "nx", "py", "pz", "nz"] {
        std::fs::copy(
            folder.path().join("small.exr"),
            folder.path().join(format!("sky_{face}.exr")),
        )
        .unwrap();
    }
    for (words, help) in [
        ("empty.exr new.png", "empty; "),
        ("sky_%f.exr new.png", "not there: sky_ny.exr; "),
    ] {
        let run = convert(folder.path(), words);
        assert_eq!(run.status, 1, "{words}");
        assert!(run.err.contains(help), "{words}: {}", run.err);
    }
    let before = files(folder.path());
    // The command line names its own options; a window has others.
    done(folder.path(), "small.exr square.png --to octahedral");
    let told = convert(folder.path(), "square.png x.png --to latlong");
    assert!(
        told.err.contains("(--from, --from-layout): square.png"),
        "{}",
        told.err
    );
    std::fs::remove_file(folder.path().join("square.png")).unwrap();
    for words in [
        "small.exr old.png",
        "bad.png new.png --from latlong",
        "missing.png new.png --from latlong",
        "small.exr no/such/folder.png",
        "small.exr .. ",
        "in_%04d.exr out_%04d.png",
    ] {
        let run = convert(folder.path(), words);
        assert!(matches!(run.status, 1 | 2), "{words}");
        assert_eq!(
            (run.out.as_str(), run.err.lines().count()),
            ("", 1),
            "{words}: {}",
            run.err
        );
    }
    assert_eq!(files(folder.path()), before);
    let old = || std::fs::read(folder.path().join("old.png")).unwrap();
    assert_eq!(old(), b"old");
    done(folder.path(), "small.exr old.png --force");
    assert!(old().starts_with(b"\x89PNG"));
}

#[test]
fn frames_go_through_a_pipe() {
    let words = "convert - - --raw rgb24 8x4 --from latlong --to latlong --filter nearest";
    let words: Vec<&str> = words.split(' ').collect();
    let frames: Vec<u8> = (0..3 * 96).map(|i| b'!' + (i % 90) as u8).collect();
    let whole = super::run_on(&words, frames.clone());
    assert_eq!((whole.status, whole.err.as_str()), (0, ""));
    assert_eq!(whole.out.as_bytes(), frames, "the same map is not the same");
    let cut = super::run_on(&words, frames[..200].to_vec());
    assert_eq!((cut.status, cut.err.lines().count()), (1, 1));
    assert!(cut.err.contains("8 bytes into frame 3"), "{}", cut.err);
    assert_eq!(cut.out.as_bytes(), &frames[..192]);
    let turned = run(&[&words[..], &["--rotate", "180,0,0"]].concat(), "");
    assert_eq!((turned.status, turned.out.as_str()), (0, ""));
}

#[test]
fn a_reader_that_goes_away_ends_the_pipe_quietly() {
    let words = "convert - - --raw rgb24 64x32 --from latlong";
    let mut child = piped(&words.split(' ').collect::<Vec<_>>());
    let mut stdin = child.stdin.take().unwrap();
    let writer =
        std::thread::spawn(move || (0..10_000).any(|_| stdin.write_all(&[0; 6144]).is_err()));
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut [0; 6144]).unwrap();
    drop(stdout);
    let mut err = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut err)
        .unwrap();
    assert_eq!((child.wait().unwrap().code(), err.as_str()), (Some(0), ""));
    assert!(
        writer.join().unwrap(),
        "read to the end though nobody listened"
    );
}
