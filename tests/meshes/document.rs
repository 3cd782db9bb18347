//! glTF documents made in memory.

use base64::Engine;
use base64::engine::general_purpose::{STANDARD, STANDARD_NO_PAD};
use serde_json::{Value, json};

use super::fixtures::{POSITIONS, TRIANGLES};

pub const U8: u32 = 5121;
pub const U16: u32 = 5123;
pub const U32: u32 = 5125;
pub const F32: u32 = 5126;

/// A document with one buffer, whose bytes are put where the form wants them.
#[derive(Clone)]
pub struct Document {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Document {
    /// One mesh of one primitive without anything, shown by one node.
    pub fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": {} }] }],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{ "byteLength": 0 }],
        });
        Self {
            json,
            bytes: Vec::new(),
        }
    }

    /// The tetrahedron with vertex numbers of `component`.
    pub fn tetrahedron(component: u32) -> Self {
        let mut document = Self::new();
        let positions = document.vectors(&POSITIONS);
        let numbers = document.numbers(TRIANGLES.as_flattened(), component);
        document.primitive()["attributes"]["POSITION"] = positions.into();
        document.primitive()["indices"] = numbers.into();
        document
    }

    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// Adds bytes as a view, aligned to four.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.json["buffers"][0]["byteLength"] = self.bytes.len().into();
        let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
        self.push("bufferViews", view)
    }

    pub fn accessor(&mut self, view: usize, kind: &str, component: u32, count: usize) -> usize {
        let accessor = json!({
            "bufferView": view, "type": kind, "componentType": component, "count": count,
        });
        self.push("accessors", accessor)
    }

    pub fn vectors(&mut self, vectors: &[[f32; 3]]) -> usize {
        let view = self.view(&floats(vectors));
        self.accessor(view, "VEC3", F32, vectors.len())
    }

    pub fn numbers(&mut self, numbers: &[u32], component: u32) -> usize {
        let view = self.view(&whole(numbers, component));
        self.accessor(view, "SCALAR", component, numbers.len())
    }

    /// As text whose buffer is `uri`.
    pub fn text(&self, uri: &str) -> String {
        let mut json = self.json.clone();
        json["buffers"][0]["uri"] = uri.into();
        json.to_string()
    }

    /// As text with the bytes in it.
    pub fn data_uri(&self) -> String {
        let data = STANDARD.encode(&self.bytes);
        self.text(&format!("data:application/octet-stream;base64,{data}"))
    }

    pub fn unpadded_data_uri(&self) -> String {
        let data = STANDARD_NO_PAD.encode(&self.bytes);
        self.text(&format!("data:;base64,{data}"))
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut text = self.json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bytes = self.bytes.clone();
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + bytes.len();
        let word = |n: usize| (n as u32).to_le_bytes();
        let parts: [&[u8]; 9] = [
            b"glTF",
            &word(2),
            &word(length),
            &word(text.len()),
            b"JSON",
            &text,
            &word(bytes.len()),
            b"BIN\0",
            &bytes,
        ];
        parts.concat()
    }
}

pub fn floats(vectors: &[[f32; 3]]) -> Vec<u8> {
    let parts = vectors.as_flattened().iter();
    parts.flat_map(|x| x.to_le_bytes()).collect()
}

pub fn whole(numbers: &[u32], component: u32) -> Vec<u8> {
    let size = match component {
        U8 => 1,
        U16 => 2,
        _ => 4,
    };
    let bytes = numbers.iter().map(|n| n.to_le_bytes());
    bytes.flat_map(|b| b[..size].to_vec()).collect()
}
