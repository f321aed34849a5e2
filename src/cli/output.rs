//! The destination of a rendered image: a file or standard output.
use std::{
    fmt,
    fs::File,
    io::{ErrorKind, IsTerminal, Read, Write, stdout},
    path::{Path, PathBuf},
    process::ExitCode,
};

use noisefall_base::file::{WriteError, replace, save_elsewhere};
use noisefall_render::render::{
    Display, Frame,
    checkpoint::is_checkpoint_file,
    image_file::{Contents, Format, ImageError, check_target},
    layers::Channel,
};

use super::messages::{Failure, print, tell};

/// File name that means standard output.
const STREAM: &str = "-";
const ADVICE: &str = "`-o - --format png` writes the image to standard output";

#[derive(Clone, Debug, PartialEq)]
pub enum Output {
    File(PathBuf),
    Stream(Format),
}

impl Output {
    /// The destination that `-o` and `--format` name. Fails if they contradict each other, or if the name says no format.
    pub fn of(path: &Path, format: Option<Format>) -> Result<Output, String> {
        if path == Path::new(STREAM) {
            return format.map(Output::Stream).ok_or_else(|| format!("-o {STREAM} needs --format png or --format exr"));
        }
        match (Format::of(path), format) {
            (Ok(by_name), Some(format)) if by_name != format => {
                let ([name, format], path) = ([by_name, format].map(Format::name), path.display());
                Err(format!("{path}: the name ends in .{name}, but --format says {format}; leave --format out"))
            }
            (Err(unknown), _) if !is_checkpoint_file(path) => Err(unknown.to_string()),
            _ => Ok(Output::File(path.to_owned())),
        }
    }

    /// The format of the image. `None` for a file of samples.
    pub fn format(&self) -> Option<Format> {
        match self {
            Output::File(path) => Format::of(path).ok(),
            Output::Stream(format) => Some(*format),
        }
    }

    /// The path of a file.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Output::File(path) => Some(path),
            Output::Stream(_) => None,
        }
    }

    /// Checks before the render begins that the image can be written.
    pub fn check(&self) -> Result<(), Failure> {
        match self {
            Output::File(path) => check_target(path).map_err(advise),
            Output::Stream(_) if stdout().is_terminal() => {
                Err("standard output is a terminal: redirect it to a file, as in `-o - --format png > image.png`".to_owned())
            }
            Output::Stream(_) if is_closed() => Err("standard output is closed: the image would be lost".to_owned()),
            Output::Stream(_) => Ok(()),
        }
    }

    /// Writes the image. If the reader of standard output has gone away, there is no message, but the exit code reports a
    /// failure.
    pub fn write(&self, frame: &Frame, channels: &[Channel], display: Display, settings: &str) -> Result<ExitCode, Failure> {
        let format = self.format().ok_or_else(|| format!("{self}: the format is not known"))?;
        let bytes = Contents { frame, channels, settings }.encode(display, format).map_err(|error| error.to_string())?;
        match self {
            Output::File(path) => match replace(path, &bytes) {
                Ok(()) => Ok(ExitCode::SUCCESS),
                Err(error) => {
                    let name = path.file_name().unwrap_or_default().to_string_lossy();
                    Err(rescue(&advise(error.into()), &name, &bytes))
                }
            },
            Output::Stream(format) => {
                let mut stream = stdout().lock();
                match stream.write_all(&bytes).and_then(|()| stream.flush()) {
                    Ok(()) => Ok(ExitCode::SUCCESS),
                    Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(ExitCode::FAILURE),
                    Err(error) => Err(rescue(&format!("standard output: {error}"), &format!("image.{}", format.name()), &bytes)),
                }
            }
        }
    }

    /// Prints a text about the image: on standard error if the image goes to standard output.
    pub fn report(&self, text: &str) -> Result<(), Failure> {
        match self {
            Output::File(_) => print(text),
            Output::Stream(_) => {
                tell(text);
                Ok(())
            }
        }
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Output::File(path) => path.display().fmt(f),
            Output::Stream(_) => "standard output".fmt(f),
        }
    }
}

/// Adds to the error for pipes how to write to standard output.
fn advise(error: ImageError) -> Failure {
    match error {
        ImageError::Write(WriteError::NotAFile { .. }) => format!("{error}; {ADVICE}"),
        error => error.to_string(),
    }
}

/// Saves an image that cannot be written to its destination in the folder for temporary files, and extends the error by its path.
fn rescue(error: &str, name: &str, image: &[u8]) -> Failure {
    let saved = save_elsewhere(name, image);
    saved.map_or_else(|_| error.to_owned(), |path| format!("{error}\nthe image was saved as {} instead", path.display()))
}

/// Whether standard output was closed when the program started. Rust then opens `/dev/null` in its place for reading and writing;
/// `> /dev/null` opens it for writing only.
#[cfg(unix)]
fn is_closed() -> bool {
    use std::os::{fd::AsFd, unix::fs::MetadataExt};
    let Ok(descriptor) = stdout().as_fd().try_clone_to_owned() else { return true };
    let mut stream = File::from(descriptor);
    let devices = [stream.metadata(), std::fs::metadata("/dev/null")].map(|there| there.map(|there| there.rdev()).ok());
    devices[0].is_some_and(|device| device != 0) && devices[0] == devices[1] && stream.read(&mut [0]).is_ok()
}

#[cfg(not(unix))]
fn is_closed() -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> Frame {
        Frame { width: 1, height: 1, full_resolution: [1, 1], radiance: vec![[1.0; 3]], ..Frame::default() }
    }

    #[test]
    fn a_name_and_a_format_must_agree() {
        let of = |path: &str, format| Output::of(Path::new(path), format);
        assert_eq!(of("-", Some(Format::Exr)), Ok(Output::Stream(Format::Exr)));
        assert_eq!(of("-", Some(Format::Png)), Ok(Output::Stream(Format::Png)));
        assert!(of("-", None).is_err_and(|error| error.contains("--format png")));
        assert_eq!(of("a.PNG", Some(Format::Png)), Ok(Output::File("a.PNG".into())));
        let contradiction = of("a.png", Some(Format::Exr)).expect_err("it is refused");
        assert!(contradiction.contains("ends in .png, but --format says exr"), "{contradiction}");
        // The extension rules: a format does not stand in for it.
        for unknown in ["a", "a.jpg", "a.png.tiff"] {
            let mistake = of(unknown, Some(Format::Png)).expect_err("it is refused");
            assert!(mistake.contains("must end in .png (as shown) or .exr (linear), such as a."), "{mistake}");
        }
        assert_eq!(of("a.nf", None), Ok(Output::File("a.nf".into())));
    }

    #[test]
    fn a_picture_that_cannot_go_where_it_should_is_saved_elsewhere() {
        let folder = tempfile::tempdir().expect("a folder");
        let output = Output::File(folder.path().join("gone/out.exr"));
        let error = output.write(&frame(), &[], Display::default(), "{}").expect_err("there is no such folder");
        let (reason, rescued) = error.split_once("\nthe image was saved as ").expect("it is saved");
        assert!(reason.contains("there is no folder"), "{error}");
        let rescued = Path::new(rescued.strip_suffix(" instead").expect("the end of the message"));
        assert_eq!(noisefall_render::render::image_file::read(rescued).expect("it is an image").radiance, [[1.0; 3]]);
        assert!(rescued.starts_with(std::env::temp_dir()));
        std::fs::remove_file(rescued).expect("it is there");
    }
}
