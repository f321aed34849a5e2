//! The scene of a render file: what is kept of it, and where its files are.
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use super::probe::probe;
use crate::{
    render::{protocol::RenderRequest, threads::Threads},
    render_file::{CheckpointScene, Counters, Header, Kind, NamedFile, SceneChoices, Target},
};
use noisefall_base::declare::for_each_file;
use noisefall_scene::scene::{Scene, SceneError, describe, description::SceneDescription};

/// The part of a scene that its render file keeps. `choices` are those of a scene of another program, whose file `path` is read again.
pub fn keep_scene(scene: &Scene, path: &Path, choices: Option<SceneChoices>) -> CheckpointScene {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    CheckpointScene {
        text: scene.source.to_string(),
        name: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        folder: folder.to_string_lossy().into_owned(),
        choices,
    }
}

/// The header of the file of a render. `description` is that of a scene of another program. Reads the files that the scene names, and
/// traces a few samples.
pub fn checkpoint_header(
    request: &RenderRequest,
    scene: CheckpointScene,
    description: Option<&SceneDescription>,
    target: Target,
    threads: &Threads,
) -> Result<Header, SceneError> {
    let files = named_files(&request.scene, &scene, description)?;
    Ok(Header {
        kind: Kind::Progress,
        program: Header::PROGRAM.to_owned(),
        scene,
        camera: request.camera,
        settings: request.settings,
        target,
        files,
        probe: probe(request, threads),
        counters: Counters::default(),
        samples: Vec::new(),
        image: None,
        remarks: Vec::new(),
    })
}

fn named_files(scene: &Scene, kept: &CheckpointScene, known: Option<&SceneDescription>) -> Result<Vec<NamedFile>, SceneError> {
    let mut description = known.map_or_else(|| describe(&kept.name, kept.text.clone()), |known| Ok(known.clone()))?;
    let mut paths = BTreeSet::new();
    for_each_file(&mut description, &mut |path| _ = paths.insert(path.clone()));
    scene.assets.paths().for_each(|path| _ = paths.remove(path));
    paths.extend(scene.assets.sources().map(str::to_owned));
    // The text of a scene of ours is inside.
    paths.extend(kept.choices.is_some().then(|| kept.name.clone()));
    let folder = Path::new(&kept.folder);
    let named = |path: String| {
        NamedFile::of(folder, &path)
            .map_err(|error| SceneError::of_file(&folder.join(&path), format!("cannot be read: {error}"), ""))
    };
    paths.into_iter().map(named).collect()
}

/// Says which files that the scene names are not what they were.
pub fn file_differences(header: &Header, file: &Path) -> Vec<String> {
    let folder = folder_of(&header.scene, file);
    header.files.iter().filter_map(|named| named.difference(&folder)).collect()
}

/// Path of the scene file.
pub fn path_of(kept: &CheckpointScene, file: &Path) -> PathBuf {
    folder_of(kept, file).join(&kept.name)
}

/// The folder of the files that a scene names: where it was, or else that of the render file.
fn folder_of(kept: &CheckpointScene, file: &Path) -> PathBuf {
    let was = PathBuf::from(&kept.folder);
    let beside = || file.parent().unwrap_or(Path::new("")).to_owned();
    if was.is_absolute() && was.is_dir() { was } else { beside() }
}
