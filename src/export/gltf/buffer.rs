//! Binary data: buffer views and accessors.
use serde_json::{Value, json};

use super::{super::ExportError, context::Export};
use crate::memory::Reservation;

/// Codes of the format.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const OF_VERTICES: u32 = 34962;
const OF_INDICES: u32 = 34963;
/// Views begin at multiples of this number of bytes.
const ALIGNMENT: usize = 4;

/// The binary data of a file, with its memory.
pub struct Buffer {
    pub bytes: Vec<u8>,
    room: Reservation,
}

impl Default for Buffer {
    fn default() -> Buffer {
        Buffer { bytes: Vec::new(), room: Reservation::none() }
    }
}

impl Buffer {
    /// Appends bytes, and returns where they begin.
    pub fn append(&mut self, bytes: &[u8]) -> Result<usize, ExportError> {
        self.room.grow("the data of the scene", (bytes.len() + ALIGNMENT) as u64)?;
        self.bytes.resize(self.bytes.len().next_multiple_of(ALIGNMENT), 0);
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        Ok(start)
    }
}

impl Export<'_> {
    /// An accessor of an attribute of vertices.
    pub fn attribute<const N: usize>(&mut self, rows: &[[f32; N]]) -> Result<usize, ExportError> {
        let accessor = self.rows(rows)?;
        Ok(self.document.add("accessors", accessor))
    }

    /// An accessor of positions, which states their bounds.
    pub fn positions(&mut self, points: &[[f32; 3]]) -> Result<usize, ExportError> {
        let mut accessor = self.rows(points)?;
        let fold = |start: f32, f: fn(f32, f32) -> f32| {
            let bounds: [f32; 3] = std::array::from_fn(|axis| points.iter().map(|p| p[axis]).fold(start, f));
            json!(bounds.map(f64::from))
        };
        accessor["min"] = fold(f32::INFINITY, f32::min);
        accessor["max"] = fold(f32::NEG_INFINITY, f32::max);
        Ok(self.document.add("accessors", accessor))
    }

    fn rows<const N: usize>(&mut self, rows: &[[f32; N]]) -> Result<Value, ExportError> {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, OF_VERTICES)?;
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        Ok(json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": shape }))
    }

    /// An accessor of the corners of triangles.
    pub fn corners(&mut self, triangles: &[[u32; 3]]) -> Result<usize, ExportError> {
        let bytes: Vec<u8> = triangles.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, OF_INDICES)?;
        let count = 3 * triangles.len();
        let accessor = json!({ "bufferView": view, "componentType": UNSIGNED, "count": count, "type": "SCALAR" });
        Ok(self.document.add("accessors", accessor))
    }

    fn view(&mut self, bytes: &[u8], target: u32) -> Result<usize, ExportError> {
        let start = self.buffer.append(bytes)?;
        let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len(), "target": target });
        Ok(self.document.add("bufferViews", view))
    }
}
