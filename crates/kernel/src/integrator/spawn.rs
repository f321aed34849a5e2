//! First stage: generates camera rays through points sampled from the pixel filter.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    records::{MediumStack, Path},
    work::Work,
};
use noisefall_base::math::{Lanes, V};
use noisefall_scene::sampling::Dimension;

#[simd]
pub(super) fn spawn<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    batch.bounce = 0;
    batch.paths[0].clear();
    batch.radiance.fill([0.0; 4]);
    if work.shares() {
        batch.shared.clear();
    }
    if work.counts_crossings() {
        batch.crossings.clear();
    }
    for start in (0..work.slots()).step_by(L::N) {
        let slot = l.iota() + start;
        let pixel = work.pixel(l, slot);
        let inside = work.inside(pixel);
        let stream = work.stream(l, slot);
        let (u, v) = stream.two(Dimension::PIXEL);
        let x = (pixel & 0xffff).to_real() + work.rays.filter.place(l, u);
        let y = (pixel >> 16).to_real() + work.rays.filter.place(l, v);
        let (o, d) = if work.rays.have_lens() {
            work.rays.through_lens(l, x, y, stream.two(Dimension::LENS))
        } else {
            work.rays.through(l, x, y)
        };
        let (o, d) = if work.rays.move_in_time() { work.rays.moved_by_camera(l, (o, d), work.time(l, slot)) } else { (o, d) };
        Path { o, d, throughput: V::splat(l, [1.0; 3]), slot }.push(inside, &mut batch.paths[0].paths);
        if work.has_media() {
            MediumStack { media: l.u(work.rays.media) }.push(inside, &mut batch.paths[0].media);
        }
    }
}
