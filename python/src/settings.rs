//! Settings of a render, as the options of `noisefall render` state them.
use std::time::Duration;

use noisefall::{Budget, Camera, Estimator, RenderSettings, Reuse, Roulette, Sampler, Scene};
use noisefall_base::declare::Words;
use noisefall_scene::sampling::Directions;
use pyo3::{PyErr, PyResult, exceptions::PyValueError};
use serde::Deserialize;

/// Samples per pixel if neither the settings nor the scene state a number: those of `noisefall render`.
const DEFAULT_SPP: u32 = 256;

/// Settings that differ from those of the scene.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    spp: Option<u32>,
    time: Option<f64>,
    noise: Option<f64>,
    size: Option<[u32; 2]>,
    pub threads: u16,
    /// Sample counts at which the render is looked at.
    pub stops: Vec<u32>,
    pub bounces: bool,
    estimator: Option<String>,
    sampler: Option<String>,
    directions: Option<String>,
    roulette: Option<String>,
    max_bounces: Option<Cap>,
    reuse: Option<String>,
    adaptive: Option<bool>,
    merging: Option<bool>,
    seed: Option<u32>,
}

/// A cap on bounces, or `"none"`.
#[derive(Deserialize)]
#[serde(untagged)]
enum Cap {
    Bounces(u32),
    Word(String),
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
        let of_scene = scene.settings;
        let max_bounces = match &self.max_bounces {
            None => of_scene.max_bounces,
            Some(Cap::Bounces(cap)) => Some(*cap),
            Some(Cap::Word(word)) if word == "none" => None,
            Some(Cap::Word(_)) => return Err(wrong("max_bounces", "a whole number, 0 or more, or `none`")),
        };
        let roulette = match &self.roulette {
            None => of_scene.roulette,
            Some(text) => Roulette::named(text).ok_or_else(|| wrong("roulette", &Roulette::options().join(", ")))?,
        };
        Ok(RenderSettings {
            estimator: word::<Estimator>("estimator", self.estimator.as_deref(), of_scene.estimator)?,
            sampler: word::<Sampler>("sampler", self.sampler.as_deref(), of_scene.sampler)?,
            directions: word::<Directions>("directions", self.directions.as_deref(), of_scene.directions)?,
            reuse: word::<Reuse>("reuse", self.reuse.as_deref(), of_scene.reuse)?,
            adaptive: self.adaptive.unwrap_or(of_scene.adaptive),
            merging: self.merging.unwrap_or(of_scene.merging),
            seed: self.seed.unwrap_or(of_scene.seed),
            roulette,
            strategy: of_scene.strategy,
            fault: None,
            max_bounces,
            count_crossings: of_scene.count_crossings,
        })
    }

    /// How far to render.
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

/// The value of a word, or that of the scene without one.
pub fn word<T: Words>(name: &str, text: Option<&str>, of_scene: T) -> PyResult<T> {
    let Some(text) = text else { return Ok(of_scene) };
    let found = T::words().iter().find(|(word, _)| word.name == text);
    let names = || T::words().iter().map(|(word, _)| word.name).collect::<Vec<_>>().join(", ");
    found.map(|(_, value)| *value).ok_or_else(|| wrong(name, &names()))
}

fn wrong(name: &str, expected: &str) -> PyErr {
    PyValueError::new_err(format!("{name}: expected {expected}"))
}
