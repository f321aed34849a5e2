//! Single samples: replays and tables.
use std::{
    ops::Range,
    sync::atomic::{AtomicBool, Ordering},
};

use noisefall::{CameraRays, RenderSettings, Scene};
use noisefall_kernel::integrator::{pixel_samples, replay};
use noisefall_render::render::{
    path_text::{self, PathId},
    path_reuse::resolved,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*};
use serde_json::json;

use crate::{interrupt::interruptible, settings::Settings};

/// A sample as JSON and as text.
pub fn replayed(py: Python, scene: &Scene, pixel: [u32; 2], sample: u32, settings: &Settings) -> PyResult<(String, String)> {
    let (camera, settings) = (settings.camera(scene)?, settings.settings(scene)?);
    check(pixel, camera.resolution)?;
    Ok(py.detach(|| {
        let rays = scene.rays(&camera);
        let settings = resolved(scene, &rays, &settings);
        let replay = replay(scene, &rays, &settings, pixel, sample);
        let id = PathId { scene, camera: &camera, settings: &settings, pixel, sample };
        (json!(replay).to_string(), path_text::text(&id, &replay))
    }))
}

/// The radiance of samples, one per row.
pub fn samples<'py>(
    py: Python<'py>,
    scene: &Scene,
    pixel: [u32; 2],
    range: Range<u32>,
    settings: &Settings,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (camera, settings) = (settings.camera(scene)?, settings.settings(scene)?);
    check(pixel, camera.resolution)?;
    let stop = AtomicBool::new(false);
    let count = range.len();
    let trace = || {
        let rays: CameraRays = scene.rays(&camera);
        let settings: RenderSettings = resolved(scene, &rays, &settings);
        pixel_samples(scene, &rays, &settings, pixel, range, &|| stop.load(Ordering::Relaxed))
    };
    let samples = interruptible(py, trace, &|| stop.store(true, Ordering::Relaxed))?.unwrap_or_default();
    PyArray1::from_vec(py, samples.into_flattened()).reshape([count, 3])
}

fn check(pixel: [u32; 2], [width, height]: [u32; 2]) -> PyResult<()> {
    let [x, y] = pixel;
    if x >= width || y >= height {
        return Err(PyValueError::new_err(format!("pixel {x},{y} lies outside the image of {width} × {height}")));
    }
    Ok(())
}
