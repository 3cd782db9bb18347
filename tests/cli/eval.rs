//! `sixfold eval`: the numbers, the columns, and what becomes of lines that are no directions.

use sixfold::math::angle_rad;

use super::{MAPS, golden, numbers, run, run_on, worst};

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
        // A plumbing test: rims and poles are resolved to half the digits only, which tests/laws looks at closely.
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
        ("sphere", "hoff", "x,y,z,chart,u,v"),
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
