//! The bytes of a buffer: in memory, or on disk if they are many.
use std::{
    borrow::Cow,
    cell::RefCell,
    fs::File,
    io::{Read, Seek, SeekFrom},
};

use super::refusal::Found;
use noisefall_base::{
    memory::Reservation,
    progress::{Progress, Stage},
};

/// Buffers of up to this many bytes are read at once. Of larger ones, only the part that is decoded next is in memory.
const IN_MEMORY: u64 = 32 << 20;

/// The bytes of a buffer.
pub enum Bytes {
    Memory(Vec<u8>),
    Disk(Disk),
}

/// Bytes in an open file.
pub struct Disk {
    file: RefCell<File>,
    /// The first one.
    start: u64,
    length: u64,
    progress: Progress,
}

impl Bytes {
    /// The bytes of a file from its current position on, which it is known to have. Reserves room for those in memory.
    pub fn of(mut file: File, length: u64, room: &mut Reservation, progress: &Progress) -> Found<Bytes> {
        progress.expect(Stage::Files, length);
        if length <= IN_MEMORY {
            room.grow("the bytes of a buffer", length)?;
            return Ok(Bytes::Memory(take(&mut file, length, progress)?));
        }
        let start = file.stream_position().map_err(|error| format!("cannot be read: {error}"))?;
        Ok(Bytes::Disk(Disk { file: RefCell::new(file), start, length, progress: progress.clone() }))
    }

    pub fn len(&self) -> u64 {
        match self {
            Bytes::Memory(bytes) => bytes.len() as u64,
            Bytes::Disk(disk) => disk.length,
        }
    }

    /// All of them.
    pub fn all(&self) -> Slice<'_> {
        match self {
            Bytes::Memory(bytes) => Slice::Memory(Cow::Borrowed(bytes)),
            Bytes::Disk(disk) => Slice::Disk { disk, start: 0, length: disk.length },
        }
    }
}

/// A part of the bytes of a buffer, or bytes that were made.
pub enum Slice<'a> {
    Memory(Cow<'a, [u8]>),
    Disk { disk: &'a Disk, start: u64, length: u64 },
}

impl<'a> Slice<'a> {
    pub fn len(&self) -> u64 {
        match self {
            Slice::Memory(bytes) => bytes.len() as u64,
            Slice::Disk { length, .. } => *length,
        }
    }

    /// Borrows the bytes without a copy.
    pub fn borrowed(&self) -> Slice<'_> {
        match self {
            Slice::Memory(bytes) => Slice::Memory(Cow::Borrowed(bytes)),
            Slice::Disk { disk, start, length } => Slice::Disk { disk, start: *start, length: *length },
        }
    }

    /// A part. `None` if it goes beyond the end.
    pub fn part(self, from: u64, count: u64) -> Option<Slice<'a>> {
        from.checked_add(count).filter(|end| *end <= self.len())?;
        let range = || from as usize..(from + count) as usize;
        Some(match self {
            Slice::Memory(Cow::Borrowed(bytes)) => Slice::Memory(Cow::Borrowed(&bytes[range()])),
            Slice::Memory(Cow::Owned(bytes)) => Slice::Memory(Cow::Owned(bytes[range()].to_vec())),
            Slice::Disk { disk, start, .. } => Slice::Disk { disk, start: start + from, length: count },
        })
    }

    /// The bytes, read if they are on disk.
    pub fn read(self) -> Found<Cow<'a, [u8]>> {
        match self {
            Slice::Memory(bytes) => Ok(bytes),
            Slice::Disk { disk, start, length } => {
                let mut file = disk.file.borrow_mut();
                file.seek(SeekFrom::Start(disk.start + start)).map_err(|error| format!("cannot be read: {error}"))?;
                Ok(Cow::Owned(take(&mut file, length, &disk.progress)?))
            }
        }
    }
}

impl From<Vec<u8>> for Slice<'_> {
    fn from(bytes: Vec<u8>) -> Self {
        Slice::Memory(Cow::Owned(bytes))
    }
}

/// Reads bytes that the file is known to have.
pub fn take(file: &mut File, length: u64, progress: &Progress) -> Found<Vec<u8>> {
    /// Bytes between two reports of progress.
    const BLOCK: u64 = 1 << 24;
    let mut bytes = Vec::new();
    let size = usize::try_from(length).map_err(|_| "the file is too large")?;
    bytes.try_reserve_exact(size).map_err(|_| format!("there is no memory for {length} bytes"))?;
    for start in (0..length).step_by(BLOCK as usize) {
        let block = BLOCK.min(length - start);
        file.take(block).read_to_end(&mut bytes).map_err(|error| format!("cannot be read: {error}"))?;
        progress.advance(block)?;
    }
    if bytes.len() < size {
        return Err("the file ends too early".into());
    }
    Ok(bytes)
}
