//! Rendered images and their figures.
use std::{path::PathBuf, sync::Arc};

use noisefall::{Camera, Display, Frame, Reference, RenderSettings, Scene, ToneMap, image_file, to_srgb};
use noisefall_base::declare::SettingValue;
use noisefall_render::render::{Status, settings_text::settings_text};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*};
use serde_json::json;

use crate::{errors, pixels::Pixels, settings::wrong};

/// A rendered image: its pixels, and everything that they depend on.
#[pyclass(frozen, module = "noisefall._noisefall")]
pub struct Image {
    pub picture: Picture,
}

/// The contents of an image.
pub struct Picture {
    pub scene: Arc<Scene>,
    pub camera: Camera,
    pub settings: RenderSettings,
    pub frame: Arc<Frame>,
    pub status: Status,
    /// A frame with the series by bounces.
    pub bounces: Option<Arc<Frame>>,
    pub stopped_by: &'static str,
}

impl Image {
    pub fn new(picture: Picture) -> Image {
        Image { picture }
    }

    fn display(&self, exposure: Option<f32>, tone: Option<&str>) -> PyResult<Display> {
        let exposure = exposure.unwrap_or(self.picture.scene.exposure);
        if exposure.is_nan() || exposure.abs() > 100.0 {
            return Err(PyValueError::new_err("exposure: expected stops, from -100 to 100, such as -1.5"));
        }
        let tone_map = match tone {
            None => ToneMap::default(),
            Some(name) => ToneMap::read(name).ok_or_else(|| wrong("tone", &ToneMap::accepted().to_string()))?,
        };
        Ok(Display { exposure, tone_map, ..Display::default() })
    }
}

#[pymethods]
impl Image {
    #[getter]
    fn radiance(&self) -> Pixels {
        Pixels::colours(&self.picture.frame, |frame| &frame.radiance)
    }

    #[getter]
    fn variance(&self) -> Option<Pixels> {
        let frame = &self.picture.frame;
        frame.noise.as_ref()?;
        Some(Pixels::colours(frame, |frame| frame.noise.as_ref().map_or(&[], |noise| &noise.variance)))
    }

    #[getter]
    fn standard_error(&self) -> Pixels {
        Pixels::numbers(&self.picture.frame, |frame| &frame.standard_error)
    }

    /// Sample counts of the pixels; `None` if all have the same.
    #[getter]
    fn counts(&self) -> Option<Pixels> {
        (!self.picture.frame.counts.is_empty()).then(|| Pixels::counts(&self.picture.frame))
    }

    /// Images by number of bounces; the last one has all others.
    #[getter]
    fn bounces(&self) -> Option<Vec<Pixels>> {
        let frame = self.picture.bounces.as_ref()?;
        let count = frame.series.as_ref()?.terms.len();
        Some((0..count).map(|k| bounce(frame, k)).collect())
    }

    /// The figures, as JSON.
    fn figures(&self) -> String {
        let Picture { frame, status, settings, scene, camera, stopped_by, .. } = &self.picture;
        let is_of_scene = Camera { resolution: camera.resolution, ..scene.camera } == *camera;
        let truth = Reference::of(scene).filter(|truth| is_of_scene && truth.mismatch(camera.resolution).is_none());
        let error = truth.as_ref().and_then(|truth| truth.compare(frame));
        json!({
            "width": frame.width,
            "height": frame.height,
            "estimator": settings.estimator.name(),
            "directions": settings.directions.name(),
            "sampler": settings.sampler.name(),
            "roulette": settings.roulette.name(),
            "max_bounces": settings.max_bounces,
            "reuse": settings.reuse.name(),
            "adaptive": if settings.adaptive { "on" } else { "off" },
            "seed": settings.seed,
            "spp": frame.spp,
            "mean_spp": frame.sample_counts().mean(),
            "stopped_by": stopped_by,
            "path_reuse": status.path_reuse.name(),
            "adapts": status.adapts,
            "seconds": frame.elapsed.as_secs_f64(),
            "paths": status.samples,
            "rays": status.rays,
            "rel_mse_estimate": frame.rel_mse_estimate,
            "rmse": error.map(|error| error.rmse),
            "rel_mse": error.map(|error| error.rel_mse),
            "bias": error.map(|error| error.bias),
            "biased": status.bias(settings),
            "cut_paths": status.cut_paths,
            "invalid_samples": status.invalid_samples,
        })
        .to_string()
    }

    /// The pixels as displayed: 8-bit sRGB with an opaque fourth channel.
    fn srgb<'py>(&self, py: Python<'py>, exposure: Option<f32>, tone: Option<&str>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let display = self.display(exposure, tone)?;
        let frame = &self.picture.frame;
        let codes = py.detach(|| {
            let mut pixels = Vec::new();
            to_srgb(&frame.radiance, display, &mut pixels);
            pixels.into_flattened()
        });
        PyArray1::from_vec(py, codes).reshape([frame.height as usize, frame.width as usize, 4])
    }

    /// Writes a PNG or EXR, by the extension, with all that the image depends on.
    fn save(&self, py: Python, path: PathBuf, exposure: Option<f32>, tone: Option<&str>) -> PyResult<()> {
        let display = self.display(exposure, tone)?;
        let Picture { frame, settings, scene, camera, .. } = &self.picture;
        let text = settings_text(scene, camera, settings, display, frame, &[]);
        py.detach(|| image_file::save(frame, display, &text, &path)).map_err(|error| errors::of_image(&error))
    }
}

fn bounce(frame: &Arc<Frame>, k: usize) -> Pixels {
    Pixels::colours(frame, |frame| frame.series.as_ref().map_or(&[], |series| &series.terms[k]))
}
