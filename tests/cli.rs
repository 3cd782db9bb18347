//! The command line as other programs see it: the real binary, its streams and its exit status.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};

use sixfold::math::angle_rad;

/// What a run left behind.
struct Run {
    status: i32,
    out: String,
    err: String,
}

fn sixfold(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sixfold"));
    command.args(args);
    command
}

/// Runs the binary on `input`, which is written by a thread of its own so that no pipe can fill up.
fn run_on(args: &[&str], input: Vec<u8>) -> Run {
    let mut child = piped(args);
    let mut stdin = child.stdin.take().unwrap();
    // A command that refuses its arguments closes the pipe early: not this test's concern.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    Run {
        status: output.status.code().expect("ended by a signal"),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn run(args: &[&str], input: &str) -> Run {
    run_on(args, input.as_bytes().to_vec())
}

fn piped(args: &[&str]) -> Child {
    let mut command = sixfold(args);
    command.stdin(Stdio::piped());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn golden(name: &str) -> String {
    let path = format!("{}/tests/golden/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

fn numbers(line: &str) -> Vec<f64> {
    let cells = line.split(',');
    cells.map(|cell| cell.parse().unwrap()).collect()
}

const MAPS: [&str; 11] = [
    "latlong",
    "sphere",
    "matcap",
    "paraboloid",
    "cube",
    "ccm",
    "eac",
    "octahedral",
    "octahedral-equal-area",
    "angular",
    "cylindrical-equal-area",
];

/// Largest |u| or |v| difference between two tables of x,y,z,chart,u,v; a wrong chart counts as 1.
fn worst(table: &str, expected: &str) -> f64 {
    let rows = table.lines().zip(expected.lines()).skip(1);
    rows.map(|(got, expected)| {
        let (got, expected) = (numbers(got), numbers(expected));
        if got[3] == expected[3] {
            (got[4] - expected[4])
                .abs()
                .max((got[5] - expected[5]).abs())
        } else {
            1.0
        }
    })
    .fold(0.0, f64::max)
}

#[test]
fn eval_gives_the_golden_rows_in_both_precisions() {
    for map in MAPS {
        let table = golden(map);
        let single = run(&["eval", map], &table);
        let double = run(&["eval", map, "--precision", "f64"], &table);
        let reference = run(&["eval", map, "--evaluator", "reference"], &table);
        for run in [&single, &double, &reference] {
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{map}");
            assert!(run.out.starts_with("x,y,z,chart,u,v\n"));
            assert_eq!(run.out.lines().count(), table.lines().count());
        }
        let observed = [&single, &double, &reference].map(|run| worst(&run.out, &table));
        println!(
            "{map}: f32 {:.1e}, f64 {:.1e}, reference {:.1e}",
            observed[0], observed[1], observed[2]
        );
        assert!(observed[0] <= 4e-7 && observed[1] <= 5e-15);
        // Rounded once to half the last digit below 1, and as much again because the shortest decimal is read as f64 here.
        assert!(observed[2] <= 2f64.powi(-24), "{map}");
        // Negative control: another mapping's table.
        let other = if map == "eac" { "cube" } else { "eac" };
        assert!(worst(&single.out, &golden(other)) > 1e-3, "{map}");
    }
}

#[test]
fn inverse_undoes_eval_and_keeps_the_columns() {
    for map in MAPS {
        let forward = run(&["eval", map, "--precision", "f64"], &golden(map)).out;
        let cut = |line: &str| line.split(',').skip(3).collect::<Vec<_>>().join(",") + "\n";
        let points: String = forward.lines().map(cut).collect();
        let back = run(&["eval", map, "--inverse", "--precision", "f64"], &points);
        assert_eq!((back.status, back.err.as_str()), (0, ""), "{map}");
        assert!(back.out.starts_with("x,y,z,chart,u,v\n"));
        let rows = back.out.lines().zip(points.lines()).skip(1);
        assert!(rows.clone().count() >= 339);
        let mut worst = 0.0_f64;
        for ((row, point), given) in rows.zip(forward.lines().skip(1)) {
            assert!(row.ends_with(point), "{row} does not end with {point}");
            let (back, given) = (numbers(row), numbers(given));
            let length = back[..3].iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() < 1e-12, "{map}: {row}");
            if map != "matcap" || given[2] < 0.0 {
                let angle = angle_rad([given[0], given[1], given[2]], [back[0], back[1], back[2]]);
                worst = worst.max(angle);
            }
        }
        println!("{map}: {worst:.1e} rad");
        // A plumbing test: rims and poles are resolved to half the digits only, which tests/laws.rs looks at closely.
        assert!(worst < 1e-7, "{map}: {worst:.1e} rad");
    }
}

#[test]
fn conventions_name_their_columns_and_give_their_numbers() {
    let expected = [
        ("ccm", "paper", "x,y,z,tex_index,s,t"),
        ("ccm", "appendix-b", "x,y,z,case,u,v"),
        ("ccm", "printed-eq6", "x,y,z,tex_index,s,t"),
        ("latlong", "grimm", "x,y,z,chart,u,v"),
        ("sphere", "hoff", "x,y,z,chart,s,t"),
        ("matcap", "scali", "x,y,z,chart,u,v"),
        ("cube", "lower-left", "x,y,z,chart,u,v"),
    ];
    for (map, convention, header) in expected {
        let run = run(&["eval", map, "--convention", convention], "0.3,-1,0.2\n");
        assert_eq!(run.status, 0, "{}", run.err);
        assert_eq!(run.out.lines().next(), Some(header));
    }
    let table = golden("ccm-paper");
    let paper = run(
        &["eval", "ccm", "--convention", "paper", "--precision", "f64"],
        &table,
    );
    assert!(worst(&paper.out, &table) <= 5e-15);
    let printed = run(&["eval", "ccm", "--convention", "printed-eq6"], &table);
    assert!(
        worst(&printed.out, &table) > 0.2,
        "the printed Eq. 6 must be off"
    );

    let args = ["eval", "ccm", "--convention", "paper", "--inverse"];
    let centre = run(&args, "tex_index,s,t\n5,0.5,0.5\n");
    let rows: Vec<&str> = centre.out.lines().collect();
    assert_eq!(rows[0], "x,y,z,tex_index,s,t");
    assert_eq!(numbers(rows[1]), [1.0, 0.0, 0.0, 5.0, 0.5, 0.5]);
}

#[test]
fn a_bad_line_is_reported_and_the_run_goes_on() {
    let input = "0,0,0\n1,2\n1,nan,0\ninf,0,0\n1,two,\"3,5\"\n\n0,0,2\n";
    let run = run(&["eval", "cube"], input);
    assert_eq!(run.status, 1);
    assert_eq!(
        run.out,
        "x,y,z,chart,u,v\n0,0,0,,,\n1,2,,,,\n1,nan,0,,,\ninf,0,0,,,\n1,two,\"3,5\",,,\n0,0,2,4,0.5,0.5\n"
    );
    let reports: Vec<&str> = run.err.lines().collect();
    assert_eq!(reports.len(), 6, "{}", run.err);
    for (report, number) in reports.iter().zip(1..=5) {
        assert!(
            report.starts_with(&format!("sixfold: line {number}: ")),
            "{report}"
        );
    }
    assert!(reports[5].contains("5 of 6"), "{}", reports[5]);
}

#[test]
fn a_point_off_the_chart_is_reported() {
    let input = "chart,u,v\n7,0.5,0.5\n0,1.5,0.5\n-1,0,0\n0,nan,0\n2.0,0.5,0.5\n";
    let run = run(&["eval", "cube", "--inverse"], input);
    assert_eq!(run.status, 1);
    let rows: Vec<&str> = run.out.lines().collect();
    assert_eq!(
        rows[1..5],
        [",,,7,0.5,0.5", ",,,0,1.5,0.5", ",,,-1,0,0", ",,,0,nan,0"]
    );
    assert_eq!(numbers(rows[5]), [0.0, 1.0, 0.0, 2.0, 0.5, 0.5]);
    assert!(
        run.err
            .contains("line 2: off the chart: chart must be 0 to 5"),
        "{}",
        run.err
    );

    let corner = self::run(&["eval", "sphere", "--inverse"], "0,0.01,0.01\n");
    assert_eq!(corner.status, 1);
    assert!(corner.err.contains("inside the disc"), "{}", corner.err);
}

#[test]
fn a_rim_point_written_in_f32_is_read_in_f64() {
    // The first lies on the disc for f32 and 1.7e-7 outside of it for f64; the second is outside for both.
    let run = run(
        &["eval", "paraboloid", "--inverse", "--precision", "f64"],
        "0,0.8535535,0.1464466\n0,0.85356,0.14644\n",
    );
    let rows: Vec<&str> = run.out.lines().collect();
    assert!(numbers(rows[1])[2].abs() < 1e-15, "{}", rows[1]);
    assert_eq!((run.status, rows[2]), (1, ",,,0,0.85356,0.14644"));
}

#[test]
fn what_spreadsheets_write_is_read() {
    let expected = "x,y,z,chart,u,v\n0,0,2,4,0.5,0.5\n0,0,2,4,0.5,0.5\n";
    for input in [
        "\u{feff}x,y,z\r\n0,0,2\r\n0,0,2\r\n",
        "0,0,2\n0,0,2",
        "\"x\",\"y\",\"z\",note\n\"0\",\"0\",\"2\",\"a, b\"\n 0 , 0 ,\t2 ,,,\n",
        "\n\nX,Y,Z\n\n0,0,2\n   \n0.0,0e5,+2.000\n\n",
    ] {
        let run = run(&["eval", "cube"], input);
        assert_eq!(
            (run.status, run.out.as_str()),
            (0, expected),
            "{input:?}: {}",
            run.err
        );
    }
    // A second header is no header.
    assert_eq!(run(&["eval", "cube"], "x,y,z\nx,y,z\n").status, 1);
    let latin1 = run_on(&["eval", "cube"], b"1,\xe9,0\n0,0,1\n".to_vec());
    assert_eq!(latin1.status, 1);
    assert!(latin1.out.ends_with("\n0,0,1,4,0.5,0.5\n"));
}

#[test]
fn empty_input_gives_the_header_alone() {
    for input in ["", "\n\n", "x,y,z\n"] {
        let run = run(&["eval", "latlong"], input);
        assert_eq!(
            (run.status, run.out.as_str(), run.err.as_str()),
            (0, "x,y,z,chart,u,v\n", "")
        );
    }
}

#[test]
fn tiny_and_huge_numbers_read_back() {
    let input = "1e-45,0,0\n-3.4028235e38,3e38,0\n1e-7,1,0.1\n";
    let run = run(&["eval", "cube"], input);
    assert_eq!(run.status, 0, "{}", run.err);
    for (row, given) in run.out.lines().skip(1).zip(input.lines()) {
        let back: Vec<f32> = row.split(',').take(3).map(|c| c.parse().unwrap()).collect();
        let given: Vec<f32> = given.split(',').map(|c| c.parse().unwrap()).collect();
        assert_eq!(back, given);
        assert!(row.len() < 60, "{row}");
    }
}

#[test]
fn wrong_usage_ends_with_2_and_one_line_that_helps() {
    let cases: [(&[&str], &str); 12] = [
        (&["eval", "cubic"], "`sixfold maps` lists them"),
        (
            &["eval", "cube", "--convention", "grimm"],
            "it has: lower-left",
        ),
        (&["eval", "eac", "--convention", "grimm"], "it has: none"),
        (
            &["eval", "ccm", "--evaluator", "wgsl"],
            "it has: f32, reference, paper-shader",
        ),
        (
            &["eval", "ccm", "--evaluator", "paper-shader", "--inverse"],
            "no inverse",
        ),
        (
            &["eval", "ccm", "--convention", "printed-eq6", "--inverse"],
            "no inverse",
        ),
        (
            &[
                "eval",
                "ccm",
                "--evaluator",
                "paper-shader",
                "--convention",
                "paper",
            ],
            "leave --convention out",
        ),
        (
            &["eval", "cube", "--evaluator", "f32", "--precision", "f64"],
            "`reference`",
        ),
        (&["render", "out.jpg"], ".png"),
        (&["render", "out.png", "--size", "9000x10"], "1 to 8192"),
        (
            &["render", "out.png", "--what", "panel:cubic"],
            "`sixfold maps`",
        ),
        (&["render", "out.png", "--object", "bunny"], "rounded-cube"),
    ];
    for (args, help) in cases {
        let run = run(args, "");
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{args:?}");
        assert_eq!(run.err.lines().count(), 1, "{args:?}: {}", run.err);
        assert!(
            run.err.starts_with("sixfold: ") && run.err.contains(help),
            "{}",
            run.err
        );
    }
    for args in [&["eval"][..], &["eval", "cube", "--turbo"], &["--turbo"]] {
        assert_eq!(run(args, "").status, 2, "{args:?}");
    }
    let no_file = run(&["evl"], "");
    assert_eq!((no_file.status, no_file.err.lines().count()), (1, 1));
    assert!(no_file.err.contains("--help"));
    assert_eq!(run(&["--help"], "").status, 0);
}

#[test]
fn maps_lists_every_mapping() {
    let table = run(&["maps"], "");
    assert_eq!((table.status, table.err.as_str()), (0, ""));
    let ids: Vec<&str> = table
        .out
        .lines()
        .map(|l| l.split(' ').next().unwrap())
        .collect();
    assert_eq!(ids[0], "ID");
    assert_eq!(ids[1..], MAPS);
    let column = table.out.lines().next().unwrap().find("SOURCE").unwrap();
    for line in table.out.lines() {
        let at: String = line.chars().skip(column - 2).take(3).collect();
        assert!(
            at.starts_with("  ") && !at.ends_with(' '),
            "columns do not line up: {line}"
        );
    }

    let json: serde_json::Value = serde_json::from_str(&run(&["maps", "--json"], "").out).unwrap();
    let list = json.as_array().unwrap();
    assert_eq!(list.len(), MAPS.len());
    for (entry, id) in list.iter().zip(MAPS) {
        assert_eq!(entry["id"], id);
        for key in [
            "name",
            "charts",
            "coverage",
            "conventions",
            "evaluators",
            "source",
        ] {
            assert!(!entry[key].is_null(), "{id} has no {key}");
        }
        // Every name in the list is accepted.
        for (key, option) in [
            ("conventions", "--convention"),
            ("evaluators", "--evaluator"),
        ] {
            for named in entry[key].as_array().unwrap() {
                let name = named["id"].as_str().unwrap();
                assert_eq!(
                    run(&["eval", id, option, name], "1,2,3\n").status,
                    0,
                    "{id} {name}"
                );
            }
        }
    }
}

#[test]
fn the_printed_shader_reports_its_holes() {
    let run = run(
        &["eval", "ccm", "--evaluator", "paper-shader"],
        "-1,-1.00021,0\n1,2,3\n",
    );
    assert_eq!(run.status, 1);
    assert!(
        run.out.contains("\n-1,-1.00021,0,,,\n1,2,3,4,"),
        "{}",
        run.out
    );
    assert!(
        run.err.contains("line 1:") && run.err.contains("hole"),
        "{}",
        run.err
    );
}

#[test]
fn a_closed_pipe_ends_the_run_quietly() {
    let mut child = piped(&["eval", "cube"]);
    let mut stdin = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || {
        // Far more than all buffers hold; the write fails once the reader is gone.
        let chunk = "1,2,3\n".repeat(10_000);
        (0..1000).any(|_| stdin.write_all(chunk.as_bytes()).is_err())
    });
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut first)
        .unwrap();
    assert_eq!(first, "x,y,z,chart,u,v\n");
    let mut err = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut err)
        .unwrap();
    assert_eq!(err, "");
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(
        writer.join().unwrap(),
        "the stream was read to its end though nobody listened"
    );
}

#[test]
fn an_answer_does_not_wait_for_the_end_of_the_input() {
    let mut child = piped(&["eval", "cube"]);
    let mut stdin = child.stdin.take().unwrap();
    let mut answers = BufReader::new(child.stdout.take().unwrap()).lines();
    assert_eq!(answers.next().unwrap().unwrap(), "x,y,z,chart,u,v");
    for _ in 0..3 {
        stdin.write_all(b"0,0,1\n").unwrap();
        assert_eq!(answers.next().unwrap().unwrap(), "0,0,1,4,0.5,0.5");
    }
    drop(stdin);
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let mut command = sixfold(&["eval", "cube"]);
    command.stdin(Stdio::null()).stderr(Stdio::piped());
    command.stdout(
        std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .unwrap(),
    );
    let output = command.spawn().unwrap().wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(err.lines().count(), 1, "{err}");
    assert!(err.contains("standard output"), "{err}");
}

/// Peak memory in KiB of a run over `lines` lines and one that is `long` bytes long, taken while the process waits for
/// more.
#[cfg(target_os = "linux")]
fn peak_kib(lines: usize, long: usize) -> (u64, usize) {
    let mut child = piped(&["eval", "ccm"]);
    let out = child.stdout.take().unwrap();
    let reader = std::thread::spawn(move || {
        let mut rows = 0;
        for line in BufReader::new(out).lines() {
            rows += 1;
            if line.unwrap().starts_with("4,4,4,") {
                break;
            }
        }
        rows
    });
    let mut stdin = child.stdin.take().unwrap();
    for chunk in (0..lines).collect::<Vec<_>>().chunks(1000) {
        let text: String = chunk
            .iter()
            .map(|i| format!("{i}.5,-2.25,{}\n", i % 7))
            .collect();
        stdin.write_all(text.as_bytes()).unwrap();
    }
    let digits = vec![b'7'; 1 << 20];
    for _ in 0..long >> 20 {
        stdin.write_all(&digits).unwrap();
    }
    stdin.write_all(b"\n4,4,4\n").unwrap();
    // Nothing is held back while the input waits, so this row arrives, and then all lines have been computed.
    let rows = reader.join().unwrap();
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let peak = status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .unwrap();
    let peak = peak.trim().trim_end_matches(" kB").parse().unwrap();
    drop(stdin);
    child.wait().unwrap();
    (peak, rows)
}

#[cfg(target_os = "linux")]
#[test]
fn a_million_lines_need_no_more_memory_than_a_thousand() {
    let (few, few_rows) = peak_kib(1000, 0);
    let (many, many_rows) = peak_kib(1_000_000, 64 << 20);
    println!("peak memory: {few} KiB for {few_rows} rows, {many} KiB for {many_rows}");
    // The header and the last row; with the long line's own empty row.
    assert_eq!((few_rows, many_rows), (1002, 1_000_003));
    assert!(many <= few + 1024, "{many} KiB after {few} KiB");
}
