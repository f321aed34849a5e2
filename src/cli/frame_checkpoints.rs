//! Checkpoints of a sequence. The frame in progress has one, which is removed when its image is written.
use std::{path::Path, time::Duration};

use noisefall_base::{file, quote};
use noisefall_render::{
    render::{
        RenderRequest,
        checkpoint::{CheckpointFile, probe},
        threads::Threads,
    },
    render_file::Header,
};

use super::{
    checkpointing::{Checkpointing, check_new},
    messages::Failure,
};

/// How the frames of a sequence are kept.
pub struct FrameCheckpoints {
    /// The header of a frame. Others differ in camera and probe.
    pub header: Header,
    pub every: Duration,
    /// Whether frames continue from their checkpoints.
    pub continues: bool,
}

impl FrameCheckpoints {
    /// Checks before the first frame that a frame can be kept, and continued if it has a checkpoint.
    pub fn check(&self, frame: &RenderRequest, checkpoint: &Path, threads: &Threads) -> Result<(), Failure> {
        if !(self.continues && checkpoint.exists()) {
            return check_new(checkpoint, "The same command with --resume continues it");
        }
        self.open(checkpoint, &self.header(frame, threads))?;
        file::check(checkpoint).map_err(|error| error.to_string())
    }

    /// How a frame is kept, and what it continues from.
    pub fn keeping(&self, frame: &RenderRequest, checkpoint: &Path, threads: &Threads) -> Result<Checkpointing, Failure> {
        let header = self.header(frame, threads);
        if !(self.continues && checkpoint.exists()) {
            return Ok(Checkpointing::new(checkpoint, self.every, header, None));
        }
        let file = self.open(checkpoint, &header)?;
        let header = Header { remarks: file.header().remarks.clone(), ..header };
        let kept = file.read().map_err(|error| error.to_string())?;
        Ok(Checkpointing::new(checkpoint, self.every, header, Some(kept)))
    }

    fn header(&self, frame: &RenderRequest, threads: &Threads) -> Header {
        Header { camera: frame.camera, probe: probe(frame, threads), ..self.header.clone() }
    }

    /// Opens the checkpoint of the frame with this header.
    fn open(&self, checkpoint: &Path, header: &Header) -> Result<CheckpointFile, Failure> {
        let file = CheckpointFile::open(checkpoint).map_err(|error| error.to_string())?;
        // Another program may continue a render if its samples have the same bits.
        let before = Header { program: header.program.clone(), ..file.header().clone() };
        match before.difference(header) {
            None => Ok(file),
            Some(difference) => {
                let path = quote::path(checkpoint);
                Err(format!("{path}: the frame cannot be continued: {difference}. Remove the file to begin the frame again"))
            }
        }
    }
}
