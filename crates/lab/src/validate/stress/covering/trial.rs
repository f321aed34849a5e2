//! The trial of one scene.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    sync::Arc,
};

use glam::DVec3;

use super::{
    agreement::{Agreement, agree},
    array::Row,
    frame::{FILE, Frame, SIZE},
    render::{Renderers, SPP},
};
use noisefall_base::declare::Precision;
use noisefall_edit::edit::{Document, Edit, History, OwnedValue, Path as ScenePath, Tree};
use noisefall_kernel::integrator::{pixel_samples, replay};
use noisefall_render::render::pass::panic_message;
use noisefall_scene::scene::{Scene, SceneError, describe, description::SceneDescription};

/// The number of samples of a pixel that are replayed.
const REPLAYED: u32 = 2;
/// The relative error of a sum of samples.
const ROUNDING: f32 = 1e-5;

/// Tries the scene of a row. Returns it, for its tables, and whether estimators agree on it, or says what is wrong with it.
pub fn trial(renderers: &Renderers, frame: &Frame, row: &Row, before: &Scene) -> Result<(Scene, Agreement), String> {
    let tried = catch_unwind(AssertUnwindSafe(|| try_scene(renderers, &Arc::new(frame.describe(row)), before)));
    tried.unwrap_or_else(|panic| Err(format!("panics: {}", panic_message(&*panic))))
}

fn try_scene(renderers: &Renderers, description: &Arc<SceneDescription>, before: &Scene) -> Result<(Scene, Agreement), String> {
    let scene = build(description, before).map_err(|error| format!("is refused: {error}"))?;
    let image = renderers.bits_at_all_levels(&scene)?;
    replays(&scene, &image)?;
    survives_editing(renderers, &scene, description, &image)?;
    let read = describe(FILE, description.to_text()).map_err(|error| format!("its text is refused: {error}"))?;
    same(&read, description, "its text reads")?;
    let again = build(&Arc::new(read), &scene).map_err(|error| format!("is refused when it is read: {error}"))?;
    same_image(renderers, &again, &image, "the saved scene")?;
    let agreement = agree(renderers, &scene)?;
    Ok((scene, agreement))
}

/// Some samples are those that their replays have. All samples of a pixel add up to it, if no others bring light there.
fn replays(scene: &Scene, image: &[[u32; 3]]) -> Result<(), String> {
    let rays = scene.rays(&scene.camera);
    for pixel in [[SIZE / 2, SIZE / 2], [1, SIZE - 2]] {
        let samples = pixel_samples(scene, &rays, &scene.settings, pixel, 0..SPP, &|| false).unwrap_or_default();
        for (number, sample) in (0..REPLAYED).zip(&samples) {
            let replayed = replay(scene, &rays, &scene.settings, pixel, number).radiance;
            if replayed.map(f32::to_bits) != sample.map(f32::to_bits) {
                return Err(format!("sample {number} of pixel {pixel:?} is {sample:?}, and replayed {replayed:?}"));
            }
        }
        let found = image[(pixel[1] * SIZE + pixel[0]) as usize].map(f32::from_bits);
        let mean = |channel: usize| samples.iter().map(|sample| sample[channel]).sum::<f32>() / SPP as f32;
        let is_sum = (0..3).all(|channel| (found[channel] - mean(channel)).abs() <= ROUNDING * mean(channel).abs());
        if !is_sum && !scene.settings.adaptive && !scene.traces_light_paths(&scene.settings) {
            return Err(format!("pixel {pixel:?} is {found:?}, and the mean of its samples {:?}", [0, 1, 2].map(mean)));
        }
    }
    Ok(())
}

/// Edits that are undone leave the scene, its text and its image as they were.
fn survives_editing(
    renderers: &Renderers,
    scene: &Scene,
    description: &Arc<SceneDescription>,
    image: &[[u32; 3]],
) -> Result<(), String> {
    let text = description.to_text();
    let mut document = Document::open(FILE, &text).map_err(|error| format!("cannot be edited: {error}"))?;
    let mut history = History::default();
    let look_at = description.camera.look_at + DVec3::new(0.1, 0.2, 0.0);
    let edits = [
        Edit::set(ScenePath::of("camera.look_at"), OwnedValue::Vector(look_at)),
        Edit::Remove { path: ScenePath::of("objects.1") },
    ];
    for edit in &edits {
        history.apply(&mut document, edit).map_err(|problem| format!("an edit is refused: {}", problem.message))?;
    }
    let edited = Arc::new(document.description().clone());
    let edited = build(&edited, scene).map_err(|error| format!("cannot be edited: {error}"))?;
    renderers.bits(&edited)?;
    edits.iter().for_each(|_| _ = history.undo(&mut document));
    same(document.description(), description, "after undo it is")?;
    if document.text() != text {
        return Err("undo leaves another text".to_owned());
    }
    let undone = Arc::new(document.description().clone());
    let undone = build(&undone, &edited).map_err(|error| format!("is refused after undo: {error}"))?;
    same_image(renderers, &undone, image, "the scene after undo")
}

fn same(found: &SceneDescription, expected: &SceneDescription, what: &str) -> Result<(), String> {
    let is_same = Tree::of(&mut found.clone()).is_identical(&Tree::of(&mut expected.clone()));
    if is_same { Ok(()) } else { Err(format!("{what} {found:?}")) }
}

fn same_image(renderers: &Renderers, scene: &Scene, image: &[[u32; 3]], what: &str) -> Result<(), String> {
    if renderers.bits(scene)? == image { Ok(()) } else { Err(format!("{what} has another image of {SPP} samples")) }
}

/// Compiles a scene; tables are reused from the one before.
fn build(description: &Arc<SceneDescription>, before: &Scene) -> Result<Scene, SceneError> {
    description.rebuild(Path::new(""), before, Precision::Exact)
}
