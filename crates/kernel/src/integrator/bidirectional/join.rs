//! Tests which vertices of light paths the camera sees.
use fearless_simd_macros::simd;

use super::observer::Observer;
use crate::integrator::{
    batch::Batch,
    light_paths::{paths::LightPaths, records::CameraRay, splat::Splat},
    visible_fraction::{Segment, visible_fraction},
    work::Work,
};
use noisefall_base::math::{Lanes, MAX_LANES};
use noisefall_scene::sampling::Dimension;

#[simd]
pub(super) fn join<L: Lanes, O: Observer<L>>(l: L, work: &Work, batch: &mut Batch, state: &mut LightPaths, observer: &mut O) {
    for at in state.joins.registers(l) {
        let CameraRay { o, d, distance, slot, x, y, light } = CameraRay::read(l, &state.joins, at.start);
        let surface = Dimension::LIGHT_PATH + batch.bounce + 1;
        let segment = Segment { o, d, distance, end: None, slot };
        let fraction = visible_fraction(l, work, at.live, &segment, surface, &mut batch.rays);
        let (u, v) = work.stream(l, slot).two(Dimension::cell(surface));
        let (seen, light) = (fraction.above(0.0), light * fraction);
        observer.joined(fraction, [x, y]);
        let [x, y, u, v] = [x.to_array(), y.to_array(), u.to_array(), v.to_array()];
        let [r, g, b] = [light.x.to_array(), light.y.to_array(), light.z.to_array()];
        let mut lanes = seen.bits();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % MAX_LANES;
            lanes &= lanes - 1;
            batch.splats.push(Splat { place: [x[lane], y[lane]], u: [u[lane], v[lane]], light: [r[lane], g[lane], b[lane]] });
        }
    }
    batch.rays += state.joins.len() as u64;
    state.joins.clear();
}
