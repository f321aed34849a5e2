//! Writes that survive a loss of power.
use std::{
    fs::File,
    io::{self, BufWriter, Write},
};

/// A writer whose bytes survive a loss of power after a sync.
pub(super) trait Durable: Write {
    fn sync(&self) -> io::Result<()>;
}

impl Durable for File {
    fn sync(&self) -> io::Result<()> {
        self.sync_all()
    }
}

/// Writes and syncs the bytes, so that a rename cannot reach the disk before them.
pub(super) fn fill(file: &mut impl Durable, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::new(&mut *file);
    write(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    file.sync()
}
