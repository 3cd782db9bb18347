//! The elements of glTF accessors (glTF 2.0, 3.6.2), each found to lie within its buffer before anything is made.

use gltf::json;
use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::validation::Checked;

use super::buffer::Buffers;
use super::error::{MeshProblem, damaged_gltf as damaged, judge};

/// A document with its bytes.
pub(super) struct Source<'a> {
    pub root: &'a json::Root,
    pub buffers: Buffers<'a>,
}

impl Source<'_> {
    /// The accessor, or an error that names its number.
    pub fn accessor(&self, index: Index<Accessor>) -> Result<&Accessor, MeshProblem> {
        self.root
            .get(index)
            .ok_or_else(|| damaged(format!("accessor {index} is not there")))
    }

    /// Vectors of three. Whole numbers are taken as the extension `KHR_mesh_quantization` has them.
    pub fn vectors(&self, index: Index<Accessor>, most: u64) -> Result<Vec<[f64; 3]>, MeshProblem> {
        let accessor = self.accessor(index)?;
        let (component, kind) = kind_of(accessor);
        let (Some(component), Some(Type::Vec3)) = (component, kind) else {
            return Err(damaged(format!("accessor {index} has no vectors of three")));
        };
        if component == ComponentType::U32 {
            return Err(damaged(format!("accessor {index} has vectors of u32")));
        }
        let size = component.size();
        let normalized = accessor.normalized;
        let read = |bytes: &[u8]| {
            let mut parts = bytes.chunks_exact(size);
            [(); 3].map(|()| number(parts.next().unwrap_or_default(), component, normalized))
        };
        self.elements(index, 3 * size, most, read)
    }

    /// Vertex numbers.
    pub fn numbers(&self, index: Index<Accessor>, most: u64) -> Result<Vec<u32>, MeshProblem> {
        use ComponentType::{U8, U16, U32};
        let (component, kind) = kind_of(self.accessor(index)?);
        let (Some(component @ (U8 | U16 | U32)), Some(Type::Scalar)) = (component, kind) else {
            return Err(damaged(format!("accessor {index} has no vertex numbers")));
        };
        self.elements(index, component.size(), most, |bytes| {
            whole(bytes, component)
        })
    }

    /// The elements, with the sparse ones in their places.
    fn elements<T: Copy + Default>(
        &self,
        index: Index<Accessor>,
        size: usize,
        most: u64,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, MeshProblem> {
        let accessor = self.accessor(index)?;
        let count = accessor.count.0;
        judge("elements in one accessor", count, most)?;
        // Not above `most`, which fits.
        let length = count as usize;
        let mut elements = match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => {
                let offset = accessor.byte_offset.unwrap_or_default().0;
                let strided = self.strided(view, offset, length, size)?;
                strided.map(&read).collect()
            }
            (None, Some(_)) => vec![T::default(); length],
            (None, None) => {
                let reason = format!("accessor {index} has no data; it may be compressed");
                return Err(damaged(reason));
            }
        };
        let Some(sparse) = &accessor.sparse else {
            return Ok(elements);
        };
        // Places must increase, so there are not more of them than elements.
        judge("sparse elements in one accessor", sparse.count.0, count)?;
        let places = sparse.count.0 as usize;
        let Checked::Valid(place_type) = sparse.indices.component_type else {
            return Err(damaged(format!(
                "accessor {index} has sparse places of no type"
            )));
        };
        let at = self.strided(
            sparse.indices.buffer_view,
            sparse.indices.byte_offset.0,
            places,
            place_type.0.size(),
        )?;
        let values = self.strided(
            sparse.values.buffer_view,
            sparse.values.byte_offset.0,
            places,
            size,
        )?;
        for (at, value) in at.zip(values) {
            let at = whole(at, place_type.0);
            let element = elements
                .get_mut(at as usize)
                .ok_or_else(|| damaged(format!("accessor {index} has place {at} of {count}")))?;
            *element = read(value);
        }
        Ok(elements)
    }

    /// `count` elements of `size` bytes in a view, all of them within it.
    fn strided(
        &self,
        view: Index<json::buffer::View>,
        offset: u64,
        count: usize,
        size: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, MeshProblem> {
        let number = view.value();
        let view = self
            .root
            .get(view)
            .ok_or_else(|| damaged(format!("buffer view {number} is not there")))?;
        let bytes = self.buffers.bytes(view.buffer.value())?;
        let start = view.byte_offset.unwrap_or_default().0;
        let bytes = part(bytes, start, view.byte_length.0)
            .ok_or_else(|| damaged(format!("buffer view {number} ends behind its buffer")))?;
        // glTF 2.0, 5.11.4: without a stride elements are packed; the crate reads 0 for that too.
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            let reason = format!("buffer view {number} has a stride of {stride} for {size} bytes");
            return Err(damaged(reason));
        }
        // The last element needs no full stride.
        let needed = match count.checked_sub(1) {
            None => Some(0),
            Some(last) => last.checked_mul(stride).and_then(|n| n.checked_add(size)),
        };
        let bytes = needed
            .and_then(|needed| part(bytes, offset, needed as u64))
            .ok_or_else(|| damaged(format!("{count} elements end behind buffer view {number}")))?;
        Ok(bytes
            .chunks(stride)
            .take(count)
            .filter_map(move |chunk| chunk.get(..size)))
    }
}

fn part(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}

fn kind_of(accessor: &Accessor) -> (Option<ComponentType>, Option<Type>) {
    let component = match accessor.component_type {
        Checked::Valid(component) => Some(component.0),
        Checked::Invalid => None,
    };
    match accessor.type_ {
        Checked::Valid(kind) => (component, Some(kind)),
        Checked::Invalid => (component, None),
    }
}

/// A whole number, little-endian, of one, two or four bytes.
fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    debug_assert_eq!(bytes.len(), component.size());
    bytes
        .iter()
        .rev()
        .fold(0, |high, &low| high << 8 | u32::from(low))
}

/// A component of a vector. Normalised whole numbers: glTF 2.0, 3.11.
fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f64 {
    let bits = whole(bytes, component);
    let (value, largest) = match component {
        ComponentType::F32 => return f64::from(f32::from_bits(bits)),
        ComponentType::U32 => (f64::from(bits), f64::from(u32::MAX)),
        ComponentType::U8 => (f64::from(bits), 255.0),
        ComponentType::U16 => (f64::from(bits), 65535.0),
        ComponentType::I8 => (f64::from(bits as u8 as i8), 127.0),
        ComponentType::I16 => (f64::from(bits as u16 as i16), 32767.0),
    };
    if normalized {
        (value / largest).max(-1.0)
    } else {
        value
    }
}
