//! The exceptions of the module. Their texts are those of the program.
use noisefall_render::render::image_file::ImageError;
use pyo3::{PyErr, create_exception, exceptions::PyException};

create_exception!(noisefall, NoisefallError, PyException, "Base class of the errors of this module.");
create_exception!(noisefall, SceneError, NoisefallError, "A scene cannot be read or compiled.");
create_exception!(noisefall, RenderError, NoisefallError, "An image cannot be rendered, read, written or compared.");

/// The exception for a scene: the whole report, with the line and what to do.
pub fn of_scene(error: &noisefall::SceneError) -> PyErr {
    SceneError::new_err(error.report())
}

/// The exception for an image file.
pub fn of_image(error: &ImageError) -> PyErr {
    RenderError::new_err(error.to_string())
}
