//! Binary data.
use noisefall_base::memory::{Reservation, TooMuch};

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
    pub fn append(&mut self, bytes: &[u8]) -> Result<usize, TooMuch> {
        self.room.grow("the data of the scene", (bytes.len() + ALIGNMENT) as u64)?;
        self.bytes.resize(self.bytes.len().next_multiple_of(ALIGNMENT), 0);
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        Ok(start)
    }
}
