//! The link to the worker: compares what is wanted with what was last asked for. A difference is a new generation.
use std::sync::Arc;

use noisefall::{
    render::{Budget, Job, Publish, Published, Renderer, pass::Threads},
    scene::{Camera, RenderSettings, Scene},
};

pub struct Link {
    renderer: Renderer,
    generation: u64,
    wish: Option<Wish>,
    budget: Budget,
}

/// Everything a picture depends on. Display settings are not in it, so they cannot restart a render.
#[derive(Clone)]
pub struct Wish {
    pub scene: Arc<Scene>,
    pub camera: Camera,
    pub settings: RenderSettings,
}

impl PartialEq for Wish {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.camera == other.camera && self.settings == other.settings
    }
}

impl Link {
    pub fn new(threads: Threads, ctx: &egui::Context) -> Link {
        let ctx = ctx.clone();
        let renderer = Renderer::new(threads, Publish::Live, move || ctx.request_repaint());
        Link { renderer, generation: 0, wish: None, budget: Budget::default() }
    }

    /// Asks for what has changed.
    pub fn update(&mut self, wish: Wish, budget: Budget) {
        if budget != self.budget {
            self.renderer.set_budget(budget);
            self.budget = budget;
        }
        if self.wish.as_ref() != Some(&wish) {
            self.generation += 1;
            let Wish { scene, camera, settings } = wish.clone();
            self.renderer.submit(Job { generation: self.generation, scene, camera, settings });
            self.wish = Some(wish);
        }
    }

    /// The next [`Link::update`] starts over.
    pub fn restart(&mut self) {
        self.wish = None;
    }

    /// The number of the picture that was asked for last.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    pub fn latest(&self) -> Published {
        self.renderer.latest()
    }

    /// What was asked for last.
    pub fn wish(&self) -> Option<&Wish> {
        self.wish.as_ref()
    }
}
