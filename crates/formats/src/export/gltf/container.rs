//! The two containers: JSON with files beside it, and one binary file.
use std::path::Path;

use serde_json::{Value, json};

use super::{
    super::{
        ExportError, ExportSource, Prepared,
        files::{ExportedFiles, bytes},
    },
    context::Export,
};
use noisefall_base::memory::Size;

/// Codes of the binary container.
const MAGIC: &[u8; 4] = b"glTF";
const VERSION: u32 = 2;
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";
const HEADER: usize = 12;
const CHUNK: usize = 8;

impl Export<'_> {
    /// The JSON file. Binary data and images are files of their own.
    pub fn text(mut self, source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
        let mut buffer = None;
        if !self.document.buffer.bytes.is_empty() {
            let bytes = std::mem::take(&mut self.document.buffer.bytes);
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let length = bytes.len();
            buffer = Some((self.new.add("meshes", &stem, "bin", bytes), length));
        }
        let moved = ExportSource { assets: &self.new.assets, ..source };
        let files = ExportedFiles::place(&moved, self.new.named, path)?;
        for image in &self.images {
            self.document.add("images", json!({ "uri": encoded(&files.path(image)) }));
        }
        if let Some((buffer, length)) = buffer {
            self.document.add("buffers", json!({ "uri": encoded(&files.path(&buffer)), "byteLength": length }));
        }
        let content = format!("{:#}\n", self.document.finish()).into_bytes();
        Ok(Prepared { path: path.to_owned(), content, files, remarks: self.notes.remarks })
    }

    /// The binary file, with everything in it.
    pub fn binary(mut self, source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
        for image in std::mem::take(&mut self.images) {
            let content = match self.new.assets.get::<Vec<u8>>(&image) {
                Some(content) => content,
                None => bytes(&source.folder.join(&image))?.into(),
            };
            let start = self.document.buffer.append(&content)?;
            let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": content.len() });
            let view = self.document.add("bufferViews", view);
            let kind = if content.starts_with(b"\x89PNG") { "image/png" } else { "image/jpeg" };
            let name = image.rsplit('/').next().and_then(|file| file.split('.').next()).unwrap_or_default();
            self.document.add("images", json!({ "bufferView": view, "mimeType": kind, "name": name }));
        }
        let data = std::mem::take(&mut self.document.buffer.bytes);
        if !data.is_empty() {
            self.document.add("buffers", json!({ "byteLength": data.len() }));
        }
        let content = chunks(&self.document.finish(), &data)
            .ok_or_else(|| ExportError::TooLong { path: path.to_owned(), size: Size(data.len() as u64).to_string() })?;
        let files = ExportedFiles::place(&source, Vec::new(), path)?;
        Ok(Prepared { path: path.to_owned(), content, files, remarks: self.notes.remarks })
    }
}

/// The header, the JSON and the binary data, padded to words; `None` if their length has no room in 32 bits.
fn chunks(document: &Value, data: &[u8]) -> Option<Vec<u8>> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let padded = data.len().next_multiple_of(4);
    let length = HEADER + CHUNK + json.len() + if data.is_empty() { 0 } else { CHUNK + padded };
    let word = |length: usize| u32::try_from(length).ok().map(u32::to_le_bytes);
    let mut file = Vec::with_capacity(length);
    file.extend(MAGIC);
    file.extend(VERSION.to_le_bytes());
    file.extend(word(length)?);
    file.extend(word(json.len())?);
    file.extend(JSON);
    file.extend(&json);
    if !data.is_empty() {
        file.extend(word(padded)?);
        file.extend(BINARY);
        file.extend(data);
        file.resize(length, 0);
    }
    Some(file)
}

/// A path as a URI: other characters than those that never have a meaning there are escaped.
fn encoded(path: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte);
    path.bytes().map(|byte| if is_plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }).collect()
}
