//! Reads render files.
use std::io::{self, Read, Seek, SeekFrom};

use super::{AFTER, BEFORE, Fields, Header, LARGEST, MAGIC, RenderFileError, START, Tag, VERSION, checksum};
use noisefall_base::memory::Reservation;

/// Reads a file section by section. Lengths are compared with the size of the file before memory is allocated, and a section is
/// handed out only if its checksum is right.
pub struct Reader<R> {
    from: R,
    header: Header,
    cursor: Cursor,
}

/// The place in a file, and its current section.
struct Cursor {
    /// Bytes of the file.
    size: u64,
    /// Where the next section begins.
    at: u64,
    /// Sections so far.
    sections: u64,
    has_ended: bool,
    payload: Vec<u8>,
    /// Memory of the payload.
    memory: Reservation,
}

impl<R: Read + Seek> Reader<R> {
    /// Checks the start of a file, and reads its header.
    pub fn new(mut from: R) -> Result<Reader<R>, RenderFileError> {
        let size = from.seek(SeekFrom::End(0))?;
        from.rewind()?;
        check_start(&mut from, size)?;
        let memory = Reservation::none();
        let mut cursor = Cursor { size, at: START, sections: 0, has_ended: false, payload: Vec::new(), memory };
        if cursor.next(&mut from)? != Some(Tag::HEADER) {
            return Err(RenderFileError::contents("its first section is not a header"));
        }
        let header = serde_json::from_slice(&cursor.payload);
        let header = header.map_err(|error| RenderFileError::contents(format!("its header is invalid: {error}")))?;
        Ok(Reader { from, header, cursor })
    }

    /// Returns the file's metadata about its image.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Bytes of the file.
    pub fn size(&self) -> u64 {
        self.cursor.size
    }

    /// The next section, of which it returns tag and payload; `None` at the end.
    pub fn section(&mut self) -> Result<Option<(Tag, &[u8])>, RenderFileError> {
        let tag = self.cursor.next(&mut self.from)?;
        Ok(tag.map(|tag| (tag, self.cursor.payload.as_slice())))
    }
}

fn check_start(from: &mut impl Read, size: u64) -> Result<(), RenderFileError> {
    let mut start = Vec::new();
    from.take(START).read_to_end(&mut start)?;
    let (magic, version) = start.split_at(start.len().min(MAGIC.len()));
    if magic != MAGIC {
        let name = &MAGIC[..4];
        return Err(match magic.starts_with(name) {
            true if magic.len() < MAGIC.len() && MAGIC.starts_with(magic) => RenderFileError::CutOff(size),
            true => RenderFileError::TransferredAsText,
            false => RenderFileError::Foreign,
        });
    }
    let version = version.try_into().map(u32::from_le_bytes).map_err(|_| RenderFileError::CutOff(size))?;
    match version {
        VERSION => Ok(()),
        0 => Err(RenderFileError::contents("there is no version 0 of the format")),
        newer => Err(RenderFileError::Newer(newer)),
    }
}

impl Cursor {
    /// Reads the next section into `payload`, and returns its tag; `None` at the end.
    fn next(&mut self, from: &mut impl Read) -> Result<Option<Tag>, RenderFileError> {
        if self.has_ended {
            return Ok(None);
        }
        let cut_off = RenderFileError::CutOff(self.size);
        let left = self.size - self.at;
        let Some(most) = left.checked_sub(BEFORE + AFTER) else { return Err(cut_off) };
        let mut start = [0; BEFORE as usize];
        exactly(from, &mut start, self.size)?;
        let mut fields = Fields::of(&start);
        let (tag, length) = (Tag(fields.take()?), fields.take::<u64>()?);
        if length > most {
            return Err(cut_off);
        }
        if length > LARGEST {
            return Err(RenderFileError::Damaged { tag, at: self.at });
        }
        self.resize(length)?;
        exactly(from, &mut self.payload, self.size)?;
        let mut sum = [0; AFTER as usize];
        exactly(from, &mut sum, self.size)?;
        if u32::from_le_bytes(sum) != checksum(tag, &self.payload) {
            return Err(RenderFileError::Damaged { tag, at: self.at });
        }
        self.at += BEFORE + length + AFTER;
        if tag == Tag::END { self.end().map(|()| None) } else { self.count(tag).map(Some) }
    }

    fn count(&mut self, tag: Tag) -> Result<Tag, RenderFileError> {
        self.sections += 1;
        Ok(tag)
    }

    fn end(&mut self) -> Result<(), RenderFileError> {
        let mut fields = Fields::of(&self.payload);
        let sections: u64 = fields.take()?;
        fields.end()?;
        self.has_ended = true;
        match self.size - self.at {
            0 if sections == self.sections => Ok(()),
            0 => Err(RenderFileError::contents(format!("{} of its {sections} sections are there", self.sections))),
            more => Err(RenderFileError::Longer(more)),
        }
    }

    fn resize(&mut self, length: u64) -> Result<(), RenderFileError> {
        if length > self.memory.bytes() {
            self.memory.grow("sections of render files", length - self.memory.bytes())?;
        }
        self.payload.clear();
        self.payload.resize(length as usize, 0);
        Ok(())
    }
}

fn exactly(from: &mut impl Read, bytes: &mut [u8], size: u64) -> Result<(), RenderFileError> {
    from.read_exact(bytes).map_err(|error| match error.kind() {
        // The file has become shorter meanwhile.
        io::ErrorKind::UnexpectedEof => RenderFileError::CutOff(size),
        _ => RenderFileError::Io(error),
    })
}
