//! Render files (`.nf`): renders that are kept, to be continued or joined.
//!
//! A file is a magic number, a version, and sections, each with a tag, a length and a checksum. The first section is the
//! [`Header`], JSON that says of what image the rest is; the others are binary. `docs/compatibility.md` has the layout.
mod encode;
mod error;
mod fields;
mod header;
mod named_file;
mod reader;
mod tag;
mod writer;

pub use self::{
    encode::Encode,
    error::RenderFileError,
    fields::Fields,
    header::{CheckpointScene, Counters, Header, ImageFacts, Kind, SceneChoices, Target},
    named_file::{NamedFile, sha256},
    reader::Reader,
    tag::Tag,
    writer::{Encoded, Writer},
};

/// The first bytes of a file. Like those of PNG, they show whether a transfer changed the ends of lines.
pub const MAGIC: [u8; 8] = *b"\x89NFR\r\n\x1a\n";
/// The version of the layout that this program writes.
pub const VERSION: u32 = 1;
/// Bytes before the first section.
const START: u64 = 12;
/// Bytes of a section before its payload: tag and length.
const BEFORE: u64 = 12;
/// Bytes of a section after its payload: the checksum.
const AFTER: u64 = 4;
/// Most bytes of a payload. The largest is a header with the text of a scene.
const LARGEST: u64 = 256 << 20;

/// The checksum of a section: CRC-32 of tag, length and payload.
fn checksum(tag: Tag, payload: &[u8]) -> u32 {
    let mut sum = flate2::Crc::new();
    sum.update(&tag.0);
    sum.update(&(payload.len() as u64).to_le_bytes());
    sum.update(payload);
    sum.sum()
}

#[cfg(test)]
mod tests;
