//! What cannot be asked for.

use super::run;

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
            &["eval", "ccm", "--evaluator", "abacus"],
            "it has: f32, reference, library, wgsl, atan-5,",
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
