//! A small asymmetric model, and the laws that every loaded mesh keeps.

use std::path::Path;

use glam::{DVec3, Vec3};
use sixfold::imaging::Progress;
use sixfold::meshes::{LoadedMesh, MeshError, load_bytes};
use sixfold::scene::Mesh;

/// A tetrahedron, right-handed: no two of its edges at the origin are equally long.
pub const POSITIONS: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 3.0],
];

/// Counter-clockwise as seen from outside.
pub const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

pub fn open(bytes: impl Into<Vec<u8>>, name: &str) -> Result<LoadedMesh, MeshError> {
    load_bytes(bytes.into(), Path::new(name), &Progress::new())
}

pub fn open_obj(text: &str) -> Result<LoadedMesh, MeshError> {
    open(text, "here.obj")
}

/// The positions as OBJ lines.
pub fn obj_positions(positions: &[[f32; 3]]) -> String {
    let line = |p: &[f32; 3]| format!("v {} {} {}\n", p[0], p[1], p[2]);
    positions.iter().map(line).collect()
}

pub fn tetrahedron_obj() -> String {
    let faces = TRIANGLES.map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1));
    obj_positions(&POSITIONS) + &faces.concat()
}

/// The mesh that every form of the tetrahedron must give.
pub fn tetrahedron() -> Mesh {
    open_obj(&tetrahedron_obj()).unwrap().mesh
}

/// What `check` found.
pub struct Checked {
    /// Enclosed volume, positive when the winding faces outwards.
    pub volume: f64,
    /// Smallest cosine between a triangle and the normals at its corners.
    pub worst_cosine: f64,
}

/// The laws of a loaded mesh.
pub fn check(mesh: &Mesh) -> Result<Checked, String> {
    if mesh.positions.len() != mesh.normals.len() || !mesh.indices.len().is_multiple_of(3) {
        return Err("lengths".into());
    }
    let (mut low, mut high, mut radius) = (Vec3::MAX, Vec3::MIN, 0.0f32);
    for (&position, &normal) in mesh.positions.iter().zip(&mesh.normals) {
        let (position, normal) = (Vec3::from(position), Vec3::from(normal));
        if !(position + normal).is_finite() {
            return Err(format!("{position}, {normal}"));
        }
        if (normal.length() - 1.0).abs() >= 4.0 * f32::EPSILON {
            return Err(format!("normal {normal} is not unit"));
        }
        if position.length() > 1.0 + 2.0 * f32::EPSILON {
            return Err(format!("{position} is outside the unit ball"));
        }
        radius = radius.max(position.length());
        (low, high) = (low.min(position), high.max(position));
    }
    if radius < 1.0 - 4.0 * f32::EPSILON {
        return Err(format!("the farthest vertex is at {radius}"));
    }
    let centre = (low + high) / 2.0;
    if centre.abs().max_element() > 2.0 * f32::EPSILON {
        return Err(format!("the box is centred at {centre}"));
    }
    let mut is_used = vec![false; mesh.positions.len()];
    let mut checked = Checked {
        volume: 0.0,
        worst_cosine: 1.0,
    };
    for corners in mesh.triangles() {
        if corners.iter().any(|&i| i as usize >= is_used.len()) {
            return Err("index out of range".into());
        }
        let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]).as_dvec3());
        checked.volume += a.dot(b.cross(c)) / 6.0;
        let Some(face) = (b - a).cross(c - a).try_normalize() else {
            return Err(format!("degenerate triangle at {a}"));
        };
        for i in corners {
            is_used[i as usize] = true;
            let normal = DVec3::from(mesh.normals[i as usize].map(f64::from));
            checked.worst_cosine = checked.worst_cosine.min(face.dot(normal));
        }
    }
    if !is_used.iter().all(|used| *used) {
        return Err("a vertex of no triangle".into());
    }
    Ok(checked)
}

/// Opens, and checks the laws.
pub fn good(result: Result<LoadedMesh, MeshError>) -> (LoadedMesh, Checked) {
    let loaded = result.unwrap_or_else(|error| panic!("{error}"));
    let checked = check(&loaded.mesh).unwrap_or_else(|fault| panic!("{fault}"));
    (loaded, checked)
}

/// The one line that a refused model gives: what was found, and the name last.
pub fn refused(result: Result<LoadedMesh, MeshError>, name: &str) -> String {
    let error = match result {
        Ok(loaded) => panic!("{name} opened: {:?}", loaded.notes),
        Err(error) => error.to_string(),
    };
    assert!(error.ends_with(&format!(": {name}")), "{error}");
    assert!(!error.contains('\n') && error.contains(';'), "{error}");
    error
}

#[test]
fn the_laws_can_be_broken() {
    let mesh = tetrahedron();
    assert!(check(&mesh).is_ok());
    type Fault = fn(&mut Mesh);
    let faults: [(&str, Fault); 8] = [
        ("NaN", |m| m.normals[0][1] = f32::NAN),
        ("lengths", |m| m.normals.truncate(3)),
        ("not unit", |m| {
            m.normals[0] = m.normals[0].map(|x| 1.000_002 * x)
        }),
        ("outside", |m| m.positions[0] = [1.0, 0.1, 0.0]),
        ("farthest", |m| {
            m.positions.iter_mut().flatten().for_each(|x| *x *= 0.999)
        }),
        ("centred", |m| {
            m.positions.iter_mut().for_each(|p| p[0] = p[0].max(-0.5))
        }),
        ("degenerate", |m| m.indices[1] = m.indices[0]),
        ("no triangle", |m| m.indices.truncate(9)),
    ];
    for (name, fault) in faults {
        let mut broken = mesh.clone();
        fault(&mut broken);
        let found = check(&broken).map(|_| ()).unwrap_err();
        assert!(found.contains(name), "{name}: {found}");
    }
    let mut reversed = mesh.clone();
    reversed.indices.reverse();
    let reversed = check(&reversed).unwrap();
    assert!(reversed.volume < 0.0 && reversed.worst_cosine < 0.0);
}
