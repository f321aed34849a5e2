//! The state of a translation: what it has made so far.
use std::{
    collections::{BTreeSet, HashMap},
    path::PathBuf,
};

use super::{load::FileSearch, packed::Packed, tree::Element};
use crate::import::{Names, NewFiles, Remarks, absorbing::Absorbers};
use noisefall_scene::scene::{SceneError, description::SceneDescription};

/// Objects within objects, references followed.
const DEEPEST: usize = 64;

/// Quantity that a texture is looked up for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureValue {
    /// A radiance.
    Light,
    /// Another colour: reflectance or transmittance.
    Colour,
    /// A number, such as roughness or opacity.
    Number,
}

/// A translation.
pub struct Import {
    pub files: FileSearch,
    pub description: SceneDescription,
    /// Meshes and images that exist in memory only.
    pub new_files: NewFiles,
    pub remarks: Remarks,
    pub textures: Names,
    pub materials: Names,
    /// Properties that the object in translation needs of its shape.
    pub uses: Uses,
    /// Textures by their element and what is looked up.
    pub known_textures: HashMap<(usize, TextureValue), (String, Uses)>,
    /// Textures within 0 and 1 by the texture that may not be.
    pub known_limited: HashMap<String, String>,
    /// Materials by their element and whether both sides reflect.
    pub known_surfaces: HashMap<(usize, bool), Surface>,
    /// Image files by the path that the description gives them.
    pub images: HashMap<String, PathBuf>,
    /// Models in memory by file and variant.
    pub known_models: HashMap<String, String>,
    /// Colours of spectrum files by what they stand for and by path.
    pub known_spectra: HashMap<String, [f64; 3]>,
    /// Lists in the files of meshes.
    pub known_lists: HashMap<PathBuf, Lists>,
    /// Files of serialized meshes.
    pub packed: HashMap<PathBuf, Packed>,
    pub media: Media,
    /// Shapes that were followed, those of groups once for each instance.
    pub shapes: usize,
    /// The objects that are being translated, the innermost last.
    within: Vec<usize>,
}

/// Properties of a shape that textures need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uses {
    /// Surface coordinates, or tangents that follow them.
    pub coordinates: bool,
    /// Attributes of meshes.
    pub attributes: BTreeSet<String>,
}

/// Lists in the file of a mesh besides its triangles.
#[derive(Clone, Copy)]
pub struct Lists {
    pub normals: bool,
    pub uvs: bool,
}

/// Media so far.
#[derive(Default)]
pub struct Media {
    /// Whether the integrator does not render them.
    pub are_unseen: bool,
    pub absorbers: Absorbers,
}

/// A material in the description.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Its name.
    pub material: String,
    pub uses: Uses,
}

impl Uses {
    /// Adds what something else uses.
    pub fn add(&mut self, other: &Uses) {
        self.coordinates |= other.coordinates;
        self.attributes.extend(other.attributes.iter().cloned());
    }
}

impl Import {
    /// A translation that has made nothing yet.
    pub fn new(files: FileSearch) -> Import {
        Import {
            files,
            description: SceneDescription::default(),
            new_files: NewFiles::default(),
            remarks: Remarks::default(),
            textures: Names::default(),
            materials: Names::default(),
            uses: Uses::default(),
            known_textures: HashMap::new(),
            known_limited: HashMap::new(),
            known_surfaces: HashMap::new(),
            images: HashMap::new(),
            known_models: HashMap::new(),
            known_spectra: HashMap::new(),
            known_lists: HashMap::new(),
            packed: HashMap::new(),
            media: Media::default(),
            shapes: 0,
            within: Vec::new(),
        }
    }

    /// Adds a remark about an element: what was used instead, and what that changes in the image.
    pub fn remark(&mut self, element: Element, used: &str, effect: &str) {
        self.remarks.add(element.place(), element.shown(), used, effect);
    }

    /// Adds a remark about a value of an element, if it has that value.
    pub fn remark_value(&mut self, element: Element, name: &str, used: &str, effect: &str) -> Result<(), SceneError> {
        if let Some(value) = element.property(name)? {
            self.remark(value, used, effect);
        }
        Ok(())
    }

    /// Translates an object that can contain others. An object within itself is an error.
    pub fn nested<T>(
        &mut self,
        element: Element,
        translate: impl FnOnce(&mut Import) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        if self.within.contains(&element.index) {
            return Err(element.error(format!("{} contains itself", element.shown()), "break the circle of references"));
        }
        if self.within.len() >= DEEPEST {
            return Err(element.error(format!("objects are nested more than {DEEPEST} deep"), "simplify the scene"));
        }
        self.within.push(element.index);
        let result = translate(self);
        self.within.pop();
        result
    }

    /// Translates something, and returns what it uses of shapes besides.
    pub fn used<T>(&mut self, translate: impl FnOnce(&mut Import) -> Result<T, SceneError>) -> Result<(T, Uses), SceneError> {
        let around = std::mem::take(&mut self.uses);
        let result = translate(self);
        let uses = std::mem::replace(&mut self.uses, around);
        self.uses.add(&uses);
        Ok((result?, uses))
    }

    /// Translates a part that the rest can be translated without, if only to find all missing files: [`Missing::part`].
    ///
    /// [`Missing::part`]: crate::import::Missing::part
    pub fn part<T>(&mut self, translate: impl FnOnce(&mut Import) -> Result<T, SceneError>) -> Result<Option<T>, SceneError> {
        let missing = self.files.folder.missing.clone();
        missing.part(|| translate(self))
    }

    /// The path of a file that a value of an element names.
    pub fn file(&mut self, element: Element, name: &str) -> Result<PathBuf, SceneError> {
        const HELP: &str = "paths are relative to the scene file, or to the folder of a `<path>`";
        let found = self.files.resolve(element.required_text(name)?);
        let place = element.property(name)?.unwrap_or(element);
        self.files.folder.missing.require(found, |message| place.error(message, HELP))
    }
}
