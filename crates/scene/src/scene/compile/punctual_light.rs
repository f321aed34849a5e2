//! Punctual lights of a description.
use super::problems::Problems;
use crate::{
    light::{PunctualLight, punctual_light::MOST_DIRECTIONAL},
    scene::{PunctualLightInstance, description::PunctualLightDescription},
    shape::product,
};
use noisefall_base::{
    declare::{Path, Problem, Resources},
    quote,
};

/// The lights that emit light.
pub fn punctual_lights(
    described: &[PunctualLightDescription],
    resources: &Resources,
    problems: &mut Problems,
) -> Vec<(PunctualLightInstance, PunctualLight)> {
    let list = Path::of("lights");
    let mut punctual_lights = Vec::new();
    let mut directional = 0;
    for (place, punctual_light) in described.iter().enumerate() {
        if problems.are_many() {
            break;
        }
        let compiled = problems.keep(&list.item(place), || {
            let compiled = placed_punctual(punctual_light, resources)?;
            directional += usize::from(compiled.position().is_none());
            if directional > MOST_DIRECTIONAL {
                let message = format!("a scene has at most {MOST_DIRECTIONAL} directional lights");
                return Err(Problem::at("", message, "one too many").help("merge lights of similar directions"));
            }
            Ok(compiled)
        });
        let instance = PunctualLightInstance { described: place as u32, name: quote::piece(&punctual_light.name) };
        punctual_lights.extend(compiled.filter(|compiled| !compiled.is_black()).map(|compiled| (instance, compiled)));
    }
    punctual_lights
}

/// A light where its transforms put it.
pub fn placed_punctual(described: &PunctualLightDescription, resources: &Resources) -> Result<PunctualLight, Problem> {
    let map = product(&described.transform).map_err(|problem| problem.within(&Path::of("transform")))?;
    let kind = &described.kind;
    let punctual_light = kind.kind().compile(&map, resources).map_err(|problem| problem.within(&Path::of(kind.name())))?;
    punctual_light.check()?;
    Ok(punctual_light)
}
