//! Fourth stage, once per BSDF type: samples a light at every hit, samples the next direction of every path, and plays Russian
//! roulette.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    queues::{PathQueues, ShadowQueues},
    records::{DELTA, MediumStack, PreviousLobe, PreviousVertex, TRANSMITS},
    shading::{LightEstimate, Reflected, Shading, shares_first},
    work::Work,
};
use noisefall_base::math::{Lanes, Pick};
use noisefall_scene::{light::Lobe, material::Shade};

#[simd]
pub(super) fn shade<L: Lanes, K: Shade>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { paths, hits, shadows, shared, bounce, .. } = batch;
    let hits = &hits[K::STAGE as usize];
    let reflection = *bounce + 1;
    let next = &mut paths[(reflection & 1) as usize];
    let shares = shares_first::<K>(work, *bounce);
    for at in hits.registers(l) {
        let shading = Shading::<L, K>::read(l, work, hits, at, reflection);
        if K::SEES_LIGHTS && work.samples_lights() {
            queue_light_sample(l, work, &shading, shadows);
        }
        let reflected = shading.reflect(l, work, shares);
        if shares {
            shared.keep_first(l, at.live, &shading.hit);
        }
        queue_path(l, work, &shading, &reflected, next);
    }
}

/// Samples lights, and queues the samples that would contribute if they are visible.
#[inline(always)]
fn queue_light_sample<L: Lanes, K: Shade>(l: L, work: &Work, shading: &Shading<L, K>, queues: &mut ShadowQueues) {
    let LightEstimate { shadow, wi, may_contribute, .. } = shading.sample_light(l, work);
    let keep = shading.live & may_contribute;
    shadow.push(keep, &mut queues.shadows);
    if K::DETAILED && work.has_media() {
        MediumStack { media: shading.vertex.media_towards::<K>(wi.z) }.push(keep, &mut queues.media);
    }
}

/// Queues the paths that go on, with the records that the next bounce reads.
#[inline(always)]
fn queue_path<L: Lanes, K: Shade>(l: L, work: &Work, shading: &Shading<L, K>, reflected: &Reflected<L>, queues: &mut PathQueues) {
    let (Shading { live, vertex, .. }, Reflected { sample, path, goes_on, .. }) = (shading, reflected);
    let keep = *live & *goes_on;
    path.push(keep, &mut queues.paths);
    if work.weights_hits() {
        let unsampled = if K::TRANSMITS { sample.delta | vertex.self_lit } else { sample.delta };
        let flags = unsampled.pick(l.u(DELTA), l.u(0)) | if K::TRANSMITS { TRANSMITS } else { 0 };
        PreviousVertex { n: vertex.n, pdf: sample.pdf, flags }.push(keep, &mut queues.previous_vertices);
        if work.weights_lights_by_lobe() {
            let Lobe { wo, alpha } = shading.lobe(l);
            PreviousLobe { wo, alpha }.push(keep, &mut queues.previous_lobes);
        }
    }
    if K::DETAILED && work.has_media() {
        MediumStack { media: vertex.media_towards::<K>(sample.wi.z) }.push(keep, &mut queues.media);
    }
}
