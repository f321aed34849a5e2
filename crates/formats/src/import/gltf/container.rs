//! The two containers of glTF: `.gltf`, which is the JSON itself, and `.glb`, which holds JSON and binary data as chunks.
use std::{
    collections::BTreeMap,
    fs::File,
    io::{ErrorKind, Read, Seek, SeekFrom},
    path::Path,
};

use serde::{Deserialize, de::IgnoredAny};

use super::{
    bytes::{Bytes, take},
    document::Document,
    refusal::{Found, Refusal},
};
use noisefall_base::{
    file::open_regular,
    memory::{Reservation, reserve},
    progress::{Progress, Stage},
};

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");
/// Bytes of memory that an element of the JSON takes at most while lists grow, and a number in a list.
const ELEMENT: u64 = 512;
const NUMBER: u64 = 12;
/// Bytes of memory that a document may take beyond this factor of its text.
const FACTOR: u64 = 4;
const BASE: u64 = 200 << 20;

/// A file, read once.
pub struct Container {
    pub document: Document,
    /// The binary chunk.
    pub blob: Option<Bytes>,
    /// Length of the file, bytes.
    pub length: u64,
    /// Room for the chunks that are in memory.
    pub room: Reservation,
}

/// Reads a file. Its first bytes determine the container, not its name.
pub fn open(path: &Path, progress: &Progress) -> Found<Container> {
    let unreadable = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => Refusal::new("there is no such file", "check the path"),
        _ => Refusal::new(format!("cannot be read: {error}"), "a scene is a .gltf or .glb file"),
    };
    let mut file = open_regular(path).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    let mut room = Reservation::none();
    let mut head = [0; 12];
    let is_binary = length >= 12 && file.read_exact(&mut head).is_ok() && word(&head, 0) == MAGIC;
    if !is_binary {
        file.seek(SeekFrom::Start(0)).map_err(unreadable)?;
        room.grow("the bytes of the file", length)?;
        progress.expect(Stage::Files, length);
        let json = take(&mut file, length, progress)?;
        return Ok(Container { document: parse(&json)?, blob: None, length, room });
    }
    match word(&head, 1) {
        2 => {}
        1 => return Err(refused_version("1.0")),
        version => return Err(refused_version(&version.to_string())),
    }
    let (document, blob) = chunks(&mut file, length - 12, &mut room, progress)?;
    Ok(Container { document, blob, length, room })
}

/// The chunks of a binary file whose header has been read.
fn chunks(file: &mut File, mut left: u64, room: &mut Reservation, progress: &Progress) -> Found<(Document, Option<Bytes>)> {
    let unreadable = |error: std::io::Error| format!("cannot be read: {error}");
    let (mut document, mut blob) = (None, None);
    while left >= 8 && (document.is_none() || blob.is_none()) {
        let mut head = [0; 8];
        file.read_exact(&mut head).map_err(unreadable)?;
        let length = u64::from(word(&head, 0));
        left -= 8;
        if length > left {
            return Err(format!("a chunk of {length} bytes goes beyond the end of the file").into());
        }
        match word(&head, 1) {
            JSON if document.is_none() => {
                room.grow("the bytes of the file", length)?;
                progress.expect(Stage::Files, length);
                document = Some(parse(&take(file, length, progress)?)?);
            }
            BINARY if blob.is_none() => {
                let other = file.try_clone().map_err(unreadable)?;
                let end = file.stream_position().map_err(unreadable)? + length;
                blob = Some(Bytes::of(other, length, room, progress)?);
                // Both have the same position.
                file.seek(SeekFrom::Start(end)).map_err(unreadable)?;
            }
            _ => file.seek_relative(length as i64).map_err(unreadable)?,
        }
        left -= length;
    }
    document.map(|document| (document, blob)).ok_or_else(|| "the file has no JSON".into())
}

fn word(bytes: &[u8], place: usize) -> u32 {
    let at = 4 * place;
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// Parses the JSON.
pub fn parse(json: &[u8]) -> Found<Document> {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let count = |bytes: &[u8]| json.iter().filter(|byte| bytes.contains(byte)).count() as u64;
    let needed = ELEMENT * count(b"{") + NUMBER * count(b",");
    if needed > FACTOR * json.len() as u64 + BASE {
        return Err(Refusal::new("the file describes too many elements", "split it into several files"));
    }
    let _room = reserve("elements of the file", needed)?;
    let document: Document = serde_json::from_slice(json).map_err(|error| {
        if is_of_first_version(json) {
            return refused_version("1.0");
        }
        let place = if error.line() > 0 { format!("line {}, column {}: ", error.line(), error.column()) } else { String::new() };
        let text = error.to_string();
        let message = text.split(" at line ").next().unwrap_or_default();
        Refusal::from(format!("{place}{message}"))
    })?;
    let version = document.asset.min_version.as_deref().unwrap_or(&document.asset.version);
    match version {
        "2.0" => Ok(document),
        // A later version that adds to 2.0 can be read as 2.0.
        _ if version.starts_with("2.") && document.asset.min_version.is_none() => Ok(document),
        "" => Err("it does not say its version, so it is not glTF".into()),
        _ => Err(refused_version(version)),
    }
}

/// Whether a file is of glTF 1.0, which has tables of named elements where later versions have lists.
fn is_of_first_version(json: &[u8]) -> bool {
    #[derive(Default, Deserialize)]
    #[serde(default)]
    struct Named {
        nodes: BTreeMap<String, IgnoredAny>,
        meshes: BTreeMap<String, IgnoredAny>,
    }
    serde_json::from_slice(json).is_ok_and(|Named { nodes, meshes }| !nodes.is_empty() || !meshes.is_empty())
}

fn refused_version(version: &str) -> Refusal {
    let help = match version.starts_with('1') {
        true => "convert it, for example by `npx gltf-pipeline -i old.gltf -o new.glb`, or export it as glTF 2.0",
        false => "export the file as glTF 2.0",
    };
    Refusal::new(format!("this is glTF {version}, which is not supported: the reader takes glTF 2.0"), help)
}
