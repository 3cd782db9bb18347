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
