//! Accessors: rows of numbers in the binary data.
use serde_json::{Value, json};

use super::document::Document;
use noisefall_base::memory::TooMuch;

/// Codes of the format.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const OF_VERTICES: u32 = 34962;
const OF_INDICES: u32 = 34963;

impl Document {
    /// An accessor of an attribute of vertices.
    pub fn attribute<const N: usize>(&mut self, rows: &[[f32; N]]) -> Result<usize, TooMuch> {
        let accessor = self.rows(rows)?;
        Ok(self.add("accessors", accessor))
    }

    /// An accessor of positions, which states their bounds.
    pub fn positions(&mut self, points: &[[f32; 3]]) -> Result<usize, TooMuch> {
        let mut accessor = self.rows(points)?;
        let fold = |start: f32, f: fn(f32, f32) -> f32| {
            let bounds: [f32; 3] = std::array::from_fn(|axis| points.iter().map(|p| p[axis]).fold(start, f));
            json!(bounds.map(f64::from))
        };
        accessor["min"] = fold(f32::INFINITY, f32::min);
        accessor["max"] = fold(f32::NEG_INFINITY, f32::max);
        Ok(self.add("accessors", accessor))
    }

    fn rows<const N: usize>(&mut self, rows: &[[f32; N]]) -> Result<Value, TooMuch> {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, OF_VERTICES)?;
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        Ok(json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": shape }))
    }

    /// An accessor of the corners of triangles.
    pub fn corners(&mut self, triangles: &[[u32; 3]]) -> Result<usize, TooMuch> {
        let bytes: Vec<u8> = triangles.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, OF_INDICES)?;
        let count = 3 * triangles.len();
        let accessor = json!({ "bufferView": view, "componentType": UNSIGNED, "count": count, "type": "SCALAR" });
        Ok(self.add("accessors", accessor))
    }

    fn view(&mut self, bytes: &[u8], target: u32) -> Result<usize, TooMuch> {
        let start = self.buffer.append(bytes)?;
        let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len(), "target": target });
        Ok(self.add("bufferViews", view))
    }
}
