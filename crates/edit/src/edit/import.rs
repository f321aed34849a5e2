//! Meshes and skies from files.
use glam::DVec3;

use super::{Document, Edit, Placement, add::with_material, tree::Tree};
use noisefall_base::declare::Path;
use noisefall_scene::{
    light::environment::{EnvironmentDescription, image::Image},
    scene::{Scene, description::ObjectDescription},
    shape::{
        Transform,
        mesh::{Mesh, MeshSource},
    },
};

/// Largest and smallest size of a new mesh relative to what is seen around it. A mesh beyond them has another unit of length.
const SIZES: [f64; 2] = [0.5, 0.01];

impl Document {
    /// The edit that adds a mesh file, and the path of the new object. `bounds` are the corners of its box in the file. The mesh stands
    /// upright on the floor at the placement, or below it, and is scaled by a power of ten if it would be a speck or too large for
    /// what is seen there. It has the first diffuse material of the scene. `scene` is the compiled scene of this document.
    pub fn add_mesh(&self, file: &str, bounds: [DVec3; 2], placement: Placement, scene: &Scene) -> (Edit, Path) {
        let [min, max] = bounds;
        let factor = factor((max - min).max_element(), placement.extent);
        let size = (max - min) * factor;
        let at = placement.on_floor(scene, 0.5 * size.x.max(size.z));
        let foot = DVec3::new(0.5 * (min.x + max.x), min.y, 0.5 * (min.z + max.z));
        let scale = (factor != 1.0).then(|| Transform::Scale(DVec3::splat(factor)));
        let translate = Transform::Translate(at.rounded(at.at - foot * factor));
        let (material, new_material) = self.diffuse_material(None);
        let stem = std::path::Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
        let mut object = ObjectDescription {
            name: self.free_name("objects", &stem),
            shape: Mesh { source: MeshSource::File(file.to_owned()), smooth: None }.into(),
            transform: scale.into_iter().chain([translate]).collect(),
            material: Some(material),
            ..ObjectDescription::default()
        };
        let path = Path::of("objects").item(self.description().objects.len());
        (with_material(new_material, Edit::insert_tree(path.clone(), Tree::of(&mut object))), path)
    }

    /// The edit that makes an equirectangular image the environment.
    pub fn set_sky(&self, file: &str) -> Edit {
        let path = Path::of("environment");
        let mut sky = EnvironmentDescription::from(Image { path: file.to_owned(), ..Image::default() });
        let tree = Tree::of(&mut sky);
        match self.description().environment {
            None => Edit::insert_tree(path, tree),
            Some(_) => Edit::Replace { path, tree },
        }
    }
}

/// The power of ten that gives a mesh a size that fits this extent; both in metres.
fn factor(size: f64, extent: f64) -> f64 {
    let mut exponent = 0;
    let ratio = |exponent: i32| size * 10f64.powi(exponent) / extent;
    if ratio(0).is_finite() && ratio(0) > 0.0 {
        while ratio(exponent) > SIZES[0] {
            exponent -= 1;
        }
        while ratio(exponent) < SIZES[1] {
            exponent += 1;
        }
    }
    // Read as it is written, so that it is as short as it can be.
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_other_units_are_scaled_by_powers_of_ten() {
        for (size, factor_of_it) in [(1.0, 1.0), (4.9, 1.0), (0.1, 1.0), (5.1, 0.1), (1800.0, 0.001), (0.09, 10.0), (0.0, 1.0)] {
            assert_eq!(factor(size, 10.0), factor_of_it, "{size}");
        }
        assert_eq!((factor(1.0, f64::INFINITY), factor(f64::NAN, 1.0)), (1.0, 1.0));
    }
}
