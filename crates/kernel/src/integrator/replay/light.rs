//! Records a light sample and whether it arrives.
use super::{
    terms::{LightOutcome, SampledLight},
    throughput::{BLACK, WHITE, own},
};
use crate::integrator::{
    batch::Batch,
    queue::Register,
    records::Shadow,
    shading::LightEstimate,
    shadow::{arriving, crossings_left},
    work::Work,
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_scene::geometry::MISS;

/// The terms of a light sample, and what becomes of it if it is queued at an index.
pub(super) fn sampled_light(
    work: &Work,
    batch: &Batch,
    LightEstimate { sample, f_cos, weight, .. }: &LightEstimate<One>,
    queued: Option<Register<One>>,
) -> SampledLight {
    let target = sample.target.0;
    let lights = &work.scene.lights;
    let punctual_light = lights.punctual_at(target);
    let place = |light: u32| lights.place(One, U(light), F(0.0));
    let mut light = SampledLight {
        direction: sample.wi.lane(0),
        object: (target != MISS && punctual_light.is_none()).then(|| work.scene.owners[place(target).primitive.0 as usize]),
        punctual_light: punctual_light.map(|punctual_light| work.scene.punctual_lights[punctual_light].title()),
        pdf: sample.pdf.0,
        f_cos: f_cos.lane(0),
        weight: if sample.pdf.0 > 0.0 { weight.0 } else { 0.0 },
        radiance: sample.radiance.lane(0),
        outcome: LightOutcome::Void,
        distance: None,
        passed: BLACK,
        contribution: BLACK,
        shared: false,
    };
    let Some(at) = queued else { return light };
    let shadow = Shadow::read(One, &batch.shadows.shadows, at.start);
    let media = if work.has_media() { batch.shadows.media(One, at) } else { U(0) };
    let left = crossings_left(One, work, &batch.crossings, M(true), &shadow, batch.bounce);
    let end_of = |shadow: &Shadow<One>| arriving(One, work, (M(true), left), shadow, media, batch.bounce + 1, &mut 0);
    let arriving = end_of(&shadow);
    light.outcome = if arriving.seen.0 { LightOutcome::Seen } else { LightOutcome::Hidden };
    light.distance = Some(arriving.t.0).filter(|t| t.is_finite());
    if arriving.seen.0 {
        light.passed = end_of(&Shadow { radiance: V::splat(One, WHITE), ..shadow }).light.lane(0);
        light.contribution = own(batch, shadow.slot, arriving.light.lane(0));
    }
    light
}
