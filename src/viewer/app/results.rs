//! Results of the renderer and the display pipeline.
use std::sync::Arc;

use egui::{Context, TextureHandle, TextureOptions};
use noisefall_kernel::measure::LogRatio;
use noisefall_render::render::{
    Frame, Status,
    view::{Legend, ZScoreHistogram},
};
use noisefall_scene::scene::Camera;

use crate::viewer::background::{
    display_image::{DisplayImage, PixelValues, ReferenceComparison},
    exposure_meter::Misfit,
};

#[derive(Default)]
pub struct Results {
    pub status: Status,
    pub second_status: Status,
    /// The frame on the screen.
    pub shown: Option<Arc<Frame>>,
    /// The latest frame of the second view.
    pub second_frame: Option<Arc<Frame>>,
    pub comparison: Option<ReferenceComparison>,
    pub second_comparison: Option<ReferenceComparison>,
    /// Logarithm of the error of A over that of B.
    pub error_ratio: Option<LogRatio>,
    pub legend: Option<Legend>,
    pub values: PixelValues,
    pub second_values: PixelValues,
    pub scores: Option<ZScoreHistogram>,
    /// The image on the screen is black.
    pub black: bool,
    /// Why it is black, and its generation.
    pub black_reason: Option<(u64, String)>,
    /// The last camera whose image was not black.
    pub last_seeing: Option<Camera>,
    /// The first image of the open scene is not measured yet.
    pub awaits_meter: bool,
    /// The exposure with which the scene opened does not suit it.
    pub misfit: Option<Misfit>,
    pub textures: [Option<TextureHandle>; 2],
}

impl Results {
    /// Takes over an image for the screen.
    pub fn show(&mut self, ctx: &Context, image: DisplayImage) {
        // A reduced image has a texel for each pixel of the screen, but for the moment in which the zoom changes.
        let options = if image.is_reduced { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
        set(ctx, &mut self.textures[0], "image", Some(image.image), options);
        set(ctx, &mut self.textures[1], "image beside", image.second_image, options);
        (self.comparison, self.second_comparison) = (image.comparison, image.second_comparison);
        self.error_ratio = image.error_ratio;
        (self.legend, self.values, self.scores) = (image.legend, image.values, image.scores);
        self.second_values = image.second_values;
        self.shown = Some(image.frame);
    }

    /// The likeliest reason why the image on the screen is black, if it is.
    pub fn why_black(&self) -> Option<&str> {
        self.black_reason.as_ref().filter(|_| self.black).map(|(_, reason)| reason.as_str())
    }
}

/// Puts an image into a texture, or takes it away.
fn set(ctx: &Context, texture: &mut Option<TextureHandle>, name: &str, image: Option<egui::ColorImage>, options: TextureOptions) {
    match (texture, image) {
        (Some(texture), Some(image)) => texture.set(image, options),
        (texture, image) => *texture = image.map(|image| ctx.load_texture(name, image, options)),
    }
}
