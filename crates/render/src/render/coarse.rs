//! Coarse images: the first ones of a render, which appear at once.
use std::time::Duration;

use super::film::Film;
use noisefall_scene::scene::Camera;

/// Time limit of the first, coarse image: less than the time between two moves of a dragged camera.
const FIRST_PICTURE: Duration = Duration::from_millis(10);

/// One sample of every `scale`-th pixel.
pub(super) struct Coarse {
    pub scale: u32,
    pub camera: Camera,
    pub film: Film,
}

impl Coarse {
    pub fn new(full: &Camera, scale: u32) -> Option<Coarse> {
        let resolution = full.resolution.map(|side| side.div_ceil(scale));
        (scale > 1).then(|| Coarse { scale, camera: Camera { resolution, ..*full }, film: Film::new(resolution) })
    }

    /// The scale at which the first image meets its time limit.
    pub fn first_scale(camera: &Camera, rate: f64) -> u32 {
        let pixels = camera.resolution.map(f64::from).iter().product::<f64>();
        (pixels / (rate * FIRST_PICTURE.as_secs_f64())).sqrt().ceil() as u32
    }
}
