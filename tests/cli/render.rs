//! `sixfold render`: what is refused before anything is drawn.

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
