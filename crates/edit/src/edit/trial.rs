//! Random scenes, written and read: for tests and for the validation.
use rand::{Rng, RngCore};

use super::{content::Content, origin::Origins, references::references, tree::Tree};
use noisefall_base::declare::{Declare, Dice, Family, Path, write};
use noisefall_scene::scene::{describe, description::SceneDescription};

/// Texts that are hard to quote.
const TEXTS: [&str; 8] =
    ["", "ball", "a \"ball\"", "it's", "'both' \"quotes\"", "C:\\new\\table", "two\nlines\r\nand\ttab", "größe = ''' # \u{7f}"];
/// Names of materials and textures that are hard to write as keys.
const NAMES: [&str; 5] = ["a.b", "\"quoted\"", "weiß", "3", "two words"];

/// A scene drawn from the declarations, every value within its range, every name defined.
pub fn drawn_scene(random: &mut dyn RngCore) -> SceneDescription {
    let mut scene = SceneDescription::default();
    scene.parameters(&mut Dice::new(random));
    scene.title = pick(random, &TEXTS).to_owned();
    scene.notes = pick(random, &TEXTS).to_owned();
    for object in &mut scene.objects {
        object.name = pick(random, &TEXTS).to_owned();
    }
    rename_one(random, &mut scene.materials);
    rename_one(random, &mut scene.textures);
    define_names(random, &mut scene);
    scene
}

fn pick<T: Copy>(random: &mut dyn RngCore, of: &[T]) -> T {
    of[random.random_range(0..of.len())]
}

fn rename_one<T>(random: &mut dyn RngCore, map: &mut std::collections::BTreeMap<String, T>) {
    if let Some((_, table)) = map.pop_first() {
        map.insert(pick(random, &NAMES).to_owned(), table);
    }
}

/// Replaces every reference by a name that the scene defines.
pub fn define_names(random: &mut dyn RngCore, scene: &mut SceneDescription) {
    let mut used = [false; 2];
    let everything = Path::default();
    references(scene, &everything, |_, family, _| used[usize::from(family == Family::Material)] = true);
    if used[0] && scene.textures.is_empty() {
        scene.textures.insert("only".to_owned(), Default::default());
    }
    if used[1] && scene.materials.is_empty() {
        scene.materials.insert("only".to_owned(), Default::default());
    }
    let textures: Vec<String> = scene.textures.keys().cloned().collect();
    let materials: Vec<String> = scene.materials.keys().cloned().collect();
    references(scene, &everything, |_, family, name| {
        let known = if family == Family::Texture { &textures } else { &materials };
        name.clone_from(&known[random.random_range(0..known.len())]);
    });
}

/// Writes a random scene into the file of another one and reads it again: first without changes, then with all of them. An error
/// describes the difference and quotes the text.
pub fn write_and_read(random: &mut dyn RngCore) -> Result<(), String> {
    let [file, scene] = [drawn_scene(random), drawn_scene(random)];
    let text = file_text(random, &file);
    let mut content = Content::new(text.clone(), read(&text)?);
    same(&content.description, &file, &text)?;
    if content.text() != text {
        return Err(format!("writing a file without changes altered it:\n{text}"));
    }
    content.origins = random_origins(random, &file, &scene);
    content.description = scene;
    let written = content.text();
    let again = read(&written).map_err(|error| format!("{error}\nwritten into\n{text}"))?;
    same(&again, &content.description, &written).map_err(|error| format!("{error}\nwritten into\n{text}"))
}

/// The text of a scene: with a table for everything, or in the style of a person.
fn file_text(random: &mut dyn RngCore, scene: &SceneDescription) -> String {
    let whole = write(&mut scene.clone()).to_string();
    if random.random() {
        return whole;
    }
    let empty = SceneDescription::default();
    let bare = "format = 1\ncamera = { eye = [0.0, 0.0, 4.0], look_at = [0, 0, 0], fov = 40, resolution = [640, 480] }\n";
    let origins = Origins::of(&empty);
    Content { description: scene.clone(), origins, ..Content::new(bare.to_owned(), empty) }.text()
}

/// Matches some objects, materials and textures with random ones of the file.
fn random_origins(random: &mut dyn RngCore, file: &SceneDescription, scene: &SceneDescription) -> Origins {
    let mut origins = Origins::of(file);
    let mut left: Vec<usize> = (0..file.objects.len()).collect();
    let mut any = |_| random.random::<bool>().then(|| left.pop()).flatten();
    origins.objects = (0..scene.objects.len()).map(&mut any).collect();
    let mut shift = origins.objects.clone();
    if !shift.is_empty() {
        let by = random.random_range(0..shift.len());
        shift.rotate_left(by);
    }
    origins.objects = shift;
    let names = |random: &mut dyn RngCore, file: Vec<&String>, scene: Vec<&String>| {
        let pairs = scene.into_iter().zip(file).filter(|_| random.random());
        pairs.map(|(name, origin)| (name.clone(), origin.clone())).collect()
    };
    let materials = names(random, file.materials.keys().collect(), scene.materials.keys().collect());
    let textures = names(random, file.textures.keys().rev().collect(), scene.textures.keys().collect());
    origins.named = [("materials".to_owned(), materials), ("textures".to_owned(), textures)].into();
    origins
}

fn read(text: &str) -> Result<SceneDescription, String> {
    describe("drawn", text.to_owned()).map_err(|error| format!("{}\n{text}", error.report()))
}

fn same(found: &SceneDescription, expected: &SceneDescription, text: &str) -> Result<(), String> {
    let is_same = Tree::of(&mut found.clone()).is_identical(&Tree::of(&mut expected.clone())) && found == expected;
    if is_same { Ok(()) } else { Err(format!("it reads as {found:?}\nin place of {expected:?}\n{text}")) }
}
