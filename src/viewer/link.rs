//! The link to the worker: compares what is wanted with what was last asked for. A difference is a new generation.
use std::sync::Arc;

use noisefall::{
    math::SimdLevel,
    render::{Beside, Budget, Job, Publish, Published, Renderer, pass::Threads},
    scene::{Camera, RenderSettings, Scene},
};

/// While a control is dragged, what it asked for last is waited for so many seconds before it is asked for the next.
const PATIENCE: f64 = 0.1;

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
    /// When that was, in seconds of the window's clock.
    asked: f64,
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
    /// The picture by numbers of bounces.
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
            asked: 0.0,
        }
    }

    /// How far to render what is asked for.
    pub fn set_budget(&mut self, budget: Budget) {
        if budget != self.budget {
            self.renderer.set_budget(budget);
            self.budget = budget;
        }
    }

    /// Asks for what has changed. `now` is the time of the window's clock.
    pub fn update(&mut self, wish: Wish, beside: Option<Companion>, now: f64) {
        let is_new = std::mem::take(&mut self.restarts) || self.wish.as_ref() != Some(&wish);
        if is_new {
            self.generation = self.next(now);
            self.renderer.submit(wish.job(self.generation));
        }
        if self.beside != beside || (is_new && beside.is_some()) {
            self.generation_beside = self.next(now);
            self.renderer.submit_beside(beside.map(|beside| match beside {
                Companion::Other(settings) => Beside::Picture(Job { settings, ..wish.job(self.generation_beside) }),
                Companion::Series => Beside::Series(wish.job(self.generation_beside)),
            }));
            self.beside = beside;
        }
        self.wish = Some(wish);
    }

    fn next(&mut self, now: f64) -> u64 {
        self.asked = now;
        self.latest += 1;
        self.latest
    }

    /// Whether what was asked for last is still to appear, for a little while after it was. `shown` are the generations of the
    /// picture and of the one beside it.
    pub fn is_awaited(&self, shown: [u64; 2], now: f64) -> bool {
        let beside = self.beside.is_some() && shown[1] < self.generation_beside;
        (shown[0] < self.generation || beside) && now - self.asked < PATIENCE
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

    /// When the last picture was asked for.
    #[cfg(test)]
    pub fn asked(&self) -> f64 {
        self.asked
    }

    /// What was asked for last.
    pub fn wish(&self) -> Option<&Wish> {
        self.wish.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use noisefall::scene::built_in;

    use super::*;

    fn link() -> (Link, Wish) {
        let scene = built_in();
        let camera = Camera { resolution: [8, 8], ..scene.camera };
        let wish = Wish { settings: scene.settings, scene: Arc::new(scene), camera };
        (Link::new(Threads::new(1, SimdLevel::best()).expect("a thread can be had"), &egui::Context::default()), wish)
    }

    #[test]
    fn what_was_asked_for_is_awaited_until_it_is_shown_or_patience_ends() {
        let (mut link, wish) = link();
        link.update(wish.clone(), None, 10.0);
        assert_eq!((link.generation(), link.generation_beside()), (1, 0));
        assert!(link.is_awaited([0, 0], 10.0 + 0.9 * PATIENCE));
        assert!(!link.is_awaited([0, 0], 10.0 + 1.1 * PATIENCE), "for a little while only");
        assert!(!link.is_awaited([1, 0], 10.0));
        // Nothing new is nothing to wait for, and the time counts from what was asked last.
        link.update(wish.clone(), None, 20.0);
        assert_eq!(link.generation(), 1);
        let other = Companion::Other(RenderSettings { seed: 5, ..wish.settings });
        link.update(wish.clone(), Some(other), 30.0);
        assert_eq!((link.generation(), link.generation_beside()), (1, 2));
        assert!(link.is_awaited([1, 0], 30.0) && !link.is_awaited([1, 2], 30.0), "the picture beside is awaited too");
        link.update(wish, None, 40.0);
        assert!(!link.is_awaited([1, 0], 40.0), "but not when it is gone");
    }

    #[test]
    fn only_what_a_picture_depends_on_starts_a_new_one() {
        let (mut link, wish) = link();
        link.update(wish.clone(), None, 0.0);
        assert!(link.is_asked(&wish, None) && !link.is_asked(&wish, Some(Companion::Series)));
        link.set_budget(Budget { max_spp: Some(3), ..Budget::default() });
        link.update(wish.clone(), None, 0.0);
        assert_eq!(link.generation(), 1);
        let of_settings = Wish { settings: RenderSettings { seed: 1, ..wish.settings }, ..wish.clone() };
        let of_camera = Wish { camera: Camera { fov: 20.0, ..wish.camera }, ..wish.clone() };
        let of_scene = Wish { scene: Arc::new(built_in()), ..wish.clone() };
        for (changed, generation) in [(of_settings, 2), (of_camera, 3), (of_scene, 4)] {
            assert!(!link.is_asked(&changed, None));
            link.update(changed, None, 0.0);
            assert_eq!(link.generation(), generation);
        }
        link.update(wish.clone(), None, 0.0);
        link.restart();
        link.update(wish.clone(), None, 0.0);
        link.update(wish.clone(), None, 0.0);
        assert_eq!(link.generation(), 6, "it starts over once");
        // What is beside the picture starts over with it, and anew with other settings.
        let other = |seed| Some(Companion::Other(RenderSettings { seed, ..wish.settings }));
        link.update(wish.clone(), other(1), 0.0);
        link.update(wish.clone(), other(2), 0.0);
        assert_eq!((link.generation(), link.generation_beside()), (6, 8));
        link.restart();
        link.update(wish.clone(), other(2), 0.0);
        assert_eq!((link.generation(), link.generation_beside()), (9, 10));
    }
}
