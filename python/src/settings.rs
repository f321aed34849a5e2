//! Settings of a render, as the options of `noisefall render` state them.
use std::time::Duration;

use noisefall::{Budget, Camera, RenderSettings, Scene};
use pyo3::{PyErr, PyResult, exceptions::PyValueError};
use serde::Deserialize;
use serde_json::{Map, Value};

/// Samples per pixel if neither the settings nor the scene state a number: those of `noisefall render`.
const DEFAULT_SPP: u32 = 256;

/// Settings that differ from those of the scene.
#[derive(Default, Deserialize)]
#[serde(default)]
pub struct Settings {
    spp: Option<u32>,
    time: Option<f64>,
    noise: Option<f64>,
    size: Option<[u32; 2]>,
    pub threads: u16,
    /// Sample counts at which the render is looked at.
    pub stops: Vec<u32>,
    pub bounces: bool,
    /// Settings of the estimate, by their keys.
    #[serde(flatten)]
    of_estimate: Map<String, Value>,
}

impl Settings {
    pub fn parse(json: &str) -> PyResult<Settings> {
        serde_json::from_str(json).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    pub fn camera(&self, scene: &Scene) -> PyResult<Camera> {
        let camera = Camera { resolution: self.size.unwrap_or(scene.camera.resolution), ..scene.camera };
        camera.check().map(|()| camera).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    pub fn settings(&self, scene: &Scene) -> PyResult<RenderSettings> {
        let mut settings = scene.settings;
        for (key, value) in &self.of_estimate {
            let setting = RenderSettings::setting(key).ok_or_else(|| PyValueError::new_err(format!("unknown setting: {key}")))?;
            setting.read(&mut settings, &word(value)).map_err(|expected| PyValueError::new_err(format!("{key}: {expected}")))?;
        }
        Ok(settings)
    }

    /// Returns the limits of samples, time and noise.
    pub fn budget(&self, scene: &Scene) -> PyResult<Budget> {
        let by_samples = self.time.is_none() && self.noise.is_none();
        let max_spp = self.spp.or_else(|| by_samples.then(|| scene.spp.unwrap_or(DEFAULT_SPP)));
        if max_spp == Some(0) {
            return Err(wrong("spp", "a whole number, 1 or more"));
        }
        let seconds = |seconds: f64| Duration::try_from_secs_f64(seconds).ok().filter(|time| !time.is_zero());
        let max_time = match self.time {
            None => None,
            Some(time) => Some(seconds(time).ok_or_else(|| wrong("time", "a number of seconds above 0"))?),
        };
        if self.noise.is_some_and(|noise| !(noise > 0.0 && noise.is_finite())) {
            return Err(wrong("noise", "a number above 0, such as 0.01 for 1 %"));
        }
        Ok(Budget { max_spp, max_time, noise: self.noise, ..Budget::default() })
    }
}

/// A value as a word of the command line.
fn word(value: &Value) -> String {
    match value {
        Value::Bool(true) => "on".to_owned(),
        Value::Bool(false) => "off".to_owned(),
        Value::String(word) => word.clone(),
        value => value.to_string(),
    }
}

pub fn wrong(name: &str, expected: &str) -> PyErr {
    PyValueError::new_err(format!("{name}: expected {expected}"))
}
