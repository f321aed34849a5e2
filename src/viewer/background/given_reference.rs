//! References that are given by the user: files, and rendered images.
use std::sync::Arc;

use noisefall_render::render::{
    Frame, RenderRequest,
    image_file::{Picture, Provenance},
    reference::Reference,
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, PathReuse, Scene},
};

/// An image that renders are compared with.
pub struct GivenReference {
    /// Name of its file, or what was rendered.
    pub name: String,
    pub reference: Arc<Reference>,
    /// The camera that it is for.
    pub camera: Camera,
    /// The scene that was rendered; `None` for a file, which is taken to be of any.
    pub scene: Option<Arc<Scene>>,
}

impl GivenReference {
    /// An image that was rendered here.
    pub fn rendered(name: &str, frame: &Frame, request: &RenderRequest) -> GivenReference {
        let picture = Picture { width: frame.width, height: frame.height, radiance: frame.radiance.clone() };
        let settings = &request.settings;
        let provenance = Provenance {
            noise: frame.noise.clone(),
            rel_mse_estimate: frame.rel_mse_estimate,
            seed: Some(settings.seed.into()),
            is_independent: settings.sampler == Sampler::Independent && frame.path_reuse == PathReuse::Off,
            is_denoised: false,
        };
        let reference = Arc::new(Reference::Picture(Arc::new(picture), Arc::new(provenance)));
        GivenReference { name: name.to_owned(), reference, camera: request.camera, scene: Some(request.scene.clone()) }
    }

    /// Whether it is an image of what is rendered. The resolution is compared elsewhere.
    pub fn is_of(&self, request: &RenderRequest) -> bool {
        let camera = Camera { resolution: request.camera.resolution, ..self.camera };
        camera == request.camera && self.scene.as_ref().is_none_or(|scene| scene.has_same_image(&request.scene))
    }
}
