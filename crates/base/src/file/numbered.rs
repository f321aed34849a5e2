//! Names of numbered files.
use std::path::{Path, PathBuf};

/// The character whose place a digit of the number takes.
const DIGIT: char = '#';

/// The path with a number in place of the last run of `#` in its name, with as many digits or more. `None` if there is no `#`.
pub fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
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
