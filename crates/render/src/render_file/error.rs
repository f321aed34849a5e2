//! Errors of reading render files.
use std::io;

use super::{Tag, VERSION};
use noisefall_base::memory::TooMuch;

/// Why a render file cannot be read. The message does not contain the path.
#[derive(Debug, thiserror::Error)]
pub enum RenderFileError {
    /// Another kind of file.
    #[error("this is not a render file of Noisefall (.nf); `render --checkpoint` writes them")]
    Foreign,
    /// A file of Noisefall, damaged by a transfer that changed its ends of lines.
    #[error("the file was changed by a transfer as text: copy it again, as binary data")]
    TransferredAsText,
    /// A later version of the layout.
    #[error("it has version {0} of the format, and this program reads version {VERSION}: open it with a newer Noisefall")]
    Newer(u32),
    /// The file ends too early.
    #[error("the file is cut off at byte {0}: copy it again, or take an earlier one")]
    CutOff(u64),
    /// The bytes of a section are not those that were written.
    #[error("the file is damaged: section {tag} at byte {at} does not match its checksum. Copy it again, or take an earlier one")]
    Damaged {
        /// The section.
        tag: Tag,
        /// Where it begins.
        at: u64,
    },
    /// Something follows the last section.
    #[error("the file is damaged: {0} bytes follow its end. Copy it again, or take an earlier one")]
    Longer(u64),
    /// Whole, but it makes no sense.
    #[error("the file cannot be used: {0}. Another version of Noisefall may have written it; take an earlier file")]
    Contents(String),
    /// Too little memory is left.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// The system refuses.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
}

impl RenderFileError {
    /// Says what makes no sense.
    pub fn contents(what: impl Into<String>) -> RenderFileError {
        RenderFileError::Contents(what.into())
    }
}
