//! Every BSDF against the properties of all BSDFs: samples against pdfs, weights, reciprocity, energy, lanes.
mod anisotropy;
mod cases;
mod dielectric;
mod dielectric_fixtures;
mod dielectric_pdf;
mod diffuse_transmission;
mod disney;
mod distribution;
mod energy;
mod fresnel;
mod lanes;
mod mitsuba;
mod mixed;
mod principled;
mod tinted;

use noisefall_base::math::{F, One, V};

/// A lattice of `n` points of the unit square, `n` and `step` successive Fibonacci numbers.
pub(super) fn lattice(n: u32, step: u32) -> impl Iterator<Item = (F<One>, F<One>)> {
    let n64 = f64::from(n);
    (0..n).map(move |i| {
        let turn = f64::from((u64::from(i) * u64::from(step) % u64::from(n)) as u32);
        (F(((f64::from(i) + 0.5) / n64) as f32), F(((turn + 0.5) / n64) as f32))
    })
}

/// Towards a viewer at cosine `cos`.
fn viewer(cos: f32) -> V<One> {
    V { x: F(((1.0 - cos) * (1.0 + cos)).sqrt() * 0.8), y: F(((1.0 - cos) * (1.0 + cos)).sqrt() * -0.6), z: F(cos) }
}
