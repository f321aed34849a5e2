//! Fourth stage, once per BSDF type: samples a light at every hit, samples the next direction of every path, and plays Russian
//! roulette.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    records::{DELTA, Inside, PreviousLobe, PreviousVertex, TRANSMITS},
    shading::{LightEstimate, Reflected, Shading, shares_first},
    work::Work,
};
use crate::{
    light::Lobe,
    material::Shade,
    math::{Lanes, Pick},
};

#[simd]
pub(super) fn shade<L: Lanes, K: Shade>(l: L, work: &Work, batch: &mut Batch) {
    let Batch {
        paths, previous_vertices, previous_lobes, path_media, hits, details, shadows, shadow_media, shared, bounce, ..
    } = batch;
    let (hits, details) = (&hits[K::STAGE as usize], &details[K::STAGE as usize]);
    let reflection = *bounce + 1;
    let next = (reflection & 1) as usize;
    let shares = shares_first::<K>(work, *bounce);
    for start in (0..hits.len()).step_by(L::N) {
        let shading = Shading::<L, K>::read(l, work, (hits, details), start, reflection);
        let Shading { live, hit, vertex, .. } = &shading;
        if K::SEES_LIGHTS && work.samples_lights() {
            let LightEstimate { shadow, wi, may_contribute, .. } = shading.sample_light(l, work);
            shadow.push(*live & may_contribute, shadows);
            if K::DETAILED && work.has_media() {
                Inside { media: vertex.media_towards::<K>(wi.z) }.push(*live & may_contribute, shadow_media);
            }
        }

        let Reflected { sample, path, goes_on, .. } = shading.reflect(l, work, shares);
        if shares {
            shared.keep_first(l, *live, hit);
        }
        let keep = *live & goes_on;
        path.push(keep, &mut paths[next]);
        if work.samples_lights() {
            let unsampled = if K::TRANSMITS { sample.delta | vertex.self_lit } else { sample.delta };
            let flags = unsampled.pick(l.u(DELTA), l.u(0)) | if K::TRANSMITS { TRANSMITS } else { 0 };
            PreviousVertex { n: vertex.n, pdf: sample.pdf, flags }.push(keep, &mut previous_vertices[next]);
            if work.heeds_lobes() {
                let Lobe { wo, alpha } = shading.lobe(l);
                PreviousLobe { wo, alpha }.push(keep, &mut previous_lobes[next]);
            }
        }
        if K::DETAILED && work.has_media() {
            Inside { media: vertex.media_towards::<K>(sample.wi.z) }.push(keep, &mut path_media[next]);
        }
    }
}
