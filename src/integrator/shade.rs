//! Last stage of a bounce: the next direction of every path, and whether it survives.
//!
//! Light sampling (next-event estimation) will read the same hits just before this.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Hit, Path, Work},
    roulette::survive,
};
use crate::{
    material::lambertian,
    math::{Frame, Lanes},
    sampling::{Dimension, Stream},
};

#[simd]
pub(super) fn shade<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { paths, hits, bounce, .. } = batch;
    let reflection = *bounce + 1;
    let next = &mut paths[(reflection & 1) as usize];
    let settings = work.settings;
    next.clear();
    for start in (0..hits.len()).step_by(L::N) {
        let live = l.first(hits.len() - start);
        let hit = Hit::read(l, hits, start);
        let stream = Stream::new(settings.sampler, settings.seed, work.pixel(hit.slot), work.sample);
        let sample = lambertian::sample(hit.albedo, settings.directions, stream.two(Dimension::direction(reflection)));
        let d = Frame::new(hit.n).world_from_local(sample.wi);
        let (alive, throughput) = survive(l, settings.roulette, reflection, &stream, hit.throughput * sample.weight);
        Path { o: hit.p, d, throughput, slot: hit.slot }.push(live & alive, next);
    }
}
