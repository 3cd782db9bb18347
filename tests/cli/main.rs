//! The command line as other programs see it: the real binary, its streams and its exit status.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

mod convert;
mod eval;
mod interrupted;
mod maps;
mod metrics;
#[cfg(feature = "explorer")]
mod render;
mod streams;
mod usage;

use std::io::Write;
use std::process::{Child, Command, Stdio};

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

/// The mappings that have golden tables.
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
