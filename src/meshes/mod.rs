//! User models: OBJ and glTF files read, checked, mended and scaled to fit.
//!
//! A file is read whole, judged by what it declares before anything of that size is made, and opens nothing outside its
//! own folder. Both formats are right-handed with +y up; the world is left-handed (see [`crate::scene`]). So z changes its
//! sign and the winding is reversed, once, when the surface is made. A glTF model faces +z in its own frame (glTF 2.0,
//! 3.4): it faces -z here, towards a camera that looks along +z, as the default one does.

mod buffer;
mod element;
mod error;
mod fit;
mod gltf_scene;
mod normals;
mod obj;
mod raw;
mod surface;

use std::path::Path;

pub use error::{MeshError, MeshProblem};

use crate::imaging::caught::caught;
use crate::imaging::{Progress, Stage, read_whole};
use crate::scene::Mesh;
use error::stop_if_cancelled;
use raw::Raw;

/// Longest file, and most bytes of all buffers beside it.
pub const MOST_FILE_BYTES: u64 = 1 << 28;

/// Most vertices, in the file and of the mesh. Position and normal of so many take 24 bytes each, 192 MB together, and fit
/// into the 256 MiB that WebGPU promises for one buffer.
pub const MOST_VERTICES: u64 = 8_000_000;

/// Most triangles. Their 48 MB of numbers fit into a storage binding of 128 MiB.
pub const MOST_TRIANGLES: u64 = 4_000_000;

/// File formats that open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0 as text or binary (GLB).
    Gltf,
}

impl Format {
    /// The format's usual name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
        }
    }

    /// glTF is known by how it starts. OBJ has no signature: its name must say so.
    fn of(bytes: &[u8], path: &Path) -> Option<Self> {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if bytes.starts_with(b"glTF") || text.trim_ascii_start().starts_with(b"{") {
            return Some(Self::Gltf);
        }
        let ending = path.extension()?;
        ending.eq_ignore_ascii_case("obj").then_some(Self::Obj)
    }
}

/// A model, fit to show, and what was done for that.
#[derive(Clone, Debug)]
pub struct LoadedMesh {
    /// Keeps the laws of [`Mesh`]. Its bounding box is centred; the vertex farthest from the centre lies on the unit ball.
    pub mesh: Mesh,
    /// Short lines for the user: how much there is, what was made, mended or left out.
    pub notes: Vec<String>,
}

/// Opens a model.
///
/// # Errors
/// [`MeshError`], one line: what was found, what to do, the path last. Never panics on a bad file.
pub fn load(path: &Path, progress: &Progress) -> Result<LoadedMesh, MeshError> {
    read_whole(path, MOST_FILE_BYTES, progress)
        .map_err(MeshProblem::from)
        .and_then(|bytes| open(bytes, path, progress))
        .map_err(|problem| MeshError {
            problem,
            name: path.display().to_string(),
        })
}

/// Opens a model whose bytes are in memory already. `path` tells the format of an OBJ, and buffers are looked for beside
/// it; the file itself is not opened.
///
/// # Errors
/// As [`load`].
pub fn load_bytes(
    bytes: Vec<u8>,
    path: &Path,
    progress: &Progress,
) -> Result<LoadedMesh, MeshError> {
    open(bytes, path, progress).map_err(|problem| MeshError {
        problem,
        name: path.display().to_string(),
    })
}

fn open(bytes: Vec<u8>, path: &Path, progress: &Progress) -> Result<LoadedMesh, MeshProblem> {
    let Some(format) = Format::of(&bytes, path) else {
        return Err(MeshProblem::UnknownFormat {
            start: bytes[..bytes.len().min(8)].to_vec(),
        });
    };
    let mend = || {
        progress.enter(Stage::Decoding);
        stop_if_cancelled(progress)?;
        let raw = match format {
            Format::Obj => obj::parse(&bytes, progress),
            Format::Gltf => gltf_scene::parse(&bytes, path, progress),
        }?;
        drop(bytes);
        progress.enter(Stage::Checking);
        mended(raw, progress)
    };
    let loaded = caught(mend).unwrap_or_else(|| {
        Err(MeshProblem::Damaged {
            format,
            reason: "its reader gave up".to_owned(),
        })
    })?;
    progress.enter(Stage::Done);
    progress.step(1, 1);
    Ok(loaded)
}

/// Fits, welds, orients and gives normals.
fn mended(mut raw: Raw, progress: &Progress) -> Result<LoadedMesh, MeshProblem> {
    const STEPS: usize = 4;
    let declared = raw.triangles.len();
    let step = |done| {
        progress.step(done, STEPS);
        stop_if_cancelled(progress)
    };

    let points = fit::fit(&mut raw)?;
    step(1)?;
    let left_out = declared - raw.triangles.len();
    let (parts, skipped, more) = (raw.parts, raw.skipped, std::mem::take(&mut raw.notes));
    let mut surface = surface::Surface::welded(&points, raw);
    step(2)?;
    let edges = surface.edges();
    let turned = surface.orient(&edges);
    step(3)?;
    let (mesh, made) = normals::finished(&surface, &edges)?;
    step(STEPS)?;

    let mut notes = vec![format!(
        "{}, {}, {}",
        counted(parts, "mesh", "meshes"),
        counted(mesh.indices.len() / 3, "triangle", "triangles"),
        counted(mesh.positions.len(), "vertex", "vertices"),
    )];
    if made > 0 {
        notes.push(format!(
            "normals were made for {} of {}, smooth up to {} degrees between faces",
            grouped(made),
            counted(mesh.positions.len(), "vertex", "vertices"),
            normals::CREASE_DEG,
        ));
    }
    if left_out > 0 {
        let thin = counted(left_out, "triangle", "triangles");
        notes.push(format!("left out: {thin} without area"));
    }
    if skipped > 0 {
        let other = counted(skipped, "primitive", "primitives");
        notes.push(format!("left out: {other} of points, lines or curves"));
    }
    notes.extend(turned.map(str::to_owned));
    notes.extend(edges.notes());
    notes.extend(more);
    Ok(LoadedMesh { mesh, notes })
}

/// A number and what it counts: "14 000 triangles".
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{} {}", grouped(count), if count == 1 { one } else { many })
}

/// 14000 as "14 000".
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}
