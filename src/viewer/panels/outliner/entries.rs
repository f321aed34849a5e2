//! The parts of a description as entries in groups.
use egui::{TextFormat, Visuals, text::LayoutJob};
use noisefall_scene::scene::description::{MaterialDescription, ObjectDescription, PunctualLightDescription, SceneDescription};

use crate::viewer::panels::subject::Subject;

/// Entries with a title.
pub struct EntryGroup {
    pub title: &'static str,
    pub entries: Vec<Entry>,
}

/// A part of the scene as a row.
pub struct Entry {
    pub subject: Subject,
    /// Label of the row.
    pub name: String,
    /// The name in the description: an object may have none.
    pub given_name: String,
    /// Its kind, and for an object its material.
    pub kind: String,
}

/// The parts of a description whose name or type contains the search, in groups. Groups without entries are left out.
pub fn groups(description: &SceneDescription, search: &str) -> Vec<EntryGroup> {
    let search = search.trim().to_lowercase();
    let matches = |entry: &Entry| entry.name.to_lowercase().contains(&search) || entry.kind.to_lowercase().contains(&search);
    let group =
        |title, entries: &mut dyn Iterator<Item = Entry>| EntryGroup { title, entries: entries.filter(matches).collect() };
    let objects = |emits: bool| {
        let objects = description.objects.iter().enumerate().filter(move |(_, object)| object.emission.is_some() == emits);
        objects.map(|(place, object)| of_object(description, place, object))
    };
    let environment = description.environment.as_ref().map_or("none", |environment| environment.name());
    let single = [
        Entry::single(Subject::Camera, "Camera", ""),
        Entry::single(Subject::Environment, "Environment", environment),
        Entry::single(Subject::Presentation, "Title and settings", ""),
    ];
    let punctual_lights = description
        .punctual_lights
        .iter()
        .enumerate()
        .map(|(place, punctual_light)| of_punctual(description, place, punctual_light));
    let materials = description.materials.iter();
    let textures = description.textures.iter();
    let groups = [
        group("Objects", &mut objects(false)),
        group("Lights", &mut objects(true).chain(punctual_lights)),
        group("Materials", &mut materials.map(|(name, material)| of_material(name, material))),
        group(
            "Textures",
            &mut textures.map(|(name, texture)| Entry::named(Subject::Texture(name.clone()), name, texture.name())),
        ),
        group("Scene", &mut single.into_iter()),
    ];
    groups.into_iter().filter(|group| !group.entries.is_empty()).collect()
}

fn of_object(description: &SceneDescription, place: usize, object: &ObjectDescription) -> Entry {
    let subject = Subject::Object(place);
    let material = object.material.as_deref().unwrap_or("no material");
    let kind = format!("{}, {material}", object.shape.name().replace('_', " "));
    Entry { name: subject.name(description), subject, given_name: object.name.clone(), kind }
}

fn of_punctual(description: &SceneDescription, place: usize, punctual_light: &PunctualLightDescription) -> Entry {
    let subject = Subject::PunctualLight(place);
    let name = subject.name(description);
    Entry { given_name: punctual_light.name.clone(), ..Entry::named(subject, &name, punctual_light.kind.name()) }
}

fn of_material(name: &str, material: &MaterialDescription) -> Entry {
    Entry::named(Subject::Material(name.to_owned()), name, material.kind.name())
}

impl Entry {
    fn named(subject: Subject, name: &str, kind: &str) -> Entry {
        Entry { subject, name: name.to_owned(), given_name: name.to_owned(), kind: kind.replace('_', " ") }
    }

    fn single(subject: Subject, name: &str, kind: &str) -> Entry {
        Entry { given_name: String::new(), ..Entry::named(subject, name, kind) }
    }

    /// The name, and behind it the kind in a faint colour.
    pub fn text(&self, visuals: &Visuals) -> LayoutJob {
        let font = egui::FontId::proportional(14.0);
        let mut job = LayoutJob::default();
        job.append(&self.name, 0.0, TextFormat::simple(font.clone(), visuals.text_color()));
        job.append(&self.kind, 10.0, TextFormat::simple(font, visuals.weak_text_color()));
        job
    }
}

#[cfg(test)]
mod tests {
    use noisefall_scene::{material::Lambertian, scene::description::EmissionDescription, shape::Sphere, texture::TextureKind};

    use super::*;

    fn room() -> SceneDescription {
        let mut room = SceneDescription::default();
        room.add_material("white", Lambertian::default());
        room.add_object("ball", Sphere::default()).material = Some("white".to_owned());
        room.add_object("", Sphere::default());
        room.add_object("light", Sphere::default()).emission = Some(EmissionDescription::default());
        room.punctual_lights.push(PunctualLightDescription::default());
        room.textures.insert("squares".to_owned(), TextureKind::default());
        room
    }

    fn names(search: &str) -> Vec<(&'static str, Vec<String>)> {
        let names = |group: EntryGroup| (group.title, group.entries.into_iter().map(|entry| entry.name).collect());
        groups(&room(), search).into_iter().map(names).collect()
    }

    #[test]
    fn every_part_is_in_one_group() {
        let all = [
            ("Objects", vec!["ball", "object 2"]),
            ("Lights", vec!["light", "light 1"]),
            ("Materials", vec!["white"]),
            ("Textures", vec!["squares"]),
            ("Scene", vec!["Camera", "Environment", "Title and settings"]),
        ];
        assert_eq!(names(""), all.map(|(title, names)| (title, names.into_iter().map(str::to_owned).collect())));
    }

    #[test]
    fn search_finds_names_and_kinds_in_any_case() {
        assert_eq!(names("BALL"), [("Objects", vec!["ball".to_owned()])]);
        assert_eq!(names("lamb"), [("Materials", vec!["white".to_owned()])]);
        assert_eq!(names("white"), [("Objects", vec!["ball".to_owned()]), ("Materials", vec!["white".to_owned()])]);
        assert!(names("nothing of the kind").is_empty());
    }

    #[test]
    fn an_object_says_its_shape_and_its_material() {
        let kinds: Vec<String> = groups(&room(), "").remove(0).entries.into_iter().map(|entry| entry.kind).collect();
        assert_eq!(kinds, ["sphere, white", "sphere, no material"]);
    }
}
