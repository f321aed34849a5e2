//! The parts of a scene that can be selected and edited.
use noisefall_base::declare::{Declare, OneOf, Path, Step};
use noisefall_scene::{
    light::punctual_light::PunctualLightKind,
    material::Material,
    scene::{
        Projection,
        description::{EnvironmentDescription, Presentation, SceneDescription},
    },
    shape::ShapeKind,
    texture::TextureKind,
};

/// A part of a scene description.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// An object, one that emits light included, by its place in the description.
    Object(usize),
    /// A punctual light, by its place in the description.
    PunctualLight(usize),
    Material(String),
    Texture(String),
    Camera,
    Environment,
    /// Title, notes, settings and truth.
    Presentation,
}

impl Subject {
    /// Path of the part in the description.
    pub fn path(&self) -> Path {
        let top = Path::default();
        match self {
            Subject::Object(place) => top.key("objects").item(*place),
            Subject::PunctualLight(place) => top.key("lights").item(*place),
            Subject::Material(name) => top.key("materials").key(name),
            Subject::Texture(name) => top.key("textures").key(name),
            Subject::Camera => top.key("camera"),
            Subject::Environment => top.key("environment"),
            Subject::Presentation => top,
        }
    }

    /// The name of the part as a person reads it: "gold", "object 6", "camera".
    pub fn name(&self, description: &SceneDescription) -> String {
        match self {
            Subject::Presentation => "title and settings".to_owned(),
            _ => description.part_name(&self.path()),
        }
    }

    /// The part at a path of a description.
    pub fn at(path: &Path) -> Option<Subject> {
        Some(match &path.0[..] {
            [Step::Key(list), Step::Item(place)] if list == "objects" => Subject::Object(*place),
            [Step::Key(list), Step::Item(place)] if list == "lights" => Subject::PunctualLight(*place),
            [Step::Key(map), Step::Key(name)] if map == "materials" => Subject::Material(name.clone()),
            [Step::Key(map), Step::Key(name)] if map == "textures" => Subject::Texture(name.clone()),
            [Step::Key(key)] if key == "camera" => Subject::Camera,
            [Step::Key(key)] if key == "environment" => Subject::Environment,
            [] => Subject::Presentation,
            _ => return None,
        })
    }

    /// The part under another name: materials and textures are known by theirs.
    pub fn renamed(&self, name: &str) -> Subject {
        match self {
            Subject::Material(_) => Subject::Material(name.to_owned()),
            Subject::Texture(_) => Subject::Texture(name.to_owned()),
            other => other.clone(),
        }
    }

    /// The table that chooses the kind of the part, and what is chosen there; `None` if it has no kind.
    pub fn choice(&self) -> Option<(Path, &'static str)> {
        let path = self.path();
        Some(match self {
            Subject::Object(_) => (path.key("shape"), ShapeKind::WHAT),
            Subject::PunctualLight(_) => (path, PunctualLightKind::WHAT),
            Subject::Material(_) => (path, Material::WHAT),
            Subject::Texture(_) => (path, TextureKind::WHAT),
            Subject::Camera => (path, Projection::WHAT),
            Subject::Environment => (path, EnvironmentDescription::WHAT),
            Subject::Presentation => return None,
        })
    }

    /// Whether a description has the part. An environment can be selected before there is one.
    pub fn is_in(&self, description: &SceneDescription) -> bool {
        match self {
            Subject::Object(place) => *place < description.objects.len(),
            Subject::PunctualLight(place) => *place < description.punctual_lights.len(),
            Subject::Material(name) => description.materials.contains_key(name),
            Subject::Texture(name) => description.textures.contains_key(name),
            Subject::Camera | Subject::Environment | Subject::Presentation => true,
        }
    }

    /// A copy of the part; `None` if the description does not have it.
    pub fn of(&self, description: &SceneDescription) -> Option<Box<dyn Declare>> {
        fn copy<T: Declare + Clone + 'static>(part: Option<&T>) -> Option<Box<dyn Declare>> {
            part.cloned().map(|part| Box::new(part) as Box<dyn Declare>)
        }
        match self {
            Subject::Object(place) => copy(description.objects.get(*place)),
            Subject::PunctualLight(place) => copy(description.punctual_lights.get(*place)),
            Subject::Material(name) => copy(description.materials.get(name)),
            Subject::Texture(name) => copy(description.textures.get(name)),
            Subject::Camera => copy(Some(&description.camera)),
            Subject::Environment => copy(description.environment.as_ref()),
            Subject::Presentation => copy(Some(&Presentation::of(description))),
        }
    }
}

#[cfg(test)]
mod tests {
    use noisefall_edit::edit::Tree;
    use noisefall_scene::{
        material::Lambertian,
        scene::description::{EnvironmentDescription, PunctualLightDescription},
        shape::Sphere,
    };

    use super::*;

    #[test]
    fn a_part_with_kinds_names_the_table_that_chooses_one() {
        let found = |subject: Subject| subject.choice();
        assert_eq!(found(Subject::Object(2)), Some((Path::of("objects.2.shape"), ShapeKind::WHAT)));
        assert_eq!(found(Subject::Material("red".to_owned())), Some((Path::of("materials.red"), Material::WHAT)));
        assert_eq!(found(Subject::Texture("bark".to_owned())), Some((Path::of("textures.bark"), TextureKind::WHAT)));
        assert_eq!(found(Subject::PunctualLight(1)), Some((Path::of("lights.1"), PunctualLightKind::WHAT)));
        assert_eq!(found(Subject::Camera), Some((Path::of("camera"), Projection::WHAT)));
        assert_eq!(found(Subject::Environment), Some((Path::of("environment"), EnvironmentDescription::WHAT)));
        assert_eq!(found(Subject::Presentation), None);
    }

    #[test]
    fn a_part_is_found_at_its_path() {
        let mut room = SceneDescription::default();
        room.add_material("white", Lambertian::default());
        room.add_object("ball", Sphere::default());
        let found = |subject: &Subject, room: &SceneDescription| Some(Tree::of(&mut *subject.of(room)?));
        let is = |subject: &Subject, room: &SceneDescription, part: &mut dyn Declare| {
            found(subject, room).is_some_and(|found| found.is_identical(&Tree::of(part)))
        };
        let ball = Subject::Object(0);
        assert!(is(&ball, &room, &mut room.objects[0].clone()));
        assert_eq!([ball.path(), Subject::Material("white".to_owned()).path()], ["objects.0", "materials.white"].map(Path::of));
        assert!(is(&Subject::Camera, &room, &mut room.camera.clone()));
        assert!([Subject::Object(1), Subject::Environment].iter().all(|subject| found(subject, &room).is_none()));
        room.environment = Some(EnvironmentDescription::default());
        assert!(is(&Subject::Environment, &room, &mut EnvironmentDescription::default()));
        room.punctual_lights.push(PunctualLightDescription::default());
        assert_eq!(Subject::at(&Path::of("lights.0")), Some(Subject::PunctualLight(0)));
        assert!(
            is(&Subject::PunctualLight(0), &room, &mut PunctualLightDescription::default())
                && !Subject::PunctualLight(1).is_in(&room)
        );
        room.title = "Room".to_owned();
        assert!(is(&Subject::Presentation, &room, &mut Presentation::of(&room)));
    }
}
