//! Sequences of frames: a turntable or a camera path, in numbered files.
use std::{
    ops::Range,
    path::{Path, PathBuf},
};

use noisefall_base::file::numbered;
use noisefall_scene::scene::{Camera, CameraSequence};

use super::{
    headings,
    messages::{Failure, tell},
    options as parse,
    output::Output,
};

/// The message for an interruption that drops the frame.
pub const DROPPED: &str = "interrupted: the unfinished frame is dropped (interrupt again to stop at once)";
pub const UNFINISHED: &str = "the sequence is not finished; the same command with --resume continues it";

#[derive(clap::Args)]
pub struct SequenceOptions {
    /// Render N frames of a full turn around the camera's look-at point; -o is then a name such as frame-####.png
    #[arg(help_heading = headings::KEEP, long, value_name = "N", value_parser = parse::frames, group = "sequence", requires = "output")]
    turntable: Option<u32>,
    /// Render the frames of a camera path, a TOML file; -o is then a name such as frame-####.png
    #[arg(help_heading = headings::KEEP, long, value_name = "FILE", group = "sequence", requires = "output")]
    cameras: Option<PathBuf>,
    /// Render only the frames A to B - 1 of the sequence; the first one is 1
    #[arg(help_heading = headings::KEEP, long, value_name = "A..B", value_parser = parse::frame_range, requires = "sequence")]
    frames: Option<Range<u32>>,
    /// Continue the render that --checkpoint kept in FILE; give no scene, because the file has it. Without FILE: skip frames of a
    /// sequence whose file exists, and continue those that have a checkpoint
    #[arg(help_heading = headings::KEEP, long, value_name = "FILE", num_args = 0..=1)]
    resume: Option<Option<PathBuf>>,
}

/// A camera and the files of its image.
pub struct Shot {
    pub camera: Camera,
    pub output: Output,
    /// Where the render is kept.
    pub checkpoint: Option<PathBuf>,
}

impl SequenceOptions {
    pub fn is_asked(&self) -> bool {
        self.sequence().is_some()
    }

    fn sequence(&self) -> Option<CameraSequence> {
        let path = self.cameras.clone().map(CameraSequence::Path);
        path.or(self.turntable.map(CameraSequence::Turntable))
    }

    /// Whether the frames of a sequence that are missing are rendered.
    pub fn is_continued(&self) -> bool {
        self.is_asked() && self.resume.is_some()
    }

    /// The images to render: one, or the frames of the sequence that are left.
    pub fn shots(&self, camera: Camera, output: &Output, checkpoint: Option<&Path>) -> Result<Vec<Shot>, Failure> {
        let Some(sequence) = self.sequence() else {
            return Ok(vec![Shot { camera, output: output.clone(), checkpoint: checkpoint.map(Path::to_owned) }]);
        };
        let cameras = sequence.cameras(&camera)?;
        let frames = self.frames.clone().unwrap_or(1..cameras.len() as u32 + 1);
        if frames.end as usize > cameras.len() + 1 {
            return Err(format!("--frames {}..{}: the sequence has the frames 1 to {}", frames.start, frames.end, cameras.len()));
        }
        let all = frames.len();
        let shot = |(camera, number)| {
            let checkpoint = checkpoint.and_then(|path| numbered(path, number));
            Some(Shot { camera, output: Output::File(numbered(output.file()?, number)?), checkpoint })
        };
        let is_left = |shot: &Shot| !(self.is_continued() && shot.output.file().is_some_and(Path::is_file));
        let left: Vec<Shot> =
            cameras.into_iter().zip(1..).filter(|(_, number)| frames.contains(number)).filter_map(shot).filter(is_left).collect();
        if left.len() < all {
            tell(&format!("warning: {} of {all} frames exist and are skipped", all - left.len()));
        }
        Ok(left)
    }

    /// The file of a render to continue. Before a sequence, the word behind `--resume` is the scene.
    pub fn resumed(&self) -> Option<&Path> {
        self.resume.as_ref()?.as_deref().filter(|_| !self.is_asked())
    }

    /// The scene, if it stands behind `--resume`.
    pub fn scene(&self) -> Option<&Path> {
        self.resume.as_ref()?.as_deref().filter(|_| self.is_asked())
    }

    /// The mistake in the name of a sequence, or in its continuation, if there is one.
    pub fn mistake(&self, output: Option<&Output>) -> Option<String> {
        if self.resume == Some(None) && !self.is_asked() {
            return Some(
                "--resume needs the file of a render, as in --resume image.nf; without one it continues a sequence".to_owned(),
            );
        }
        let is_pattern = |output: &Output| output.file().is_some_and(|path| numbered(path, 1).is_some());
        let mistaken = self.is_asked() && !output.is_some_and(is_pattern);
        mistaken.then(|| "the frames of a sequence need a file name with a number, such as -o frame-####.png".to_owned())
    }
}
