//! Pipes, full disks and long inputs.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::Stdio;

use super::{piped, sixfold};

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
