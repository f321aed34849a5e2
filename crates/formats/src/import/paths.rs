//! Paths of files that a scene refers to.
use std::{
    collections::BTreeSet,
    io::ErrorKind,
    path::{Component, Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

use super::{
    ImportOptions,
    budget::Budget,
    missing::{Missing, Unresolved},
    reach, spelling,
};
use noisefall_base::{progress::Progress, quote};

/// The folder of a scene. Files outside it are refused unless the user allows them: a scene from elsewhere must not read what it
/// likes.
#[derive(Clone, Debug)]
pub struct Folder {
    /// The path as the user typed it.
    typed: PathBuf,
    /// The path without links.
    root: PathBuf,
    allow_outside: bool,
    /// The files that were found, as [`Folder::described`]. Clones share it.
    found: Arc<Mutex<BTreeSet<String>>>,
    /// The files that were not found, and that the scene needs.
    pub missing: Missing,
    /// Limits of what the scene may make of its files.
    pub budget: Budget,
    /// The progress of the reader.
    pub progress: Progress,
}

impl Folder {
    /// The folder of the scene file that the user chose.
    pub fn new(scene: &Path, options: &ImportOptions) -> Folder {
        let parent = scene.parent().filter(|folder| !folder.as_os_str().is_empty());
        let typed = parent.unwrap_or(Path::new(".")).to_owned();
        let root = typed.canonicalize().unwrap_or_else(|_| typed.clone());
        let (allow_outside, progress) = (options.allow_outside, options.progress.clone());
        Folder {
            typed,
            root,
            allow_outside,
            found: Arc::default(),
            missing: Missing::default(),
            budget: Budget::default(),
            progress,
        }
    }

    /// The file at a path that the scene names. It exists, and lies within the folder, links followed. The message of an error does
    /// not begin with the path of the scene.
    pub fn resolve(&self, named: &str) -> Result<PathBuf, Unresolved> {
        self.resolve_beside(&self.typed, named)
    }

    /// The file whose path differs in upper and lower case only from one that does not exist.
    pub fn resolve_in_any_case(&self, named: &str) -> Option<PathBuf> {
        self.resolve(&spelling::on_disk(&self.root, named)?).ok()
    }

    /// The file at a path that a file in `folder` names, such as a material library.
    pub fn resolve_beside(&self, folder: &Path, named: &str) -> Result<PathBuf, Unresolved> {
        let shown = quote::path(Path::new(named));
        let path = Path::new(named);
        if named.is_empty() {
            return Err(Unresolved::refused("the path is empty".to_owned()));
        }
        // Before the disk is touched: some absolute paths lead to other machines.
        if is_absolute(path) && !self.allow_outside {
            return Err(Unresolved::refused(format!("`{shown}` is an absolute path; {ADVICE}")));
        }
        let full = folder.join(path).canonicalize().map_err(|error| match error.kind() {
            ErrorKind::NotFound => Unresolved { message: format!("`{shown}`: there is no such file"), is_missing: true },
            _ => Unresolved::refused(format!("`{shown}` cannot be found: {error}")),
        })?;
        match reach::refusal(&self.root, &full).filter(|_| !self.allow_outside) {
            Some(why) => Err(Unresolved::refused(format!("`{shown}` {why}; {ADVICE}"))),
            None => {
                self.note(&full);
                Ok(full)
            }
        }
    }

    /// A folder in which the scene looks for files, and which it may share with others beside it.
    pub fn shared_folder(&self, named: &str) -> Result<PathBuf, String> {
        let (shown, path) = (quote::path(Path::new(named)), Path::new(named));
        if is_absolute(path) && !self.allow_outside {
            return Err(format!("`{shown}` is an absolute path; {ADVICE}"));
        }
        let shared = self.typed.join(path).canonicalize().ok().filter(|shared| shared.is_dir());
        let shared = shared.ok_or_else(|| format!("the search folder `{shown}` does not exist"))?;
        let refusal = reach::refusal_to_share(&self.root, path, &shared).filter(|_| !self.allow_outside);
        refusal.map_or(Ok(shared), |why| Err(format!("the search folder `{shown}` {why}; {ADVICE}")))
    }

    /// The file at a path in such a folder, if there is one that may be read.
    pub fn in_shared_folder(&self, folder: &Path, named: &str) -> Option<PathBuf> {
        let inside = (!named.is_empty() && !is_absolute(Path::new(named))).then(|| folder.join(named).canonicalize().ok())??;
        let is_read = self.allow_outside || reach::refusal(folder, &inside).is_none();
        is_read.then(|| self.note(&inside))?;
        Some(inside)
    }

    /// Whether messages may show what stands in a file: not in one that only lies in a folder that the scene shares.
    pub fn may_quote(&self, file: &Path) -> bool {
        self.allow_outside || file.canonicalize().is_ok_and(|file| file.starts_with(&self.root))
    }

    /// The scene file itself without links.
    pub fn resolved(&self, scene: &Path) -> PathBuf {
        scene.canonicalize().unwrap_or_else(|_| scene.to_owned())
    }

    /// The folder without links.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The folder, as the user typed it.
    pub fn path(&self) -> &Path {
        &self.typed
    }

    /// Notes a file that was found elsewhere.
    pub fn note(&self, file: &Path) {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).insert(self.described(file));
    }

    /// The files that were found so far, by the paths that a description gives them.
    pub fn found(&self) -> BTreeSet<String> {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The path that a description gives to a resolved file: relative to the folder of the scene, or else absolute.
    pub fn described(&self, resolved: &Path) -> String {
        let inside = resolved.strip_prefix(&self.root).ok();
        let parts = inside.map(|path| path.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>());
        parts.map_or_else(|| resolved.display().to_string(), |parts| parts.join("/"))
    }
}

const ADVICE: &str = "--allow-outside permits it";

/// Whether a path does not start at the folder of the scene, on any system.
fn is_absolute(path: &Path) -> bool {
    let text = path.as_os_str().as_encoded_bytes();
    let has_drive = text.len() > 1 && text[0].is_ascii_alphabetic() && text[1] == b':';
    let has_root = path.components().next().is_some_and(|part| matches!(part, Component::Prefix(_) | Component::RootDir));
    has_root || has_drive || text.starts_with(b"\\")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn scene() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir_all(folder.path().join("scene/textures")).expect("a folder");
        for file in ["secret.png", "scene/textures/wood.png"] {
            fs::write(folder.path().join(file), "x").expect("it is written");
        }
        let path = folder.path().join("scene/room.xml");
        (folder, path)
    }

    #[test]
    fn files_in_the_folder_are_found_and_described_by_their_relative_path() {
        let (_folder, path) = scene();
        let folder = Folder::new(&path, &ImportOptions::default());
        let wood = folder.resolve("textures/wood.png").expect("it is there");
        assert_eq!(
            (fs::read(&wood).expect("it is readable"), folder.described(&wood)),
            (b"x".to_vec(), "textures/wood.png".into())
        );
        assert_eq!(folder.resolve("textures/../textures/wood.png"), Ok(wood.clone()));
        assert_eq!(folder.resolve_beside(wood.parent().expect("a folder"), "wood.png"), Ok(wood));
        assert_eq!(folder.clone().found(), BTreeSet::from(["textures/wood.png".to_owned()]));
    }

    #[test]
    fn files_elsewhere_are_refused_by_the_name_of_the_flag_that_allows_them() {
        let (_folder, path) = scene();
        let strict = Folder::new(&path, &ImportOptions::default());
        let lax = Folder::new(&path, &ImportOptions { allow_outside: true, ..ImportOptions::default() });
        let secret = path.parent().and_then(Path::parent).expect("a folder").join("secret.png");
        for named in ["../secret.png", "textures/../../secret.png", secret.to_str().expect("text")] {
            assert!(strict.resolve(named).is_err_and(|error| error.message.contains("--allow-outside")), "{named}");
            let found = lax.resolve(named).expect("it is allowed");
            assert_eq!(Path::new(&lax.described(&found)), found);
        }
        for named in ["C:\\secret.png", "\\\\machine\\secret.png", "/secret.png"] {
            assert!(strict.resolve(named).is_err_and(|error| error.message.contains("absolute")), "{named}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_does_not_lead_outside() {
        let (_folder, path) = scene();
        let folder = Folder::new(&path, &ImportOptions::default());
        let link = path.with_file_name("link.png");
        std::os::unix::fs::symlink("../secret.png", link).expect("it is made");
        assert!(folder.resolve("link.png").is_err_and(|error| error.message.contains("outside")));
    }

    #[test]
    fn a_shared_folder_is_searched_and_hidden_files_in_it_are_not() {
        let (outer, path) = scene();
        fs::create_dir_all(outer.path().join("common/.keys")).expect("a folder");
        for file in ["common/wood.png", "common/.keys/id"] {
            fs::write(outer.path().join(file), "x").expect("it is written");
        }
        let folder = Folder::new(&path, &ImportOptions::default());
        let common = folder.shared_folder("../common").expect("it is beside");
        assert!(folder.in_shared_folder(&common, "wood.png").is_some_and(|wood| !folder.may_quote(&wood)));
        for named in [".keys/id", "../secret.png", "", "none.png"] {
            assert_eq!(folder.in_shared_folder(&common, named), None, "{named}");
        }
        for refused in ["..", "../common/.keys", "/tmp", "nowhere", "textures/wood.png"] {
            assert!(folder.shared_folder(refused).is_err(), "{refused}");
        }
        let lax = Folder::new(&path, &ImportOptions { allow_outside: true, ..ImportOptions::default() });
        let all = lax.shared_folder("..").expect("it is allowed");
        let secret = lax.in_shared_folder(&all, "secret.png").expect("it is allowed");
        assert!(lax.may_quote(&secret));
    }

    #[test]
    fn missing_and_impossible_files_have_messages() {
        let (_folder, path) = scene();
        let folder = Folder::new(&path, &ImportOptions::default());
        let message = |named: &str| folder.resolve(named).expect_err("it is refused").message;
        assert_eq!((message(""), message("a.png")), ("the path is empty".into(), "`a.png`: there is no such file".into()));
        assert!(message("a\0b").contains("cannot be found"));
    }
}
