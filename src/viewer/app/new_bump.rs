//! A new bump map whose bumps have a size that suits the objects with the material.
use noisefall_base::declare::{Path, Step};
use noisefall_edit::edit::{Document, Edit, Tree};
use noisefall_scene::{
    scene::{Scene, description::Bump},
    texture::{TextureKind, noise::Noise},
};

/// Bumps across the smallest object with the material.
const ACROSS: f64 = 8.0;
/// Height of a bump, relative to its width.
const STEEPNESS: f64 = 0.25;
/// Part of the extent of the scene that stands for the objects of a material that nothing uses.
const OF_SCENE: f64 = 0.25;

/// The edit that gives a material a bump map with a texture of its own; `None` if this is not the path of one.
pub fn new_bump(document: &Document, scene: &Scene, path: &Path) -> Option<Edit> {
    let [Step::Key(map), Step::Key(material), Step::Key(key)] = &path.0[..] else { return None };
    if map != "materials" || key != "bump" {
        return None;
    }
    let width = two_digits(extent(document, scene, material) / ACROSS);
    let texture = document.free_name("textures", "bumps");
    let noise = Noise { scale: two_digits(1.0 / width), octaves: 2, low: [0.0; 3], high: [1.0; 3] };
    let mut bump = Bump { texture: texture.clone(), height: two_digits(STEEPNESS * width) };
    Some(Edit::All(vec![
        Edit::insert_tree(Path::of("textures").key(&texture), Tree::of(&mut TextureKind::from(noise))),
        Edit::insert_tree(path.clone(), Tree::of(&mut bump)),
    ]))
}

/// The extent of the smallest object with a material, metres, and at most that of the scene.
fn extent(document: &Document, scene: &Scene, material: &str) -> f64 {
    let objects = document.description().objects.iter().enumerate();
    let users = objects.filter(|(_, object)| object.material.as_deref() == Some(material)).map(|(place, _)| place);
    let pieces = users.flat_map(|place| &scene.objects[scene.objects_of(place)]);
    let smallest = pieces.map(|object| 2.0 * object.shape.bounding_sphere().1).reduce(f64::min);
    smallest.unwrap_or(OF_SCENE * scene.size).clamp(1e-3 * scene.size, scene.size)
}

/// A number that is short to read.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}
