//! Reuses the shapes and lights of the previous scene if their inputs have not changed.
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use glam::DVec3;

use crate::{
    geometry::{Shapes, same_point},
    light::{Environment, Lights, PunctualLight, PunctualLights},
    scene::{Object, Scene},
};
use noisefall_base::declare::{Precision, Problem, Resources};

/// The previously compiled scene.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    pub scene: &'a Scene,
    /// Which of its parts may be reused.
    pub precision: Precision,
}

/// Name of the trees of meshes in the report of a compile.
const MESH_TREES: &str = "mesh trees";

/// The shapes of the objects. `near` is a point in the middle of the scene.
pub fn shapes(objects: &[Object], near: DVec3, before: Option<Before>, resources: &Resources) -> Result<Arc<Shapes>, Problem> {
    const PART: &str = "shapes";
    if let Some(Before { scene, precision }) = before
        && (precision == Precision::Interactive || !scene.shapes.have_moved_meshes())
        && same_point(&scene.shapes.near(), &near)
        && are_same(objects, &scene.objects, |a, b| a.shape.is_same(&b.shape) && a.motion.is_same(&b.motion))
    {
        resources.note(PART, None);
        (0..scene.shapes.count_mesh_trees()).for_each(|_| resources.note(MESH_TREES, None));
        return Ok(scene.shapes.clone());
    }
    let start = Instant::now();
    let precision = before.map_or(Precision::Exact, |before| before.precision);
    let placed = objects.iter().map(|object| (&object.shape, &object.motion));
    let before = before.map(|before| &*before.scene.shapes);
    let made = Shapes::after(before, precision, placed, near, resources.progress());
    let (shapes, trees) = made.map_err(Problem::cancelled)?;
    let of_trees: Duration = trees.iter().flatten().sum();
    resources.note(PART, Some(start.elapsed().saturating_sub(of_trees)));
    trees.into_iter().for_each(|took| resources.note(MESH_TREES, took));
    Ok(Arc::new(shapes))
}

/// The lights of the objects, and the punctual lights. `shapes` are those of the same objects.
pub fn lights(
    objects: &[Object],
    shapes: &Shapes,
    punctual_lights: &[PunctualLight],
    environment: Option<Environment>,
    before: Option<Before>,
    resources: &Resources,
) -> Arc<Lights> {
    const PART: &str = "lights";
    let near = shapes.near();
    if let Some(Before { scene, .. }) = before
        && same_point(&scene.shapes.near(), &near)
        && has_same_environment(scene, environment.as_ref())
        && scene.lights.punctual_lights.are_same(&PunctualLights::new(punctual_lights))
        && has_same_emitters(scene, objects, shapes)
    {
        resources.note(PART, None);
        return scene.lights.clone();
    }
    let start = Instant::now();
    let emitting = objects.iter().map_while(|o| o.emission.map(|emission| (o, emission)));
    let emitters: Vec<_> = emitting
        .flat_map(|(o, emission)| o.shape.pieces().into_iter().map(move |piece| (piece, o.motion.clone(), emission)))
        .collect();
    let lights = Arc::new(Lights::new(shapes, &emitters, punctual_lights, environment, near));
    resources.note(PART, Some(start.elapsed()));
    lights
}

/// The value of [`Scene::deepest_media`], reused if its inputs have not changed.
pub fn deepest_media(scene: &Scene, before: Option<Before>) -> usize {
    let same_insides = |old: &Scene| {
        let filled = |scene: &Scene, object: &Object| (object.flip, scene.has_inside(object));
        are_same(&scene.objects, &old.objects, |a, b| filled(scene, a) == filled(old, b))
    };
    match before.map(|before| before.scene) {
        Some(old)
            if Arc::ptr_eq(&scene.shapes, &old.shapes)
                && scene.surfaces.media.is_empty() == old.surfaces.media.is_empty()
                && same_insides(old) =>
        {
            old.deepest_media
        }
        _ => scene.count_deepest_media(),
    }
}

fn has_same_environment(scene: &Scene, environment: Option<&Environment>) -> bool {
    match (&scene.lights.environment, environment) {
        (Some(a), Some(b)) => a.is_same(b),
        (None, None) => true,
        _ => false,
    }
}

fn has_same_emitters(scene: &Scene, objects: &[Object], shapes: &Shapes) -> bool {
    let emitting = |objects: &[Object]| objects.iter().take_while(|object| object.emission.is_some()).count();
    let [here, there] = [objects, &scene.objects].map(emitting);
    let is_same = |a: &Object, b: &Object| {
        let same_emission = a.emission.zip(b.emission).is_some_and(|(a, b)| a.is_same(&b));
        same_emission && a.shape.is_same(&b.shape) && a.motion.is_same(&b.motion)
    };
    let primitives = scene.owners.partition_point(|owner| (*owner as usize) < there) as u32;
    are_same(&objects[..here], &scene.objects[..there], is_same)
        && (0..primitives).all(|primitive| shapes.has_same_triangles(&scene.shapes, primitive))
}

fn are_same<T>(a: &[T], b: &[T], is_same: impl Fn(&T, &T) -> bool) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{
        scene::description::{EmissionDescription, SceneDescription},
        shape::{
            Mesh, Sphere, Transform,
            mesh::{Heightfield, MeshSource},
        },
    };

    /// Lights refer to the triangles of their meshes: new triangles of one mesh need new lights, whatever the others have.
    #[test]
    fn lights_are_made_anew_where_one_mesh_of_them_has_other_triangles() {
        let mut description = SceneDescription::default();
        let hills = MeshSource::Heightfield(Heightfield { quads: 4, seed: 1 });
        description.add_object("hills", Mesh { source: hills, smooth: None });
        description.add_object("ball", Sphere::default());
        for object in &mut description.objects {
            object.emission = Some(EmissionDescription::radiance([1.0; 3]));
        }
        let before = description.build(Path::new("")).expect("it is valid");
        description.objects[0].transform.push(Transform::Translate(DVec3::new(0.1, 0.2, 0.3)));
        let description = Arc::new(description);
        let after = |before: &Scene, precision| description.rebuild(Path::new(""), before, precision).expect("it is valid");
        let moved = after(&before, Precision::Interactive);
        let exact = after(&moved, Precision::Exact);
        let made = |scene: &Scene| ["mesh trees", "lights"].map(|part| scene.compiled.made(part));
        assert_eq!([&moved, &exact].map(made), [[0, 1], [1, 1]]);
        assert_eq!(made(&after(&exact, Precision::Exact)), [0, 0]);
    }
}
