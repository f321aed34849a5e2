//! Reading and compiling a scene with the document that edits change.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use noisefall_edit::edit::{Document, Recovery, Template};
use noisefall_formats::import::{self, ImportOptions, Opened, Remarks};
use noisefall_render::render::{checkpoint::is_checkpoint_file, reference::Reference};
use noisefall_scene::scene::{BUILT_IN, Scene, SceneReference, ShippedScene, built_in, description::SceneDescription, parse};

use super::{
    catalogue::{self, BUILT_IN_NAME},
    checkpoint_render::{OpenedRender, ReopenedScene, open_kept},
};

/// A scene ready to be shown.
pub struct OpenedScene {
    pub scene: Arc<Scene>,
    pub name: String,
    pub path: Option<PathBuf>,
    /// The reference in the scene, which is for its own camera.
    pub reference: Option<Arc<Reference>>,
    /// Source of the scene.
    pub description: Arc<SceneDescription>,
    /// Names of the materials by number.
    pub materials: Arc<[String]>,
    /// Things that are legal but probably not meant.
    pub warnings: Vec<String>,
    /// Parts that were not imported exactly from the file of another program.
    pub remarks: Arc<Remarks>,
    /// The render that continues, if the scene was opened from its file. It is taken once.
    pub kept: Option<Box<OpenedRender>>,
}

/// A scene of the command line.
#[derive(Clone, Debug, Default)]
pub struct GivenScene {
    /// The file; `None` is the built-in scene.
    pub path: Option<PathBuf>,
    /// Options of the reader, also when the file is opened again.
    pub options: ImportOptions,
    /// Whether remarks are errors.
    pub strict: bool,
}

impl From<Option<PathBuf>> for GivenScene {
    fn from(path: Option<PathBuf>) -> GivenScene {
        GivenScene { path, ..GivenScene::default() }
    }
}

impl OpenedScene {
    /// The folder of the files that the scene names.
    pub fn folder(&self) -> PathBuf {
        self.path.as_deref().and_then(Path::parent).map(Path::to_owned).unwrap_or_default()
    }

    /// Takes over an edited scene.
    pub fn change(&mut self, scene: Arc<Scene>) {
        self.materials = scene.legend().names.into();
        let is_same = match (&scene.reference, &self.scene.reference) {
            (Some(SceneReference::Image(_, new)), Some(SceneReference::Image(_, old))) => Arc::ptr_eq(new, old),
            (new, old) => new == old,
        };
        if !is_same {
            self.reference = Reference::of(&scene).map(Arc::new);
        }
        self.scene = scene;
    }
}

/// The result of opening a scene: with the document that edits change.
pub type OpenResult = Result<(OpenedScene, Document), String>;

/// Opens a scene file, a file of a render, or the built-in scene.
pub fn open(scene: GivenScene) -> OpenResult {
    if let Some(path) = scene.path.as_deref().filter(|path| is_checkpoint_file(path)) {
        return open_render(path, &scene.options);
    }
    let GivenScene { path: Some(path), options, strict } = scene else {
        let document = Document::untitled(BUILT_IN).map_err(|error| error.report())?;
        return Ok(opened(Arc::new(built_in()), BUILT_IN_NAME.to_owned(), document, None));
    };
    let Opened { scene, remarks, description } = import::open(&path, &options).map_err(|error| error.report())?;
    if strict && !remarks.is_empty() {
        let lines = remarks.lines(remarks.len()).join("\n");
        return Err(format!("{}: with --strict, each of these is an error:\n{lines}", path.display()));
    }
    // An image carries its scene, and is not replaced by it. A scene in the program has no file.
    let is_picture = path.extension().is_some_and(|extension| !extension.eq_ignore_ascii_case("toml"));
    let is_shipped = ShippedScene::of(&path).is_some();
    let document = match description {
        Some(description) => Ok(Document::imported(&path, &scene.source, (*description).clone())),
        None if is_picture || is_shipped => Document::untitled(&scene.source),
        None => Document::open(&path, &scene.source),
    };
    let name = catalogue::name(&scene.title, &path);
    let (opened, document) = opened(Arc::new(scene), name, document.map_err(|error| error.report())?, Some(path));
    Ok((OpenedScene { remarks: Arc::new(remarks), ..opened }, document))
}

/// Opens the scene of a render that continues.
fn open_render(path: &Path, options: &ImportOptions) -> OpenResult {
    let ReopenedScene { scene, remarks, description, kept } = open_kept(path, options)?;
    let scene_path = Path::new(&kept.header.scene.folder).join(&kept.header.scene.name);
    let document = match description {
        Some(description) => Document::imported(&scene_path, &scene.source, (*description).clone()),
        None => Document::untitled(&scene.source).map_err(|error| error.report())?,
    };
    let name = catalogue::name(&scene.title, &scene_path);
    let (opened, document) = opened(scene, name, document, Some(scene_path));
    Ok((OpenedScene { remarks: Arc::new(remarks), kept: Some(Box::new(kept)), ..opened }, document))
}

/// Begins a new scene.
pub fn begin(template: Template) -> OpenResult {
    let scene = parse(template.title, template.text.to_owned()).map_err(|error| error.report())?;
    let document = Document::untitled(template.text).map_err(|error| error.report())?;
    Ok(opened(Arc::new(scene), template.title.to_owned(), document, None))
}

/// Opens a scene with the changes that were not saved.
pub fn restore(recovery: &Recovery, options: &ImportOptions) -> OpenResult {
    let document = recovery.open().map_err(|error| error.report())?;
    let source = recovery.file().map_or_else(|| "recovered scene".to_owned(), |path| path.display().to_string());
    let scene = match &recovery.origin {
        // Its meshes and textures are in the original only.
        Some(origin) => import::read(origin, options).and_then(|imported| {
            let description = Arc::new(document.description().clone());
            description.build_watched(origin, imported.assets, &options.progress)
        }),
        None => parse(&source, recovery.text.clone()),
    };
    let scene = scene.map_err(|error| error.report())?;
    let name = catalogue::name(&scene.title, Path::new(&source));
    Ok(opened(Arc::new(scene), name, document, recovery.file().map(Path::to_owned)))
}

fn opened(scene: Arc<Scene>, name: String, document: Document, path: Option<PathBuf>) -> (OpenedScene, Document) {
    let reference = Reference::of(&scene).map(Arc::new);
    let (materials, warnings) = (scene.legend().names.into(), scene.warnings().to_vec());
    let description = Arc::new(document.description().clone());
    (
        OpenedScene { scene, name, path, reference, description, materials, warnings, remarks: Arc::default(), kept: None },
        document,
    )
}
