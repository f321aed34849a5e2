//! The parts of a scene that can be selected and edited.
use noisefall_base::declare::{Declare, OneOf, Path, Step};
use noisefall_scene::{
    light::lamp::LampKind,
    material::Material,
    scene::{
        Projection,
        description::{BackgroundDescription, Presentation, SceneDescription},
    },
    shape::ShapeKind,
    texture::TextureKind,
};

/// A part of a scene description.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// An object, one that emits light included, by its place in the description.
    Object(usize),
    /// A lamp without surface, by its place in the description.
    Lamp(usize),
    Material(String),
    Texture(String),
    Camera,
    Background,
    /// Title, notes, settings and truth.
    Presentation,
}

impl Subject {
    /// Path of the part in the description.
    pub fn path(&self) -> Path {
        let top = Path::default();
        match self {
            Subject::Object(place) => top.key("objects").item(*place),
            Subject::Lamp(place) => top.key("lamps").item(*place),
            Subject::Material(name) => top.key("materials").key(name),
            Subject::Texture(name) => top.key("textures").key(name),
            Subject::Camera => top.key("camera"),
            Subject::Background => top.key("background"),
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
            [Step::Key(list), Step::Item(place)] if list == "lamps" => Subject::Lamp(*place),
            [Step::Key(map), Step::Key(name)] if map == "materials" => Subject::Material(name.clone()),
            [Step::Key(map), Step::Key(name)] if map == "textures" => Subject::Texture(name.clone()),
            [Step::Key(key)] if key == "camera" => Subject::Camera,
            [Step::Key(key)] if key == "background" => Subject::Background,
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
            Subject::Lamp(_) => (path, LampKind::WHAT),
            Subject::Material(_) => (path, Material::WHAT),
            Subject::Texture(_) => (path, TextureKind::WHAT),
            Subject::Camera => (path, Projection::WHAT),
            Subject::Background => (path, BackgroundDescription::WHAT),
            Subject::Presentation => return None,
        })
    }

    /// Whether a description has the part. A background can be selected before there is one.
    pub fn is_in(&self, description: &SceneDescription) -> bool {
        match self {
            Subject::Object(place) => *place < description.objects.len(),
            Subject::Lamp(place) => *place < description.lamps.len(),
            Subject::Material(name) => description.materials.contains_key(name),
            Subject::Texture(name) => description.textures.contains_key(name),
            Subject::Camera | Subject::Background | Subject::Presentation => true,
        }
    }

    /// A copy of the part; `None` if the description does not have it.
    pub fn of(&self, description: &SceneDescription) -> Option<Box<dyn Declare>> {
        fn copy<T: Declare + Clone + 'static>(part: Option<&T>) -> Option<Box<dyn Declare>> {
            part.cloned().map(|part| Box::new(part) as Box<dyn Declare>)
        }
        match self {
            Subject::Object(place) => copy(description.objects.get(*place)),
            Subject::Lamp(place) => copy(description.lamps.get(*place)),
            Subject::Material(name) => copy(description.materials.get(name)),
            Subject::Texture(name) => copy(description.textures.get(name)),
            Subject::Camera => copy(Some(&description.camera)),
            Subject::Background => copy(description.background.as_ref()),
            Subject::Presentation => copy(Some(&Presentation::of(description))),
        }
    }
}

#[cfg(test)]
mod tests {
    use noisefall_edit::edit::Tree;
    use noisefall_scene::{
        material::Lambertian,
        scene::description::{BackgroundDescription, LampDescription},
        shape::Sphere,
    };

    use super::*;

    #[test]
    fn a_part_with_kinds_names_the_table_that_chooses_one() {
        let found = |subject: Subject| subject.choice();
        assert_eq!(found(Subject::Object(2)), Some((Path::of("objects.2.shape"), ShapeKind::WHAT)));
        assert_eq!(found(Subject::Material("red".to_owned())), Some((Path::of("materials.red"), Material::WHAT)));
        assert_eq!(found(Subject::Texture("bark".to_owned())), Some((Path::of("textures.bark"), TextureKind::WHAT)));
        assert_eq!(found(Subject::Lamp(1)), Some((Path::of("lamps.1"), LampKind::WHAT)));
        assert_eq!(found(Subject::Camera), Some((Path::of("camera"), Projection::WHAT)));
        assert_eq!(found(Subject::Background), Some((Path::of("background"), BackgroundDescription::WHAT)));
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
        assert!([Subject::Object(1), Subject::Background].iter().all(|subject| found(subject, &room).is_none()));
        room.background = Some(BackgroundDescription::default());
        assert!(is(&Subject::Background, &room, &mut BackgroundDescription::default()));
        room.lamps.push(LampDescription::default());
        assert_eq!(Subject::at(&Path::of("lamps.0")), Some(Subject::Lamp(0)));
        assert!(is(&Subject::Lamp(0), &room, &mut LampDescription::default()) && !Subject::Lamp(1).is_in(&room));
        room.title = "Room".to_owned();
        assert!(is(&Subject::Presentation, &room, &mut Presentation::of(&room)));
    }
}
