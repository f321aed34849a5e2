//! Writes render files.
use std::io::{self, Write};

use super::{Encode, Header, LARGEST, MAGIC, Tag, VERSION, checksum};

/// A section as it stands in the file, made before it is written: on another thread, for instance.
pub struct Encoded(Vec<u8>);

impl Encoded {
    /// Encodes a section. `bytes` is about how long its payload will be, and `fill` appends it.
    pub fn new(tag: Tag, bytes: usize, fill: impl FnOnce(&mut Vec<u8>)) -> Encoded {
        let before = tag.0.len() + size_of::<u64>();
        let mut section = Vec::with_capacity(before + bytes + size_of::<u32>());
        section.extend_from_slice(&tag.0);
        section.extend_from_slice(&[0; size_of::<u64>()]);
        fill(&mut section);
        let length = (section.len() - before) as u64;
        section[tag.0.len()..before].copy_from_slice(&length.to_le_bytes());
        let sum = checksum(tag, &section[before..]);
        sum.encode(&mut section);
        Encoded(section)
    }

    /// Its bytes in the file.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }
}

/// Writes a file from front to back.
pub struct Writer<W> {
    to: W,
    /// Sections so far.
    sections: u64,
}

impl<W: Write> Writer<W> {
    /// Begins a file.
    pub fn new(mut to: W, header: &Header) -> io::Result<Writer<W>> {
        to.write_all(&MAGIC)?;
        to.write_all(&VERSION.to_le_bytes())?;
        let text = serde_json::to_vec(header)?;
        if text.len() as u64 > LARGEST {
            return Err(io::Error::other("the text of the scene is too long for a render file"));
        }
        let mut writer = Writer { to, sections: 0 };
        writer.section(&Encoded::new(Tag::HEADER, text.len(), |to| to.extend_from_slice(&text)))?;
        Ok(writer)
    }

    /// Appends a section.
    pub fn section(&mut self, section: &Encoded) -> io::Result<()> {
        self.sections += 1;
        self.to.write_all(section.bytes())
    }

    /// Ends the file. One without its end is taken as cut off.
    pub fn finish(mut self) -> io::Result<W> {
        let count = self.sections;
        self.section(&Encoded::new(Tag::END, size_of::<u64>(), |to| count.encode(to)))?;
        self.to.flush()?;
        Ok(self.to)
    }
}
