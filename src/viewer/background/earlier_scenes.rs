//! The scenes before the edits, for as long as the renderer keeps images of them.
use std::sync::{Arc, Weak};

use noisefall_scene::scene::{Scene, description::SceneDescription};

/// Scenes with their descriptions. It keeps no scene in memory by itself.
#[derive(Default)]
pub struct EarlierScenes(Vec<(Arc<SceneDescription>, Weak<Scene>)>);

impl EarlierScenes {
    /// Notes a scene that is rendered, and forgets those that are gone.
    pub fn note(&mut self, description: &Arc<SceneDescription>, scene: &Arc<Scene>) {
        let is_other = |known: &Weak<Scene>| known.strong_count() > 0 && !std::ptr::eq(known.as_ptr(), Arc::as_ptr(scene));
        self.0.retain(|(_, known)| is_other(known));
        self.0.push((description.clone(), Arc::downgrade(scene)));
    }

    /// The latest scene with the image of a description.
    pub fn of(&self, description: &SceneDescription) -> Option<Arc<Scene>> {
        let has_image = |known: &SceneDescription| known == description || description.differs_unseen(known);
        self.0.iter().rev().filter(|(known, _)| has_image(known)).find_map(|(_, scene)| scene.upgrade())
    }
}

#[cfg(test)]
mod tests {
    use noisefall_scene::shape::Sphere;

    use super::*;

    #[test]
    fn a_scene_is_found_by_its_description_until_nobody_has_it() {
        let mut described = SceneDescription::default();
        described.add_object("ball", Sphere::default());
        let first = Arc::new(described.clone());
        described.objects[0].flip = true;
        let second = Arc::new(described);
        let compile = |description: &Arc<SceneDescription>| Arc::new(description.build("".as_ref()).expect("it is a scene"));
        let scenes = [&first, &second].map(compile);
        let mut earlier = EarlierScenes::default();
        earlier.note(&first, &scenes[0]);
        earlier.note(&second, &scenes[1]);
        let found = |earlier: &EarlierScenes| earlier.of(&first).is_some_and(|scene| Arc::ptr_eq(&scene, &scenes[0]));
        assert!(found(&earlier));
        let renamed = SceneDescription { title: "Ball".to_owned(), ..SceneDescription::clone(&first) };
        assert!(earlier.of(&renamed).is_some(), "another title is no other image");
        let [gone, kept] = scenes;
        drop(gone);
        assert!(earlier.of(&first).is_none());
        earlier.note(&second, &kept);
        assert_eq!(earlier.0.len(), 1);
    }
}
