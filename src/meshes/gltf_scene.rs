//! glTF 2.0, text or binary: the triangles of a scene, with the transforms of their nodes.
//!
//! The `gltf` crate reads the JSON into its structures and does nothing else here: its own import opens files anywhere and
//! panics on bad URIs, and its readers trust declared counts. Materials, textures, skins, animations and morph targets
//! are not used.

use std::path::Path;

use glam::{DMat3, DMat4, DQuat, DVec3};
use gltf::json;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;

use super::buffer::Buffers;
use super::element::Source;
use super::error::{MeshProblem, damaged_gltf as damaged, judge, quoted, stop_if_cancelled};
use super::raw::{Corner, Raw};
use super::{Format, MOST_TRIANGLES, MOST_VERTICES, counted};
use crate::imaging::Progress;

/// Most objects in the JSON. Text of two bytes can become a structure of some hundred: so many take 200 MB at most.
const MOST_OBJECTS: u64 = 1 << 18;

/// Most commas in the JSON, hence members of its lists, which take 24 bytes at most where they are no objects.
const MOST_MEMBERS: u64 = 1 << 23;

/// Extensions whose absence changes colours only. Other required ones are refused by name.
const HARMLESS: [&str; 6] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_lights_",
    "KHR_mesh_quantization", // understood
];

pub(super) fn parse(bytes: &[u8], path: &Path, progress: &Progress) -> Result<Raw, MeshProblem> {
    let (text, chunk) = if bytes.starts_with(b"glTF") {
        chunks(bytes)?
    } else {
        (bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None)
    };
    let count = |sign| text.iter().filter(|&&b| b == sign).count() as u64;
    judge("JSON objects", count(b'{'), MOST_OBJECTS)?;
    judge("JSON list members", count(b','), MOST_MEMBERS)?;
    let root: json::Root = json::deserialize::from_slice(text).map_err(|error| {
        damaged(format!(
            "its JSON does not read: {}",
            quoted(&error.to_string())
        ))
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = quoted(&root.asset.version);
        return Err(unsupported(format!(
            "its version is {version}, only 2 opens; export it as glTF 2.0"
        )));
    }
    let is_harmless = |name: &str| HARMLESS.iter().any(|known| name.starts_with(known));
    if let Some(name) = root
        .extensions_required
        .iter()
        .find(|name| !is_harmless(name))
    {
        let what = format!("it needs the extension {}; export it without", quoted(name));
        return Err(unsupported(what));
    }

    let source = Source {
        root: &root,
        buffers: Buffers::new(&root.buffers, chunk, path, progress),
    };
    let mut raw = Raw::default();
    let placed = placed_meshes(&root)?;
    let mut visited = 0;
    for (i, (mesh, root_from_mesh)) in placed.iter().enumerate() {
        progress.step(i, placed.len());
        // Many nodes may show one mesh of many primitives, each with next to nothing in it.
        visited += mesh.primitives.len() as u64;
        judge("primitives", visited, MOST_OBJECTS)?;
        let mut has_triangles = false;
        for primitive in &mesh.primitives {
            stop_if_cancelled(progress)?;
            has_triangles |= add_primitive(&mut raw, &source, primitive, root_from_mesh)?;
        }
        raw.parts += usize::from(has_triangles);
    }
    raw.notes = unused(&root);
    Ok(raw)
}

/// The JSON text and the binary chunk of a GLB (glTF 2.0, 4.4).
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), MeshProblem> {
    let word = |bytes: &[u8], at: usize| {
        let word = bytes.get(at..at + 4)?.try_into().ok()?;
        Some(u32::from_le_bytes(word))
    };
    let cut_off = || damaged("it breaks off".to_owned());
    let version = word(bytes, 4).ok_or_else(cut_off)?;
    if version != 2 {
        return Err(unsupported(format!(
            "its version is {version}, only 2 opens; export it as glTF 2.0"
        )));
    }
    let length = word(bytes, 8).ok_or_else(cut_off)? as usize;
    let mut rest = bytes.get(12..length).ok_or_else(cut_off)?;
    let mut chunk = |wanted: &[u8; 4]| -> Result<Option<&[u8]>, MeshProblem> {
        if rest.is_empty() {
            return Ok(None);
        }
        let length = word(rest, 0).ok_or_else(cut_off)? as usize;
        let kind = rest.get(4..8).ok_or_else(cut_off)?;
        let body = rest.get(8..).and_then(|rest| rest.get(..length));
        let body = body.ok_or_else(cut_off)?;
        rest = &rest[8 + length..];
        Ok((kind == wanted).then_some(body))
    };
    let text = chunk(b"JSON")?;
    let text = text.ok_or_else(|| damaged("its first chunk is no JSON".to_owned()))?;
    Ok((text, chunk(b"BIN\0")?))
}

/// The meshes of the default scene, else the first, else of all nodes that are nobody's children; without nodes each mesh
/// once. With the transform of each.
///
/// A node has one parent at most (glTF 2.0, 3.5.2), so each is met once: no circle turns for ever, and no stack grows.
fn placed_meshes(root: &json::Root) -> Result<Vec<(&json::Mesh, DMat4)>, MeshProblem> {
    if root.nodes.is_empty() {
        let meshes = root.meshes.iter();
        return Ok(meshes.map(|mesh| (mesh, DMat4::IDENTITY)).collect());
    }
    let children = |node: &json::Node| node.children.clone().unwrap_or_default();
    let scene = root.scene.map_or(0, |scene| scene.value());
    let tops = match root.scenes.get(scene) {
        Some(scene) => scene.nodes.clone(),
        None if root.scene.is_some() => return Err(damaged(format!("scene {scene} is not there"))),
        None => {
            let mut is_child = vec![false; root.nodes.len()];
            for child in root.nodes.iter().flat_map(children) {
                if let Some(is_child) = is_child.get_mut(child.value()) {
                    *is_child = true;
                }
            }
            let tops = (0..root.nodes.len() as u32).filter(|&n| !is_child[n as usize]);
            tops.map(json::Index::new).collect()
        }
    };

    let mut placed = Vec::new();
    let mut is_met = vec![false; root.nodes.len()];
    let mut waiting: Vec<(json::Index<json::Node>, DMat4)> = Vec::new();
    // Met when put down, not when taken up: so no node waits twice. Reversed: the last put down is taken up first.
    let mut put_down =
        |waiting: &mut Vec<_>, nodes: Vec<json::Index<json::Node>>, root_from_parent| {
            for index in nodes.into_iter().rev() {
                match is_met.get_mut(index.value()) {
                    Some(is_met) if !*is_met => *is_met = true,
                    Some(_) => {
                        return Err(damaged(format!(
                            "node {index} has two parents or is its own"
                        )));
                    }
                    None => return Err(damaged(format!("node {index} is not there"))),
                }
                waiting.push((index, root_from_parent));
            }
            Ok(())
        };
    put_down(&mut waiting, tops, DMat4::IDENTITY)?;
    while let Some((index, root_from_parent)) = waiting.pop() {
        let Some(node) = root.get(index) else {
            continue; // judged when it was put down
        };
        let root_from_node = root_from_parent * parent_from_node(node);
        if let Some(mesh) = node.mesh {
            let mesh = root
                .get(mesh)
                .ok_or_else(|| damaged(format!("mesh {mesh} is not there")))?;
            placed.push((mesh, root_from_node));
        }
        put_down(&mut waiting, children(node), root_from_node)?;
    }
    Ok(placed)
}

/// A node's own transform: its matrix, or scale, then rotation, then translation.
fn parent_from_node(node: &json::Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |rotation| {
        let [x, y, z, w] = rotation.0.map(f64::from);
        // Not unit by more than rounding, or zero: made unit, or NaN, which no position passes.
        DQuat::from_xyzw(x, y, z, w).normalize()
    });
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, vector),
        rotation,
        node.translation.map_or(DVec3::ZERO, vector),
    )
}

/// Adds the triangles of a primitive; false when it has none.
fn add_primitive(
    raw: &mut Raw,
    source: &Source,
    primitive: &Primitive,
    root_from_mesh: &DMat4,
) -> Result<bool, MeshProblem> {
    let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
    let mode = match primitive.mode {
        Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
        Checked::Valid(_) => {
            raw.skipped += 1;
            return Ok(false);
        }
        Checked::Invalid => return Err(damaged("a primitive has no known mode".to_owned())),
    };
    let Some(positions) = attribute(Semantic::Positions) else {
        raw.skipped += 1;
        return Ok(false);
    };
    raw.judge_positions(source.accessor(positions)?.count.0)?;
    let corners = match primitive.indices {
        Some(indices) => source.accessor(indices)?.count.0,
        None => source.accessor(positions)?.count.0,
    };
    raw.judge_triangles(match mode {
        Mode::Triangles => corners / 3,
        _ => corners.saturating_sub(2),
    })?;

    let positions = source.vectors(positions, MOST_VERTICES)?;
    let normals = match attribute(Semantic::Normals) {
        Some(normals) => Some(source.vectors(normals, MOST_VERTICES)?),
        None => None,
    };
    if let Some(normals) = &normals
        && normals.len() != positions.len()
    {
        let (normals, positions) = (normals.len(), positions.len());
        return Err(damaged(format!(
            "{positions} positions have {normals} normals"
        )));
    }
    // Three corners a triangle, and two more for the strips.
    let numbers = match primitive.indices {
        Some(indices) => source.numbers(indices, 3 * MOST_TRIANGLES + 2)?,
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(number) = numbers.iter().find(|&&n| n as usize >= positions.len()) {
        let reason = format!("a triangle names vertex {number} of {}", positions.len());
        return Err(damaged(reason));
    }

    let linear = DMat3::from_mat4(*root_from_mesh);
    let (normal_turn, is_mirrored) = normal_transform(linear);
    let (first, first_normal) = (raw.positions.len() as u32, raw.normals.len() as u32);
    for position in &positions {
        let position = root_from_mesh.transform_point3(DVec3::from(*position));
        if !raw.add_position(position) {
            return Err(damaged("a position is not a finite number".to_owned()));
        }
    }
    let has_normals = normals.is_some();
    for normal in normals.into_iter().flatten() {
        let normal = normal_turn * DVec3::from(normal);
        raw.normals.push(normal.normalize_or_zero().as_vec3());
    }
    let corner = |number: u32| Corner {
        position: first + number,
        normal: has_normals.then_some(first_normal + number),
    };
    // glTF 2.0, 3.7.4: a mirroring transform reverses the winding.
    let mut add = |[a, b, c]: [u32; 3]| {
        let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
        raw.triangles.push(triangle.map(corner));
    };
    let windows = || numbers.windows(3).enumerate();
    match mode {
        Mode::TriangleStrip => windows().for_each(|(i, n)| {
            // Every other triangle runs the other way.
            let odd = i % 2;
            add([n[0], n[1 + odd], n[2 - odd]]);
        }),
        Mode::TriangleFan => {
            let rest = numbers.get(1..).unwrap_or_default();
            rest.windows(2).for_each(|n| add([n[0], n[1], numbers[0]]));
        }
        _ => numbers.as_chunks().0.iter().for_each(|&n| add(n)),
    }
    Ok(numbers.len() >= 3)
}

/// Takes normals along: the cofactors, which are the inverse transposed but for a positive factor, and are there for flat
/// transforms too. Divided first by the largest entry, so that small scales do not vanish when they are multiplied. And
/// whether the transform mirrors.
fn normal_transform(linear: DMat3) -> (DMat3, bool) {
    let columns = [linear.x_axis, linear.y_axis, linear.z_axis];
    let largest = columns
        .iter()
        .map(|c| c.abs().max_element())
        .fold(0.0, f64::max);
    let [x, y, z] = columns.map(|column| column / largest);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let is_mirrored = x.dot(y.cross(z)) < 0.0;
    (
        if is_mirrored { -cofactors } else { cofactors },
        is_mirrored,
    )
}

/// What the document has and the mesh does not show.
fn unused(root: &json::Root) -> Vec<String> {
    let mut names = Vec::new();
    let mut look = |count: usize, one: &str, many: &str| {
        if count > 0 {
            names.push(counted(count, one, many));
        }
    };
    look(root.materials.len(), "material", "materials");
    look(root.textures.len(), "texture", "textures");
    look(root.skins.len(), "skin", "skins");
    look(root.animations.len(), "animation", "animations");
    if names.is_empty() {
        return Vec::new();
    }
    vec![format!("not used: {}", names.join(", "))]
}

fn unsupported(what: String) -> MeshProblem {
    MeshProblem::Unsupported {
        format: Format::Gltf,
        what,
    }
}
