//! Progressive rendering, with a callback that can stop it.
use std::sync::Arc;

use crossbeam_channel::{Receiver, RecvTimeoutError, bounded};
use noisefall::{
    Budget, Camera, Film, Frame, Publish, Published, RenderRequest, RenderSettings, RenderTask, Renderer, Scene, SimdLevel,
    State, Target, Threads,
};
use pyo3::{prelude::*, types::PyBool};

use crate::{
    errors::RenderError,
    image::{Image, Picture},
    interrupt::{INTERVAL, raise_signal},
    settings::Settings,
};

/// Number of the only image of a renderer.
const IMAGE: u64 = 1;
/// The value of `stopped_by` if the callback stopped the render.
const STOPPED: &str = "callback";

/// Renders an image. `callback` is called with the image so far, and stops the render if it returns `False`.
pub fn render(py: Python, scene: &Arc<Scene>, settings: &Settings, callback: Option<&Py<PyAny>>) -> PyResult<Image> {
    let job = Job::new(scene, settings)?;
    py.detach(|| job.run(callback))
}

/// An image to render.
struct Job {
    scene: Arc<Scene>,
    camera: Camera,
    settings: RenderSettings,
    budget: Budget,
    /// Sample counts at which the callback is called, in ascending order; at its leisure if there are none.
    stops: Vec<u32>,
    threads: usize,
    bounces: bool,
}

/// Whether the render goes on.
type GoesOn = bool;

impl Job {
    fn new(scene: &Arc<Scene>, settings: &Settings) -> PyResult<Job> {
        let budget = settings.budget(scene)?;
        let mut stops = settings.stops.clone();
        stops.retain(|stop| *stop > 0 && budget.max_spp.is_none_or(|most| *stop < most));
        stops.sort_unstable();
        stops.dedup();
        Ok(Job {
            scene: scene.clone(),
            camera: settings.camera(scene)?,
            settings: settings.settings(scene)?,
            budget,
            stops,
            threads: settings.threads.into(),
            bounces: settings.bounces,
        })
    }

    fn run(&self, callback: Option<&Py<PyAny>>) -> PyResult<Image> {
        let failed = |error: &dyn std::fmt::Display| RenderError::new_err(error.to_string());
        let [width, height] = self.camera.resolution;
        let _memory = Film::reserve([width, height]).map_err(|error| failed(&error))?;
        let _series = self.bounces.then(|| Film::reserve_series([width, height])).transpose().map_err(|error| failed(&error))?;
        let threads = Threads::new(self.threads, SimdLevel::best()).map_err(|error| failed(&error))?;
        let (wake, woken) = bounded(1);
        let renderer = Renderer::new(threads, Publish::Sparse, move || {
            let _ = wake.try_send(());
        });
        let worker = Worker { renderer, woken };
        let (published, stopped_by) = self.picture(&worker, callback)?;
        // A render that its callback stopped had no target: that of its bounces is what it has.
        let target = match stopped_by {
            STOPPED => Budget { max_spp: Some(published.frame.spp.max(1)), ..Budget::default() },
            _ => self.budget,
        };
        let series = self.bounces.then(|| self.series(&worker, target)).transpose()?;
        Ok(self.image(&published, series.as_ref(), stopped_by))
    }

    /// Renders the image from stop to stop. Returns it with what ended it.
    fn picture(&self, worker: &Worker, callback: Option<&Py<PyAny>>) -> PyResult<(Published, &'static str)> {
        let mut seen: Option<Arc<Frame>> = None;
        let mut show = |published: &Published| -> PyResult<GoesOn> {
            let is_new = published.frame.spp > 0 && seen.as_ref().is_none_or(|seen| !Arc::ptr_eq(seen, &published.frame));
            let Some(callback) = callback.filter(|_| is_new) else { return Ok(true) };
            seen = Some(published.frame.clone());
            Python::attach(|py| {
                let answer = callback.call1(py, (self.image(published, None, "running"),))?;
                Ok(!answer.bind(py).is(PyBool::new(py, false)))
            })
        };
        let last = self.budget.max_spp;
        let mut stops = self.stops.iter().copied().map(Some);
        let mut stop = stops.next().unwrap_or(last);
        worker.renderer.set_budget(Budget { max_spp: stop, ..self.budget });
        worker.renderer.submit(IMAGE, self.request());
        loop {
            // Between stops that are asked for, nobody looks.
            let mut glance = |published: &Published| if self.stops.is_empty() { show(published) } else { Ok(true) };
            let (published, reached) = worker.wait(Renderer::latest, stop, &mut glance)?;
            let goes_on = show(&published)?;
            match reached {
                Some(Target::Samples(_)) if stop != last && goes_on => {}
                Some(target) if stop == last || !matches!(target, Target::Samples(_)) => return Ok((published, target.name())),
                _ => return Ok((published, STOPPED)),
            }
            stop = stops.next().unwrap_or(last);
            worker.renderer.set_budget(Budget { max_spp: stop, ..self.budget });
        }
    }

    /// Renders the image by number of bounces, with samples of its own.
    fn series(&self, worker: &Worker, budget: Budget) -> PyResult<Published> {
        worker.renderer.set_budget(budget);
        worker.renderer.submit_second(IMAGE, RenderTask::Series(self.request()));
        worker.wait(Renderer::latest_second, budget.max_spp, &mut |_| Ok(true)).map(|(published, _)| published)
    }

    fn request(&self) -> RenderRequest {
        RenderRequest { scene: self.scene.clone(), camera: self.camera, settings: self.settings }
    }

    fn image(&self, published: &Published, series: Option<&Published>, stopped_by: &'static str) -> Image {
        Image::new(Picture {
            scene: self.scene.clone(),
            camera: self.camera,
            settings: self.settings,
            frame: published.frame.clone(),
            status: published.status.clone(),
            bounces: series.map(|series| series.frame.clone()),
            stopped_by,
        })
    }
}

/// The render thread.
struct Worker {
    renderer: Renderer,
    woken: Receiver<()>,
}

impl Worker {
    /// Waits until an image has reached a target, or `watch` ends the wait: there is no target then.
    fn wait(
        &self,
        latest: fn(&Renderer) -> Published,
        stop: Option<u32>,
        watch: &mut dyn FnMut(&Published) -> PyResult<GoesOn>,
    ) -> PyResult<(Published, Option<Target>)> {
        loop {
            let woken = self.woken.recv_timeout(INTERVAL);
            if woken == Err(RecvTimeoutError::Disconnected) {
                return Err(RenderError::new_err("the render thread ended unexpectedly"));
            }
            Python::attach(raise_signal)?;
            let published = latest(&self.renderer);
            if published.status.generation != IMAGE {
                continue;
            }
            match &published.status.state {
                State::Failed(failure) => return Err(RenderError::new_err(format!("the renderer failed: {}", failure.message))),
                // The figures may still be those of an earlier stop.
                State::Done(Target::Samples(spp)) if stop.is_some_and(|stop| *spp < stop) => {}
                State::Done(target) => {
                    let target = *target;
                    return Ok((published, Some(target)));
                }
                _ if !watch(&published)? => return Ok((published, None)),
                _ => {}
            }
        }
    }
}
