//! What is made, mended, left out and told.

use glam::DVec3;
use sixfold::meshes::LoadedMesh;

use super::document::{Document, U8};
use super::fixtures::{Checked, good, obj_positions, open, open_obj, refused, tetrahedron_obj};

/// A cube of quads from -1 to 1, outwards; `tail` is put behind each corner's number.
fn cube(tail: impl Fn(u32) -> String) -> String {
    let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit as f32 * 2.0 - 1.0);
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let mut text = obj_positions(&std::array::from_fn::<_, 8, _>(|i| corner(i as u32)));
    for face in faces {
        let corners = face.map(|n| format!("{}{}", n + 1, tail(n)));
        text += &format!("f {}\n", corners.join(" "));
    }
    text
}

/// A sphere of `columns` x `rows` quads without normals, moved and scaled.
fn sphere(columns: u32, rows: u32, centre: [f64; 3], radius: f64) -> String {
    let mut text = String::new();
    for j in 0..=rows {
        for i in 0..columns {
            let polar = std::f64::consts::PI * f64::from(j) / f64::from(rows);
            let around = std::f64::consts::TAU * f64::from(i) / f64::from(columns);
            let out = [
                polar.sin() * around.cos(),
                polar.cos(),
                polar.sin() * around.sin(),
            ];
            let [x, y, z] = [0, 1, 2].map(|k| centre[k] + radius * out[k]);
            text += &format!("v {x:e} {y:e} {z:e}\n");
        }
    }
    let number = |i: u32, j: u32| j * columns + i % columns + 1;
    for j in 0..rows {
        for i in 0..columns {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let corners = corners.map(|(i, j)| number(i, j).to_string());
            text += &format!("f {}\n", corners.join(" "));
        }
    }
    text
}

fn says(loaded: &LoadedMesh, wanted: &str) -> bool {
    loaded.notes.iter().any(|note| note.contains(wanted))
}

/// Largest angle between a sphere's normals and the exact ones, radians.
fn worst_angle(loaded: &LoadedMesh) -> f64 {
    let pairs = loaded.mesh.positions.iter().zip(&loaded.mesh.normals);
    let angles = pairs.map(|(p, n)| {
        let [p, n] = [p, n].map(|v| DVec3::from(v.map(f64::from)));
        p.cross(n).length().atan2(p.dot(n))
    });
    angles.fold(0.0, f64::max)
}

#[test]
fn a_cube_keeps_its_faces_and_given_normals_are_kept() {
    let volume = |checked: &Checked| (checked.volume - 8.0 / 27_f64.sqrt()).abs();
    let (flat, checked) = good(open_obj(&cube(|_| String::new())));
    assert_eq!(
        (flat.mesh.positions.len(), flat.mesh.indices.len()),
        (24, 36)
    );
    assert!(checked.worst_cosine > 1.0 - 1e-6 && volume(&checked) < 1e-6);
    assert!(
        says(&flat, "1 mesh, 12 triangles, 24 vertices"),
        "{:?}",
        flat.notes
    );
    assert!(says(&flat, "normals were made for 24 of 24 vertices"));
    assert!(!says(&flat, "open") && !says(&flat, "left out"));

    // One normal for each corner of the cube, as if it were round.
    let normals = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit * 20 - 10));
    let normals: String = normals
        .map(|[x, y, z]| format!("vn {x} {y} {z}\n"))
        .collect();
    let with_normals = cube(|n| format!("//{}", n + 1)) + &normals;
    let (round, checked) = good(open_obj(&with_normals));
    assert_eq!(
        (round.mesh.positions.len(), round.mesh.indices.len()),
        (8, 36)
    );
    assert!((checked.worst_cosine - 1.0 / 3_f64.sqrt()).abs() < 1e-6 && volume(&checked) < 1e-6);
    assert!(!says(&round, "normals"), "{:?}", round.notes);
    assert!(worst_angle(&round) < 1e-6 && worst_angle(&flat) > 0.9);

    // A normal that is none is made: the three corners at one place, the others are kept.
    for bad in ["vn 0 0 0", "vn NaN 1 0", "vn 1 inf 0", "vn 1e-60 0 0"] {
        let broken = with_normals.replace("vn -10 -10 -10", bad);
        let (mended, _) = good(open_obj(&broken));
        assert!(
            says(&mended, "made for 3 of 10 vertices"),
            "{bad}: {:?}",
            mended.notes
        );
    }
}

#[test]
fn a_round_model_becomes_smooth() {
    let (loaded, checked) = good(open_obj(&sphere(48, 24, [0.0; 3], 1.0)));
    // One vertex a place: the poles once, no seam. The triangles at the poles that have no area are left out.
    assert_eq!(loaded.mesh.positions.len(), 48 * 23 + 2);
    assert!(
        says(&loaded, "left out: 96 triangles without area"),
        "{:?}",
        loaded.notes
    );
    assert!(!says(&loaded, "open") && checked.volume > 4.1);
    // Observed: 0.0027 rad.
    let worst = worst_angle(&loaded);
    assert!(worst < 0.0035 && worst > 0.0035 / 4.0, "{worst}");
    // Control: the faces' own normals are off by up to 0.092 rad.
    assert!(checked.worst_cosine.acos() > 0.09);
}

#[test]
fn creases_split_above_forty_degrees_only() {
    let prism = |sides: u32| {
        let at = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(sides);
        let mut text = String::new();
        for i in 0..sides {
            let (sin, cos) = at(i).sin_cos();
            text += &format!("v {cos} -1 {sin}\nv {cos} 1 {sin}\n");
        }
        for i in 0..sides {
            let (a, b) = (2 * i + 1, 2 * ((i + 1) % sides) + 1);
            text += &format!("f {a} {} {} {b}\n", a + 1, b + 1);
        }
        let (loaded, _) = good(open_obj(&text));
        assert!(says(&loaded, &format!("open at {} edges", 2 * sides)));
        loaded.mesh.positions.len() as u32
    };
    // 8 sides meet at 45 degrees, 10 at 36.
    assert_eq!((prism(8), prism(10)), (8 * 4, 10 * 2));
}

#[test]
fn every_size_and_place_fits() {
    let (unit, _) = good(open_obj(&sphere(16, 8, [0.0; 3], 1.0)));
    for (centre, radius) in [
        ([0.0; 3], 1e30),
        ([0.0; 3], 1e-30),
        ([3e38, -3e38, 0.0], 3e37),
        ([1e6, 2e6, -3e6], 0.5),
        ([0.0; 3], 1e-300),
    ] {
        let (loaded, _) = good(open_obj(&sphere(16, 8, centre, radius)));
        assert_eq!(
            loaded.mesh.indices.len(),
            unit.mesh.indices.len(),
            "{radius}"
        );
        let pairs = loaded.mesh.positions.iter().zip(&unit.mesh.positions);
        for (a, b) in pairs {
            let far = DVec3::from(a.map(f64::from)).distance(b.map(f64::from).into());
            assert!(far < 1e-6, "{radius}: {far}");
        }
    }
    let message = refused(open_obj(&sphere(16, 8, [0.0; 3], 1e39)), "here.obj");
    assert!(message.contains("not a finite number"), "{message}");
}

#[test]
fn triangles_without_area_do_not_count() {
    let plain = tetrahedron_obj();
    let (wanted, _) = good(open_obj(&plain));
    // One corner twice, all on a line, and far outside: the box must not grow by them. Vertices of no triangle neither.
    let more = "v 90 0 0\nv 80 0 0\nv 70 0 0\nf 5 5 6\nf 5 6 7\nf 1 1 1\n";
    let (loaded, _) = good(open_obj(&(plain.clone() + more)));
    assert_eq!(loaded.mesh, wanted.mesh);
    assert!(
        says(&loaded, "left out: 3 triangles without area"),
        "{:?}",
        loaded.notes
    );
    assert!(!says(&wanted, "left out"));
    // Control: with an area it counts.
    let (other, _) = good(open_obj(&(plain + more + "f 5 6 1\nf 5 6 2\nf 5 6 3\n")));
    assert_ne!(other.mesh.positions[0], wanted.mesh.positions[0]);

    for flat in ["v 1 2 3\nf 1 1 1", "v 1 2 3\nv 2 3 4\nv 3 4 5\nf 1 2 3"] {
        let message = refused(open_obj(flat), "here.obj");
        assert!(message.contains("no triangle with an area"), "{message}");
    }
}

#[test]
fn the_outside_is_found() {
    let inside_out = |text: String| {
        let turn = |line: &str| match line.strip_prefix("f ") {
            Some(face) => format!(
                "f {}\n",
                face.split(' ').rev().collect::<Vec<_>>().join(" ")
            ),
            None => format!("{line}\n"),
        };
        text.lines().map(turn).collect::<String>()
    };
    let (right, right_way) = good(open_obj(&cube(|_| String::new())));
    let (turned, way) = good(open_obj(&inside_out(cube(|_| String::new()))));
    assert!(says(&turned, "inside out") && !says(&right, "turned"));
    assert!((way.volume - right_way.volume).abs() < 1e-6 && way.worst_cosine > 0.99);

    // Normals: outwards or inwards, with either winding, all end outwards.
    for factor in [1.0, -1.0] {
        let normal = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|bit| f64::from(bit) * 2.0 - 1.0);
        let normals = (0..8).map(normal).map(|n| n.map(|x| x * factor));
        let normals: String = normals
            .map(|[x, y, z]| format!("vn {x} {y} {z}\n"))
            .collect();
        let text = normals + &cube(|n| format!("//{}", n + 1));
        for (text, turns) in [(text.clone(), factor < 0.0), (inside_out(text), true)] {
            let (loaded, checked) = good(open_obj(&text));
            assert!(checked.volume > 0.0 && checked.worst_cosine > 0.5);
            assert_eq!(says(&loaded, "turned"), turns, "{:?}", loaded.notes);
        }
    }

    // Open: nothing but the normals tells. Up in the file is up in the world.
    let sheet = "v 0 0 0\nv 1 0 0\nv 0 0 1\nvn 0 1 0\n";
    for (face, turns) in [("f 1//1 3//1 2//1", false), ("f 1//1 2//1 3//1", true)] {
        let (loaded, checked) = good(open_obj(&format!("{sheet}{face}")));
        assert!(checked.worst_cosine > 0.99 && says(&loaded, "turned") == turns);
        assert!(says(&loaded, "open at 3 edges") && loaded.mesh.normals[0] == [0.0, 1.0, 0.0]);
    }
}

#[test]
fn notes_tell_what_is_unusual() {
    let against = tetrahedron_obj().replace("f 1 3 2", "f 1 2 3");
    let (loaded, _) = good(open_obj(&against));
    assert!(
        says(&loaded, "3 edges join triangles that face opposite ways"),
        "{:?}",
        loaded.notes
    );
    let lines = tetrahedron_obj() + "l 1 2 3\np 4\nusemtl gold\n";
    let (loaded, _) = good(open_obj(&lines));
    assert_eq!(loaded.mesh.indices.len(), 12);
    assert!(says(&loaded, "left out: 2 primitives") && says(&loaded, "not used: materials"));

    let mut document = Document::tetrahedron(U8);
    document.json["materials"] = serde_json::json!([{}, {}]);
    let points = serde_json::json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
    document.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(points);
    let (loaded, _) = good(open(document.glb(), "here.glb"));
    assert!(says(&loaded, "not used: 2 materials") && says(&loaded, "left out: 1 primitive"));
    let (plain, _) = good(open(Document::tetrahedron(U8).glb(), "here.glb"));
    assert!(!says(&plain, "not used") && !says(&plain, "left out"));
}

/// The most triangles that open. Run it by name, to measure time and memory.
#[test]
#[ignore = "20 s and 1.2 GB"]
fn long_the_largest_model_opens() {
    let text = sphere(2000, 1000, [0.0; 3], 1.0);
    let start = std::time::Instant::now();
    let (loaded, checked) = good(open(text, "here.obj"));
    println!(
        "{:.1} s: {}",
        start.elapsed().as_secs_f64(),
        loaded.notes[0]
    );
    assert_eq!(loaded.mesh.positions.len(), 2000 * 999 + 2);
    assert!((checked.volume - 4.18879).abs() < 1e-3);
}
