//! The render of one image: its films, from coarse to full, and the size of the next pass.
mod cache;
mod checkpointing;
mod publishing;

use std::time::{Duration, Instant};

pub(super) use self::cache::SessionCache;
use super::{
    block::UNIFORM,
    coarse::Coarse,
    error_estimator::rel_mse_estimate,
    film::Film,
    halves::Halves,
    pass::{Failure, PassCount, SampleId},
    path_reuse::resolved_unless,
    protocol::{Budget, Publish, RenderRequest, State, is_below, next_look},
    region::Region,
    splats::SplatFilm,
    threads::{PassJob, Threads},
};
use noisefall_base::memory::{Reservation, TooMuch};
use noisefall_scene::scene::{Estimator, PathReuse, RenderSettings, Reuse};

/// Camera samples per second before the first measurement: those of a slow machine with a simple scene.
const UNKNOWN_RATE: f64 = 1e6;
const MOST_SPP_A_PASS: f64 = 1024.0;
/// A pause waits for the first full sample of an image, but at most for this time.
const PATIENCE: Duration = Duration::from_secs(1);

/// A request and its films.
pub(super) struct Session {
    /// Number of the image.
    generation: u64,
    request: RenderRequest,
    /// The image at a lower resolution, for display until the full one has a sample everywhere.
    coarse: Option<Coarse>,
    film: Film,
    count: PassCount,
    elapsed: Duration,
    /// Last measured camera samples per second.
    rate: Option<f64>,
    steps_done: u64,
    rel_mse_estimate: Option<f64>,
    error_is_lower_bound: bool,
    /// The region that is rendered before the rest, and its estimated relMSE.
    region_estimate: Option<(Region, f64)>,
    /// Path reuse between pixels.
    path_reuse: PathReuse,
    /// Whether the first samples are of another scene or program.
    is_mixed: bool,
    last_frame: Option<Instant>,
    /// Whether there are samples that no frame shows.
    stale: bool,
    /// Memory of the image, and of the series.
    memory: [Option<Reservation>; 2],
    /// Memory of half images, if frames have them.
    halves: Option<Reservation>,
}

impl Session {
    /// Starts a session. `rate`: known camera samples per second of the same scene. `film`: an old film to reuse.
    pub fn new(
        generation: u64,
        request: RenderRequest,
        publish: Publish,
        rate: Option<f64>,
        budget: &Budget,
        film: Option<Film>,
    ) -> Session {
        let scale = Coarse::first_scale(&request.camera, rate.unwrap_or(UNKNOWN_RATE));
        let memory = Film::reserve(request.camera.resolution);
        let mut session = Session {
            coarse: if publish == Publish::Live { Coarse::new(&request.camera, scale) } else { None },
            film: film.map_or_else(|| Film::new(request.camera.resolution), |film| film.recycled(request.camera.resolution)),
            count: PassCount::default(),
            elapsed: Duration::ZERO,
            rate,
            steps_done: budget.steps,
            rel_mse_estimate: None,
            error_is_lower_bound: false,
            region_estimate: None,
            path_reuse: PathReuse::Off,
            is_mixed: false,
            last_frame: None,
            stale: false,
            memory: [None, None],
            halves: None,
            generation,
            request,
        };
        session.keep(0, memory);
        let RenderRequest { scene, camera, settings } = &session.request;
        if scene.traces_light_paths(settings) || settings.estimator == Estimator::Auto {
            session.keep(1, SplatFilm::reserve(camera.resolution));
        }
        session
    }

    /// Keeps the reservation for the image or the series, or fails if there is none.
    fn keep(&mut self, which: usize, memory: Result<Reservation, TooMuch>) {
        match memory {
            Ok(memory) => self.memory[which] = Some(memory),
            Err(error) => {
                let (at, resolution) = (SampleId { pixel: [0, 0], sample: 0 }, self.request.camera.resolution);
                self.count.failure = Some(Failure { at, replays: false, resolution, message: error.to_string() });
            }
        }
    }

    /// A session that stores the contribution of each number of bounces separately. Its pixels do not reuse paths, and have the
    /// same number of samples.
    pub fn of_series(generation: u64, request: RenderRequest, rate: Option<f64>, budget: &Budget) -> Session {
        let settings = RenderSettings { reuse: Reuse::Off, adaptive: false, ..request.settings };
        let mut session = Session::new(generation, RenderRequest { settings, ..request }, Publish::Sparse, rate, budget, None);
        session.keep(1, Film::reserve_series(session.request.camera.resolution));
        if session.count.failure.is_none() {
            session.film.keep_series();
        }
        // The image that it is the series of is there to look at.
        session.last_frame = Some(Instant::now());
        session
    }

    /// Adds half images to frames, or leaves them out. Drops kept sessions until there is memory for them. If that is too little,
    /// frames do without.
    pub fn keep_halves(&mut self, keeps: bool, kept: &mut SessionCache) {
        if keeps != self.halves.is_some() {
            let resolution = self.request.camera.resolution;
            self.halves = if keeps { kept.reserve(|| Halves::reserve(resolution)) } else { None };
            self.stale |= self.halves.is_some() && self.film.spp() > 0;
        }
    }

    /// The number of the request.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    pub fn request(&self) -> &RenderRequest {
        &self.request
    }

    pub fn into_film(self) -> Film {
        self.film
    }

    /// Whether the image is a series by bounces.
    pub fn has_series(&self) -> bool {
        self.film.has_series()
    }

    /// Whether the next frame is a coarse one.
    pub fn is_coarse(&self) -> bool {
        self.coarse.is_some()
    }

    /// Render time.
    pub fn elapsed(&self) -> Duration {
        self.elapsed
    }

    pub fn rate(&self) -> Option<f64> {
        self.rate
    }

    /// The state for a budget. Every image gets its first sample, even if paused, so that the user sees the effect of a change.
    pub fn state(&self, budget: &Budget) -> State {
        let spp = self.film.spp();
        if let Some(failure) = &self.count.failure {
            State::Failed(failure.clone())
        } else if let Some(target) = budget.target(spp, self.elapsed, self.noise_to_look_at(budget)) {
            State::Done(target)
        } else if budget.paused && budget.steps <= self.steps_done && (spp > 0 || self.takes_long()) {
            State::Paused
        } else {
            State::Running
        }
    }

    /// The estimated relMSE of the samples so far, if a target asks for it. That of the last frame may be of fewer.
    fn noise_to_look_at(&self, budget: &Budget) -> Option<f64> {
        let spp = self.film.spp();
        budget
            .noise
            .filter(|goal| is_below(*goal, spp, Some(0.0)) && self.coarse.is_none())
            .and_then(|_| rel_mse_estimate(&self.film))
    }

    /// The region to render before the rest, until it reaches the samples or the noise of the budget. Every pixel has its first
    /// sample before.
    fn focus(&self, budget: &Budget) -> Option<Region> {
        let estimate = |region: &Region| self.region_estimate.filter(|(of, _)| of == region).map(|(_, rel_mse)| rel_mse);
        let unfinished = |region: &Region| {
            let Some(spp) = self.film.spp_in(region) else { return false };
            let low_noise = budget.noise.is_some_and(|goal| is_below(goal, spp, estimate(region)));
            budget.max_spp.is_none_or(|most| spp < most) && !low_noise
        };
        budget.region.filter(|region| self.film.spp() > 0 && unfinished(region))
    }

    /// Samples of every pixel that currently gets samples.
    fn spp_in_focus(&self) -> u32 {
        self.film.focus.and_then(|region| self.film.spp_in(&region)).unwrap_or_else(|| self.film.spp())
    }

    /// Whether the first sample is incomplete although a coarse image has been visible for a while.
    fn takes_long(&self) -> bool {
        self.last_frame.is_some_and(|coarse| coarse.elapsed() > PATIENCE)
    }

    /// Renders until the next frame is due, or until interrupted.
    pub fn advance(&mut self, threads: &Threads, budget: &Budget, publish: Publish, interrupted: &(dyn Fn() -> bool + Sync)) {
        if self.coarse.is_some() {
            self.coarse_pass(threads, interrupted);
            return;
        }
        self.film.focus = self.focus(budget);
        let spp = self.spp_in_focus();
        let target = if budget.paused { spp + 1 } else { self.target_of_pass(budget, publish) };
        let RenderRequest { scene, camera, settings } = &self.request;
        let rays = scene.rays(camera);
        let begun = Instant::now();
        let resolved = threads.install(|| resolved_unless(scene, &rays, settings, interrupted));
        // The time of a trial is part of the time of the image.
        self.elapsed += begun.elapsed();
        let Ok(settings) = resolved else { return };
        self.path_reuse = scene.path_reuse(&rays, &settings);
        let start = Instant::now();
        let time_left = budget.max_time.filter(|_| spp > 0).map(|most| most.saturating_sub(self.elapsed));
        let last_frame = self.last_frame;
        let impatient = || budget.paused && spp == 0 && last_frame.is_some_and(|coarse: Instant| coarse.elapsed() > PATIENCE);
        let enough = || interrupted() || impatient() || time_left.is_some_and(|left| start.elapsed() >= left);
        let job = PassJob { scene: &self.request.scene, rays: &rays, settings: &settings };
        let before = self.film.samples();
        let count = threads.pass(job, &mut self.film, target, &enough);
        let samples = self.film.samples() - before;
        let took = start.elapsed();

        self.elapsed += took;
        self.measure(samples, took);
        self.stale |= samples > 0;
        self.count = std::mem::take(&mut self.count).merge(count);
        if !budget.paused {
            self.steps_done = budget.steps;
        } else if self.spp_in_focus() == target && spp > 0 {
            self.steps_done += 1;
        }
    }

    fn coarse_pass(&mut self, threads: &Threads, interrupted: &(dyn Fn() -> bool + Sync)) {
        let Some(coarse) = &mut self.coarse else { return };
        let job = PassJob {
            scene: &self.request.scene,
            rays: &self.request.scene.rays(&coarse.camera),
            // It is shown for too short a time for a pilot of outliers.
            settings: &RenderSettings { reuse: Reuse::Off, ..self.request.settings },
        };
        let start = Instant::now();
        let before = coarse.film.samples();
        let count = threads.pass(job, &mut coarse.film, 1, interrupted);
        let samples = coarse.film.samples() - before;
        let complete = coarse.film.spp() > 0;
        self.measure(samples, start.elapsed());
        self.stale |= complete;
        self.count.failure = count.failure;
    }

    fn measure(&mut self, samples: u64, took: Duration) {
        const ENOUGH_TO_TELL: u64 = 1024;
        if samples >= ENOUGH_TO_TELL {
            self.rate = Some(samples as f64 / took.as_secs_f64().max(1e-9));
        }
    }

    /// The samples of every pixel after the next pass.
    fn target_of_pass(&self, budget: &Budget, publish: Publish) -> u32 {
        let spp = self.spp_in_focus();
        let target = spp + self.spp_of_pass(budget, publish);
        let target = budget.noise.map_or(target, |_| target.min(next_look(spp)));
        // The first doubling of the average ends together for all blocks, so that records of noise do not depend on the passes.
        let first = if self.request.settings.adaptive && target > UNIFORM { target.max(2 * UNIFORM) } else { target };
        budget.max_spp.map_or(first, |most| first.min(most.max(target)))
    }

    /// The number of samples that fit between two frames.
    fn spp_of_pass(&self, budget: &Budget, publish: Publish) -> u32 {
        let resolution = self.request.camera.resolution;
        let size = self.film.focus.map_or(resolution, |region| region.in_tiles(resolution).size());
        let pixels = size.map(f64::from).iter().product::<f64>().max(1.0);
        let time_left = budget.max_time.map_or(Duration::MAX, |most| most.saturating_sub(self.elapsed));
        let time = self.interval(publish).min(time_left).as_secs_f64();
        let fits = (self.rate.unwrap_or(UNKNOWN_RATE) * time / pixels).clamp(1.0, MOST_SPP_A_PASS) as u32;
        budget.max_spp.map_or(fits, |most| fits.min(most.saturating_sub(self.spp_in_focus())))
    }
}

#[cfg(test)]
mod tests;
