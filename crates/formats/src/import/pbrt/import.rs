//! The state of a translation: what it has made so far.
use std::{collections::HashMap, path::PathBuf, rc::Rc};

use glam::DAffine3;

use super::{
    parameters::Entity,
    records::{Covering, Surface, TextureKey},
    source::{SourceFiles, TextSpan},
};
use crate::import::{Folder, Imported, Names, NewFiles, Remarks, absorbing::Absorbers};
use noisefall_base::declare::Textured;
use noisefall_scene::scene::{SceneError, description::SceneDescription};

/// A translation.
pub struct Import {
    pub files: SourceFiles,
    pub description: SceneDescription,
    /// Meshes and images that exist in memory only.
    pub new_files: NewFiles,
    pub remarks: Remarks,
    pub texture_names: Names,
    pub material_names: Names,
    /// Textures by type and name, as they stand in the file.
    pub textures: HashMap<TextureKey, Rc<Entity>>,
    /// Textures that are translated.
    pub known_textures: HashMap<String, Textured>,
    /// The textures and materials that are being translated, the innermost last.
    pub within: Vec<String>,
    /// Materials as they stand in the file.
    pub materials: Vec<Rc<Entity>>,
    pub named_materials: HashMap<String, usize>,
    /// Names of translated materials by number and opacity.
    pub known_materials: HashMap<(usize, String), String>,
    pub media: HashMap<String, Rc<Entity>>,
    pub absorbers: Absorbers,
    /// Paths and whether there are normals, of meshes that were packed.
    pub packed_meshes: HashMap<String, (String, bool)>,
    /// Colours of spectrum files by what they stand for and by path.
    pub known_spectra: HashMap<String, [f64; 3]>,
    /// Meshes of parts of quadrics.
    pub patches: usize,
    /// Surfaces of instances, whether they become objects or not.
    pub instances: u64,
    /// The shapes of each definition of an object.
    pub definitions: HashMap<String, Rc<Vec<Surface>>>,
    /// Material and opacity of each object of the description.
    pub coverings: Vec<Covering>,
    /// From the world of the file to that of the description: the identity, or a reflection.
    pub mirror: DAffine3,
    /// The film multiplies radiance by this factor.
    pub gain: f64,
    /// The times of both transforms, seconds.
    pub times: [f64; 2],
    /// Whether something moves.
    pub moves: bool,
    /// Whether a remark has said that the scene is one of pbrt-v3.
    is_old: bool,
}

impl Import {
    /// A translation that has made nothing yet.
    pub fn new(folder: Folder) -> Import {
        Import {
            files: SourceFiles::new(folder),
            description: SceneDescription::default(),
            new_files: NewFiles::default(),
            remarks: Remarks::default(),
            texture_names: Names::default(),
            material_names: Names::default(),
            textures: HashMap::new(),
            known_textures: HashMap::new(),
            within: Vec::new(),
            materials: Vec::new(),
            named_materials: HashMap::new(),
            known_materials: HashMap::new(),
            media: HashMap::new(),
            absorbers: Absorbers::default(),
            packed_meshes: HashMap::new(),
            known_spectra: HashMap::new(),
            patches: 0,
            instances: 0,
            definitions: HashMap::new(),
            coverings: Vec::new(),
            mirror: DAffine3::IDENTITY,
            gain: 1.0,
            times: [0.0, 1.0],
            moves: false,
            is_old: false,
        }
    }

    /// The result.
    pub fn finish(self) -> Imported {
        Imported { description: self.description, assets: self.new_files.assets, remarks: self.remarks }
    }

    /// Adds a remark about a directive: what was used instead, and what that changes in the image.
    pub fn remark(&mut self, entity: &Entity, used: &str, effect: &str) {
        self.remarks.add(entity.place.to_string(), entity.shown(), used, effect);
    }

    /// Adds a remark about a parameter, if it is given.
    pub fn remark_parameter(&mut self, entity: &Entity, name: &str, used: &str, effect: &str) {
        if entity.has(name) {
            entity.ignore(&[name]);
            self.remarks.add(entity.place.to_string(), format!("`{name}` of {}", entity.shown()), used, effect);
        }
    }

    /// Adds a remark about the first thing that only pbrt-v3 has.
    pub fn remark_old(&mut self, place: &TextSpan, found: &str) {
        if !std::mem::replace(&mut self.is_old, true) {
            let effect = "what both versions have is read as in pbrt-v4";
            self.remarks.add(place.to_string(), format!("{found} of pbrt-v3"), "its meaning there", effect);
        }
    }

    /// Adds a remark about each parameter that nothing has used.
    pub fn remark_unused(&mut self, entity: &Entity) {
        for parameter in entity.unused() {
            let found = format!("`{}` of {}", parameter.name, entity.shown());
            self.remarks.add(parameter.place.to_string(), found, "nothing", "the parameter is not known here");
        }
    }

    /// Translates something that can contain others. A thing within itself is an error.
    pub fn nested<T>(
        &mut self,
        key: &str,
        place: &TextSpan,
        translate: impl FnOnce(&mut Import) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        /// Textures within textures, and materials within materials.
        const DEEPEST: usize = 16;
        if self.within.iter().any(|outer| outer == key) {
            return Err(place.error(format!("{key} contains itself"), "break the circle of names"));
        }
        if self.within.len() >= DEEPEST {
            return Err(place.error(format!("textures or materials are nested more than {DEEPEST} deep"), "simplify the scene"));
        }
        self.within.push(key.to_owned());
        let result = translate(self);
        self.within.pop();
        result
    }

    /// Translates a part that the rest can be translated without, if only to find all missing files: [`Missing::part`].
    ///
    /// [`Missing::part`]: crate::import::Missing::part
    pub fn part<T>(&mut self, translate: impl FnOnce(&mut Import) -> Result<T, SceneError>) -> Result<Option<T>, SceneError> {
        let missing = self.files.folder.missing.clone();
        missing.part(|| translate(self))
    }

    /// The file that a text parameter names.
    pub fn file(&self, entity: &Entity, name: &str) -> Result<Option<PathBuf>, SceneError> {
        let Some(named) = entity.text(name).filter(|named| !named.is_empty()) else { return Ok(None) };
        let folder = &self.files.folder;
        let error = |message| entity.error(message, "paths are relative to the folder of the scene");
        folder.missing.require(folder.resolve(named), error).map(Some)
    }

    /// Returns the file of a parameter that must be given.
    pub fn required_file(&self, entity: &Entity, name: &str) -> Result<PathBuf, SceneError> {
        let missing = || entity.error(format!("{} names no file", entity.shown()), format!("`string {name}` is missing"));
        self.file(entity, name)?.ok_or_else(missing)
    }
}
