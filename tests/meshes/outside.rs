//! A model reads nothing outside its own folder.

use std::fs;

use sixfold::imaging::Progress;
use sixfold::meshes::{MeshProblem, load};

use super::document::{Document, U16};
use super::fixtures::{good, refused, tetrahedron};

#[test]
fn nothing_outside_the_folder_is_used() {
    let top = tempfile::tempdir().unwrap();
    let folder = top.path().join("model");
    fs::create_dir(&folder).unwrap();
    let document = Document::tetrahedron(U16);
    let outside = top.path().join("outside.bin");
    fs::write(&outside, &document.bytes).unwrap();
    let model = folder.join("model.gltf");
    let open = |uri: &str| {
        fs::write(&model, document.text(uri)).unwrap();
        load(&model, &Progress::new())
    };

    let absolute = outside.display().to_string();
    let uris = [
        "../outside.bin",
        "./../outside.bin",
        "sub/../../outside.bin",
        "%2e%2e/outside.bin",
        "..%2Foutside.bin",
        "%2E%2E%2Foutside.bin",
        ".. /outside.bin",
        "..\\outside.bin",
        "..%5Coutside.bin",
        "\\\\host\\share\\outside.bin",
        "%5c%5chost%5cshare%5coutside.bin",
        "//host/share/outside.bin",
        "%2f%2fhost/outside.bin",
        "C:outside.bin",
        "C%3A/outside.bin",
        "http://localhost/outside.bin",
        "%FF.bin",
        "%C3%28.bin",
        "outside%",
        "outside%2",
        "outside%zz.bin",
        "out\u{0}side.bin",
        "out%00side.bin",
        &absolute,
        &absolute.replace('/', "%2f"),
        &format!("file://{absolute}"),
        &format!("FILE:{absolute}"),
    ];
    for uri in uris {
        let result = open(uri);
        let problem = &result.as_ref().unwrap_err().problem;
        assert!(
            matches!(problem, MeshProblem::Outside { .. }),
            "{uri}: {problem}"
        );
        refused(result, &model.display().to_string());
    }

    // Controls: the very file is good where the model may read it, and each name is good when it stays inside.
    fs::write(folder.join("outside.bin"), &document.bytes).unwrap();
    for uri in ["outside.bin", "./outside.bin", "%6futside.bin"] {
        assert_eq!(good(open(uri)).0.mesh, tetrahedron(), "{uri}");
    }
    let above = top.path().join("model.gltf");
    fs::write(&above, document.text("outside.bin")).unwrap();
    assert_eq!(good(load(&above, &Progress::new())).0.mesh, tetrahedron());
}

#[cfg(unix)]
#[test]
fn links_that_leave_the_folder_are_refused() {
    use std::os::unix::fs::symlink;

    let top = tempfile::tempdir().unwrap();
    let folder = top.path().join("model");
    fs::create_dir(&folder).unwrap();
    let document = Document::tetrahedron(U16);
    fs::write(top.path().join("outside.bin"), &document.bytes).unwrap();
    fs::write(folder.join("inside.bin"), &document.bytes).unwrap();
    symlink("../outside.bin", folder.join("link.bin")).unwrap();
    symlink("..", folder.join("up")).unwrap();
    symlink("inside.bin", folder.join("within.bin")).unwrap();
    symlink("/dev/zero", folder.join("endless.bin")).unwrap();
    let model = folder.join("model.gltf");
    let open = |uri: &str| {
        fs::write(&model, document.text(uri)).unwrap();
        load(&model, &Progress::new())
    };
    for uri in ["link.bin", "up/outside.bin", "endless.bin"] {
        let problem = open(uri).unwrap_err().problem;
        assert!(
            matches!(problem, MeshProblem::Outside { .. }),
            "{uri}: {problem}"
        );
    }
    assert_eq!(good(open("within.bin")).0.mesh, tetrahedron());

    // What is no file, or not there, or too short.
    fs::create_dir(folder.join("sub")).unwrap();
    for uri in ["sub", "none.bin", ""] {
        let problem = open(uri).unwrap_err().problem;
        assert!(
            matches!(problem, MeshProblem::Buffer { .. }),
            "{uri}: {problem}"
        );
    }
    fs::write(folder.join("short.bin"), &document.bytes[1..]).unwrap();
    let message = open("short.bin").unwrap_err().to_string();
    assert!(
        message.contains("declares 72 bytes and has 71"),
        "{message}"
    );
}
