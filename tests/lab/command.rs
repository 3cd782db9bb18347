//! The commands as other programs see them.

use std::process::{Command, Output};

use serde_json::Value;

fn sixfold(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sixfold"))
        .args(args)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn bench_writes_its_five_files() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/folder");
    let arguments = [
        "bench", "--quick", "cube", "--device", "cpu", "--texels", "512", "--out",
    ];
    let arguments = [&arguments[..], &[out.to_str().unwrap()]].concat();
    let run = sixfold(&arguments);
    assert!(run.status.success(), "{}", text(&run.stderr));
    assert!(
        run.stderr.is_empty(),
        "no bar beside a terminal: {}",
        text(&run.stderr)
    );
    let table = text(&run.stdout);
    assert!(table.starts_with("MAP") && table.lines().skip(1).all(|line| line.starts_with("cube")));

    let read = |name: &str| std::fs::read(out.join(name)).unwrap();
    let rows: Vec<Value> = serde_json::from_slice(&read("bench.json")).unwrap();
    let fields = [
        "mapping",
        "evaluator",
        "direction",
        "inputs",
        "device",
        "isa",
        "threads",
        "n",
        "ns",
        "ns_latency",
        "spread",
        "copy_ratio",
        "max_error_rad",
        "rms_error_rad",
        "max_error_ulp",
        "max_error_texels",
        "texels",
        "worst",
        "on_front",
    ];
    for row in &rows {
        for field in fields {
            assert!(row.get(field).is_some(), "{field} in {row}");
        }
        assert_eq!(row["texels"], 512);
        assert_eq!(row["device"], "cpu");
        assert!(["forward", "inverse"].contains(&row["direction"].as_str().unwrap()));
        assert_eq!(row["worst"].as_array().unwrap().len(), 3);
        // Between a tenth and a million nanoseconds, whatever the machine is: the unit is right.
        assert!((0.01..1e6).contains(&row["ns"].as_f64().unwrap()));
        assert!(row["max_error_rad"].as_f64().unwrap() < 1e-6);
    }
    let head: Value = serde_json::from_slice(&read("bench_machine.json")).unwrap();
    for field in ["cpu", "adapter", "driver", "compiler", "commit", "date"] {
        assert!(head.get(field).is_some(), "{field} in {head}");
    }
    assert!(head["compiler"].as_str().unwrap().starts_with("rustc 1."));
    assert_eq!(text(&read("bench.csv")).lines().count(), rows.len() + 1);
    assert!(text(&read("bench.svg")).starts_with("<svg"));
    assert!(read("bench.png").starts_with(b"\x89PNG"));

    // What is there is kept, and nothing is measured for nothing.
    let again = sixfold(&arguments);
    assert_eq!(again.status.code(), Some(1));
    assert!(text(&again.stderr).contains("exists already") && again.stdout.is_empty());
}

#[test]
fn stress_tells_what_it_saw_beside_what_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let run = sixfold(&["stress", "--quick", "ccm", "--device", "cpu", "--out", out]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    let shader = table
        .lines()
        .find(|line| line.contains("paper-shader"))
        .unwrap();
    assert!(shader.contains(" x "), "{shader}");
    let rows: Vec<Value> =
        serde_json::from_slice(&std::fs::read(folder.path().join("stress.json")).unwrap()).unwrap();
    let measures = [
        "holes",
        "wrong_chart",
        "out_of_range",
        "not_finite",
        "max_round_trip_rad",
        "max_forward_rad",
        "max_seam_jump_texels",
    ];
    for row in &rows {
        for field in [
            "mapping",
            "evaluator",
            "device",
            "family",
            "n",
            "worst",
            "allowed",
            "expected_fault",
            "broken",
        ] {
            assert!(row.get(field).is_some(), "{field} in {row}");
        }
        for measure in measures {
            assert!(row[measure].is_number() && row["allowed"][measure].is_number());
        }
        assert!(
            row["worst"]
                .as_array()
                .unwrap()
                .iter()
                .all(|c| c.as_str().unwrap().starts_with("0x"))
        );
        assert_eq!(row["broken"], false);
    }
    let csv = std::fs::read_to_string(folder.path().join("stress.csv")).unwrap();
    assert_eq!(csv.lines().count(), rows.len() + 1);
    let all = sixfold(&["stress", "--quick", "--all", "--device", "cpu", "cube"]);
    let lines = text(&all.stdout).lines().count();
    assert_eq!(
        lines,
        1 + 4 * 9,
        "a line for each of four evaluators and nine families"
    );
}

#[test]
fn wrong_words_are_refused() {
    for arguments in [
        ["bench", "nomap"],
        ["stress", "nomap"],
        ["bench", "--texels=0"],
    ] {
        let run = sixfold(&arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        assert!(run.stdout.is_empty());
    }
}

#[test]
fn eval_runs_any_evaluator() {
    use std::io::{Seek, Write};
    // A file, not a pipe: the program may end before it has read.
    let run = |arguments: &[&str], input: &str| {
        let mut lines = tempfile::tempfile().unwrap();
        lines.write_all(input.as_bytes()).unwrap();
        lines.rewind().unwrap();
        let program = env!("CARGO_BIN_EXE_sixfold");
        let mut command = Command::new(program);
        command.args(arguments).stdin(lines).output().unwrap()
    };
    let found = run(&["eval", "ccm", "--evaluator", "atan-17"], "0.3,-1,0.2\n");
    let line = text(&found.stdout).lines().nth(1).unwrap().to_owned();
    let cells: Vec<&str> = line.split(',').collect();
    assert_eq!(cells[3], "3");
    // The errata's example, seen from the app's side: u = 1 - S, v = T.
    let [u, v] = [4, 5].map(|k| cells[k].parse::<f64>().unwrap());
    assert!(
        (u - (1.0 - 0.330_186_7)).abs() < 1e-6 || (u - 0.330_186_7).abs() < 1e-6,
        "{line}"
    );
    assert!((0.0..1.0).contains(&v));
    let back = run(
        &["eval", "ccm", "--inverse", "--evaluator", "table-64"],
        "3,0.25,0.5\n",
    );
    assert!(back.status.success(), "{}", text(&back.stderr));
    let none = run(
        &["eval", "ccm", "--inverse", "--evaluator", "rational"],
        "3,0.25,0.5\n",
    );
    assert_eq!(none.status.code(), Some(2));
    assert!(text(&none.stderr).contains("has no inverse"));
    let unknown = run(&["eval", "cube", "--evaluator", "nothing"], "");
    assert!(
        text(&unknown.stderr).contains("lanes"),
        "{}",
        text(&unknown.stderr)
    );
}

#[cfg(not(feature = "explorer"))]
#[test]
fn without_the_explorer_shaders_are_left_out_with_a_reason() {
    let lines = |run: &Output| text(&run.stderr).lines().count();
    for command in ["bench", "stress"] {
        let run = sixfold(&[command, "--quick", "cube"]);
        assert_eq!((run.status.code(), lines(&run)), (Some(0), 1), "{command}");
        assert!(text(&run.stderr).contains("built without the explorer"));
        let named = sixfold(&[command, "--quick", "cube", "--device", "gpu"]);
        assert_eq!((named.status.code(), lines(&named)), (Some(1), 1));
        let cpu = sixfold(&[command, "--quick", "cube", "--device", "cpu"]);
        assert_eq!((cpu.status.code(), lines(&cpu)), (Some(0), 0), "{command}");
    }
    let run = sixfold(&["eval", "ccm", "--evaluator", "wgsl"]);
    assert_eq!((run.status.code(), lines(&run)), (Some(1), 1));
    // They are listed all the same, with where they would run.
    let maps = sixfold(&["maps", "--json"]);
    assert!(text(&maps.stdout).contains(r#""device": "gpu""#));
}
