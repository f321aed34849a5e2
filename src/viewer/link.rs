//! The link to the worker: compares what is wanted with what was last asked for. A difference is a new generation.
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use noisefall::{
    math::SimdLevel,
    render::{Beside, Budget, Job, Publish, Published, Renderer, pass::Threads},
    scene::{Camera, RenderSettings, Scene},
};

/// While a control is dragged, what it asked for last is waited for that long before it is asked for the next.
const PATIENCE: Duration = Duration::from_millis(100);

pub struct Link {
    renderer: Renderer,
    /// Of the last picture asked for, be it the first or the one beside it.
    latest: u64,
    generation: u64,
    generation_beside: u64,
    wish: Option<Wish>,
    beside: Option<Companion>,
    budget: Budget,
    threads: usize,
    restarts: bool,
    asked: Instant,
}

/// Everything a picture depends on. Display settings are not in it, so they cannot restart a render.
#[derive(Clone)]
pub struct Wish {
    pub scene: Arc<Scene>,
    pub camera: Camera,
    pub settings: RenderSettings,
}

/// What is rendered beside the picture, of the same scene and camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Companion {
    /// The picture by other settings.
    Other(RenderSettings),
    /// The picture by numbers of reflections.
    Series,
}

impl PartialEq for Wish {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.camera == other.camera && self.settings == other.settings
    }
}

impl Wish {
    fn job(&self, generation: u64) -> Job {
        let Wish { scene, camera, settings } = self.clone();
        Job { generation, scene, camera, settings }
    }
}

impl Link {
    pub fn new(threads: Threads, ctx: &egui::Context) -> Link {
        let ctx = ctx.clone();
        let count = threads.count();
        let renderer = Renderer::new(threads, Publish::Live, move || ctx.request_repaint());
        Link {
            renderer,
            latest: 0,
            generation: 0,
            generation_beside: 0,
            wish: None,
            beside: None,
            budget: Budget::default(),
            threads: count,
            restarts: false,
            asked: Instant::now(),
        }
    }

    /// How far to render what is asked for.
    pub fn set_budget(&mut self, budget: Budget) {
        if budget != self.budget {
            self.renderer.set_budget(budget);
            self.budget = budget;
        }
    }

    /// Asks for what has changed.
    pub fn update(&mut self, wish: Wish, beside: Option<Companion>) {
        let is_new = std::mem::take(&mut self.restarts) || self.wish.as_ref() != Some(&wish);
        if is_new {
            self.generation = self.next();
            self.renderer.submit(wish.job(self.generation));
        }
        if self.beside != beside || (is_new && beside.is_some()) {
            self.generation_beside = self.next();
            self.renderer.submit_beside(beside.map(|beside| match beside {
                Companion::Other(settings) => Beside::Picture(Job { settings, ..wish.job(self.generation_beside) }),
                Companion::Series => Beside::Series(wish.job(self.generation_beside)),
            }));
            self.beside = beside;
        }
        self.wish = Some(wish);
    }

    fn next(&mut self) -> u64 {
        self.asked = Instant::now();
        self.latest += 1;
        self.latest
    }

    /// Whether what was asked for last is still to appear, for a little while after it was. `shown` are the generations of the
    /// picture and of the one beside it.
    pub fn is_awaited(&self, shown: [u64; 2]) -> bool {
        let beside = self.beside.is_some() && shown[1] < self.generation_beside;
        (shown[0] < self.generation || beside) && self.asked.elapsed() < PATIENCE
    }

    /// Whether this is what was asked for last.
    pub fn is_asked(&self, wish: &Wish, beside: Option<Companion>) -> bool {
        self.wish.as_ref() == Some(wish) && self.beside == beside
    }

    /// The next [`Link::update`] starts over.
    pub fn restart(&mut self) {
        self.restarts = true;
    }

    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Renders on so many threads from now on.
    pub fn set_threads(&mut self, count: usize) -> Result<(), String> {
        if count != self.threads {
            let threads = Threads::new(count, SimdLevel::best()).map_err(|error| error.to_string())?;
            self.renderer.set_threads(threads);
            self.threads = count;
        }
        Ok(())
    }

    /// The number of the picture that was asked for last.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    pub fn generation_beside(&self) -> u64 {
        self.generation_beside
    }

    pub fn latest(&self) -> Published {
        self.renderer.latest()
    }

    pub fn latest_beside(&self) -> Published {
        self.renderer.latest_beside()
    }

    /// What was asked for last.
    pub fn wish(&self) -> Option<&Wish> {
        self.wish.as_ref()
    }
}
