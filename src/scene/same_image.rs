//! Scenes that differ only in what no image shows: title, notes, truth, exposure, names of objects, and materials and textures that
//! nothing uses.
use std::sync::Arc;

use super::{
    Scene,
    description::{ObjectDescription, SceneDescription},
    used::Used,
};

/// Parts whose compile leaves the image as it is: they are made every time, are only compared with the image, or belong to materials.
/// Only unused materials differ here.
const HARMLESS: [&str; 3] = ["surfaces", "references", "material tables"];

impl SceneDescription {
    /// Whether texts, exposure, unused materials or unused textures differ, and nothing else does.
    pub fn differs_unseen(&self, other: &SceneDescription) -> bool {
        let SceneDescription { camera, background, textures, materials, objects, lamps, render, .. } = self;
        let names = |objects: &[ObjectDescription]| objects.iter().map(|object| object.name.clone()).collect::<Vec<_>>();
        let texts = |of: &SceneDescription| (of.title.clone(), of.notes.clone(), of.truth.clone(), of.render.exposure);
        let has_same_lists = (textures, materials) == (&other.textures, &other.materials);
        (texts(self) != texts(other) || names(objects) != names(&other.objects) || !has_same_lists)
            && (camera, background) == (&other.camera, &other.background)
            && render.renders_like(&other.render)
            && lamps == &other.lamps
            && objects.len() == other.objects.len()
            && objects.iter().zip(&other.objects).all(|(a, b)| a.is_same_but_for_name(b))
            && (has_same_lists || Used::by(self).are_same(self, other))
    }
}

impl ObjectDescription {
    fn is_same_but_for_name(&self, other: &ObjectDescription) -> bool {
        self == other || *self == ObjectDescription { name: self.name.clone(), ..other.clone() }
    }
}

impl Scene {
    /// Whether both scenes have the same image, bit for bit, by any camera and any settings. Scenes that were compiled from different
    /// descriptions can have the same image without being recognised.
    pub fn has_same_image(&self, other: &Scene) -> bool {
        Arc::ptr_eq(&self.identity, &other.identity)
    }

    /// Whether both scenes are edits of the same scene, or one is an edit of the other.
    pub fn is_of_same_file(&self, other: &Scene) -> bool {
        Arc::ptr_eq(&self.lineage, &other.lineage)
    }

    /// Takes over the identity of the scene that this one was rebuilt from. Their descriptions [differ
    /// unseen](SceneDescription::differs_unseen) at most. If a file that
    /// the scene names has changed, parts were made anew, and the scene keeps an identity of its own.
    pub fn keep_image(&mut self, before: &Scene) {
        if self.compiled.parts.iter().all(|part| part.made == 0 || HARMLESS.contains(&part.part)) {
            self.identity = before.identity.clone();
            before.estimator_by_trial.get().into_iter().for_each(|best| _ = self.estimator_by_trial.set(*best));
            before.sharing_by_trial.get().into_iter().for_each(|sharing| _ = self.sharing_by_trial.set(*sharing));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        declare::Precision,
        light::background::{BackgroundDescription, image::Image},
        material::{Dielectric, Lambertian},
        scene::{BUILT_IN, Sharing, built_in, describe},
    };

    fn built_in_description() -> SceneDescription {
        describe("built-in", BUILT_IN.to_owned()).expect("it is a scene")
    }

    #[test]
    fn what_an_image_shows_is_told_from_the_rest() {
        let before = built_in_description();
        assert!(!before.differs_unseen(&before), "nothing differs");
        let changed = |change: fn(&mut SceneDescription)| {
            let mut after = before.clone();
            change(&mut after);
            after.differs_unseen(&before)
        };
        assert!(changed(|scene| scene.title = "Room".to_owned()));
        assert!(changed(|scene| scene.notes = "Bright.".to_owned()));
        assert!(changed(|scene| scene.truth = Some(Default::default())));
        assert!(changed(|scene| scene.render.exposure = 1.5));
        assert!(!changed(|scene| (scene.title, scene.camera.fov) = ("Room".to_owned(), Some(20.0))));
        assert!(changed(|scene| scene.objects[0].name = "wall".to_owned()));
        assert!(!changed(|scene| (scene.objects[0].name, scene.objects[0].flip) = ("wall".to_owned(), true)));
        assert!(changed(|scene| _ = scene.add_material("new", Lambertian::default())));
        assert!(!changed(|scene| _ = scene.add_material("white", Lambertian::default())));
        assert!(!changed(|scene| scene.render.settings.seed = 5));
        assert!(!changed(|scene| drop(scene.objects.pop())));
    }

    #[test]
    fn a_scene_with_another_title_has_the_same_image_unless_its_files_have_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let sky = folder.path().join("sky.png");
        let write = |width: u32| {
            let bytes = vec![200; 3 * (width * width / 2) as usize];
            let pixels = ::image::RgbImage::from_raw(width, width / 2, bytes).expect("they fit");
            pixels.save(&sky).expect("it is written");
        };
        write(8);
        let mut description = built_in_description();
        description.background = Some(BackgroundDescription::from(Image { path: "sky.png".to_owned(), ..Image::default() }));
        let before = description.build(folder.path()).expect("it is valid");
        before.sharing_by_trial.set(Sharing::Suffixes).expect("it is not known yet");
        description.title = "Room".to_owned();
        let description = Arc::new(description);
        let renamed = || {
            let mut after = description.rebuild(folder.path(), &before, Precision::Interactive).expect("it is valid");
            after.keep_image(&before);
            after
        };
        let after = renamed();
        assert!(
            after.has_same_image(&before) && after.title == "Room" && after.sharing_by_trial.get() == Some(&Sharing::Suffixes)
        );
        write(16);
        assert!(!renamed().has_same_image(&before));
        assert!(after.is_of_same_file(&before) && !built_in().is_of_same_file(&before));
        assert!(!built_in().has_same_image(&built_in()), "another compile is not compared");
    }
    #[test]
    fn a_material_that_nothing_uses_leaves_the_image_as_it_is() {
        let mut description = built_in_description();
        let before = description.build(std::path::Path::new("")).expect("it is valid");
        for (name, transmittance) in [("spare", 0.5), ("spare", 0.25), ("another", 0.1)] {
            let glass = Dielectric { transmittance: [transmittance; 3], ..Dielectric::default() };
            description.add_material(name, glass);
            let mut after = Arc::new(description.clone())
                .rebuild(std::path::Path::new(""), &before, Precision::Interactive)
                .expect("it is valid");
            after.keep_image(&before);
            assert!(after.has_same_image(&before) && after.surfaces.media.is_empty(), "{name}");
            assert_eq!(after.materials.len(), description.materials.len());
        }
    }
}
