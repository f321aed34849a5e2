//! The scene of a render file: what is kept of it, and how it is opened again.
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use super::probe::probe;
use crate::{
    declare::for_each_file,
    import::{self, ImportOptions, Opened, Remarks, is_foreign},
    progress::Progress,
    render::{protocol::RenderRequest, threads::Threads},
    render_file::{Counters, Header, KeptScene, Kind, NamedFile, SceneChoices, Target},
    scene::{Scene, SceneError, describe, description::SceneDescription, parse_watched},
};

/// What is kept of a scene that was read from `path`. Scenes of other programs are read from their file again.
pub fn keep_scene(scene: &Scene, path: &Path, options: &ImportOptions) -> KeptScene {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let ImportOptions { defines, time, variant, allow_outside, size, .. } = options.clone();
    KeptScene {
        text: scene.source.to_string(),
        name: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        folder: folder.to_string_lossy().into_owned(),
        choices: is_foreign(path).then_some(SceneChoices { defines, time, variant, size, allow_outside }),
    }
}

/// The header of the file of a render. `description` is that of a scene of another program. Reads the files that the scene names, and
/// traces a few samples.
pub fn kept_header(
    request: &RenderRequest,
    scene: KeptScene,
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

fn named_files(scene: &Scene, kept: &KeptScene, known: Option<&SceneDescription>) -> Result<Vec<NamedFile>, SceneError> {
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

/// Opens the scene of a file again. That it may read files outside of its folder is for the user to say, and not for the file.
pub fn reopen(kept: &KeptScene, file: &Path, allow_outside: bool, progress: &Progress) -> Result<Opened, SceneError> {
    let path = folder_of(kept, file).join(&kept.name);
    match &kept.choices {
        None => {
            let scene = parse_watched(&path.display().to_string(), kept.text.clone(), progress)?;
            Ok(Opened { scene, remarks: Remarks::default(), description: None })
        }
        Some(SceneChoices { allow_outside: true, .. }) if !allow_outside => {
            let message = "the scene of this render reads files outside of its folder";
            Err(SceneError::of_file(file, message, "if you trust the file and its scene, add --allow-outside"))
        }
        Some(SceneChoices { defines, time, variant, size, allow_outside }) => {
            let (defines, variant, progress) = (defines.clone(), variant.clone(), progress.clone());
            let (time, allow_outside, size) = (*time, *allow_outside, *size);
            import::open(&path, &ImportOptions { defines, time, variant, allow_outside, size, progress })
        }
    }
}

/// The folder of the files that a scene names: where it was, or else that of the render file.
fn folder_of(kept: &KeptScene, file: &Path) -> PathBuf {
    let was = PathBuf::from(&kept.folder);
    let beside = || file.parent().unwrap_or(Path::new("")).to_owned();
    if was.is_absolute() && was.is_dir() { was } else { beside() }
}
