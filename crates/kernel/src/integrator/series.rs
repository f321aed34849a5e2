//! The terms of a sample by number of bounces: emitted light, light reflected once, twice, and so on, the Neumann series L = Σₖ
//! Tᵏ Lₑ (J. Kajiya, "The Rendering Equation", SIGGRAPH 1986).
use super::{
    batch::Batch,
    interrupted::Interrupted,
    trace::{Observer, trace_in},
    work::Work,
};
use noisefall_base::math::{SimdLevel, colour::luminance, in_lanes};

/// Number of separate terms: 0, 1, … bounces; the last one is the sum of all others.
pub const TERMS: usize = 8;
/// Number of separate shares of the light by bounces; the last one is the sum of all others.
pub const SHARES: usize = 64;

/// The terms of a batch. Allocated once, reused for every tile.
#[derive(Default)]
pub struct Terms {
    /// Radiance of at most k bounces, per slot.
    up_to: [Vec<[f32; 4]>; TERMS - 1],
    /// Luminance of at most k bounces, summed over all slots.
    light: Vec<f64>,
}

impl Observer for Terms {
    fn at_surfaces(&mut self, _: &Work, batch: &Batch) {
        // Lights sampled at the surface before have just as many bounces as what is run into here.
        let bounces = batch.bounce as usize;
        if let Some(up_to) = self.up_to.get_mut(bounces) {
            up_to.clear();
            up_to.extend_from_slice(batch.radiance());
        }
        if bounces < SHARES - 1 {
            self.light.push(light(batch));
        }
    }
}

/// The luminance summed over all slots.
fn light(batch: &Batch) -> f64 {
    let luminances = batch.radiance().iter().map(|[r, g, b, _]| f64::from(luminance([*r, *g, *b])));
    luminances.filter(|y| y.is_finite()).sum()
}

impl Terms {
    /// The term of `k` bounces at a slot; `whole` is its total radiance.
    pub fn term(&self, k: usize, slot: usize, whole: [f32; 4]) -> [f32; 3] {
        let up_to = |k: usize| self.up_to.get(k).and_then(|radiance| radiance.get(slot)).unwrap_or(&whole);
        let [r, g, b, _] = *up_to(k);
        match k.checked_sub(1).map(up_to) {
            None => [r, g, b],
            Some(before) => [r - before[0], g - before[1], b - before[2]],
        }
    }

    /// The luminance of each number of bounces, summed over all slots.
    pub fn light(&self) -> [f64; SHARES] {
        let up_to = |k: usize| self.light.get(k).or(self.light.last()).copied().unwrap_or(0.0);
        std::array::from_fn(|k| if k == 0 { up_to(0) } else { up_to(k) - up_to(k - 1) })
    }
}

/// Traces a whole tile without path reuse and records its terms.
pub fn trace_series(
    level: SimdLevel,
    work: &Work,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
    terms: &mut Terms,
) -> Result<(), Interrupted> {
    terms.up_to.iter_mut().for_each(Vec::clear);
    terms.light.clear();
    in_lanes!(level, l => trace_in(l, work, batch, interrupted, terms))?;
    // Lights that were sampled at the last surfaces, and all the rest.
    terms.light.push(light(batch));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::trace;
    use noisefall_scene::scene::{RenderSettings, built_in};

    #[test]
    fn up_to_k_is_the_picture_of_a_cap_of_k_bit_for_bit() {
        let scene = built_in();
        let rays = scene.rays(&scene.camera);
        let settings = RenderSettings { seed: 3, ..RenderSettings::default() };
        let work = Work::tile(&scene, &rays, &settings, [96, 96], [32, 32], 5);
        let (mut batch, mut terms) = (Batch::default(), Terms::default());
        trace_series(SimdLevel::best(), &work, &mut batch, &|| false, &mut terms).expect("nobody interrupts");
        let whole = batch.radiance().to_vec();
        trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nobody interrupts");
        assert_eq!(whole, batch.radiance(), "looking at the terms changes nothing");
        for (cap, up_to) in terms.up_to.iter().enumerate() {
            let settings = RenderSettings { max_bounces: Some(cap as u32), ..settings };
            let capped = Work { settings: &settings, ..work };
            trace(SimdLevel::best(), &capped, &mut batch, &|| false).expect("nobody interrupts");
            assert_eq!(up_to, batch.radiance(), "a cap of {cap}");
        }
        let light: f64 = terms.light().iter().sum();
        let all: f64 = whole.iter().map(|[r, g, b, _]| f64::from(luminance([*r, *g, *b]))).sum();
        assert!((light / all - 1.0).abs() < 1e-9);
        for (slot, whole) in whole.iter().enumerate() {
            let sum: f32 = (0..TERMS).map(|k| terms.term(k, slot, *whole)[1]).sum();
            assert!((sum - whole[1]).abs() <= 1e-5 * whole[1], "{sum} {whole:?}");
        }
    }
}
