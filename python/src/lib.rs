//! The native half of the Python module `noisefall`. The other half, in `noisefall/`, gives it its Python types.
//!
//! Trees of values cross the border as JSON, images as memory that numpy views.
mod compare;
mod errors;
mod image;
mod interrupt;
mod path;
mod pixels;
mod render;
mod scene;
mod settings;
mod validate;

use pyo3::prelude::*;

/// Renders scenes: see the module `noisefall`.
#[pymodule]
mod _noisefall {
    use noisefall_scene::scene::{ShippedScene, description::SceneDescription};
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::{
        compare::compare,
        errors::{NoisefallError, RenderError, SceneError},
        image::Image,
        pixels::Pixels,
        scene::{Scene, build, load, parse},
        validate::validate,
    };

    /// The JSON Schema of scene files, as text.
    #[pyfunction]
    fn schema() -> String {
        noisefall_base::declare::schema("Noisefall scene", &mut SceneDescription::default()).to_string()
    }

    /// The names of the scenes that come with the program.
    #[pyfunction]
    fn scenes() -> Vec<&'static str> {
        ShippedScene::all().iter().map(|scene| scene.name).collect()
    }
}
