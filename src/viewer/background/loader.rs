//! Reading and compiling scenes off the UI thread. The latest request wins.
use std::{
    path::{Path, PathBuf, absolute},
    sync::Arc,
};

use noisefall::{
    edit::{Document, Recovery, Template},
    import::{self, ImportOptions, Opened, Remarks},
    progress::Progress,
    render::truth::Reference,
    scene::{BUILT_IN, Camera, Scene, Truth, built_in, description::SceneDescription, parse},
};

use super::{background_task::BackgroundTask, catalogue};

/// The name of the built-in scene.
pub const BUILT_IN_NAME: &str = "Five-sphere Cornell box (built-in)";

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
    /// What was not taken over exactly from the file of another program.
    pub remarks: Arc<Remarks>,
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
    /// The progress of the latest request.
    progress: Progress,
    reference: Option<BackgroundTask<ReferenceResult>>,
    /// The scene of the command line.
    given: GivenScene,
}

impl Loader {
    pub fn new(ctx: &egui::Context) -> Loader {
        Loader { ctx: ctx.clone(), pending: None, progress: Progress::default(), reference: None, given: GivenScene::default() }
    }

    /// Opens the scene of the command line.
    pub fn open_given(&mut self, scene: GivenScene) {
        self.given = scene.clone();
        self.open(scene.path);
    }

    /// Opens a scene file, or the built-in scene.
    pub fn open(&mut self, path: Option<PathBuf>) {
        let mut scene = if self.is_given(path.as_deref()) { GivenScene { path, ..self.given.clone() } } else { path.into() };
        scene.options.progress = self.restart();
        self.pending = Some(BackgroundTask::start(&self.ctx, |_| open(scene)));
    }

    /// Cancels the request that is pending, and returns the progress of the next one.
    fn restart(&mut self) -> Progress {
        self.cancel();
        self.progress = Progress::default();
        self.progress.clone()
    }

    /// Cancels the pending request. No result will come.
    pub fn cancel(&mut self) {
        self.progress.cancel();
        self.pending = None;
    }

    /// The progress of the pending request.
    pub fn progress(&self) -> Option<&Progress> {
        self.pending.is_some().then_some(&self.progress)
    }

    /// Whether a file is that of the command line, whose options it takes.
    fn is_given(&self, path: Option<&Path>) -> bool {
        let paths = self.given.path.as_deref().zip(path);
        paths.is_some_and(|(given, path)| absolute(given).ok() == absolute(path).ok())
    }

    /// Begins a new scene.
    pub fn begin(&mut self, template: Template) {
        self.cancel();
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| begin(template)));
    }

    /// Opens a scene with the changes that were not saved.
    pub fn restore(&mut self, recovery: Recovery) {
        let is_given = self.is_given(recovery.origin.as_deref());
        let of_file = if is_given { self.given.options.clone() } else { ImportOptions::default() };
        let options = ImportOptions { progress: self.restart(), ..of_file };
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| restore(&recovery, &options)));
    }

    /// Reads a reference for images by this camera.
    pub fn read_reference(&mut self, path: PathBuf, camera: Camera) {
        self.reference = Some(BackgroundTask::start(&self.ctx, move |_| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
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

/// The thread must not go on for nobody.
impl Drop for Loader {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn open(scene: GivenScene) -> OpenResult {
    let GivenScene { path: Some(path), options, strict } = scene else {
        let document = Document::untitled(BUILT_IN).map_err(|error| error.report())?;
        return Ok(opened(built_in(), BUILT_IN_NAME.to_owned(), document, None));
    };
    let Opened { scene, remarks, description } = import::open(&path, &options).map_err(|error| error.report())?;
    if strict && !remarks.is_empty() {
        let lines = remarks.lines(remarks.len()).join("\n");
        return Err(format!("{}: with --strict, each of these is an error:\n{lines}", path.display()));
    }
    // A picture carries its scene, and is not replaced by it.
    let is_picture = path.extension().is_some_and(|extension| !extension.eq_ignore_ascii_case("toml"));
    let document = match description {
        Some(description) => Ok(Document::imported(&path, &scene.source, (*description).clone())),
        None if is_picture => Document::untitled(&scene.source),
        None => Document::open(&path, &scene.source),
    };
    let name = catalogue::name(&scene.title, &path);
    let (opened, document) = opened(scene, name, document.map_err(|error| error.report())?, Some(path));
    Ok((OpenedScene { remarks: Arc::new(remarks), ..opened }, document))
}

fn begin(template: Template) -> OpenResult {
    let scene = parse(template.title, template.text.to_owned()).map_err(|error| error.report())?;
    let document = Document::untitled(template.text).map_err(|error| error.report())?;
    Ok(opened(scene, template.title.to_owned(), document, None))
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
    Ok(opened(scene, name, document, recovery.file().map(Path::to_owned)))
}

fn opened(scene: Scene, name: String, document: Document, path: Option<PathBuf>) -> (OpenedScene, Document) {
    let truth = Reference::of(&scene).map(Arc::new);
    let (materials, warnings) = (scene.legend().names.into(), scene.warnings().to_vec());
    let description = Arc::new(document.description().clone());
    (
        OpenedScene { scene: Arc::new(scene), name, path, truth, description, materials, warnings, remarks: Arc::default() },
        document,
    )
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn wait<T>(mut take: impl FnMut() -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(found) = take() {
                return found;
            }
            assert!(start.elapsed() < Duration::from_secs(60), "it never came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn the_latest_request_wins_and_an_error_names_its_file() {
        let mut loader = Loader::new(&egui::Context::default());
        loader.open(Some("no/such/scene.toml".into()));
        loader.open(None);
        assert!(loader.is_busy());
        let (opened, _) = wait(|| loader.take()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((opened.name.as_str(), opened.path, opened.truth.is_none()), (BUILT_IN_NAME, None, true));
        assert_eq!(opened.materials.len(), opened.scene.legend().names.len());
        assert!(!loader.is_busy() && loader.take().is_none());
        loader.open(Some("no/such/scene.toml".into()));
        assert!(wait(|| loader.take()).is_err_and(|error| error.contains("scene.toml")));
        let furnace = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/furnace.toml");
        loader.open(Some(furnace.clone()));
        let (opened, _) = wait(|| loader.take()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((opened.name.as_str(), opened.path, opened.truth.is_some()), ("Furnace", Some(furnace), true));
    }

    #[test]
    fn a_cancelled_request_has_no_result_and_its_reader_is_told() {
        let mut loader = Loader::new(&egui::Context::default());
        assert!(loader.progress().is_none());
        loader.open(None);
        let first = loader.progress().expect("it is opened").clone();
        loader.open(Some("no/such/scene.toml".into()));
        let second = loader.progress().expect("it is opened").clone();
        assert!(first.is_cancelled() && !second.is_cancelled());
        loader.cancel();
        assert!(second.is_cancelled() && !loader.is_busy() && loader.progress().is_none() && loader.take().is_none());
        loader.open(None);
        assert!(wait(|| loader.take()).is_ok());
    }

    #[test]
    fn a_reference_that_is_read_for_another_scene_is_forgotten() {
        let mut loader = Loader::new(&egui::Context::default());
        let camera = built_in().camera;
        loader.read_reference("no/such/picture.exr".into(), camera);
        assert!(wait(|| loader.take_reference()).is_err_and(|error| error.contains("Not a reference")));
        loader.read_reference("no/such/picture.exr".into(), camera);
        loader.forget_reference();
        assert!(loader.reference.is_none() && loader.take_reference().is_none());
    }
}
