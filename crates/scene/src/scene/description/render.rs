//! The settings of a scene file.
use crate::scene::RenderSettings;
use noisefall_base::declare::{CountRange, Declare, Parameter, Parameters, Range};

/// The settings that a scene opens with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderDescription {
    /// The settings of the estimate.
    pub settings: RenderSettings,
    /// Samples per pixel at which the render stops; `None` is no limit.
    pub spp: Option<u32>,
    /// Exposure of the displayed image, stops. No sample depends on it.
    pub exposure: f32,
}

impl RenderDescription {
    /// The target of the render, as files and the window name it.
    pub const SPP: Parameter = Parameter::new("spp", "Samples per pixel at which the render stops. Default: no limit.")
        .title("Stop at")
        .symbol("N")
        .aliases("samples samples_per_pixel sample_count num_samples n");

    /// Whether the renders are the same, with the same target. Their displays may differ.
    pub fn renders_like(&self, other: &RenderDescription) -> bool {
        (self.settings, self.spp) == (other.settings, other.spp)
    }
}

impl Declare for RenderDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const EXPOSURE: Parameter = Parameter::new(
            "exposure",
            "Exposure of the displayed image. One stop doubles the brightness; samples do not change.",
        )
        .unit("stops")
        .aliases("ev");
        self.settings.parameters(p);
        p.optional(&Self::SPP, &mut self.spp, || 64, |p, spp| p.count(&Self::SPP, spp, CountRange::new(1, u32::MAX)));
        p.single(&EXPOSURE, &mut self.exposure, Range::linear(-100.0, 100.0));
    }
}
