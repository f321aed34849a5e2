//! A scene of a study: compiled, at the resolution of the study, with its reference if that is known.
use std::path::{Path, PathBuf};

use super::{StudyError, plan::study_size};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_render::render::{film::Film, reference::Reference as KnownReference};
use noisefall_scene::scene::{Camera, Scene, SceneReference};

/// Beside a scene `NAME.toml`, its reference is `NAME.ref.exr`.
const REFERENCE_EXTENSION: &str = "ref.exr";

/// A scene of a study.
pub struct StudyScene {
    /// The scene file.
    pub path: PathBuf,
    /// The compiled scene.
    pub scene: Scene,
    /// Its camera at the resolution of the study.
    pub camera: Camera,
    /// The known image or radiance and its description; without one, a converged render is made.
    pub known: Option<(KnownReference, String)>,
    /// The reference is the scene's `[reference]`, not a rendered file.
    pub is_declared: bool,
}

impl StudyScene {
    /// A scene that was read from a file. `reference` is an image to use in place of any other reference.
    pub fn new(path: &Path, scene: Scene, size: Option<[u32; 2]>, reference: Option<&Path>) -> Result<StudyScene, StudyError> {
        let unmeasurable = |reason: String| StudyError::Unmeasurable { path: path.to_owned(), reason };
        let known = known(path, &scene, reference)?;
        let own_size = match &known {
            Some((KnownReference::Picture(picture, _), _)) => [picture.width, picture.height],
            _ => study_size(scene.camera.resolution),
        };
        let camera = Camera { resolution: size.unwrap_or(own_size), ..scene.camera };
        camera.check().map_err(|error| unmeasurable(error.to_string()))?;
        if let Some((KnownReference::Picture(picture, _), name)) = &known
            && own_size != camera.resolution
        {
            let ([width, height], [w, h]) = (camera.resolution, [picture.width, picture.height]);
            return Err(unmeasurable(format!("{name} is {w} × {h} and the study {width} × {height}: leave --size out")));
        }
        if scene.lights.is_empty() {
            return Err(unmeasurable("nothing in this scene emits light: there is no error to measure".to_owned()));
        }
        let is_declared = reference.is_none() && scene.reference.is_some();
        Ok(StudyScene { path: path.to_owned(), scene, camera, known, is_declared })
    }

    /// The scene's title, or the name of its file.
    pub fn title(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if self.scene.title.is_empty() { stem } else { self.scene.title.clone() }
    }
}

/// Reserves the memory for measuring these scenes one after the other: a film and the references.
pub fn reserve(study_scenes: &[StudyScene]) -> Result<[Reservation; 2], TooMuch> {
    /// Bytes per pixel of an image.
    const PIXEL: u64 = 12;
    let pixels = |study_scene: &&StudyScene| study_scene.camera.resolution.map(u64::from).iter().product::<u64>();
    let largest = study_scenes.iter().max_by_key(pixels);
    let [width, height] = largest.map_or([0; 2], |study_scene| study_scene.camera.resolution);
    // Files stay in memory. A reference also needs two halves, or a copy for hashing.
    let files: u64 =
        study_scenes.iter().filter(|study_scene| study_scene.known.is_some()).map(|study_scene| pixels(&study_scene)).sum();
    let bytes = PIXEL * (files + 3 * largest.map_or(0, |study_scene| pixels(&study_scene)));
    Ok([Film::reserve([width, height])?, memory::reserve(format_args!("references of {width} × {height} pixels"), bytes)?])
}

/// Titles of scenes that are studied together. Equal titles are extended by the file.
pub fn titles(study_scenes: &[StudyScene]) -> Vec<String> {
    let titles: Vec<String> = study_scenes.iter().map(StudyScene::title).collect();
    let told_apart = |(title, study_scene): (&String, &StudyScene)| {
        let is_alone = titles.iter().filter(|other| *other == title).count() == 1;
        if is_alone { title.clone() } else { format!("{title} ({})", study_scene.path.display()) }
    };
    titles.iter().zip(study_scenes).map(told_apart).collect()
}

fn known(path: &Path, scene: &Scene, given: Option<&Path>) -> Result<Option<(KnownReference, String)>, StudyError> {
    let beside = path.with_extension(REFERENCE_EXTENSION);
    let beside = (scene.reference.is_none() && beside.is_file()).then_some(beside);
    if let Some(file) = given.map(Path::to_owned).or(beside) {
        let reference = KnownReference::read(&file)
            .map_err(|error| StudyError::Unmeasurable { path: path.to_owned(), reason: error.to_string() })?;
        return Ok(Some((reference, format!("the reference {}", file.display()))));
    }
    let name = match &scene.reference {
        Some(SceneReference::Image(file, _)) => format!("the reference image {}", file.display()),
        _ => "the exact radiance".to_owned(),
    };
    let reference = KnownReference::of(scene);
    if reference.as_ref().is_some_and(KnownReference::is_denoised) {
        let reason = format!("{name} is denoised, and so biased; [reference] must be a render without --denoise");
        return Err(StudyError::Unmeasurable { path: path.to_owned(), reason });
    }
    Ok(reference.map(|reference| (reference, name)))
}
