//! Lamps without surface of a description.
use super::problems::Problems;
use crate::{
    light::{Lamp, lamp::MOST_DIRECTIONAL},
    scene::{LampInstance, description::LampDescription},
    shape::product,
};
use noisefall_base::{
    declare::{Path, Problem, Resources},
    quote,
};

/// The lamps that emit light.
pub fn lamps(described: &[LampDescription], resources: &Resources, problems: &mut Problems) -> Vec<(LampInstance, Lamp)> {
    let list = Path::of("lamps");
    let mut lamps = Vec::new();
    let mut directional = 0;
    for (place, lamp) in described.iter().enumerate() {
        if problems.are_many() {
            break;
        }
        let compiled = problems.keep(&list.item(place), || {
            let compiled = placed_lamp(lamp, resources)?;
            directional += usize::from(compiled.position().is_none());
            if directional > MOST_DIRECTIONAL {
                let message = format!("a scene has at most {MOST_DIRECTIONAL} directional lamps");
                return Err(Problem::at("", message, "one too many").help("merge lamps of similar directions"));
            }
            Ok(compiled)
        });
        let instance = LampInstance { described: place as u32, name: quote::piece(&lamp.name) };
        lamps.extend(compiled.filter(|compiled| !compiled.is_black()).map(|compiled| (instance, compiled)));
    }
    lamps
}

/// A lamp where its transforms put it.
pub fn placed_lamp(described: &LampDescription, resources: &Resources) -> Result<Lamp, Problem> {
    let map = product(&described.transform).map_err(|problem| problem.within(&Path::of("transform")))?;
    let kind = &described.kind;
    let lamp = kind.kind().compile(&map, resources).map_err(|problem| problem.within(&Path::of(kind.name())))?;
    lamp.check()?;
    Ok(lamp)
}
