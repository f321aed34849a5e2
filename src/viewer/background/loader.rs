//! Reading and compiling scenes off the UI thread. The latest request wins.
#[cfg(test)]
mod tests;

use std::{
    path::{Path, PathBuf, absolute},
    sync::Arc,
};

use noisefall::{
    edit::{Document, Recovery, Template},
    import::{self, ImportOptions, Opened, Remarks},
    progress::Progress,
    render::{checkpoint::is_kept_file, truth::Reference},
    scene::{BUILT_IN, Camera, Scene, ShippedScene, Truth, built_in, description::SceneDescription, parse},
};

use super::{
    background_task::BackgroundTask,
    catalogue::{self, BUILT_IN_NAME},
    kept_render::{KeptScene, OpenedRender, open_kept},
};

/// A scene ready to be shown.
pub struct OpenedScene {
    pub scene: Arc<Scene>,
    pub name: String,
    pub path: Option<PathBuf>,
    /// The reference in the scene, which is for its own camera.
    pub truth: Option<Arc<Reference>>,
    /// Source of the scene.
    pub description: Arc<SceneDescription>,
    /// Names of the materials by number.
    pub materials: Arc<[String]>,
    /// Things that are legal but probably not meant.
    pub warnings: Vec<String>,
    /// What was not imported exactly from the file of another program.
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
        let is_same = match (&scene.truth, &self.scene.truth) {
            (Some(Truth::Image(_, new)), Some(Truth::Image(_, old))) => Arc::ptr_eq(new, old),
            (new, old) => new == old,
        };
        if !is_same {
            self.truth = Reference::of(&scene).map(Arc::new);
        }
        self.scene = scene;
    }
}

/// The result of opening a scene: with the document that edits change.
pub type OpenResult = Result<(OpenedScene, Document), String>;

/// A reference image that was dropped on the window.
pub struct DroppedReference {
    /// Name of its file.
    pub name: String,
    pub reference: Arc<Reference>,
    /// The camera at that moment, which the reference is for.
    pub camera: Camera,
}

pub type ReferenceResult = Result<DroppedReference, String>;

pub struct Loader {
    ctx: egui::Context,
    pending: Option<BackgroundTask<OpenResult>>,
    /// Name of what is being read.
    name: String,
    /// The progress of the latest request.
    progress: Progress,
    reference: Option<BackgroundTask<ReferenceResult>>,
    /// The scene of the command line.
    given: GivenScene,
}

impl Loader {
    pub fn new(ctx: &egui::Context) -> Loader {
        Loader {
            ctx: ctx.clone(),
            pending: None,
            name: String::new(),
            progress: Progress::default(),
            reference: None,
            given: GivenScene::default(),
        }
    }

    /// Opens the scene of the command line.
    pub fn open_given(&mut self, scene: GivenScene) {
        self.given = scene.clone();
        self.open(scene.path);
    }

    /// Opens a scene file, or the built-in scene.
    pub fn open(&mut self, path: Option<PathBuf>) {
        let mut scene = if self.is_given(path.as_deref()) { GivenScene { path, ..self.given.clone() } } else { path.into() };
        self.name = scene.path.as_deref().map_or_else(|| BUILT_IN_NAME.to_owned(), file_name);
        scene.options.progress = self.restart();
        self.pending = Some(BackgroundTask::start(&self.ctx, |_| open(scene)));
    }

    /// Cancels the request that is pending, and returns the progress of the next one.
    fn restart(&mut self) -> Progress {
        self.cancel();
        self.progress = Progress::default();
        self.progress.clone()
    }

    /// The progress of the pending request.
    pub fn progress(&self) -> Option<&Progress> {
        self.pending.is_some().then_some(&self.progress)
    }

    /// The options with which a scene was opened.
    pub fn options_of(&self, path: Option<&Path>) -> ImportOptions {
        if self.is_given(path) { self.given.options.clone() } else { ImportOptions::default() }
    }

    /// Whether a file is that of the command line, whose options it takes.
    fn is_given(&self, path: Option<&Path>) -> bool {
        let paths = self.given.path.as_deref().zip(path);
        paths.is_some_and(|(given, path)| absolute(given).ok() == absolute(path).ok())
    }

    /// Begins a new scene.
    pub fn begin(&mut self, template: Template) {
        self.cancel();
        template.title.clone_into(&mut self.name);
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| begin(template)));
    }

    /// Opens a scene with the changes that were not saved.
    pub fn restore(&mut self, recovery: Recovery) {
        let is_given = self.is_given(recovery.origin.as_deref());
        self.name = recovery.file().map_or_else(|| "unsaved changes".to_owned(), file_name);
        let of_file = if is_given { self.given.options.clone() } else { ImportOptions::default() };
        let options = ImportOptions { progress: self.restart(), ..of_file };
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| restore(&recovery, &options)));
    }

    /// Reads a reference for images by this camera.
    pub fn read_reference(&mut self, path: PathBuf, camera: Camera) {
        self.reference = Some(BackgroundTask::start(&self.ctx, move |_| {
            let name = file_name(&path);
            let read = Reference::read(&path);
            let read = read.map(|reference| DroppedReference { name, reference: Arc::new(reference), camera });
            read.map_err(|error| format!("Not a reference: {error}"))
        }));
    }

    /// Discards the reference that is being read, because it is for another scene.
    pub fn forget_reference(&mut self) {
        self.reference = None;
    }

    pub fn is_busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The name of the scene that is being read.
    pub fn reading(&self) -> Option<&str> {
        self.pending.is_some().then_some(&self.name)
    }

    /// Cancels the pending request; no result will come. Returns whether there was one.
    pub fn cancel(&mut self) -> bool {
        self.progress.cancel();
        self.pending.take().is_some()
    }

    /// Reads a scene that is never there, until it is cancelled. `ended` is set then.
    #[cfg(test)]
    pub fn read_for_ever(&mut self, name: &str, ended: Arc<std::sync::atomic::AtomicBool>) {
        name.clone_into(&mut self.name);
        self.pending = Some(BackgroundTask::start(&self.ctx, move |cancelled| {
            while !cancelled() {
                std::thread::yield_now();
            }
            ended.store(true, std::sync::atomic::Ordering::Relaxed);
            Err("cancelled".to_owned())
        }));
    }

    /// Takes the result of the latest request, if it is finished.
    pub fn take(&mut self) -> Option<OpenResult> {
        let failed = |_| Err("reading the scene failed unexpectedly".to_owned());
        Some(BackgroundTask::take(&mut self.pending)?.unwrap_or_else(failed))
    }

    /// Takes the last reference, if it has been read.
    pub fn take_reference(&mut self) -> Option<ReferenceResult> {
        let failed = |_| Err("Reading the reference failed unexpectedly".to_owned());
        Some(BackgroundTask::take(&mut self.reference)?.unwrap_or_else(failed))
    }
}

/// Nobody takes the result of a load whose window is gone.
impl Drop for Loader {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn open(scene: GivenScene) -> OpenResult {
    if let Some(path) = scene.path.as_deref().filter(|path| is_kept_file(path)) {
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
    // A picture carries its scene, and is not replaced by it. A scene in the program has no file.
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
    let KeptScene { scene, remarks, description, kept } = open_kept(path, options)?;
    let scene_path = Path::new(&kept.header.scene.folder).join(&kept.header.scene.name);
    let document = match description {
        Some(description) => Document::imported(&scene_path, &scene.source, (*description).clone()),
        None => Document::untitled(&scene.source).map_err(|error| error.report())?,
    };
    let name = catalogue::name(&scene.title, &scene_path);
    let (opened, document) = opened(scene, name, document, Some(scene_path));
    Ok((OpenedScene { remarks: Arc::new(remarks), kept: Some(Box::new(kept)), ..opened }, document))
}

fn begin(template: Template) -> OpenResult {
    let scene = parse(template.title, template.text.to_owned()).map_err(|error| error.report())?;
    let document = Document::untitled(template.text).map_err(|error| error.report())?;
    Ok(opened(Arc::new(scene), template.title.to_owned(), document, None))
}

fn restore(recovery: &Recovery, options: &ImportOptions) -> OpenResult {
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
    let truth = Reference::of(&scene).map(Arc::new);
    let (materials, warnings) = (scene.legend().names.into(), scene.warnings().to_vec());
    let description = Arc::new(document.description().clone());
    (OpenedScene { scene, name, path, truth, description, materials, warnings, remarks: Arc::default(), kept: None }, document)
}
