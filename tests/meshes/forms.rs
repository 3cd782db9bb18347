//! One model in every form: each must give the same mesh, bit by bit.

use std::fs;

use glam::DVec3;
use serde_json::json;
use sixfold::imaging::Progress;
use sixfold::meshes::load;

use super::document::{Document, F32, U8, U16, U32, floats, whole};
use super::fixtures::{
    POSITIONS, TRIANGLES, check, good, obj_positions, open, open_obj, tetrahedron, tetrahedron_obj,
};

/// Opens a glTF text and demands the tetrahedron, without a word of mending.
fn is_tetrahedron(document: &Document) {
    let (loaded, _) = good(open(document.data_uri(), "here.gltf"));
    assert_eq!(loaded.mesh, tetrahedron());
    assert!(
        !loaded.notes.iter().any(|note| note.contains("turned")),
        "{:?}",
        loaded.notes
    );
}

#[test]
fn the_tetrahedron_is_where_it_must_be() {
    let mesh = tetrahedron();
    // Box from (0, 0, 0) to (2, 1, 3); its corners are farthest from its centre.
    let (centre, radius) = (DVec3::new(1.0, 0.5, 1.5), 3.5_f64.sqrt());
    let expected = |p: [f32; 3]| (DVec3::from(p.map(f64::from)) - centre) / radius;
    let is_there = |wanted: DVec3| {
        let positions = mesh.positions.iter();
        let far = positions.map(|p| DVec3::from(p.map(f64::from)).distance(wanted));
        far.fold(f64::MAX, f64::min) < 1e-7
    };
    let found = |signs: DVec3| {
        let expected = POSITIONS.map(|p| expected(p) * signs);
        expected.into_iter().filter(|p| is_there(*p)).count()
    };
    assert_eq!(found(DVec3::new(1.0, 1.0, -1.0)), 4);
    // Controls: as it was, and with another axis turned.
    for signs in [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, -1]] {
        assert!(found(DVec3::from(signs.map(f64::from))) < 4, "{signs:?}");
    }
    let volume = check(&mesh).unwrap().volume;
    assert!((volume - radius.powi(-3)).abs() < 1e-6, "{volume}");
}

#[test]
fn numbers_of_every_width() {
    for component in [U8, U16, U32] {
        is_tetrahedron(&Document::tetrahedron(component));
    }
    let mut plain = Document::new();
    let corners = TRIANGLES.as_flattened().iter();
    let corners: Vec<_> = corners.map(|&n| POSITIONS[n as usize]).collect();
    plain.primitive()["attributes"]["POSITION"] = plain.vectors(&corners).into();
    is_tetrahedron(&plain);

    // Control: one other coordinate is another mesh.
    let mut other = Document::tetrahedron(U16);
    let y_of_third = 4 * 7;
    other.bytes[y_of_third..][..4].copy_from_slice(&1.001_f32.to_le_bytes());
    let (loaded, _) = good(open(other.data_uri(), "here.gltf"));
    assert_ne!(loaded.mesh, tetrahedron());
}

#[test]
fn buffers_in_every_place() {
    let document = Document::tetrahedron(U16);
    let wanted = tetrahedron();
    for bytes in [
        document.glb(),
        document.data_uri().into_bytes(),
        document.unpadded_data_uri().into_bytes(),
        format!("\u{feff} {}", document.data_uri()).into_bytes(),
    ] {
        let (loaded, _) = good(open(bytes, "any name"));
        assert_eq!(loaded.mesh, wanted);
    }

    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    for (name, uri) in [
        ("a.bin", "a.bin"),
        ("a b%.bin", "a%20b%25.bin"),
        ("parts/c.bin", "./parts/c.bin"),
        ("..d.bin", "..d.bin"),
    ] {
        // More bytes than declared are no fault.
        let bytes = [&document.bytes[..], b"more"].concat();
        fs::write(folder.path().join(name), bytes).unwrap();
        let model = folder.path().join("model.gltf");
        fs::write(&model, document.text(uri)).unwrap();
        let (loaded, _) = good(load(&model, &Progress::new()));
        assert_eq!(loaded.mesh, wanted, "{uri}");
    }
}

#[test]
fn strided_with_given_normals() {
    let up = [[0.0, 1.0, 0.0]; 4];
    let mixed: Vec<[f32; 3]> = POSITIONS
        .iter()
        .zip(&up)
        .flat_map(|(p, n)| [*p, *n])
        .collect();
    let mut document = Document::new();
    let view = document.view(&floats(&mixed));
    document.json["bufferViews"][view]["byteStride"] = 24.into();
    let positions = document.accessor(view, "VEC3", F32, 4);
    let normals = document.accessor(view, "VEC3", F32, 4);
    document.json["accessors"][normals]["byteOffset"] = 12.into();
    let numbers = document.numbers(TRIANGLES.as_flattened(), U8);
    *document.primitive() = json!({
        "attributes": { "POSITION": positions, "NORMAL": normals }, "indices": numbers,
    });
    let (loaded, _) = good(open(document.glb(), "here.glb"));
    assert_eq!(loaded.mesh.normals, up);
    // The same with two arrays, and as an OBJ.
    let mut apart = Document::tetrahedron(U32);
    apart.primitive()["attributes"]["NORMAL"] = apart.vectors(&up).into();
    let (apart, _) = good(open(apart.glb(), "here.glb"));
    assert_eq!(apart.mesh, loaded.mesh);
    let faces = TRIANGLES.map(|t| t.map(|n| format!("{0}/7/{0}", n + 1)).join(" "));
    let text = obj_positions(&POSITIONS) + &"vn 0 1 0\n".repeat(4) + "f " + &faces.join("\nf ");
    let (obj, _) = good(open_obj(&text));
    assert_eq!(obj.mesh, loaded.mesh);
    // Control: without its stride the view gives another model.
    document.json["bufferViews"][view]["byteStride"] = 12.into();
    let (packed, _) = good(open(document.glb(), "here.glb"));
    assert_ne!(packed.mesh, loaded.mesh);
}

#[test]
fn sparse_vertices() {
    // Two places mended over a wrong base, and all three others over a base of zeros.
    for (with_base, places) in [(true, vec![1, 3]), (false, vec![1, 2, 3])] {
        let mut document = Document::tetrahedron(U8);
        if with_base {
            for place in &places {
                document.bytes[12 * *place as usize..][..12].fill(60 + *place as u8);
            }
            let (broken, _) = good(open(document.glb(), "here.glb"));
            assert_ne!(broken.mesh, tetrahedron());
        } else {
            let accessor = document.json["accessors"][0].as_object_mut().unwrap();
            accessor.remove("bufferView");
        }
        let values: Vec<_> = places.iter().map(|&n| POSITIONS[n as usize]).collect();
        let values = document.view(&floats(&values));
        let at = document.view(&whole(&places, U16));
        document.json["accessors"][0]["sparse"] = json!({
            "count": places.len(),
            "indices": { "bufferView": at, "componentType": U16 },
            "values": { "bufferView": values },
        });
        is_tetrahedron(&document);
    }
}

#[test]
fn whole_number_positions() {
    let mut document = Document::tetrahedron(U8);
    let bytes = POSITIONS.map(|p| p.map(|x| x as u8)).concat();
    let view = document.view(&bytes);
    let positions = document.accessor(view, "VEC3", U8, 4);
    document.primitive()["attributes"]["POSITION"] = positions.into();
    document.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    is_tetrahedron(&document);
    // Normalised, all are 255 times smaller: the same shape, but for rounding.
    document.json["accessors"][positions]["normalized"] = true.into();
    let (loaded, _) = good(open(document.glb(), "here.glb"));
    let pairs = loaded.mesh.positions.iter().zip(tetrahedron().positions);
    for (a, b) in pairs {
        assert!(DVec3::from(a.map(f64::from)).distance(b.map(f64::from).into()) < 2e-7);
    }
}

#[test]
fn node_transforms() {
    // The parent turns a quarter about y (x to -z, z to x) and moves; the child doubles. Undone in the positions.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let parent_from_root = |p: [f32; 3]| [-(p[2] - 3.0), p[1] - 2.0, p[0] - 1.0];
    let positions = POSITIONS.map(|p| parent_from_root(p).map(|x| x / 2.0));
    let mut document = Document::tetrahedron(U8);
    document.bytes[..48].copy_from_slice(&floats(&positions));
    document.json["nodes"] = json!([
        { "children": [1], "rotation": [0, half, 0, half], "translation": [1, 2, 3] },
        { "mesh": 0, "scale": [2, 2, 2] },
    ]);
    let (loaded, checked) = good(open(document.glb(), "here.glb"));
    let distance = |mesh: &sixfold::scene::Mesh| {
        let pairs = mesh.positions.iter().zip(tetrahedron().positions);
        let far =
            pairs.map(|(a, b)| DVec3::from(a.map(f64::from)).distance(b.map(f64::from).into()));
        far.fold(0.0, f64::max)
    };
    assert!(distance(&loaded.mesh) < 2e-7 && checked.volume > 0.0);

    // The same as one matrix, column by column; without the scene; and in a second scene that is the default.
    let matrix = json!([0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1]);
    document.json["nodes"] = json!([{ "mesh": 0, "matrix": matrix }]);
    let (matrix, _) = good(open(document.glb(), "here.glb"));
    assert!(distance(&matrix.mesh) < 2e-7);
    let root = document.json.as_object_mut().unwrap();
    root.remove("scene");
    root.remove("scenes");
    let (loose, _) = good(open(document.glb(), "here.glb"));
    assert_eq!(loose.mesh, matrix.mesh);
    document.json["scenes"] = json!([{ "nodes": [] }, { "nodes": [0] }]);
    document.json["scene"] = 1.into();
    let (second, _) = good(open(document.glb(), "here.glb"));
    assert_eq!(second.mesh, matrix.mesh);
    // Control: without the transform the box differs.
    document.json["nodes"] = json!([{ "mesh": 0 }]);
    let (plain, _) = good(open(document.glb(), "here.glb"));
    assert!(distance(&plain.mesh) > 0.1);
}

#[test]
fn mirrors_keep_the_outside_outside() {
    let mirrored = |reverse: bool| {
        let mut document = Document::tetrahedron(U8);
        let positions = POSITIONS.map(|[x, y, z]| [-x, y, z]);
        document.bytes[..48].copy_from_slice(&floats(&positions));
        let order = |[a, b, c]: [u32; 3]| if reverse { [a, c, b] } else { [a, b, c] };
        let numbers = document.numbers(TRIANGLES.map(order).as_flattened(), U8);
        document.primitive()["indices"] = numbers.into();
        document.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
        good(open(document.glb(), "here.glb")).0
    };
    // Mirrored positions need the other order to face outwards, and the mirror of the node turns both back.
    let loaded = mirrored(true);
    assert!(!loaded.notes.iter().any(|note| note.contains("turned")));
    let wanted = check(&tetrahedron()).unwrap().volume;
    assert!((check(&loaded.mesh).unwrap().volume - wanted).abs() < 1e-7);
    // Control: in the first order it is inside out, and that is told.
    let inside_out = mirrored(false);
    assert!(
        inside_out
            .notes
            .iter()
            .any(|note| note.contains("inside out"))
    );
}

#[test]
fn normals_go_with_their_surface() {
    // A slope under a non-uniform scale: its normal is not scaled like a position.
    let mut document = Document::new();
    let positions = document.vectors(&[[0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 0.0]]);
    let s = std::f32::consts::FRAC_1_SQRT_2;
    let normals = document.vectors(&[[s, s, 0.0]; 3]);
    document.primitive()["attributes"] = json!({ "POSITION": positions, "NORMAL": normals });
    document.json["nodes"][0]["scale"] = json!([3, 1, 1]);
    let (loaded, checked) = good(open(document.glb(), "here.glb"));
    assert!(
        checked.worst_cosine > 1.0 - 1e-6,
        "{}",
        checked.worst_cosine
    );
    let wrong = DVec3::new(3.0, 1.0, 0.0).normalize();
    let normal = DVec3::from(loaded.mesh.normals[0].map(f64::from));
    assert!(normal.dot(wrong) < 0.7, "{normal}");
}

#[test]
fn strips_and_fans() {
    let mut strip = Document::tetrahedron(U8);
    let numbers = strip.numbers(&[1, 0, 2, 3, 1, 0], U8);
    strip.primitive()["indices"] = numbers.into();
    strip.primitive()["mode"] = 5.into();
    let (loaded, checked) = good(open(strip.glb(), "here.glb"));
    let wanted = check(&tetrahedron()).unwrap().volume;
    assert!((checked.volume - wanted).abs() < 1e-7);
    assert_eq!(loaded.mesh.indices.len(), 12);
    assert!(
        !loaded
            .notes
            .iter()
            .any(|n| n.contains("turned") || n.contains("open"))
    );

    let fan = |mode: u32, numbers: &[u32]| {
        let mut document = Document::tetrahedron(U8);
        let numbers = document.numbers(numbers, U8);
        document.primitive()["indices"] = numbers.into();
        document.primitive()["mode"] = mode.into();
        good(open(document.glb(), "here.glb")).0.mesh
    };
    // Three faces round the corner 0.
    let as_fan = fan(6, &[0, 2, 1, 3, 2]);
    let as_list = fan(4, &[2, 1, 0, 1, 3, 0, 3, 2, 0]);
    assert_eq!(as_fan, as_list);
    assert_ne!(fan(6, &[0, 2, 3, 1, 2]), as_list);
}

#[test]
fn obj_in_every_spelling() {
    let wanted = tetrahedron();
    let plain = tetrahedron_obj();
    let negative = "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
    let texts = [
        obj_positions(&POSITIONS) + negative,
        // Faces before what they name, groups, materials, comments, colours, other line ends, joined lines, Latin-1.
        plain.replace('\n', "\r\n"),
        plain.replace(
            "f 1 3 2",
            "o a\ng b c\nusemtl red\ns off\nf 1 \\\n 3 \\\r\n 2 # here",
        ),
        plain.replace("v 2 0 0", "v 2.0e0 +0 -0 1.0 0.5 0.5 0.5"),
        plain
            .lines()
            .rev()
            .skip(4)
            .map(|l| format!("{l}\n"))
            .collect::<String>(),
    ];
    for text in &texts[..4] {
        let (loaded, _) = good(open_obj(text));
        assert_eq!(loaded.mesh, wanted, "{text}");
    }
    let mut latin = b"# caf\xe9\no \xff\xfe\n".to_vec();
    latin.extend(plain.bytes());
    assert_eq!(good(open(latin, "A.OBJ")).0.mesh, wanted);
    // Forward: all faces stand before the positions.
    let (positions, faces) = plain.split_at(plain.find('f').unwrap());
    assert_eq!(
        good(open_obj(&format!("{faces}{positions}"))).0.mesh,
        wanted
    );
    // Controls: positions alone are no model, another face is another mesh.
    assert!(open_obj(&texts[4]).is_err());
    let other = plain.replace("f 1 3 2", "f 1 2 3");
    assert_ne!(open_obj(&other).unwrap().mesh, wanted);
}
