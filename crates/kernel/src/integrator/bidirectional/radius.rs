//! Radius within which vertices are merged.
use std::f32::consts::PI;

use crate::integrator::work::Work;

/// Radius of the first sample, in extents of the scene.
const FIRST_RADIUS: f32 = 0.01;

/// 2^(-k/6) for k from 0 to 5. Powers of the standard library are not the same on all machines.
const ROOTS: [f32; 6] = [1.0, 0.890_898_7, 0.793_700_5, 0.707_106_77, 0.629_960_54, 0.561_231];

/// The radius of merges in metres. It shrinks with the sixth root of the number of samples, rounded down to a power of two, so that noise
/// and bias vanish both (C. Knaus and M. Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", 2011, with α = 2/3).
pub(super) fn radius(work: &Work) -> f32 {
    let doublings = work.sample.saturating_add(1).ilog2();
    let shrunk = ROOTS[doublings as usize % ROOTS.len()] / (1 << (doublings / 6)) as f32;
    FIRST_RADIUS * work.scene.size as f32 * shrunk
}

/// The number η of `merge.rs`, N π r²; 0 if nothing is merged.
pub(super) fn merged_paths(work: &Work) -> f32 {
    if !work.scene.merges(work.settings) {
        return 0.0;
    }
    let (radius, [width, height]) = (radius(work), work.size);
    width as f32 * height as f32 * PI * radius * radius
}
