//! The scene whose parts vary: a floor, a subject and an emitter above it.
use std::{
    path::Path,
    sync::{Arc, Mutex, PoisonError},
};

use glam::DVec3;

use super::{
    array::Row,
    assign::{Assign, IMAGE, INNER, MESH},
    factors::{SceneFactor, factors},
    place::SUBJECT,
};
use crate::validate::stress::dice::Dice;
use noisefall_base::declare::{Assets, Declare, OneOf, Precision};
use noisefall_scene::{
    material::{Lambertian, Material},
    model::Model,
    scene::{
        Scene, SceneError,
        description::{EmissionDescription, MaterialDescription, ObjectDescription, SceneDescription},
    },
    shape::{ShapeKind, Transform, kinds::Rectangle},
    texture::{TextureKind, checker::Checker},
};

/// Width and height of images.
pub const SIZE: u32 = 8;
/// The file of the scenes.
pub const FILE: &str = "covering.toml";
/// The key of the environment.
const ENVIRONMENT: &str = "environment";
/// Factor of the emitter's radiance.
const BRIGHT: f64 = 6.0;

/// The description whose parts vary, its factors, and the files that it names.
pub struct Frame {
    description: SceneDescription,
    /// The materials of parts of blends and of emitters.
    materials: Vec<String>,
    pub factors: Vec<SceneFactor>,
    /// A scene that compiled; others reuse its tables.
    known: Mutex<Arc<Scene>>,
}

impl Frame {
    pub fn new() -> Result<Frame, SceneError> {
        let mut description = SceneDescription::default();
        description.camera.eye = DVec3::new(0.3, 1.4, 5.5);
        description.camera.look_at = DVec3::new(0.0, -0.1, 0.0);
        description.camera.resolution = [SIZE; 2];
        description.textures.insert(SUBJECT.to_owned(), TextureKind::default());
        description.textures.insert(INNER.to_owned(), TextureKind::from(Checker::default()));
        let kinds = Material::alternatives().into_iter().filter(|kind| !matches!(kind, Material::Blend(_)));
        for kind in kinds {
            description.materials.insert(format!("plain {}", kind.name()), MaterialDescription { kind, ..Default::default() });
        }
        let materials: Vec<String> = description.materials.keys().cloned().collect();
        let grey = Lambertian { albedo: [0.6, 0.5, 0.4].into() };
        description.materials.insert("floor".to_owned(), MaterialDescription { kind: grey.into(), ..Default::default() });
        description.materials.insert(SUBJECT.to_owned(), MaterialDescription::default());
        let floor = Rectangle { origin: DVec3::new(-4.0, -1.4, 4.0), edge_u: DVec3::X * 8.0, edge_v: DVec3::Z * -8.0 };
        let of = |shape: ShapeKind, material: Option<&str>, emission: Option<EmissionDescription>| ObjectDescription {
            shape,
            material: material.map(str::to_owned),
            emission,
            ..ObjectDescription::default()
        };
        let emission = EmissionDescription { scale: BRIGHT, ..EmissionDescription::default() };
        description.objects = vec![
            of(floor.into(), Some("floor"), None),
            of(ShapeKind::default(), Some(SUBJECT), None),
            of(ShapeKind::default(), None, Some(emission)),
        ];
        let factors = factors(&description, &materials);
        let mut row = vec![None; factors.len()];
        close(&factors, &mut row);
        let plain = Arc::new(describe(&description, &factors, &materials, &row)).build_with(Path::new(FILE), assets())?;
        Ok(Frame { description, materials, factors, known: Mutex::new(Arc::new(plain)) })
    }

    /// The row with these levels of the `chosen` factors. The others are as in the plain scene.
    pub fn completed(&self, chosen: &[usize], levels: &Row) -> Row {
        let mut row: Row = vec![None; self.factors.len()];
        chosen.iter().zip(levels).for_each(|(factor, level)| row[*factor] = *level);
        close(&self.factors, &mut row);
        row
    }

    /// The row of a number with some of its numbers changed by chance, if these can be combined. Neighbours have the same numbers in the
    /// background.
    pub fn with_numbers(&self, row: &Row, number: usize, neighbours: usize) -> Row {
        let mut dice = [Dice::new("numbers", number as u32), Dice::new(ENVIRONMENT, neighbours as u32)];
        let changed = |(factor, level): (&SceneFactor, &Option<usize>)| {
            let other = dice[usize::from(is_of_environment(factor))].below(factor.levels.len());
            level.map(|level| if factor.is_number { other } else { level })
        };
        let changed: Row = self.factors.iter().zip(row).map(changed).collect();
        if self.refuses(&changed) { row.clone() } else { changed }
    }

    /// The scene of a row.
    pub fn describe(&self, row: &Row) -> SceneDescription {
        describe(&self.description, &self.factors, &self.materials, row)
    }

    /// A scene that compiled without an environment, and the tables of many.
    pub fn known(&self) -> Arc<Scene> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The levels that make the environment, which takes longer to compile than the rest.
    pub fn levels_of_environment(&self, row: &Row) -> Row {
        self.factors.iter().zip(row).map(|(factor, level)| level.filter(|_| is_of_environment(factor))).collect()
    }

    /// Whether the scene of a row is refused. The environment can be combined with everything.
    fn refuses(&self, row: &Row) -> bool {
        let description = SceneDescription { environment: None, ..self.describe(row) };
        let built = Arc::new(description).rebuild(Path::new(""), &self.known(), Precision::Exact);
        let is_refused = built.is_err();
        if let Ok(scene) = built {
            *self.known.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(scene);
        }
        is_refused
    }

    /// Which levels of a row cannot be combined, if its scene is refused: as few as possible that differ from the plain scene.
    pub fn refused(&self, row: &Row) -> Option<Vec<(usize, usize)>> {
        if !self.refuses(row) {
            return None;
        }
        let mut least = row.clone();
        let mut revert = |places: &[usize]| {
            let mut fewer = least.clone();
            places.iter().for_each(|place| fewer[*place] = None);
            close(&self.factors, &mut fewer);
            if fewer != least && self.refuses(&fewer) {
                least = fewer;
            }
        };
        // Whole parts of the scene first.
        let part = |place: &usize| self.factors[*place].path.split(['.', ':', '?']).next().unwrap_or_default();
        let all: Vec<usize> = (0..row.len()).rev().collect();
        all.chunk_by(|a, b| part(a) == part(b)).for_each(&mut revert);
        all.chunks(1).for_each(&mut revert);
        let levels = least.iter().enumerate().filter_map(|(place, level)| Some((place, (*level)?)));
        let changed: Vec<(usize, usize)> = levels.filter(|(place, level)| *level != self.factors[*place].base).collect();
        // A kind goes without saying where one of its parameters is named.
        let is_implied =
            |level: &(usize, usize)| changed.iter().any(|(place, _)| self.factors[*place].factor.parent == Some(*level));
        Some(changed.iter().filter(|level| !is_implied(level)).copied().collect())
    }

    /// Levels in words.
    pub fn words(&self, levels: &[(usize, usize)]) -> String {
        let word = |(factor, level): &(usize, usize)| {
            let SceneFactor { path, levels, .. } = &self.factors[*factor];
            format!("{path} {}", levels[*level])
        };
        levels.iter().map(word).collect::<Vec<_>>().join(", ")
    }
}

fn is_of_environment(factor: &SceneFactor) -> bool {
    factor.path.starts_with(ENVIRONMENT)
}

/// The description with the levels of a row.
fn describe(plain: &SceneDescription, factors: &[SceneFactor], materials: &[String], row: &Row) -> SceneDescription {
    let mut scene = plain.clone();
    scene.parameters(&mut Assign::new(factors, row, materials));
    let camera = &mut scene.camera;
    camera.fov = camera.projection.has_angle().then_some(40.0);
    // The shapes of all kinds stand at the origin; the emitter moves away from there.
    let there = [Transform::Scale(DVec3::splat(0.6)), Transform::Translate(DVec3::new(1.3, 2.1, 0.8))];
    scene.objects[2].transform.extend(there);
    scene
}

/// Removes the levels of factors that do not exist, and gives those without a level their base.
fn close(factors: &[SceneFactor], row: &mut Row) {
    for (place, factor) in factors.iter().enumerate() {
        let exists = factor.factor.parent.is_none_or(|(parent, level)| row[parent] == Some(level));
        row[place] = exists.then(|| row[place].unwrap_or(factor.base));
    }
}

/// The files that scenes name: a mesh with everything that a mesh may have, and an image.
fn assets() -> Assets {
    let vertices = vec![[-1.0, -1.0, 0.5], [1.0, -1.0, 0.5], [0.0, 1.0, 0.0], [0.0, -1.0, -1.0]];
    let directions: Vec<DVec3> = vertices.iter().map(|v: &[f32; 3]| DVec3::from(v.map(f64::from)).normalize()).collect();
    let mesh = Model {
        normals: Some(directions.iter().map(|n| n.as_vec3().to_array()).collect()),
        uvs: Some(vec![[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.2, 0.3]]),
        colours: Some(vec![[0.9, 0.2, 0.3, 1.0], [0.2, 0.8, 0.4, 0.5], [0.3, 0.3, 0.9, 0.8], [0.7, 0.7, 0.7, 1.0]]),
        tangents: Some(directions.iter().map(|n| n.any_orthonormal_vector().extend(1.0).as_vec4().to_array()).collect()),
        vertices,
        triangles: vec![[0, 1, 2], [1, 3, 2], [3, 0, 2], [0, 3, 1]],
        ..Model::default()
    };
    let pixel = |x: u32, y: u32| image::Rgb([100 + 50 * x as u8, 120 + 40 * y as u8, 200]);
    let mut png = std::io::Cursor::new(Vec::new());
    let written = image::RgbImage::from_fn(3, 2, pixel).write_to(&mut png, image::ImageFormat::Png);
    let mut assets = Assets::default();
    assets.insert(MESH, mesh);
    assets.insert(IMAGE, written.map_or_else(|_| Vec::new(), |()| png.into_inner()));
    assets
}
