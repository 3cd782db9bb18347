//! Keeps WGSL and Rust together, without a GPU: every pass is valid, says the same numbers, and leaves the built-in inverse
//! trigonometric functions alone.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

mod wgsl;

use std::f32::consts;
use std::mem::{offset_of, size_of};

use naga::Literal;
use sixfold::gpu::{Program, compute, forms, kit, optics, shader, uniforms};
use sixfold::mapping::{Domain, MappingId, ShaderForm, ccm};
use sixfold::math::{
    ATAN_COEFFICIENTS, COS_QUARTER_COEFFICIENTS, LN_2_PARTS, SIN_QUARTER_COEFFICIENTS,
};
use sixfold::optics::Formula;

/// Every pass of the app: name and whole text. A new pass is a new line here.
fn passes() -> Vec<(String, String)> {
    let mut passes = vec![
        ("plain".to_owned(), shader::plain("")),
        ("halve".to_owned(), kit::HALVE.to_owned()),
        ("evaluate optics".to_owned(), optics::GpuOptics::source()),
    ];
    let every_overlay = kit::Variant {
        great_circles: true,
        face_tint: true,
        grid: true,
        probe: true,
        level: true,
        ..kit::Variant::default()
    };
    for &id in MappingId::ALL {
        for form in id.forms() {
            let text = compute::GpuEvaluator::source(id, form);
            passes.push((format!("evaluate {id} {form}"), text));
        }
        passes.push((format!("bake {id}"), kit::bake_source(id)));
        passes.push((format!("panel {id}"), kit::panel_source(id)));
        for variant in [kit::Variant::default(), every_overlay] {
            passes.push((
                format!("sky {id} {variant:?}"),
                kit::sky_source(id, variant),
            ));
            for program in programs() {
                let name = format!("object {id} {variant:?} {program:?}");
                passes.push((name, kit::object_source(id, variant, program)));
            }
        }
        for (form, difference) in id.forms().flat_map(|form| [(form, false), (form, true)]) {
            let variant = kit::Variant {
                form,
                difference,
                ..every_overlay
            };
            let name = format!("{id} {form}, difference {difference}");
            let mirror = Program::Mirror { printed: false };
            passes.push((format!("sky {name}"), kit::sky_source(id, variant)));
            passes.push((
                format!("object {name}"),
                kit::object_source(id, variant, mirror),
            ));
        }
        for &source in MappingId::ALL {
            let roles = [("source", source), ("target", id)];
            passes.push((
                format!("{source} to {id}"),
                shader::with_mappings(&roles, ""),
            ));
        }
    }
    passes
}

/// Every program of the object; the formulas are a constant each.
fn programs() -> Vec<Program> {
    let formula = Formula::Schlick;
    vec![
        Program::Mirror { printed: false },
        Program::Mirror { printed: true },
        Program::VectorPerVertex,
        Program::CoordinatesPerVertex,
        Program::Metal,
        Program::MetalReflectance,
        Program::Dielectric(formula),
        Program::Glass(formula),
        Program::Veil,
        Program::Ball,
        Program::Refraction,
        Program::Spectrum,
        Program::Discriminant,
        Program::Reflectance(formula),
        Program::Difference(formula, Formula::Cg),
        Program::Opacity,
        Program::ThroughBall,
        Program::ThroughBallDifference(formula),
        Program::Traced,
        Program::TracedDifference(formula),
        Program::Untraced,
    ]
}

/// Built-ins that a shading language may answer with 4096 ULP or an absolute error.
const INVERSE_BUILT_INS: [&str; 7] = ["acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh"];
/// The same for the files that have a twin in Rust, which must agree to a few ULP.
const TWIN_BUILT_INS: [&str; 12] = [
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "exp2",
    "log",
    "log2",
    "pow",
    "normalize",
];

#[test]
fn every_pass_is_valid_and_every_file_is_in_one() {
    let passes = passes();
    for (name, text) in &passes {
        if let Err(fault) = wgsl::parse(text) {
            panic!("{name}: {fault}");
        }
    }
    let files = wgsl::files();
    assert!(files.len() > MappingId::ALL.len());
    for (path, text) in files {
        let used = passes.iter().any(|(_, pass)| pass.contains(&text));
        assert!(
            used,
            "shaders/{path} is in no pass; list its pass in `passes`"
        );
    }
}

#[test]
fn a_broken_pass_is_reported() {
    let unknown = wgsl::parse(&shader::plain("fn f() -> f32 { return latlong(1.0); }"));
    assert!(unknown.unwrap_err().contains("latlong"));
    let wrong_type = shader::plain("fn f() -> f32 { return ChartPoint(0u, 1.0, 1.0); }");
    assert!(wgsl::parse(&wrong_type).is_err());
    let without_twin = shader::for_mapping(MappingId::Ccm, "").replace("fn ccm_inverse", "fn gone");
    assert!(wgsl::parse(&without_twin).is_err());
}

#[test]
fn every_mapping_has_both_functions() {
    for &id in MappingId::ALL {
        let module = wgsl::parse(&shader::for_mapping(id, "")).unwrap();
        for (function, argument, result) in [
            ("forward", None, Some("ChartPoint")),
            ("inverse", Some("ChartPoint"), None),
        ] {
            let name = format!("{}_{function}", id.prefix());
            let (_, found) = module
                .functions
                .iter()
                .find(|(_, f)| f.name.as_deref() == Some(&*name))
                .unwrap_or_else(|| panic!("no function {name}"));
            let type_name = |ty: naga::Handle<naga::Type>| module.types[ty].name.as_deref();
            assert_eq!(found.arguments.len(), 1, "{name}");
            assert_eq!(type_name(found.arguments[0].ty), argument, "{name}");
            assert_eq!(
                type_name(found.result.as_ref().unwrap().ty),
                result,
                "{name}"
            );
        }
    }
}

/// What differs between the constants of a pass for this mapping and Rust.
fn unequal_constants(id: MappingId, pass: &str) -> Vec<String> {
    let info = id.info();
    let place = |id: MappingId| MappingId::ALL.iter().position(|m| *m == id).unwrap() as u32;
    let mut expected = vec![
        ("PI".to_owned(), Literal::F32(consts::PI)),
        ("FRAC_PI_2".to_owned(), Literal::F32(consts::FRAC_PI_2)),
        ("FRAC_1_PI".to_owned(), Literal::F32(consts::FRAC_1_PI)),
        ("SQRT_2".to_owned(), Literal::F32(consts::SQRT_2)),
        ("LN_2_HIGH".to_owned(), Literal::F32(LN_2_PARTS[0])),
        ("LN_2_LOW".to_owned(), Literal::F32(LN_2_PARTS[1])),
        (
            "FRAC_1_SQRT_2".to_owned(),
            Literal::F32(consts::FRAC_1_SQRT_2),
        ),
        (
            "SMALLEST_NORMAL".to_owned(),
            Literal::F32(f32::MIN_POSITIVE),
        ),
        ("LARGEST_FINITE".to_owned(), Literal::F32(f32::MAX)),
        (
            "CCM_HALF_EDGE_RAD".to_owned(),
            Literal::F32(ccm::HALF_EDGE_RAD as f32),
        ),
        ("NO_CHART".to_owned(), Literal::U32(shader::NO_CHART)),
        ("MAP_ID".to_owned(), Literal::U32(place(id))),
        ("MAP_CHARTS".to_owned(), Literal::U32(info.chart_count())),
        (
            "MAP_IS_DISC".to_owned(),
            Literal::Bool(info.domain == Domain::Disc),
        ),
    ];
    for &each in MappingId::ALL {
        expected.push((shader::id_name(each), Literal::U32(place(each))));
    }
    let found = wgsl::constants(&wgsl::parse(pass).unwrap());
    expected
        .iter()
        .filter(|constant| !found.contains(constant))
        .map(|constant| format!("{id}: {constant:?} is not in {found:?}"))
        .collect()
}

#[test]
fn ids_and_constants_are_rusts() {
    for &id in MappingId::ALL {
        let pass = shader::for_mapping(id, "");
        assert_eq!(unequal_constants(id, &pass), Vec::<String>::new());
    }
    let pass = shader::for_mapping(MappingId::Ccm, "");
    for (from, to) in [
        ("const PI: f32 = 3.1415927f", "const PI: f32 = 3.1415925f"),
        (
            "const MAPPING_LATLONG: u32 = 0u",
            "const MAPPING_LATLONG: u32 = 1u",
        ),
        ("const MAP_CHARTS: u32 = 6u", "const MAP_CHARTS: u32 = 5u"),
        (
            "const MAP_IS_DISC: bool = false",
            "const MAP_IS_DISC: bool = true",
        ),
    ] {
        assert!(pass.contains(from), "{from}");
        let faults = unequal_constants(MappingId::Ccm, &pass.replace(from, to));
        assert!(!faults.is_empty(), "{to} was not noticed");
    }
}

/// The formulas whose number in this pass is not their place in Rust's list.
fn unequal_formulas(pass: &str) -> Vec<&'static str> {
    let found = wgsl::constants(&wgsl::parse(pass).unwrap());
    let places = Formula::ALL.iter().zip(0..);
    places
        .map(|(formula, place)| (optics::formula_name(*formula), Literal::U32(place)))
        .filter(|(name, place)| !found.contains(&((*name).to_owned(), *place)))
        .map(|(name, _)| name)
        .collect()
}

#[test]
fn the_formulas_numbers_are_rusts() {
    let pass = optics::GpuOptics::source();
    assert_eq!(unequal_formulas(&pass), [""; 0]);
    let changed = pass.replace("FORMULA_CG: u32 = 4u", "FORMULA_CG: u32 = 9u");
    assert_eq!(unequal_formulas(&changed), ["FORMULA_CG"]);
}

#[test]
fn the_polynomials_are_rusts() {
    let module = wgsl::parse(&shader::plain("")).unwrap();
    for (name, coefficients) in [
        ("atan_series", &ATAN_COEFFICIENTS[..]),
        ("sin_quarter_series", &SIN_QUARTER_COEFFICIENTS),
        ("cos_quarter_series", &COS_QUARTER_COEFFICIENTS),
    ] {
        let (_, function) = module
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some(name))
            .unwrap();
        let (mut terms, mut sums, mut products) = (Vec::new(), 0, 0);
        for (_, expression) in function.expressions.iter() {
            match expression {
                naga::Expression::Literal(Literal::F32(c)) => terms.push(*c),
                naga::Expression::Binary { op, .. } => match op {
                    naga::BinaryOperator::Add => sums += 1,
                    naga::BinaryOperator::Multiply => products += 1,
                    other => panic!("{name}: {other:?}"),
                },
                naga::Expression::FunctionArgument(0) => {}
                other => panic!("{name}: {other:?}"),
            }
        }
        let highest_first: Vec<f32> = coefficients.iter().rev().copied().collect();
        assert_eq!(terms, highest_first, "{name}");
        assert_eq!(
            (sums, products),
            (terms.len() - 1, terms.len() - 1),
            "{name}"
        );
    }
}

#[test]
fn the_shorter_polynomials_are_rusts() {
    for form in [ShaderForm::Own7, ShaderForm::Own11] {
        let level = form.level().unwrap();
        let text = forms::angles(form);
        let line = |name: &str| {
            let start = format!("fn {name}(s: f32)");
            text.lines().find(|line| line.starts_with(&start)).unwrap()
        };
        let atan: Vec<f32> = level.quarters.iter().map(|c| forms::radians(*c)).collect();
        for (name, coefficients) in [
            ("atan_series", &atan[..]),
            ("sin_quarter_series", level.sin),
            ("cos_quarter_series", level.cos),
        ] {
            let numbers = line(name)
                .split(['(', ')'])
                .filter_map(|part| part.strip_suffix('f'));
            let found: Vec<f32> = numbers.filter_map(|number| number.parse().ok()).collect();
            let highest_first: Vec<f32> = coefficients.iter().rev().copied().collect();
            assert_eq!(found, highest_first, "{form} {name}");
        }
        // t P(t²), odd, and near the arctangent.
        let sum = |t: f32| t * atan.iter().rev().fold(0.0, |sum, c| sum * t * t + c);
        let error = (0..=100)
            .map(|k| 0.01 * k as f32)
            .map(|t| (sum(t) - t.atan()).abs());
        let error = error.fold(0.0, f32::max);
        let most = if form == ShaderForm::Own7 {
            8.5e-5
        } else {
            2e-6
        };
        assert!(error < most && error > 0.2 * most, "{form}: {error:e}");
    }
}

/// The one file that may call them: a form that is measured beside the others, and not used where it is not asked for.
const BUILT_IN_FORM: &str = "angles/built_in.wgsl";

#[test]
fn no_inverse_trigonometric_built_in_is_called() {
    for (path, text) in wgsl::files() {
        let called = wgsl::calls(&text, &INVERSE_BUILT_INS);
        if path == BUILT_IN_FORM {
            assert_eq!(called, ["atan", "atan2"]);
        } else {
            assert!(called.is_empty(), "shaders/{path} calls {called:?}");
        }
    }
    for form in ShaderForm::ALL {
        let called = wgsl::calls(&forms::angles(form), &TWIN_BUILT_INS);
        assert_eq!(
            called.is_empty(),
            form != ShaderForm::BuiltIn,
            "{form}: {called:?}"
        );
    }
    let twins = MappingId::ALL.iter().map(|id| (id.prefix(), id.wgsl()));
    for (name, text) in twins.chain([
        ("math", shader::MATH),
        ("cube_face", shader::CUBE_FACE),
        ("ball", shader::BALL),
    ]) {
        let called = wgsl::calls(text, &TWIN_BUILT_INS);
        assert!(called.is_empty(), "{name} calls {called:?}");
    }
    // The approximations of the reflectance are powers by definition. `pow` alone is let through: its error, a few units in
    // the last place of an exponent below 16, is held in tests/gpu_optics.rs.
    assert_eq!(wgsl::calls(optics::OPTICS, &TWIN_BUILT_INS), ["pow"]);
    let header = shader::constants();
    assert!(wgsl::calls(&header, &INVERSE_BUILT_INS).is_empty());
}

#[test]
fn a_call_is_found_and_a_comment_is_not() {
    let calls = |text: &str| wgsl::calls(text, &INVERSE_BUILT_INS);
    assert_eq!(calls("let a = acos(x);"), ["acos"]);
    assert_eq!(
        calls("let a = 1.0 -atan2 (y, x) + atan(x);"),
        ["atan", "atan2"]
    );
    assert_eq!(calls("/* a /* b */ */ asin(x)"), ["asin"]);
    assert_eq!(calls("// acos(x)\nlet a = 1.0; /* atan(\n1.0) */"), [""; 0]);
    assert_eq!(
        calls("let b = atan_unit(x) + my_acos(x); let asin = 1.0;"),
        [""; 0]
    );
}

/// A struct with every trap of the uniform layout: vec3 before a scalar, a scalar before a vector, a matrix.
#[repr(C)]
struct Sample {
    eye: [f32; 3],
    scale: f32,
    size: [f32; 2],
    flags: u32,
    unused: u32,
    turn: [[f32; 4]; 4],
}

#[test]
fn a_wrong_layout_is_reported() {
    let text = "struct Sample { eye: vec3f, scale: f32, size: vec2f, flags: u32, unused: u32, turn: mat4x4f }
                @group(0) @binding(0) var<uniform> sample: Sample;";
    let members = [
        ("eye", offset_of!(Sample, eye)),
        ("scale", offset_of!(Sample, scale)),
        ("size", offset_of!(Sample, size)),
        ("flags", offset_of!(Sample, flags)),
        ("unused", offset_of!(Sample, unused)),
        ("turn", offset_of!(Sample, turn)),
    ];
    let size = size_of::<Sample>();
    wgsl::assert_layout(text, "Sample", &members, size);
    for (from, to) in [
        ("eye: vec3f, scale: f32", "scale: f32, eye: vec3f"),
        ("unused: u32, ", ""),
        ("flags: u32", "flags: vec3u"),
        ("turn: mat4x4f", "turn: mat4x4f, more: f32"),
        ("struct Sample", "struct Other"),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text);
        let found = wgsl::check_layout(&changed, "Sample", &members, size);
        assert!(found.is_err(), "{changed}");
    }
    let wrong_size = wgsl::check_layout(text, "Sample", &members, size + 16);
    assert!(wrong_size.is_err());
}

#[test]
fn the_renderers_blocks_lie_in_memory_as_the_shaders_read_them() {
    let passes = passes();
    for (name, size, members) in uniforms::blocks() {
        let holding: Vec<_> = passes
            .iter()
            .filter(|(_, text)| text.contains(&format!("struct {name} ")))
            .collect();
        assert!(!holding.is_empty(), "no pass has a block {name}");
        for (_, text) in holding {
            wgsl::assert_layout(text, name, &members, size);
            let mut moved = members.clone();
            moved[0].1 += 4;
            assert!(wgsl::check_layout(text, name, &moved, size).is_err());
        }
    }
}
