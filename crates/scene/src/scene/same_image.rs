//! Scenes that differ only in what no image shows: title, notes, reference, exposure, names, and materials and textures that nothing uses.
use std::sync::Arc;

use super::{
    Scene,
    description::{ObjectDescription, RenderDescription, SceneDescription},
    used::number_names,
};
use crate::texture::UNUSED_PICTURES;

/// Parts whose compile leaves the image as it is: they are made every time, or only compared with the image, or belong to materials and
/// textures that nothing uses.
const HARMLESS: [&str; 4] = ["surfaces", "references", "material tables", UNUSED_PICTURES];

impl SceneDescription {
    /// Whether texts, exposure, names, unused materials or unused textures differ, and nothing else does.
    pub fn differs_unseen(&self, other: &SceneDescription) -> bool {
        self.may_show_the_same(other) && self != other && self.shown() == other.shown()
    }

    /// False if one of the parts that edits usually change is another one: a quick answer for drags.
    fn may_show_the_same(&self, other: &SceneDescription) -> bool {
        let same_place = |(a, b): (&ObjectDescription, &ObjectDescription)| a.transform == b.transform && a.shape == b.shape;
        self.camera == other.camera
            && self.punctual_lights == other.punctual_lights
            && self.render.renders_like(&other.render)
            && self.objects.len() == other.objects.len()
            && self.objects.iter().zip(&other.objects).all(same_place)
    }

    /// The scene without what no image shows.
    fn shown(&self) -> SceneDescription {
        let render = RenderDescription { exposure: 0.0, ..self.render.clone() };
        let mut shown = SceneDescription { title: String::new(), notes: String::new(), reference: None, render, ..self.clone() };
        shown.objects.iter_mut().for_each(|object| object.name.clear());
        number_names(&mut shown);
        shown
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
            before.path_reuse_by_trial.get().into_iter().for_each(|path_reuse| _ = self.path_reuse_by_trial.set(*path_reuse));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::{
        light::environment::{EnvironmentDescription, image::Image},
        material::{Dielectric, Lambertian},
        scene::{BUILT_IN, PathReuse, built_in, describe},
        texture::image::Image as Texels,
    };
    use noisefall_base::declare::{Precision, Textured};

    fn built_in_description() -> SceneDescription {
        describe("built-in", BUILT_IN.to_owned()).expect("it is a scene")
    }

    /// Renames the material `white`, and with it the order of the materials.
    fn rename_white(scene: &mut SceneDescription, to: &str) {
        let material = scene.materials.remove("white").expect("the scene has it");
        scene.materials.insert(to.to_owned(), material);
        let names = scene.objects.iter_mut().filter_map(|object| object.material.as_mut());
        names.filter(|name| *name == "white").for_each(|name| to.clone_into(name));
    }

    #[test]
    fn visible_changes_are_told_from_invisible_ones() {
        let before = built_in_description();
        assert!(!before.differs_unseen(&before), "nothing differs");
        let changed = |change: fn(&mut SceneDescription)| {
            let mut after = before.clone();
            change(&mut after);
            after.differs_unseen(&before)
        };
        assert!(changed(|scene| scene.title = "Room".to_owned()));
        assert!(changed(|scene| scene.notes = "Bright.".to_owned()));
        assert!(changed(|scene| scene.reference = Some(Default::default())));
        assert!(changed(|scene| scene.render.exposure = 1.5));
        assert!(!changed(|scene| (scene.title, scene.camera.fov) = ("Room".to_owned(), Some(20.0))));
        assert!(changed(|scene| scene.objects[0].name = "wall".to_owned()));
        assert!(!changed(|scene| (scene.objects[0].name, scene.objects[0].flip) = ("wall".to_owned(), true)));
        assert!(changed(|scene| _ = scene.add_material("new", Lambertian::default())));
        assert!(!changed(|scene| _ = scene.add_material("white", Lambertian::default())));
        assert!(!changed(|scene| scene.render.settings.seed = 5));
        assert!(!changed(|scene| drop(scene.objects.pop())));
        assert!(changed(|scene| rename_white(scene, "aaa")));
        assert!(!changed(|scene| {
            rename_white(scene, "aaa");
            scene.objects[0].material = Some("aaa".to_owned());
        }));
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
        description.environment = Some(EnvironmentDescription::from(Image { path: "sky.png".to_owned(), ..Image::default() }));
        let before = description.build(folder.path()).expect("it is valid");
        before.path_reuse_by_trial.set(PathReuse::Suffixes).expect("it is not known yet");
        description.title = "Room".to_owned();
        let description = Arc::new(description);
        let renamed = || {
            let mut after = description.rebuild(folder.path(), &before, Precision::Interactive).expect("it is valid");
            after.keep_image(&before);
            after
        };
        let after = renamed();
        assert!(
            after.has_same_image(&before)
                && after.title == "Room"
                && after.path_reuse_by_trial.get() == Some(&PathReuse::Suffixes)
        );
        write(16);
        assert!(!renamed().has_same_image(&before));
        assert!(after.is_of_same_file(&before) && !built_in().is_of_same_file(&before));
        assert!(!built_in().has_same_image(&built_in()), "another compile is not compared");
    }

    #[test]
    fn an_image_that_nothing_uses_leaves_the_image_as_it_is_and_one_that_is_used_does_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, grey: u8| {
            let pixels = ::image::RgbImage::from_pixel(4, 4, ::image::Rgb([grey; 3]));
            pixels.save(folder.path().join(name)).expect("it is written");
            BTreeMap::from([(name.to_owned(), Texels { path: name.to_owned(), ..Texels::default() }.into())])
        };
        let mut description = built_in_description();
        description.textures = write("used.png", 100);
        description.add_material("white", Lambertian { albedo: Textured::Texture("used.png".to_owned()) });
        let before = description.build(folder.path()).expect("it is valid");
        description.textures.extend(write("a_spare.png", 50));
        let description = Arc::new(description);
        let after = || {
            let mut after = description.rebuild(folder.path(), &before, Precision::Interactive).expect("it is valid");
            after.keep_image(&before);
            after.has_same_image(&before)
        };
        assert!(after());
        write("used.png", 200);
        assert!(!after());
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
