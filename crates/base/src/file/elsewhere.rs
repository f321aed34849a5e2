//! A file in the folder for temporary files, for what cannot be written where it should.
use std::path::PathBuf;

use super::{WriteError, durable::fill, short_name};

/// Saves bytes as a new file in the folder for temporary files, and returns its path. Nobody can foresee its name or have a link there,
/// and only the user can read it. Its name ends in `name`.
pub fn save_elsewhere(name: &str, bytes: &[u8]) -> Result<PathBuf, WriteError> {
    const RANDOM_LETTERS: usize = 12;
    const LONGEST: usize = 200;
    let folder = std::env::temp_dir();
    let save = || {
        let suffix = format!("-{}", short_name(name, LONGEST));
        let mut file =
            tempfile::Builder::new().prefix("noisefall-").suffix(&suffix).rand_bytes(RANDOM_LETTERS).tempfile_in(&folder)?;
        fill(file.as_file_mut(), |to| to.write_all(bytes))?;
        let (_, path) = file.keep()?;
        Ok::<_, std::io::Error>(path)
    };
    save().map_err(|error| WriteError::failed(&folder, &error.to_string()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn each_file_is_new_and_has_a_name_of_its_own() {
        let long = format!("{}.exr", "🙂".repeat(60));
        let saved = ["a.png", "a.png", &long].map(|name| save_elsewhere(name, b"image").expect("it is saved"));
        assert!(saved[0] != saved[1] && saved[2].extension().is_some_and(|extension| extension == "exr"));
        for path in saved {
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt;
                assert_eq!(fs::metadata(&path).expect("it is there").permissions().mode() & 0o777, 0o600);
            }
            assert_eq!(fs::read(&path).expect("it is there"), b"image");
            fs::remove_file(path).expect("it is there");
        }
    }
}
