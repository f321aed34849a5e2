//! Whole scenes, written and read again.
mod materials;
mod remarks;

use std::path::Path;

use glam::DMat3;

use crate::{
    export::{
        geometry,
        round_trip::{self as scene_files, RoundTrip, names, near, scenes, shipped},
    },
    import::Imported,
};
use noisefall_base::declare::{Assets, Resources};
use noisefall_scene::{geometry::Shape, scene::description::SceneDescription};

fn round_trip(description: &SceneDescription, folder: &Path) -> RoundTrip {
    scene_files::round_trip(description, &Assets::default(), folder, "scene.xml")
}

/// Whether two shapes are the same points with the same coordinates.
fn same(a: &Shape, b: &Shape) -> bool {
    match (a, b) {
        (Shape::Sphere { center: c, radius: r, turn: s }, Shape::Sphere { center, radius, turn }) => {
            let [a, b] = [s, turn].map(|turn| turn.unwrap_or(DMat3::IDENTITY));
            near(*c, *center) && (r / radius - 1.0).abs() < 1e-9 && a.abs_diff_eq(b, 1e-9)
        }
        (Shape::Flat { outline: o, origin: p, edges: [u, v], mirrored: m }, Shape::Flat { outline, origin, edges, mirrored }) => {
            o == outline && near(*p, *origin) && near(*u, edges[0]) && near(*v, edges[1]) && m == mirrored
        }
        (Shape::Cuboid { origin: p, edges: e }, Shape::Cuboid { origin, edges }) => {
            near(*p, *origin) && (0..3).all(|i| near(e.col(i), edges.col(i)))
        }
        (Shape::Mesh { data: d, map: m, .. }, Shape::Mesh { data, map, .. }) => {
            // Normals that were computed are written, and normalized when they are read.
            let are_close = |a: &[[f32; 3]], b: &[[f32; 3]]| {
                a.len() == b.len() && a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| (a - b).abs() < 1e-6)
            };
            d.vertices == data.vertices
                && d.triangles == data.triangles
                && d.uvs == data.uvs
                && are_close(&d.normals, &data.normals)
                && m.abs_diff_eq(*map, 1e-9)
        }
        _ => false,
    }
}

#[test]
fn shipped_scenes_come_back() {
    // All of their shapes, materials and lights have a plugin; remarks are about energy compensation and the like.
    for name in ["cornell_box", "glass_and_mirror", "instanced_field", "furnace", "tiny_lamp"] {
        let ours = shipped(name);
        let RoundTrip { imported: Imported { description: theirs, assets, .. }, folder, .. } = round_trip(&ours, &scenes());
        let (a, b) = (&ours.camera, &theirs.camera);
        assert_eq!((a.resolution, a.filter, a.projection), (b.resolution, b.filter, b.projection), "{name}");
        assert!(near(a.eye, b.eye) && (a.fov.unwrap_or(0.0) - b.fov.unwrap_or(0.0)).abs() < 1e-9, "{name}");
        assert!(near((a.look_at - a.eye).normalize(), (b.look_at - b.eye).normalize()), "{name}");
        assert_eq!(ours.render.settings.max_bounces, theirs.render.settings.max_bounces, "{name}");
        assert_eq!(ours.environment, theirs.environment, "{name}");
        let resources = [Resources::new(scenes()), Resources::new(folder.path()).with_assets(assets)];
        let shapes = |scene: &SceneDescription, resources: &Resources| -> Vec<(Shape, bool, Option<String>)> {
            let all = scene.objects.iter().flat_map(|object| {
                let shapes = geometry::shapes(object, resources).expect("it is valid");
                shapes.into_iter().map(|shape| (shape, object.flip, object.material.clone()))
            });
            all.collect()
        };
        let [a, b] = [shapes(&ours, &resources[0]), shapes(&theirs, &resources[1])];
        assert_eq!(a.len(), b.len(), "{name}");
        for ((a, a_flips, a_material), (b, b_flips, b_material)) in a.iter().zip(&b) {
            assert!(same(a, b) && a_flips == b_flips, "{name}: {} became {}", a.name(), b.name());
            assert!(a_material.is_none() || a_material == b_material, "{name}: {a_material:?} {b_material:?}");
        }
        let radiance =
            |scene: &SceneDescription| scene.objects.iter().filter_map(|object| object.emission.clone()).collect::<Vec<_>>();
        assert_eq!(radiance(&ours).len(), radiance(&theirs).len(), "{name}");
    }
}

#[test]
fn every_shipped_scene_can_be_written_and_read() {
    for name in names() {
        let ours = shipped(&name);
        let RoundTrip { imported, content, .. } = round_trip(&ours, &scenes());
        assert!(content.starts_with(b"<?xml") && !imported.description.objects.is_empty(), "{name}");
        assert_eq!(ours.punctual_lights.len(), imported.description.punctual_lights.len(), "{name}");
    }
}
