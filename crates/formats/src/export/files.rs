//! The files that a scene names, beside an exported scene.
use std::{
    collections::{BTreeMap, btree_map::Entry},
    io::Read,
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{ExportError, ExportSource, file_names::FileNames};
use noisefall_base::{
    file::{LONGEST_NAME, WriteError, check_below, open_regular, replace_below, short_name},
    memory::{Size, reserve},
};
use noisefall_scene::model::{Model, encode_ply};

/// The files of a scene, each with its place beside the exported scene.
pub struct ExportedFiles {
    /// The folder of those that are written or copied.
    pub folder: PathBuf,
    /// By the path under which the scene names them.
    files: BTreeMap<String, File>,
}

struct File {
    /// Relative to the folder of the exported scene, with `/` between its parts.
    path: String,
    /// Relative to [`ExportedFiles::folder`], with its content; absent for a file that stays where it is.
    copy: Option<(String, FileContent)>,
}

enum FileContent {
    Mesh(Arc<Model>),
    Bytes(Arc<Vec<u8>>),
    /// A file that is copied.
    Disk(PathBuf),
}

impl ExportedFiles {
    /// Finds the places of the files that a scene names when it is exported to a file.
    pub fn place(source: &ExportSource, named: Vec<String>, scene: &Path) -> Result<ExportedFiles, ExportError> {
        let parent = scene.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let root = parent.canonicalize().map_err(|_| no_folder(scene, parent))?;
        let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
        let data = format!("{}.files", short_name(&stem, LONGEST_NAME - ".files".len()));
        let mut files = ExportedFiles { folder: scene.with_file_name(&data), files: BTreeMap::new() };
        let (mut names, mut moved) = (FileNames::default(), Vec::new());
        for named in named {
            match content(source, &named)? {
                // It stays where it is, and no other file may replace it.
                FileContent::Disk(path) if path.starts_with(&root) => {
                    let parts = path.strip_prefix(&root).unwrap_or(&path).components();
                    let path = parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
                    path.strip_prefix(&format!("{data}/")).into_iter().for_each(|inner| names.keep(inner));
                    files.files.insert(named, File { path, copy: None });
                }
                content => moved.push((named, content)),
            }
        }
        for (named, content) in moved {
            if let Entry::Vacant(place) = files.files.entry(named) {
                let name = match &content {
                    FileContent::Disk(path) => names.free(&path.file_name().unwrap_or_default().to_string_lossy()),
                    _ => names.free(place.key()),
                };
                place.insert(File { path: format!("{data}/{name}"), copy: Some((name, content)) });
            }
        }
        Ok(files)
    }

    /// The path in the exported scene of a file.
    pub fn path(&self, named: &str) -> String {
        self.files.get(named).map_or_else(|| named.to_owned(), |file| file.path.clone())
    }

    /// Writes all files. Returns the numbers of those from memory and of copies.
    pub fn write(&self) -> Result<[usize; 2], ExportError> {
        let mut counts = [0; 2];
        let copies = || self.files.values().filter_map(|file| file.copy.as_ref());
        copies().try_for_each(|(name, _)| check_below(&self.folder, name))?;
        for (name, content) in copies() {
            let replace = |bytes: &[u8]| replace_below(&self.folder, name, bytes);
            match content {
                FileContent::Mesh(model) => replace(&encode_ply(model)?)?,
                FileContent::Bytes(bytes) => replace(bytes)?,
                FileContent::Disk(from) => replace(&bytes(from)?)?,
            }
            counts[usize::from(matches!(content, FileContent::Disk(_)))] += 1;
        }
        Ok(counts)
    }
}

fn no_folder(path: &Path, folder: &Path) -> ExportError {
    WriteError::NoFolder { path: path.to_owned(), folder: folder.to_owned() }.into()
}

/// The content of a file that a scene names.
fn content(source: &ExportSource, named: &str) -> Result<FileContent, ExportError> {
    if let Some(model) = source.assets.get::<Model>(named) {
        return Ok(FileContent::Mesh(model));
    }
    if let Some(bytes) = source.assets.get::<Vec<u8>>(named) {
        return Ok(FileContent::Bytes(bytes));
    }
    let path = source.folder.join(named);
    let found = path.canonicalize();
    found.map(FileContent::Disk).map_err(|error| ExportError::Unreadable { path, reason: error.to_string() })
}

/// The content of a file on disk.
pub fn bytes(from: &Path) -> Result<Vec<u8>, ExportError> {
    let unreadable = |error: std::io::Error| ExportError::Unreadable { path: from.to_owned(), reason: error.to_string() };
    let mut file = open_regular(from).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    let _room = reserve(format_args!("{} of a file", Size(length)), length)?;
    let mut bytes = Vec::with_capacity(length as usize);
    (&mut file).take(length).read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::export::{check, prepare, write};
    use noisefall_base::{declare::Assets, file::faults::lose_nothing};
    use noisefall_scene::{
        scene::{describe, description::SceneDescription},
        shape::mesh::{Mesh, MeshSource},
        texture::kinds::Image,
    };

    fn triangle() -> Model {
        Model { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]], ..Model::default() }
    }

    /// A scene with meshes of these names, and a texture.
    fn scene(meshes: &[&str], texture: &str) -> SceneDescription {
        let mut scene = SceneDescription::default();
        for name in meshes {
            scene.add_object(name, Mesh { source: MeshSource::File((*name).to_owned()), smooth: None });
        }
        scene.textures.insert("wood".to_owned(), Image { path: texture.to_owned(), ..Image::default() }.into());
        scene
    }

    fn named(text: &str) -> Vec<String> {
        let mut named = Vec::new();
        let mut scene = describe("scene", text.to_owned()).expect("it is a scene");
        noisefall_base::declare::for_each_file(&mut scene, &mut |file| named.push(file.clone()));
        named
    }

    #[test]
    fn files_in_memory_are_written_and_files_elsewhere_are_copied() {
        let [from, to] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
        fs::write(from.path().join("wood.png"), "wood").expect("it is written");
        let mut assets = Assets::default();
        for path in ["meshes/a.ply", "../../meshes/A.ply"] {
            assets.insert(path, triangle());
        }
        let description = scene(&["meshes/a.ply", "../../meshes/A.ply", "meshes/a.ply"], "wood.png");
        let source =
            ExportSource { description: &description, assets: &assets, folder: from.path(), allow_outside: false, text: None };
        let done = write(source, &to.path().join("room.toml")).expect("it is written");
        assert_eq!((done.written, done.copied, done.folder), (2, 1, Some(to.path().join("room.files"))));
        let text = fs::read_to_string(to.path().join("room.toml")).expect("it is there");
        let names = named(&text);
        assert_eq!(
            names,
            ["room.files/wood.png", "room.files/meshes/a.ply", "room.files/meshes/A 2.ply", "room.files/meshes/a.ply"]
        );
        assert_eq!(fs::read_to_string(to.path().join(&names[0])).expect("it is there"), "wood");
        for mesh in &names[1..] {
            assert_eq!(noisefall_scene::model::read(&to.path().join(mesh)).expect("it is there"), triangle());
        }
    }

    #[test]
    fn files_in_the_folder_of_the_exported_scene_stay() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("textures")).expect("a folder");
        fs::write(folder.path().join("textures/wood.png"), "wood").expect("it is written");
        let (description, assets) = (scene(&[], "textures/../textures/wood.png"), Assets::default());
        let source =
            ExportSource { description: &description, assets: &assets, folder: folder.path(), allow_outside: false, text: None };
        let done = write(source, &folder.path().join("room.toml")).expect("it is written");
        let text = fs::read_to_string(folder.path().join("room.toml")).expect("it is there");
        assert_eq!((done.written, done.copied, done.folder, named(&text)), (0, 0, None, vec!["textures/wood.png".to_owned()]));
        assert!(!folder.path().join("room.files").exists());
    }

    #[test]
    fn a_disk_that_fails_at_any_moment_leaves_the_scene_before() {
        let [from, to] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
        fs::write(from.path().join("wood.png"), "wood").expect("it is written");
        let mut assets = Assets::default();
        assets.insert("a.ply", triangle());
        let description = scene(&["a.ply"], "wood.png");
        let source =
            ExportSource { description: &description, assets: &assets, folder: from.path(), allow_outside: false, text: None };
        for name in ["room.toml", "room.xml"] {
            let path = to.path().join(name);
            fs::write(&path, "old").expect("it is written");
            let prepared = prepare(source, &path).expect("it can be written");
            lose_nothing(&path, &mut || prepared.write().map(drop).map_err(|error| error.to_string()));
        }
    }

    #[test]
    fn nothing_is_written_if_a_file_is_missing() {
        let folder = tempfile::tempdir().expect("a folder");
        let (description, assets) = (scene(&[], "wood.png"), Assets::default());
        let source =
            ExportSource { description: &description, assets: &assets, folder: folder.path(), allow_outside: false, text: None };
        let error = write(source, &folder.path().join("room.toml")).expect_err("it is missing");
        assert!(error.to_string().contains("wood.png"), "{error}");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
        assert!(check(Path::new("a.blend")).is_err() && check(Path::new("a.TOML")).is_ok());
    }
}
