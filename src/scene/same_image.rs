//! Scenes that differ only in title, notes, truth, exposure and names of objects, and therefore have the same image.
use std::sync::Arc;

use super::{
    Scene,
    description::{ObjectDescription, SceneDescription},
};

/// Parts whose compile leaves the image as it is: they are made every time, or only compared with the image.
const HARMLESS: [&str; 2] = ["surfaces", "references"];

impl SceneDescription {
    /// Whether title, notes, truth, exposure or names of objects differ, and nothing else does.
    pub fn differs_in_texts(&self, other: &SceneDescription) -> bool {
        let SceneDescription { camera, background, textures, materials, objects, lamps, render, .. } = self;
        let names = |objects: &[ObjectDescription]| objects.iter().map(|object| object.name.clone()).collect::<Vec<_>>();
        let texts = |of: &SceneDescription| (of.title.clone(), of.notes.clone(), of.truth.clone(), of.render.exposure);
        (texts(self) != texts(other) || names(objects) != names(&other.objects))
            && (camera, background) == (&other.camera, &other.background)
            && render.renders_like(&other.render)
            && (textures, materials) == (&other.textures, &other.materials)
            && lamps == &other.lamps
            && objects.len() == other.objects.len()
            && objects.iter().zip(&other.objects).all(|(a, b)| a.is_same_but_for_name(b))
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

    /// Takes over the identity of the scene that this one was rebuilt from. Their descriptions differ in texts at most. If a file that
    /// the scene names has changed, parts were made anew, and the scene keeps an identity of its own.
    pub fn keep_image(&mut self, before: &Scene) {
        if self.compiled.parts.iter().all(|part| part.made == 0 || HARMLESS.contains(&part.part)) {
            self.identity = before.identity.clone();
            before.estimator_by_trial.get().into_iter().for_each(|best| _ = self.estimator_by_trial.set(*best));
            before.sharing_pays.get().into_iter().for_each(|pays| _ = self.sharing_pays.set(*pays));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        declare::Precision,
        light::background::{BackgroundDescription, image::Image},
        scene::{BUILT_IN, built_in, describe},
    };

    fn built_in_description() -> SceneDescription {
        describe("built-in", BUILT_IN.to_owned()).expect("it is a scene")
    }

    #[test]
    fn texts_are_told_from_what_an_image_depends_on() {
        let before = built_in_description();
        assert!(!before.differs_in_texts(&before), "nothing differs");
        let changed = |change: fn(&mut SceneDescription)| {
            let mut after = before.clone();
            change(&mut after);
            after.differs_in_texts(&before)
        };
        assert!(changed(|scene| scene.title = "Room".to_owned()));
        assert!(changed(|scene| scene.notes = "Bright.".to_owned()));
        assert!(changed(|scene| scene.truth = Some(Default::default())));
        assert!(changed(|scene| scene.render.exposure = 1.5));
        assert!(!changed(|scene| (scene.title, scene.camera.fov) = ("Room".to_owned(), Some(20.0))));
        assert!(changed(|scene| scene.objects[0].name = "wall".to_owned()));
        assert!(!changed(|scene| (scene.objects[0].name, scene.objects[0].flip) = ("wall".to_owned(), true)));
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
        before.sharing_pays.set(true).expect("it is not known yet");
        description.title = "Room".to_owned();
        let description = Arc::new(description);
        let renamed = || {
            let mut after = description.rebuild(folder.path(), &before, Precision::Interactive).expect("it is valid");
            after.keep_image(&before);
            after
        };
        let after = renamed();
        assert!(after.has_same_image(&before) && after.title == "Room" && after.sharing_pays.get() == Some(&true));
        write(16);
        assert!(!renamed().has_same_image(&before));
        assert!(after.is_of_same_file(&before) && !built_in().is_of_same_file(&before));
        assert!(!built_in().has_same_image(&built_in()), "another compile is not compared");
    }
}
