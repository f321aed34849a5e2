//! Runs the directives of a scene one after the other.
use std::{collections::HashMap, path::PathBuf, rc::Rc};

use glam::DAffine3;

use super::{
    camera,
    colour_spaces::ColourSpace,
    import::Import,
    options::Options,
    parameter_lists::parameters,
    records::{MaterialRef, Surface},
    settings,
    source::TextSpan,
    state::{AttributeTarget, Stack, State},
    tokens::{Token, Tokens},
};
use noisefall_scene::scene::SceneError;

/// The interpreter of a scene.
pub struct Interpreter {
    pub import: Import,
    pub state: State,
    stack: Stack,
    /// The files that are being read, the innermost last.
    pub open: Vec<OpenFile>,
    pub systems: HashMap<String, [DAffine3; 2]>,
    /// Whether `WorldBegin` has come.
    in_world: bool,
    /// The object that is being defined.
    pub definition: Option<(String, Vec<Surface>)>,
    options: Options,
}

/// A file that is being read.
pub struct OpenFile {
    pub tokens: Tokens,
    pub path: PathBuf,
    /// The state to return to, for `Import`.
    pub after: Option<Box<State>>,
}

impl Interpreter {
    /// An interpreter that has read nothing yet.
    pub fn new(import: Import) -> Interpreter {
        Interpreter {
            import,
            state: State::default(),
            stack: Stack::default(),
            open: Vec::new(),
            systems: HashMap::new(),
            in_world: false,
            definition: None,
            options: Options::default(),
        }
    }

    /// Runs a file and all that it includes.
    pub fn run(mut self, tokens: Tokens, path: PathBuf) -> Result<Import, SceneError> {
        let end = tokens.end();
        self.open.push(OpenFile { tokens, path, after: None });
        while let Some(file) = self.open.last_mut() {
            match file.tokens.next()? {
                Some((Token::Word, place)) => {
                    let word = file.tokens.text(&place).to_owned();
                    let missing = self.import.files.folder.missing.clone();
                    missing.part(|| self.directive(&word, &place))?;
                }
                Some((_, place)) => return Err(place.error("a value stands where a directive is expected", "such as Shape")),
                None => {
                    if let Some(after) = self.open.pop().and_then(|file| file.after) {
                        self.state = *after;
                    }
                }
            }
        }
        self.stack.check_empty()?;
        if !self.in_world {
            self.begin_world(&end)?;
        }
        Ok(self.import)
    }

    fn directive(&mut self, word: &str, place: &TextSpan) -> Result<(), SceneError> {
        match word {
            "AttributeBegin" => self.stack.save(&self.state, place.clone())?,
            "TransformBegin" => self.stack.save_transform(&self.state, place.clone())?,
            "AttributeEnd" | "TransformEnd" => self.stack.restore(&mut self.state, word, place)?,
            "Attribute" => self.attribute(place)?,
            "WorldBegin" => self.begin_world(place)?,
            // The end of a scene of pbrt-v3.
            "WorldEnd" => self.import.remark_old(place, "`WorldEnd`"),
            "ReverseOrientation" => self.state.reverse = !self.state.reverse,
            "ColorSpace" => {
                let name = self.quoted(place)?;
                let unknown = || place.error(format!("`{name}` is not a colour space"), "srgb, dci-p3, rec2020 or aces2065-1");
                self.state.space = ColourSpace::named(&name).ok_or_else(unknown)?;
            }
            "Include" | "Import" => self.include(word == "Import", place)?,
            "ObjectBegin" => {
                let name = self.quoted(place)?;
                if self.definition.is_some() {
                    return Err(place.error("an object is defined within another", "end the outer one first"));
                }
                self.stack.save_object(&self.state, place.clone())?;
                self.definition = Some((name, Vec::new()));
            }
            "ObjectEnd" => {
                self.stack.restore(&mut self.state, word, place)?;
                if let Some((name, shapes)) = self.definition.take() {
                    self.import.definitions.insert(name, Rc::new(shapes));
                }
            }
            "ObjectInstance" => {
                let name = self.quoted(place)?;
                if self.definition.is_some() {
                    return Err(place.error("an instance stands within a definition", "pbrt does not allow it either"));
                }
                self.import.instance(&name, self.state.maps, place)?;
            }
            _ if self.transform(word, place)? => {}
            _ => self.entity(word, place)?,
        }
        Ok(())
    }

    /// Runs a directive with a kind and parameters.
    fn entity(&mut self, word: &str, place: &TextSpan) -> Result<(), SceneError> {
        match word {
            "Option" => return self.option(place),
            "MediumInterface" => return self.medium_interface(place),
            "NamedMaterial" => {
                let name = self.quoted(place)?;
                self.state.material = MaterialRef::Named(Rc::from(name));
                return Ok(());
            }
            "Texture" => {
                let [name, of_type] = [self.quoted(place)?, self.quoted(place)?];
                let entity = self.read_entity("Texture", Some(AttributeTarget::Texture), place)?;
                return self.import.declare_texture(name, &of_type, entity);
            }
            _ => {}
        }
        let (directive, target) = match word {
            "Camera" => ("Camera", None),
            "Film" => ("Film", None),
            "Sampler" => ("Sampler", None),
            "Integrator" => ("Integrator", None),
            "PixelFilter" => ("PixelFilter", None),
            "Accelerator" => ("Accelerator", None),
            "Shape" => ("Shape", Some(AttributeTarget::Shape)),
            "LightSource" => ("LightSource", Some(AttributeTarget::Light)),
            "AreaLightSource" => ("AreaLightSource", Some(AttributeTarget::Light)),
            "Material" => ("Material", Some(AttributeTarget::Material)),
            "MakeNamedMaterial" => ("MakeNamedMaterial", Some(AttributeTarget::Material)),
            "MakeNamedMedium" => ("MakeNamedMedium", Some(AttributeTarget::Medium)),
            _ => {
                return Err(
                    place.error(format!("`{word}` is not a directive of pbrt-v4 or pbrt-v3"), "such as Shape or Material")
                );
            }
        };
        let entity = Rc::new(self.read_entity(directive, target, place)?);
        match directive {
            "Camera" => {
                // The coordinate system "camera" leads from the camera to the world.
                self.systems.insert("camera".to_owned(), self.state.maps.map(|map| map.inverse()));
                self.import.refuse_medium(&self.state.media[1], place)?;
                self.options.camera = Some((entity, self.state.maps));
            }
            "Film" => self.options.film = Some(entity),
            "Sampler" => self.options.sampler = Some(entity),
            "Integrator" => self.options.integrator = Some(entity),
            "PixelFilter" => self.options.filter = Some(entity),
            "Shape" => self.shape(&entity)?,
            "LightSource" => self.import.light(&entity, self.state.maps[0])?,
            "AreaLightSource" => self.state.area_light = Some(entity),
            "Material" => self.state.material = self.import.declare_material(entity),
            "MakeNamedMaterial" => self.import.declare_named_material(entity),
            "MakeNamedMedium" => self.import.declare_medium(entity)?,
            _ => {}
        }
        Ok(())
    }

    fn begin_world(&mut self, place: &TextSpan) -> Result<(), SceneError> {
        if self.in_world {
            return Err(place.error("`WorldBegin` comes twice", "keep one of them"));
        }
        self.in_world = true;
        let options = std::mem::take(&mut self.options);
        settings::settings(&mut self.import, &options)?;
        camera::camera(&mut self.import, &options)?;
        self.state.maps = [DAffine3::IDENTITY; 2];
        self.state.active = [true; 2];
        self.systems.insert("world".to_owned(), self.state.maps);
        Ok(())
    }

    fn attribute(&mut self, place: &TextSpan) -> Result<(), SceneError> {
        let name = self.quoted(place)?;
        let target = match name.as_str() {
            "shape" => AttributeTarget::Shape,
            "light" => AttributeTarget::Light,
            "material" => AttributeTarget::Material,
            "medium" => AttributeTarget::Medium,
            "texture" => AttributeTarget::Texture,
            _ => return Err(place.error(format!("`{name}` has no attributes"), "shape, light, material, medium or texture")),
        };
        let space = self.state.space;
        let parameters = parameters(self.tokens(), space)?;
        self.state.add_defaults(target, parameters, place)
    }

    /// Options of the program change nothing about the scene.
    fn option(&mut self, place: &TextSpan) -> Result<(), SceneError> {
        self.quoted(place)?;
        let tokens = self.tokens();
        if tokens.peek()? == Some(Token::Open) {
            while tokens.next()?.is_some_and(|(token, _)| token != Token::Close) {}
        } else {
            tokens.next()?;
        }
        Ok(())
    }

    fn medium_interface(&mut self, place: &TextSpan) -> Result<(), SceneError> {
        let inside: Rc<str> = Rc::from(self.quoted(place)?);
        let is_single = self.tokens().peek()? != Some(Token::Quoted);
        let outside = if is_single { inside.clone() } else { Rc::from(self.quoted(place)?) };
        self.state.media = [inside, outside];
        Ok(())
    }
}
