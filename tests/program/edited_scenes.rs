//! A scene that is compiled again after a change equals one that is compiled from scratch.
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use glam::DVec3;
use noisefall_base::{
    declare::{Dice, OneOf, Parameters, Precision},
    math::SimdLevel,
};
use noisefall_render::render::{
    Frame,
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{
    Camera, RenderSettings, Reuse, Scene, describe,
    description::{EmissionDescription, SceneDescription, Transform},
};
use rand::{Rng, SeedableRng, rngs::SmallRng};

/// The bits of a small image, with every way to share that the scene allows.
pub fn picture(scene: &Scene, threads: &Threads) -> Vec<[u32; 3]> {
    let camera = Camera { resolution: [16, 12], ..scene.camera };
    let settings = RenderSettings { reuse: Reuse::Suffixes, ..scene.settings };
    let mut film = Film::new(camera.resolution);
    threads.pass(PassJob { scene, rays: &scene.rays(&camera), settings: &settings }, &mut film, 2, &|| false);
    let frame = Frame::of_film(&film, 0, camera.resolution, camera.resolution);
    frame.radiance.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

fn bits(rows: &[[f32; 4]]) -> Vec<[u32; 4]> {
    rows.iter().map(|row| row.map(f32::to_bits)).collect()
}

pub fn assert_same(edited: &Scene, new: &Scene, threads: &Threads, what: &str) {
    let tables = |scene: &Scene| {
        let surfaces = &scene.surfaces;
        [&surfaces.rows, &surfaces.varying, &surfaces.relief, &surfaces.media].map(|rows| bits(rows))
    };
    assert!(tables(edited) == tables(new), "{what}: tables of surfaces");
    let said = |scene: &Scene| (scene.title.clone(), scene.source.clone(), scene.legend(), scene.warnings().to_vec());
    assert_eq!(said(edited), said(new), "{what}");
    let numbers = |scene: &Scene| (scene.owners.clone(), scene.size.to_bits(), scene.deepest_media, scene.textures.len());
    assert_eq!(numbers(edited), numbers(new), "{what}");
    assert_eq!((edited.camera, edited.settings, edited.spp), (new.camera, new.settings, new.spp), "{what}");
    assert!(picture(edited, threads) == picture(new, threads), "{what}: images");
}

/// Changes a scene at random, and says what.
fn change(scene: &mut SceneDescription, random: &mut SmallRng) -> String {
    match random.random_range(0..8) {
        0..=2 if !scene.materials.is_empty() => {
            let place = random.random_range(0..scene.materials.len());
            let (name, material) = scene.materials.iter_mut().nth(place).expect("it is there");
            let dice: &mut dyn Parameters = &mut Dice::new(random);
            dice.one_of(&mut material.kind);
            format!("material {name}: {:?}", material.kind)
        }
        3 if !scene.textures.is_empty() => {
            let place = random.random_range(0..scene.textures.len());
            let (name, texture) = scene.textures.iter_mut().nth(place).expect("it is there");
            texture.chosen(&mut Dice::new(random));
            format!("texture {name}: {texture:?}")
        }
        4 => {
            let environment = scene.environment.get_or_insert_default();
            environment.chosen(&mut Dice::new(random));
            format!("environment: {environment:?}")
        }
        5 => {
            scene.camera.look_at += DVec3::new(0.01, 0.02 * random.random::<f64>(), 0.0);
            format!("the camera looks at {}", scene.camera.look_at)
        }
        _ if scene.objects.is_empty() => "nothing".to_owned(),
        _ => {
            let place = random.random_range(0..scene.objects.len());
            format!("object {place}: {}", change_object(scene, place, random))
        }
    }
}

fn change_object(scene: &mut SceneDescription, place: usize, random: &mut SmallRng) -> &'static str {
    let object = &mut scene.objects[place];
    match random.random_range(0..6) {
        0 | 1 => {
            object.transform.push(Transform::Translate(DVec3::new(0.1 * random.random::<f64>(), 0.0, 0.05)));
            "a translation"
        }
        2 => {
            object.shape.chosen(&mut Dice::new(random));
            "another shape of the kind"
        }
        3 => {
            let radiance = [0; 3].map(|_| random.random());
            object.emission = if object.emission.is_some() { None } else { Some(EmissionDescription::radiance(radiance)) };
            "emission comes or goes"
        }
        4 => {
            let copy = object.clone();
            scene.objects.insert(0, copy);
            "a copy of it"
        }
        _ => {
            scene.objects.remove(place);
            "it is deleted"
        }
    }
}

pub fn shipped(name: &str) -> (PathBuf, SceneDescription) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let text = fs::read_to_string(folder.join(format!("{name}.toml"))).expect("the scene can be read");
    // Large meshes take long and show nothing else.
    let text = text.replace("triangles = 1300000", "triangles = 4000").replace("triangles = 20000", "triangles = 600");
    (folder, describe(name, text).expect("a shipped scene is valid"))
}

fn names() -> Vec<String> {
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")).expect("the folder can be read");
    let paths = files.map(|file| file.expect("an entry").path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let mut names: Vec<_> = scenes.map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_scene_that_is_changed_at_random_equals_one_that_is_compiled_from_scratch() {
    const CHANGES: usize = 8;
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let (mut random, mut compiled) = (SmallRng::seed_from_u64(20), 0);
    for name in names() {
        let (folder, mut description) = shipped(&name);
        let mut scene = description.build(&folder).expect("a shipped scene compiles");
        for _ in 0..CHANGES {
            let mut changed = description.clone();
            let what = format!("{name}, {}", change(&mut changed, &mut random));
            // Half of the ways there lead over scenes whose meshes have moved.
            if random.random()
                && let Ok(moved) = Arc::new(changed.clone()).rebuild(&folder, &scene, Precision::Interactive)
            {
                scene = moved;
            }
            let new = changed.build(&folder);
            let edited = Arc::new(changed.clone()).rebuild(&folder, &scene, Precision::Exact);
            match (edited, new) {
                (Ok(edited), Ok(new)) => {
                    assert_same(&edited, &new, &threads, &what);
                    (scene, description) = (edited, changed);
                    compiled += 1;
                }
                (Err(edited), Err(new)) => assert_eq!(edited.report(), new.report(), "{what}"),
                (edited, new) => panic!("{what}: {:?}, {:?}", edited.map(|_| ()).err(), new.map(|_| ()).err()),
            }
        }
    }
    assert!(compiled > 100, "{compiled} changes are valid");
}
