//! The parts of a scene that can be selected and edited.
use noisefall::{
    declare::{Declare, Path},
    scene::description::SceneDescription,
};

/// A part of a scene description.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// An object, lamps included, by its place in the description.
    Object(usize),
    Material(String),
    Texture(String),
    Camera,
    Background,
}

impl Subject {
    /// Where the part stands in the description.
    pub fn path(&self) -> Path {
        let top = Path::default();
        match self {
            Subject::Object(place) => top.key("objects").item(*place),
            Subject::Material(name) => top.key("materials").key(name),
            Subject::Texture(name) => top.key("textures").key(name),
            Subject::Camera => top.key("camera"),
            Subject::Background => top.key("background"),
        }
    }

    /// The part itself; `None` if the description does not have it.
    pub fn of<'d>(&self, description: &'d mut SceneDescription) -> Option<&'d mut dyn Declare> {
        match self {
            Subject::Object(place) => description.objects.get_mut(*place).map(|object| object as &mut dyn Declare),
            Subject::Material(name) => description.materials.get_mut(name).map(|material| material as &mut dyn Declare),
            Subject::Texture(name) => description.textures.get_mut(name).map(|texture| texture as &mut dyn Declare),
            Subject::Camera => Some(&mut description.camera),
            Subject::Background => description.background.as_mut().map(|background| background as &mut dyn Declare),
        }
    }
}
