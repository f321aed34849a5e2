//! The settings of a scene file.
use crate::{
    declare::{CountRange, Declare, Parameter, Parameters},
    scene::RenderSettings,
};

/// The settings that a scene opens with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderDescription {
    /// The settings of the estimate.
    pub settings: RenderSettings,
    /// Samples per pixel at which the render stops; `None` is no limit.
    pub spp: Option<u32>,
}

impl RenderDescription {
    /// The target of the render, as files and the window name it.
    pub const SPP: Parameter = Parameter::new("spp", "Samples per pixel at which the render stops. Default: no limit.")
        .title("Stop at")
        .symbol("N")
        .aliases("samples samples_per_pixel sample_count num_samples n");
}

impl Declare for RenderDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        self.settings.parameters(p);
        p.optional(&Self::SPP, &mut self.spp, || 64, |p, spp| p.count(&Self::SPP, spp, CountRange::new(1, u32::MAX)));
    }
}
