//! `render --layers`: further channels of an EXR.
use noisefall_base::{declare::Words, math::SimdLevel};
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::{
    Frame,
    layers::{Channel, Layer, LayerSources, channels},
    threads::Threads,
};
use noisefall_scene::scene::{Camera, Scene};

use super::{
    messages::{Failure, tell},
    options,
};

/// Layers of an EXR, in the order of their declaration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers(pub Vec<Layer>);

/// Parses `all`, or a list such as `normal,depth`.
pub fn parse(text: &str) -> Result<Layers, String> {
    if text == "all" {
        return Ok(Layers(Layer::ALL.to_vec()));
    }
    let named = |word: &str| options::word::<Layer>(word.trim());
    let named = text.split(',').map(named).collect::<Result<Vec<Layer>, String>>();
    let named = named.map_err(|_| format!("expected all, or a list of {}", options::one_of::<Layer>()))?;
    Ok(Layers(Layer::words().iter().map(|(_, layer)| *layer).filter(|layer| named.contains(layer)).collect()))
}

impl Layers {
    pub fn has_bounces(&self) -> bool {
        self.0.contains(&Layer::Bounces)
    }

    /// The channels of an image. `bounces` is a frame with its series. The caller has reserved the memory of the channels, and of the
    /// surfaces in them.
    pub fn channels(
        &self,
        scene: &Scene,
        camera: &Camera,
        frame: &Frame,
        bounces: Option<&Frame>,
        threads: &Threads,
    ) -> Result<Vec<Channel>, Failure> {
        let seen = if self.0.iter().any(|layer| layer.needs_features()) { Some(seen(scene, camera, threads)?) } else { None };
        let sources = LayerSources { features: seen.as_ref(), series: bounces.and_then(|frame| frame.series.as_ref()) };
        let (channels, notes) = channels(&self.0, frame, &sources);
        notes.iter().for_each(|note| tell(&format!("warning: {note}")));
        Ok(channels)
    }
}

/// The first surfaces along camera rays.
fn seen(scene: &Scene, camera: &Camera, threads: &Threads) -> Result<Features, Failure> {
    let found = threads.install(|| features(SimdLevel::best(), scene, camera, &|| false));
    found.ok_or_else(|| "the search for the first surfaces was interrupted".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_all_or_a_list_in_one_order() {
        assert_eq!(parse("all"), Ok(Layers(Layer::ALL.to_vec())));
        assert_eq!(parse("depth, normal"), Ok(Layers(vec![Layer::Normal, Layer::Depth])));
        assert_eq!(parse("normal,normal"), Ok(Layers(vec![Layer::Normal])));
        assert!(parse("z").is_err_and(|error| error.contains("all, or a list of bounces, albedo")));
        assert!(parse("").is_err() && parse("all,normal").is_err());
    }
}
