//! Models that lie about themselves. Each is one edit away from a good one.

use serde_json::{Value, json};
use sixfold::imaging::Progress;
use sixfold::meshes::{MOST_FILE_BYTES, MOST_TRIANGLES, MOST_VERTICES, MeshProblem, load};

use super::document::{Document, F32, U8, U16, U32};
use super::fixtures::{good, open, open_obj, refused, tetrahedron_obj};

fn sparse(count: u64) -> Value {
    json!({
        "count": count,
        "indices": { "bufferView": 1, "componentType": U16 },
        "values": { "bufferView": 0 },
    })
}

#[test]
fn gltf_that_contradicts_itself_is_refused() {
    type Edit = fn(&mut Value);
    let edits: [(&str, Edit); 41] = [
        ("4000000000 sparse elements", |j| {
            j["accessors"][0]["sparse"] = sparse(4_000_000_000)
        }),
        ("vertices", |j| {
            j["accessors"][0] = json!({
                "count": 4_000_000_000_u64, "type": "VEC3", "componentType": F32,
                "sparse": sparse(4_000_000_000),
            });
        }),
        ("4611686018427387904 vertices", |j| {
            j["accessors"][0]["count"] = (1_u64 << 62).into()
        }),
        ("triangles, the limit", |j| {
            j["accessors"][1]["count"] = u64::MAX.into()
        }),
        ("5 elements end behind buffer view 0", |j| {
            j["accessors"][0]["count"] = 5.into()
        }),
        ("elements end behind", |j| {
            j["accessors"][0]["byteOffset"] = 4.into()
        }),
        ("elements end behind", |j| {
            j["accessors"][0]["byteOffset"] = u64::MAX.into()
        }),
        ("ends behind its buffer", |j| {
            j["bufferViews"][0]["byteLength"] = 100.into()
        }),
        ("ends behind its buffer", |j| {
            j["bufferViews"][1]["byteOffset"] = u64::MAX.into()
        }),
        ("stride of 4", |j| {
            j["bufferViews"][0]["byteStride"] = 4.into()
        }),
        ("elements end behind", |j| {
            j["bufferViews"][0]["byteStride"] = u64::MAX.into()
        }),
        ("declares 1000 bytes", |j| {
            j["buffers"][0]["byteLength"] = 1000.into()
        }),
        ("declares 18446744073709551615", |j| {
            j["buffers"][0]["byteLength"] = u64::MAX.into()
        }),
        ("buffer 7", |j| j["bufferViews"][0]["buffer"] = 7.into()),
        ("buffer view 7", |j| {
            j["accessors"][0]["bufferView"] = 7.into()
        }),
        ("accessor 7", |j| {
            j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7.into()
        }),
        ("accessor 7", |j| {
            j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 7.into()
        }),
        ("accessor 7", |j| {
            j["meshes"][0]["primitives"][0]["indices"] = 7.into()
        }),
        ("no vectors of three", |j| {
            j["accessors"][0]["type"] = "VEC2".into()
        }),
        ("no vectors of three", |j| {
            j["accessors"][0]["type"] = "VEC9".into()
        }),
        ("no vectors of three", |j| {
            j["accessors"][0]["componentType"] = 7.into()
        }),
        ("vectors of u32", |j| {
            j["accessors"][0]["componentType"] = U32.into()
        }),
        ("no vertex numbers", |j| {
            j["accessors"][1]["componentType"] = F32.into()
        }),
        ("names vertex", |j| j["accessors"][0]["count"] = 3.into()),
        ("normals", |j| {
            j["accessors"].as_array_mut().unwrap().push(json!({
                "bufferView": 0, "type": "VEC3", "componentType": F32, "count": 3,
            }));
            j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2.into();
        }),
        ("place", |j| {
            j["accessors"][0]["sparse"] = sparse(4);
            j["accessors"][0]["sparse"]["indices"]["byteOffset"] = 1.into();
        }),
        ("places of no type", |j| {
            j["accessors"][0]["sparse"] = sparse(1);
            j["accessors"][0]["sparse"]["indices"]["componentType"] = F32.into();
        }),
        ("may be compressed", |j| {
            drop(
                j["accessors"][0]
                    .as_object_mut()
                    .unwrap()
                    .remove("bufferView"),
            )
        }),
        ("no known mode", |j| {
            j["meshes"][0]["primitives"][0]["mode"] = 9.into()
        }),
        ("KHR_draco_mesh_compression", |j| {
            j["extensionsRequired"] = json!(["KHR_draco_mesh_compression"])
        }),
        ("EXT_meshopt_compression", |j| {
            j["extensionsRequired"] = json!(["KHR_texture_transform", "EXT_meshopt_compression"])
        }),
        ("version is \"1.0\"", |j| {
            j["asset"]["version"] = "1.0".into()
        }),
        ("node 0 has two parents", |j| {
            j["nodes"][0]["children"] = json!([0])
        }),
        ("node 1 has two parents", |j| {
            j["nodes"] = json!([{ "children": [1, 1] }, { "mesh": 0 }])
        }),
        ("node 9", |j| j["scenes"][0]["nodes"] = json!([9])),
        ("node 9", |j| j["nodes"][0]["children"] = json!([9])),
        ("mesh 9", |j| j["nodes"][0]["mesh"] = 9.into()),
        ("scene 9", |j| j["scene"] = 9.into()),
        ("not a finite number", |j| {
            j["nodes"][0]["scale"] = json!([3e38, 1, 1])
        }),
        ("not a finite number", |j| {
            j["nodes"][0]["rotation"] = json!([0, 0, 0, 0])
        }),
        ("no triangle with an area", |j| {
            j["nodes"][0]["scale"] = json!([0, 0, 1])
        }),
    ];
    let mut document = Document::tetrahedron(U16);
    // 2 along x: 3e38 times that is no f32.
    good(open(document.glb(), "here.glb"));
    let whole = document.json.clone();
    for (wanted, edit) in edits {
        document.json = whole.clone();
        edit(&mut document.json);
        for bytes in [document.glb(), document.data_uri().into_bytes()] {
            let message = refused(open(bytes, "here.glb"), "here.glb");
            assert!(message.contains(wanted), "{wanted}: {message}");
        }
    }
}

#[test]
fn not_a_number_is_refused() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut document = Document::tetrahedron(U8);
        document.bytes[8..12].copy_from_slice(&bad.to_le_bytes());
        let message = refused(open(document.glb(), "here.glb"), "here.glb");
        assert!(message.contains("not a finite number"), "{message}");
    }
}

#[test]
fn obj_that_contradicts_itself_is_refused() {
    let good_text = tetrahedron_obj();
    good(open_obj(&good_text));
    let edits = [
        ("f 1 3 2", "f 0 3 2", "line 5: a face has the number \"0\""),
        (
            "f 1 3 2",
            "f 1 3 -2147483648",
            "has the number \"-2147483648\"",
        ),
        ("f 1 3 2", "f 1 3 -9223372036854775808", "has the number"),
        ("f 1 3 2", "f 1 3 99999999999999999999", "has the number"),
        (
            "f 1 3 2",
            "f 1 3 9223372036854775807",
            "names v 9223372036854775807 of 4",
        ),
        ("f 1 3 2", "f 1 3 -5", "has the number \"-5\""),
        ("f 1 3 2", "f 1 3 5", "line 5: a face names v 5 of 4"),
        ("f 1 3 2", "f 1 3 4294967297", "names v 4294967297 of 4"),
        ("f 1 3 2", "f 1//1 3 2", "names vn 1 of 0"),
        ("f 1 3 2", "f 1//0 3 2", "has the number \"0\""),
        ("f 1 3 2", "f 1//-1 3 2", "has the number \"-1\""),
        ("f 1 3 2", "f one 3 2", "has the number \"one\""),
        ("f 1 3 2", "f 1 3.0 2", "has the number \"3.0\""),
        (
            "v 2 0 0",
            "v NaN 0 0",
            "line 2: a position is not a finite number",
        ),
        ("v 2 0 0", "v 2 -inf 0", "not a finite number"),
        ("v 2 0 0", "v 2 0 1e39", "not a finite number"),
        (
            "v 2 0 0",
            "v 2 0",
            "line 2: \"\" stands where a number must",
        ),
        ("v 2 0 0", "v 2 0x10 0", "\"0x10\" stands"),
        ("v 2 0 0", "v 2 \u{1b}[31m 0", "stands where a number must"),
    ];
    for (from, to, wanted) in edits {
        let text = good_text.replace(from, to);
        assert_ne!(text, good_text);
        let message = refused(open_obj(&text), "here.obj");
        assert!(message.contains(wanted), "{to}: {message}");
        assert!(!message.contains('\u{1b}'));
    }
}

#[test]
fn other_files_are_named() {
    for (bytes, name, wanted) in [
        (&b"solid cube"[..], "here.stl", "no format here does"),
        (b"", "here.glb", "no format here does"),
        (b"", "here.obj", "it has no faces"),
        (b"\0\0\0", "here.obj", "it has no faces"),
        (b"{", "here.gltf", "JSON does not read"),
        (b"{}", "here.gltf", "JSON does not read"),
        (b"glTF", "here.glb", "breaks off"),
        (b"glTF\x01\0\0\0\x0c\0\0\0", "here.glb", "version is 1"),
        (b"glTF\x02\0\0\0\x0c\0\0\0", "here.glb", "no JSON"),
        (b"glTF\x02\0\0\0\x05\0\0\0", "here.glb", "breaks off"),
        (b"glTF\x02\0\0\0\xff\xff\xff\xff", "here.glb", "breaks off"),
        (
            b"glTF\x02\0\0\0\x14\0\0\0\xff\xff\xff\xffJSON",
            "here.glb",
            "breaks off",
        ),
    ] {
        let message = refused(open(bytes, name), name);
        assert!(message.contains(wanted), "{message}");
    }
    let whole = Document::tetrahedron(U8).glb();
    for length in 0..whole.len() {
        assert!(open(&whole[..length], "here.glb").is_err(), "{length}");
    }
    let text = Document::tetrahedron(U8).data_uri();
    for length in 0..text.len() {
        assert!(open(&text[..length], "here.gltf").is_err(), "{length}");
    }
    for data in [
        "data:",
        "data:text/plain,abc",
        "data:;base64,%41",
        "data:;base64,A",
    ] {
        let text = Document::tetrahedron(U8).text(data);
        let message = refused(open(text, "here.gltf"), "here.gltf");
        assert!(message.contains("data URI"), "{message}");
    }
}

#[test]
fn bombs_end_in_a_message() {
    // Text that would grow: objects, members, one primitive shown by many nodes, deep lists.
    let head = r#"{"asset":{"version":"2.0"},"#;
    let objects = format!("{head}\"nodes\":[{}{{}}]}}", "{},".repeat(1 << 18));
    let members = format!(
        "{head}\"extensionsUsed\":[{}\"\"]}}",
        "\"\",".repeat(1 << 23)
    );
    let deep = format!("{head}\"extras\":{}", "[".repeat(1 << 20));
    let mut many = Document::tetrahedron(U8);
    let empty = json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
    many.json["meshes"][0]["primitives"] = vec![empty; 1000].into();
    many.json["nodes"] = vec![json!({ "mesh": 0 }); 1000].into();
    many.json["scenes"][0]["nodes"] = (0..1000).collect::<Vec<_>>().into();
    // 400 copies of a strip that stays in one place.
    let mut copies = Document::tetrahedron(U8);
    let strip = copies.numbers(&vec![0; 20_000], U8);
    copies.primitive()["indices"] = strip.into();
    copies.primitive()["mode"] = 5.into();
    copies.json["nodes"] = vec![json!({ "mesh": 0 }); 400].into();
    copies.json["scenes"][0]["nodes"] = (0..400).collect::<Vec<_>>().into();
    for (bytes, wanted) in [
        (objects.into_bytes(), "JSON objects, the limit is 262144"),
        (
            members.into_bytes(),
            "JSON list members, the limit is 8388608",
        ),
        (deep.into_bytes(), "JSON does not read"),
        (many.glb(), "primitives, the limit is 262144"),
        (copies.glb(), "triangles, the limit is 4000000"),
    ] {
        let message = refused(open(bytes, "here.gltf"), "here.gltf");
        assert!(message.contains(wanted), "{message}");
    }
    // A face of more corners than there may be triangles, and too many vertices.
    let corners = "f".to_owned() + &" 1".repeat(MOST_TRIANGLES as usize + 3);
    let message = refused(open_obj(&format!("v 0 0 0\n{corners}")), "here.obj");
    assert!(
        message.contains("4000001 triangles, the limit is 4000000"),
        "{message}"
    );
    let message = refused(
        open_obj(&"v 0 0 0\n".repeat(MOST_VERTICES as usize + 1)),
        "here.obj",
    );
    assert!(
        message.contains("8000001 vertices, the limit is 8000000"),
        "{message}"
    );
}

#[test]
fn a_crowded_place_takes_no_longer() {
    // A fan of 20 000 triangles at one point, and as many at one edge: pairs would be 400 million.
    let count = 20_000;
    let mut fan = "v 0 0 0\nv 0 1 0\n".to_owned();
    for i in 0..count {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
        fan += &format!("v {cos} 0 {sin}\n");
    }
    let mut book = fan.clone();
    for i in 0..count {
        fan += &format!("f 1 {} {}\n", i + 3, (i + 1) % count + 3);
        book += &format!("f 1 2 {}\n", i + 3);
    }
    let (loaded, _) = good(open_obj(&fan));
    assert_eq!(loaded.mesh.positions.len(), count as usize + 1);
    let (loaded, _) = good(open_obj(&book));
    assert_eq!(loaded.mesh.indices.len(), 3 * count as usize);
}

#[test]
fn cancelled_and_too_long_files_stop() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("here.obj");
    std::fs::write(&path, tetrahedron_obj()).unwrap();
    let progress = Progress::new();
    good(load(&path, &progress));
    progress.cancel();
    let error = load(&path, &progress).unwrap_err();
    assert!(matches!(error.problem, MeshProblem::Cancelled), "{error}");

    // Holes: the file takes no room.
    let file = std::fs::File::create(&path).unwrap();
    file.set_len(MOST_FILE_BYTES + 1).unwrap();
    let message = refused(load(&path, &Progress::new()), &path.display().to_string());
    assert!(
        message.contains("268435457 bytes, the limit is 268435456"),
        "{message}"
    );
    let missing = folder.path().join("none.obj");
    let error = load(&missing, &Progress::new()).unwrap_err();
    assert!(matches!(error.problem, MeshProblem::Io(_)), "{error}");
}
