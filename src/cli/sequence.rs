//! Sequences of frames: a turntable or a camera path, in numbered files.
use std::path::{Path, PathBuf};

use noisefall::scene::{Camera, CameraPath};

use super::{
    messages::{Failure, tell},
    options as parse,
    output::Output,
};

/// The character whose place a digit of the frame's number takes.
const DIGIT: char = '#';

#[derive(clap::Args)]
pub struct SequenceOptions {
    /// Render N frames of a full turn around the camera's look-at point; -o is then a name such as frame-####.png
    #[arg(long, value_name = "N", value_parser = parse::frames, group = "sequence", requires = "output")]
    turntable: Option<u32>,
    /// Render the frames of a camera path, a TOML file; -o is then a name such as frame-####.png
    #[arg(long, value_name = "FILE", group = "sequence", requires = "output")]
    cameras: Option<PathBuf>,
    /// Leave out frames whose file exists
    #[arg(long, requires = "sequence")]
    resume: bool,
}

/// A camera and the file of its image.
pub struct Shot {
    pub camera: Camera,
    pub output: Output,
}

impl SequenceOptions {
    pub fn is_asked(&self) -> bool {
        self.turntable.is_some() || self.cameras.is_some()
    }

    /// The images to render: one, or the frames of the sequence that are left.
    pub fn shots(&self, camera: Camera, output: &Output) -> Result<Vec<Shot>, Failure> {
        let cameras = match (&self.cameras, self.turntable) {
            (Some(path), _) => CameraPath::load(path).map_err(|error| error.report())?.cameras(&camera)?,
            (None, Some(frames)) => camera.turntable(frames).collect(),
            (None, None) => return Ok(vec![Shot { camera, output: output.clone() }]),
        };
        let all = cameras.len();
        let shot = |(camera, number)| Some(Shot { camera, output: Output::File(numbered(output.file()?, number)?) });
        let is_left = |shot: &Shot| !(self.resume && shot.output.file().is_some_and(Path::is_file));
        let left: Vec<Shot> = cameras.into_iter().zip(1..).filter_map(shot).filter(is_left).collect();
        if left.len() < all {
            tell(&format!("note: {} of {all} frames exist and are left out", all - left.len()));
        }
        Ok(left)
    }

    /// The mistake in the name of a sequence, if there is one.
    pub fn mistake(&self, output: Option<&Output>) -> Option<String> {
        let is_pattern = |output: &Output| output.file().is_some_and(|path| numbered(path, 1).is_some());
        let mistaken = self.is_asked() && !output.is_some_and(is_pattern);
        mistaken.then(|| "the frames of a sequence need a file name with a number, such as -o frame-####.png".to_owned())
    }
}

/// The path with the number of a frame in place of its last run of `#`, with as many digits or more.
fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let end = name.rfind(DIGIT)? + 1;
    let start = name[..end].trim_end_matches(DIGIT).len();
    let width = end - start;
    Some(path.with_file_name(format!("{}{number:0width$}{}", &name[..start], &name[end..])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_of_signs_becomes_the_number_of_the_frame() {
        let of = |path: &str, number| numbered(Path::new(path), number).map(|path| path.display().to_string());
        assert_eq!(of("a/frame-####.png", 7).as_deref(), Some("a/frame-0007.png"));
        assert_eq!(of("#.exr", 12).as_deref(), Some("12.exr"));
        assert_eq!(of("take#2-##x.exr", 3).as_deref(), Some("take#2-03x.exr"));
        assert_eq!((of("a#/frame.png", 1), of("frame.png", 1)), (None, None));
    }
}
