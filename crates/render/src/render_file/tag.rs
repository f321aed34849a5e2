//! Tags of sections.
use std::fmt;

/// Type of a section: four bytes of ASCII.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tag(pub [u8; 4]);

impl Tag {
    /// The header, the first section.
    pub const HEADER: Tag = Tag(*b"HEAD");
    /// The last section. It holds the number of sections before it.
    pub const END: Tag = Tag(*b"END ");
}

impl fmt::Display for Tag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", String::from_utf8_lossy(self.0.trim_ascii_end()).escape_debug())
    }
}
