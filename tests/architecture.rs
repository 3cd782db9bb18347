//! The house rules that no compiler checks: which layer may use which, and that a mapping is one Rust file, one WGSL
//! file and one registry line. Every check takes text, so that each has a sample here that it must report.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// A layer and those that it may use. `main.rs` puts `app` and `cli` together; `lib.rs` lists them.
const LAYERS: [(&str, &[&str]); 10] = [
    ("math", &[]),
    ("mapping", &["math"]),
    ("optics", &["math"]),
    ("scene", &["math", "optics"]),
    ("imaging", &["math", "mapping"]),
    ("lab", &["math", "mapping", "imaging"]),
    ("meshes", &["math", "scene", "imaging"]),
    ("gpu", &["math", "mapping", "optics", "scene", "imaging"]),
    (
        "cli",
        &["math", "mapping", "optics", "scene", "imaging", "lab"],
    ),
    (
        "app",
        &[
            "math", "mapping", "optics", "scene", "imaging", "lab", "meshes", "gpu",
        ],
    ),
];

/// Outside crates that stay behind one layer's door, and the layers that may name them.
const FENCED_CRATES: [(&str, &[&str]); 22] = [
    ("wgpu", &["gpu", "app"]),
    ("bytemuck", &["gpu"]),
    ("pollster", &["gpu"]),
    ("egui", &["app"]),
    ("eframe", &["app"]),
    ("egui_wgpu", &["app"]),
    ("egui_tiles", &["app"]),
    ("egui_plot", &["app"]),
    ("rfd", &["app"]),
    ("clap", &["cli"]),
    ("image", &["imaging"]),
    ("indicatif", &["cli"]),
    ("signal_hook", &["cli"]),
    ("pulp", &["math", "mapping", "imaging"]),
    ("rayon", &["imaging", "lab"]),
    ("ruzstd", &["imaging"]),
    ("exr", &["imaging"]),
    ("gltf", &["meshes"]),
    ("base64", &["meshes"]),
    ("png", &["imaging"]),
    ("half", &["imaging", "gpu"]),
    ("naga", &[]), // tests only
];

/// What `text`, a file of `layer`, names that its layer may not.
fn broken_layers(layer: &str, text: &str) -> Vec<String> {
    let Some((_, may_use)) = LAYERS.iter().find(|(name, _)| *name == layer) else {
        return vec![format!("src/{layer} is in no line of LAYERS")];
    };
    let text = without_comments(text);
    let forbidden_layers = used_layers(&text)
        .into_iter()
        .filter(|used| *used != layer && !may_use.contains(used))
        .map(|used| format!("{layer} may not use the layer {used}"));
    let forbidden_crates = FENCED_CRATES
        .iter()
        .filter(|(name, at_home)| !at_home.contains(&layer) && names_crate(&text, name))
        .map(|(name, _)| format!("{layer} may not use the crate {name}"));
    forbidden_layers.chain(forbidden_crates).collect()
}

fn without_comments(text: &str) -> String {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    code.collect::<Vec<_>>().join("\n")
}

/// The layers that paths from the crate's root begin with, lists in braces (`crate::{math::Real, optics}`) included.
/// A layer reached upwards (`super::super::math`) counts too.
fn used_layers(text: &str) -> Vec<&'static str> {
    let mut used = Vec::new();
    for root in ["crate::", "super::"] {
        for (at, _) in text.match_indices(root) {
            let rest = &text[at + root.len()..];
            for name in rest.strip_prefix('{').map_or(vec![rest], list_items) {
                let name = leading_name(name.trim_start());
                used.extend(
                    LAYERS
                        .iter()
                        .map(|(layer, _)| *layer)
                        .filter(|layer| *layer == name),
                );
            }
        }
    }
    used
}

/// The items of a list whose opening brace has just been read.
fn list_items(list: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                items.push(&list[start..at]);
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    items
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn leading_name(text: &str) -> &str {
    &text[..text.find(|c| !is_name(c)).unwrap_or(text.len())]
}

/// True where a path begins with the crate: `use wgpu;`, `wgpu::Device`, but not `egui_wgpu::wgpu` nor `self.image`.
fn names_crate(text: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + name.len()..]);
        let begins = !before.ends_with(|c| is_name(c) || c == ':' || c == '.');
        let whole = !after.starts_with(is_name);
        begins && whole && (after.starts_with("::") || before.ends_with("use "))
    })
}

/// What is missing so that each mapping is one Rust file, one WGSL file of its name and one line of the registry.
/// `rust` holds (name, text) of the files of src/mapping, of which those that implement the trait are mappings.
fn unmatched_mappings(rust: &[(String, String)], wgsl: &[String], registry: &str) -> Vec<String> {
    let registry = without_comments(registry);
    let listed: Vec<&str> = registry
        .lines()
        .skip_while(|line| !line.starts_with("registry!"))
        .take_while(|line| !line.starts_with('}'))
        .filter_map(|line| Some(line.trim().strip_suffix(',')?.split_once(" in ")?.1.trim()))
        .collect();
    let files: Vec<&str> = rust
        .iter()
        .filter(|(_, text)| {
            let text = without_comments(text);
            // What is generic over mappings is none.
            ["impl Mapping for", "impl FaceMap for", "impl Warp for"]
                .iter()
                .any(|start| text.contains(start))
        })
        .map(|(name, _)| name.as_str())
        .collect();
    let wgsl: Vec<&str> = wgsl.iter().map(String::as_str).collect();

    let mut names = [&listed[..], &files, &wgsl].concat();
    names.sort_unstable();
    names.dedup();
    let places = [
        ("a line of registry!", listed),
        ("src/mapping/*.rs with an `impl` of a mapping", files),
        ("shaders/mapping/*.wgsl", wgsl),
    ];
    let mut missing = Vec::new();
    for name in names {
        for (place, there) in &places {
            match there.iter().filter(|found| **found == name).count() {
                0 => missing.push(format!("{name} is not in: {place}")),
                1 => {}
                n => missing.push(format!("{name} is {n} times in: {place}")),
            }
        }
    }
    missing
}

/// (path below `folder` without the ending, text) of every file with this ending, however deep.
fn files_below(folder: &Path, ending: &str) -> io::Result<Vec<(String, String)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.path().is_dir() {
            let below = files_below(&entry.path(), ending)?.into_iter();
            found.extend(below.map(|(rest, text)| (format!("{name}/{rest}"), text)));
        } else if let Some(stem) = name.strip_suffix(ending) {
            found.push((stem.to_owned(), fs::read_to_string(entry.path())?));
        }
    }
    Ok(found)
}

fn in_package(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

#[test]
fn every_layer_uses_only_what_lies_below_it() {
    let files = files_below(&in_package("src"), ".rs").unwrap();
    let mut checked = 0;
    let mut broken = Vec::new();
    for (path, text) in &files {
        if let Some((layer, _)) = path.split_once('/') {
            checked += 1;
            let faults = broken_layers(layer, text);
            broken.extend(
                faults
                    .into_iter()
                    .map(|fault| format!("src/{path}.rs: {fault}")),
            );
        }
    }
    assert!(checked > 0, "no layer was found");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn every_mapping_is_one_rust_file_one_shader_and_one_line() {
    let rust = files_below(&in_package("src/mapping"), ".rs").unwrap();
    let wgsl = files_below(&in_package("shaders/mapping"), ".wgsl").unwrap();
    let wgsl: Vec<String> = wgsl.into_iter().map(|(name, _)| name).collect();
    let registry = fs::read_to_string(in_package("src/mapping/mod.rs")).unwrap();
    let missing = unmatched_mappings(&rust, &wgsl, &registry);
    assert!(!wgsl.is_empty(), "no mapping was found");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn a_broken_layer_is_reported() {
    let faults = [
        ("math", "use crate::mapping::Mapping;", "layer mapping"),
        (
            "optics",
            "fn f(scene: &crate::scene::Camera) {}",
            "layer scene",
        ),
        (
            "cli",
            "use crate::{\n    imaging::{Image, read},\n    app,\n};",
            "layer app",
        ),
        (
            "mapping",
            "use super::super::imaging::Image;",
            "layer imaging",
        ),
        ("cli", "let device: wgpu::Device;", "crate wgpu"),
        ("gpu", "use egui::Ui;", "crate egui"),
        (
            "gpu",
            "let state: egui_wgpu::RenderState;",
            "crate egui_wgpu",
        ),
        ("app", "use clap;", "crate clap"),
        ("app", "image::open(path)", "crate image"),
        ("attic", "", "in no line of LAYERS"),
    ];
    for (layer, text, fault) in faults {
        let broken = broken_layers(layer, text);
        assert!(
            broken.len() == 1 && broken[0].contains(fault),
            "{text:?}: {broken:?}"
        );
    }
}

#[test]
fn a_kept_layer_is_not_reported() {
    let text = "use crate::{math::{Real, Vec3}, mapping};\n// wgpu::Device, crate::app\nlet png_image::X = \
                self.image::<f32>(); scene::wgpu::Device; let png = crate::imaging::png::read();";
    assert_eq!(broken_layers("imaging", text), Vec::<String>::new());
    assert_eq!(broken_layers("cli", text), Vec::<String>::new());
}

#[test]
fn a_mapping_without_its_parts_is_reported() {
    let rust = |names: &[&str]| -> Vec<(String, String)> {
        let mapping = |name: &&str| (name.to_string(), "impl Mapping for M {".to_owned());
        let shared = ("faces".to_owned(), "// impl Mapping for nothing".to_owned());
        names.iter().map(mapping).chain([shared]).collect()
    };
    let wgsl = |names: &[&str]| -> Vec<String> { names.iter().map(ToString::to_string).collect() };
    let registry = "macro_rules! registry {\n    ($v:ident in $m:ident,) => {};\n}\n\n\
                    registry! {\n    Latlong in latlong, // first\n    // Old in old,\n    Cube in cube,\n}\n";
    let both = ["cube", "latlong"];
    assert_eq!(
        unmatched_mappings(&rust(&both), &wgsl(&both), registry),
        Vec::<String>::new()
    );

    let no_file = unmatched_mappings(&rust(&["cube"]), &wgsl(&both), registry);
    assert_eq!(
        no_file,
        ["latlong is not in: src/mapping/*.rs with an `impl` of a mapping"]
    );
    let no_shader = unmatched_mappings(&rust(&both), &wgsl(&["latlong"]), registry);
    assert_eq!(no_shader, ["cube is not in: shaders/mapping/*.wgsl"]);
    let three = ["ccm", "cube", "latlong"];
    let no_line = unmatched_mappings(&rust(&three), &wgsl(&three), registry);
    assert_eq!(no_line, ["ccm is not in: a line of registry!"]);
    let twice = registry.replace("Cube in cube,", "Cube in cube,\n    Box in cube,");
    let two_lines = unmatched_mappings(&rust(&both), &wgsl(&both), &twice);
    assert_eq!(two_lines, ["cube is 2 times in: a line of registry!"]);
}
