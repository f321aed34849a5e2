//! Scenes: files of any format, texts, and trees of values.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use noisefall::{ImportOptions, Opened, Remarks, progress::Progress};

use numpy::PyArray2;
use pyo3::{exceptions::PyValueError, prelude::*};

use crate::{errors, image::Image, interrupt::interruptible, path, render, settings::Settings};

/// A compiled scene.
#[pyclass(frozen, module = "noisefall._noisefall")]
pub struct Scene {
    pub scene: Arc<noisefall::Scene>,
    remarks: Vec<String>,
}

impl Scene {
    fn new(scene: noisefall::Scene, remarks: &Remarks) -> Scene {
        Scene { scene: Arc::new(scene), remarks: remarks.lines(usize::MAX) }
    }
}

/// Opens a scene file of any format, or a scene that comes with the program by its name.
#[pyfunction]
pub fn load(
    py: Python,
    path: PathBuf,
    defines: Vec<(String, String)>,
    at: Option<f64>,
    variant: Option<String>,
    allow_outside: bool,
) -> PyResult<Scene> {
    let progress = Progress::default();
    let options =
        ImportOptions { defines, time: at, variant, allow_outside, progress: progress.clone(), ..ImportOptions::default() };
    let opened = interruptible(py, || noisefall::open(&path, &options), &|| progress.cancel())?;
    let Opened { scene, remarks, .. } = opened.map_err(|error| errors::of_scene(&error))?;
    Ok(Scene::new(scene, &remarks))
}

/// Compiles the text of a scene file. Paths in it are relative to the folder of `name`.
#[pyfunction]
pub fn parse(py: Python, text: String, name: &str) -> PyResult<Scene> {
    let scene = py.detach(|| noisefall::parse(name, text)).map_err(|error| errors::of_scene(&error))?;
    Ok(Scene::new(scene, &Remarks::default()))
}

/// Compiles a tree of values, given as JSON. Paths in it are relative to `folder`.
#[pyfunction]
pub fn build(py: Python, json: &str, folder: PathBuf) -> PyResult<Scene> {
    let wrong = |error: &dyn std::fmt::Display| PyValueError::new_err(error.to_string());
    let tree: toml::Table = serde_json::from_str(json).map_err(|error| wrong(&error))?;
    let text = toml::to_string(&tree).map_err(|error| wrong(&error))?;
    parse(py, text, &folder.join("scene").display().to_string())
}

#[pymethods]
impl Scene {
    #[getter]
    fn title(&self) -> &str {
        &self.scene.title
    }

    #[getter]
    fn notes(&self) -> &str {
        &self.scene.notes
    }

    #[getter]
    fn text(&self) -> &str {
        &self.scene.source
    }

    #[getter]
    fn size(&self) -> (u32, u32) {
        self.scene.camera.resolution.into()
    }

    #[getter]
    fn object_count(&self) -> usize {
        self.scene.objects.len()
    }

    #[getter]
    fn warnings(&self, py: Python) -> Vec<String> {
        py.detach(|| self.scene.warnings().to_vec())
    }

    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.remarks.clone()
    }

    /// Renders an image. `settings` is JSON.
    fn render(&self, py: Python, settings: &str, callback: Option<Py<PyAny>>) -> PyResult<Image> {
        render::render(py, &self.scene, &Settings::parse(settings)?, callback.as_ref())
    }

    /// Replays a sample: its terms as JSON, and as text.
    fn replay(&self, py: Python, pixel: [u32; 2], sample: u32, settings: &str) -> PyResult<(String, String)> {
        path::replayed(py, &self.scene, pixel, sample, &Settings::parse(settings)?)
    }

    /// The radiance of samples of a pixel, one per row.
    fn samples<'py>(
        &self,
        py: Python<'py>,
        pixel: [u32; 2],
        range: (u32, u32),
        settings: &str,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        path::samples(py, &self.scene, pixel, range.0..range.1, &Settings::parse(settings)?)
    }

    fn __repr__(&self) -> String {
        let [width, height] = self.scene.camera.resolution;
        format!("<noisefall.Scene {:?}, {width} × {height}>", self.scene.title)
    }
}

/// A path as the program prints it.
pub fn named(path: &Path) -> String {
    path.display().to_string()
}
