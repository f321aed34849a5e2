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

    /// A copy of the part; `None` if the description does not have it.
    pub fn of(&self, description: &SceneDescription) -> Option<Box<dyn Declare>> {
        fn copy<T: Declare + Clone + 'static>(part: Option<&T>) -> Option<Box<dyn Declare>> {
            part.cloned().map(|part| Box::new(part) as Box<dyn Declare>)
        }
        match self {
            Subject::Object(place) => copy(description.objects.get(*place)),
            Subject::Material(name) => copy(description.materials.get(name)),
            Subject::Texture(name) => copy(description.textures.get(name)),
            Subject::Camera => copy(Some(&description.camera)),
            Subject::Background => copy(description.background.as_ref()),
        }
    }
}

#[cfg(test)]
mod tests {
    use noisefall::{declare::lines_of, material::Lambertian, scene::description::BackgroundDescription, shape::Sphere};

    use super::*;

    #[test]
    fn a_part_is_found_at_its_path() {
        let mut room = SceneDescription::default();
        room.add_material("white", Lambertian::default());
        room.add_object("ball", Sphere::default());
        let lines = |subject: &Subject, room: &SceneDescription| {
            let mut part = subject.of(room)?;
            Some(lines_of(|p| part.parameters(p)))
        };
        let ball = Subject::Object(0);
        assert!(lines(&ball, &room).is_some_and(|lines| lines[0] == "name: ball"));
        assert_eq!([ball.path(), Subject::Material("white".to_owned()).path()], ["objects.0", "materials.white"].map(Path::of));
        assert!(lines(&Subject::Camera, &room).is_some());
        assert_eq!([Subject::Object(1), Subject::Background].map(|subject| lines(&subject, &room)), [None, None]);
        room.background = Some(BackgroundDescription::default());
        assert!(lines(&Subject::Background, &room).is_some());
    }
}
