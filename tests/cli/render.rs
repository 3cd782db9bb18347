//! `sixfold render`: what is refused before anything is drawn.

use sixfold::app::figures::Figure;
use sixfold::app::state::AppState;

use super::{Run, run};

#[test]
fn an_existing_picture_is_refused_before_the_scene_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    std::fs::write(&out, "old").unwrap();
    let render = |more: &[&str]| {
        let args = ["render", out.to_str().unwrap(), "--scene", "missing.json"];
        run(&[&args, more].concat(), "")
    };
    let refused = render(&[]);
    assert_eq!((refused.status, refused.err.lines().count()), (1, 1));
    assert!(refused.err.contains("exists already"), "{}", refused.err);
    // Control: with --force the next thing that is wrong is the scene.
    let forced = render(&["--force"]);
    assert_eq!(forced.status, 1);
    assert!(forced.err.contains("missing.json"), "{}", forced.err);
    assert_eq!(std::fs::read(&out).unwrap(), b"old");
}

#[test]
fn a_mapping_is_not_compared_with_itself() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    // A missing environment ends a run that gets beyond the check.
    let render = |more: &[&str]| -> Run {
        let args = ["render", out.to_str().unwrap(), "--environment", "no.hdr"];
        run(&[&args, more].concat(), "")
    };
    let shown = AppState::default().mapping.info().id;
    for same in [
        &["--map", "eac", "--compare", "eac"][..],
        &["--compare", shown],
    ] {
        let refused = render(same);
        assert_eq!(
            (refused.status, refused.err.lines().count()),
            (2, 1),
            "{same:?}: {}",
            refused.err
        );
        assert!(refused.err.contains("compare"), "{}", refused.err);
    }
    let other = render(&["--map", "cube", "--compare", "eac"]);
    assert_eq!(other.status, 1, "{}", other.err);
    assert!(!out.exists());
}

#[test]
fn figures_are_listed_and_an_unknown_one_is_answered_with_those_there_are() {
    let listed = run(&["figure", "list"], "");
    assert_eq!(listed.status, 0, "{}", listed.err);
    assert_eq!(listed.out.lines().count(), Figure::all().count());
    assert!(listed.out.starts_with("paper-2\t"), "{}", listed.out);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new");
    let out_arg = out.to_str().unwrap();
    let unknown = run(&["figure", "notes-11", "--out", out_arg], "");
    assert_eq!((unknown.status, unknown.err.lines().count()), (2, 1));
    assert!(unknown.err.contains("notes-12"), "{}", unknown.err);
    assert!(!out.exists());
    // One name that is taken: nothing is drawn, and what is there stays.
    std::fs::create_dir(&out).unwrap();
    let taken = out.join("notes-13.png");
    std::fs::write(&taken, "old").unwrap();
    let refused = run(&["figure", "all", "--out", out_arg], "");
    assert_eq!((refused.status, refused.err.lines().count()), (1, 1));
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 1);
    assert_eq!(std::fs::read(&taken).unwrap(), b"old");
    // Control: the same folder takes another figure's name.
    let small = ["figure", "notes-9", "--size", "32x24", "--out", out_arg];
    let drawn = run(&small, "");
    assert_eq!(drawn.status, 0, "{}", drawn.err);
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 2);
}

#[test]
fn line_art_is_written_as_lines_too_and_nothing_else_is() {
    let folder = tempfile::tempdir().unwrap();
    let out_arg = folder.path().to_str().unwrap();
    let drawn = run(
        &["figure", "paper-8", "--size", "64x48", "--out", out_arg],
        "",
    );
    assert_eq!(drawn.status, 0, "{}", drawn.err);
    assert!(folder.path().join("paper-8.png").exists());
    let svg = std::fs::read_to_string(folder.path().join("paper-8.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    // The colours of the great circles A to F.
    for ink in [
        "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#d55e00", "#cc79a7",
    ] {
        assert!(svg.contains(ink), "{ink}");
    }
    let out = folder.path().join("out.svg");
    let render = |what: &str| run(&["render", out.to_str().unwrap(), "--what", what], "");
    let refused = render("viewport");
    assert_eq!((refused.status, refused.err.lines().count()), (1, 1));
    assert!(refused.err.contains(".png"), "{}", refused.err);
    assert!(!out.exists());
    for what in ["panel:octahedral", "panels", "fold", "sampling"] {
        let written = render(what);
        assert_eq!(written.status, 0, "{what}: {}", written.err);
        assert!(std::fs::read_to_string(&out).unwrap().contains("<polyline"));
        // A name that is taken is refused.
        assert_eq!(render(what).status, 1);
        std::fs::remove_file(&out).unwrap();
    }
    assert_eq!(render("panel:none").status, 2);
}

#[test]
fn an_unknown_material_is_answered_with_those_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let render = |name: &str| {
        let args = ["render", out.to_str().unwrap(), "--environment", "no.hdr"];
        run(&[&args[..], &["--material", name]].concat(), "")
    };
    let unknown = render("kryptonite");
    assert_eq!((unknown.status, unknown.err.lines().count()), (2, 1));
    assert!(unknown.err.contains("crown-glass"), "{}", unknown.err);
    // Control: with a known one the missing environment is what is wrong.
    assert_eq!(render("crown-glass").status, 1);
}
