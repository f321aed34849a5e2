//! Shapes that emit.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    dark,
};
use noisefall_scene::{
    light::emission::{radiance::Radiance, texture::Texture},
    scene::{
        SceneError,
        description::{EmissionDescription, EmissionSource, Textured},
    },
};

/// The emission of a shape. Its front emits.
pub fn emission(import: &mut Import, shape: Element) -> Result<Option<EmissionDescription>, SceneError> {
    let emitters = shape.objects(&["emitter"])?;
    let Some((_, emitter)) = emitters.last() else { return Ok(None) };
    emitter.ignore(&["sampling_weight"]);
    match emitter.kind() {
        "area" => {
            let radiance = import.colour(*emitter, "radiance", 1.0, Role::Emission)?;
            if dark::is_black(import, &radiance) {
                dark::leave_out(import, *emitter);
                return Ok(None);
            }
            let source: EmissionSource = match radiance {
                Textured::Constant(radiance) => Radiance { radiance }.into(),
                Textured::Texture(name) => Texture { name }.into(),
            };
            Ok(Some(EmissionDescription { source, two_sided: false, scale: 1.0 }))
        }
        "directionalarea" => {
            import.remark(*emitter, "nothing", "its light, of a single direction, is missing, as in Mitsuba's path tracer");
            emitter.ignore(&["radiance"]);
            Ok(None)
        }
        _ => {
            import.remark(*emitter, "nothing", "its light is missing");
            Ok(None)
        }
    }
}
