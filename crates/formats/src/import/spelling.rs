//! Names of files that differ from those on disk in upper and lower case: some systems do not tell them apart, and files come from there.
use std::path::{Component, Path};

/// Entries of a folder that are looked at.
const MOST: usize = 1 << 16;

/// The path as the disk spells it, if it lies below `root` and exactly one file or folder fits at each step. `None` if it is spelled
/// right, or nothing fits.
pub fn on_disk(root: &Path, named: &str) -> Option<String> {
    let mut folder = root.to_owned();
    let mut spelled = Vec::new();
    for component in Path::new(named).components() {
        match component {
            Component::CurDir => {}
            Component::Normal(name) => {
                let name = name.to_str()?;
                // A link may lead elsewhere, where nothing is looked at.
                let real = folder.canonicalize().ok().filter(|real| real.starts_with(root))?;
                let name = if real.join(name).exists() { name.to_owned() } else { alike(&real, name)? };
                folder = real.join(&name);
                spelled.push(name);
            }
            _ => return None,
        }
    }
    let spelled = spelled.join("/");
    (spelled != named).then_some(spelled)
}

/// The only entry of a folder with a name in any case.
fn alike(folder: &Path, name: &str) -> Option<String> {
    let wanted = name.to_lowercase();
    let entries = std::fs::read_dir(folder).ok()?.take(MOST).filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut fits = entries.filter(|entry| entry.to_lowercase() == wanted);
    let first = fits.next();
    first.filter(|_| fits.next().is_none())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn names_in_any_case_are_found_within_the_folder() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir_all(folder.path().join("scene/Textures")).expect("a folder");
        let root = folder.path().join("scene").canonicalize().expect("it is there");
        for file in ["scene/Textures/Wood.png", "scene/a.png", "secret.png"] {
            fs::write(folder.path().join(file), "x").expect("it is written");
        }
        let found = |named| on_disk(&root, named);
        assert_eq!(found("textures/WOOD.PNG"), Some("Textures/Wood.png".to_owned()));
        assert_eq!(found("./A.png"), Some("a.png".to_owned()));
        for named in ["a.png", "b.png", "../SECRET.png", "textures/../A.PNG", "/A.PNG", ""] {
            assert_eq!(found(named), None, "{named}");
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn names_that_fit_two_files_fit_none() {
        let folder = tempfile::tempdir().expect("a folder");
        for file in ["A.png", "a.PNG"] {
            fs::write(folder.path().join(file), "x").expect("it is written");
        }
        let root = folder.path().canonicalize().expect("it is there");
        assert_eq!(on_disk(&root, "a.png"), None);
        std::os::unix::fs::symlink(folder.path().parent().expect("a folder"), root.join("Link")).expect("it is made");
        assert_eq!(on_disk(&root, "link/x.png"), None, "nothing is looked at elsewhere");
    }
}
