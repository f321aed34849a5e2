//! Crossings of surfaces that count as bounces: see [`RenderSettings::count_crossings`](noisefall_scene::scene::RenderSettings::count_crossings).
//!
//! A path has one direction of flight, which may cross surfaces by opacity or because they are `null`. The cap on bounces then holds for
//! bounces and crossings together, on the way to emitters and to sampled lights alike, so that all estimators leave out the same light.
use super::{slots::SLOTS, work::Work};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, Pick, U};

/// The number of surfaces that paths have crossed so far, by slot, in the first column.
pub(super) struct Crossings(Vec<[f32; 4]>);

impl Default for Crossings {
    fn default() -> Self {
        Crossings(vec![[0.0; 4]; SLOTS])
    }
}

impl Crossings {
    pub fn clear(&mut self) {
        self.0.fill([0.0; 4]);
    }

    /// Adds `count` to the slots of the lanes in `mask`.
    #[inline(always)]
    pub fn add<L: Lanes>(&mut self, mask: M<L>, slot: U<L>, count: F<L>) {
        let (slot, count) = (slot.to_array(), count.to_array());
        let mut lanes = mask.bits();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % MAX_LANES;
            lanes &= lanes - 1;
            self.0[slot[lane] as usize][0] += count[lane];
        }
    }

    /// The bounces and crossings that the cap leaves to the paths in the lanes of `mask` after `bounce` bounces; below 0 beyond the cap.
    #[inline(always)]
    pub fn left<L: Lanes>(&self, l: L, work: &Work, mask: M<L>, slot: U<L>, bounce: u32) -> F<L> {
        let [crossed, ..] = l.rows(&self.0, mask.pick(slot, l.u(0)));
        l.f(work.settings.last_bounce() as f32) - l.f(bounce as f32) - crossed
    }
}

impl Work<'_> {
    /// See [`Scene::counts_crossings`](noisefall_scene::scene::Scene::counts_crossings).
    #[inline(always)]
    pub(super) fn counts_crossings(&self) -> bool {
        self.scene.counts_crossings(self.settings)
    }
}

#[cfg(test)]
mod tests {
    use crate::integrator::{Batch, Work, trace};
    use noisefall_base::math::SimdLevel;
    use noisefall_scene::scene::{Estimator, RenderSettings, parse};

    /// The mean radiance of a wall of albedo 0.5 behind three sheets of opacity 0, with a light or a bright sky behind the viewer.
    fn radiance(light: &str, sheets: usize, settings: RenderSettings) -> f32 {
        let mut text = format!(
            "format = 1
            {light}
            camera = {{ eye = [0, 0, 0], look_at = [0, 0, -1], fov = 10, resolution = [16, 16] }}
            materials.wall.lambertian.albedo = 0.5
            materials.sheet.null = {{}}
            [[objects]]
            shape.rectangle = {{ origin = [-9, -9, -9], edge_u = [18, 0, 0], edge_v = [0, 18, 0] }}
            material = 'wall'\n"
        );
        for sheet in 1..=sheets {
            text += &format!(
                "[[objects]]
                shape.rectangle = {{ origin = [-99, -99, -{sheet}], edge_u = [198, 0, 0], edge_v = [0, 198, 0] }}
                material = 'sheet'\n"
            );
        }
        let scene = parse("sheets.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        let (rays, mut batch, mut sum) = (scene.rays(&scene.camera), Batch::default(), 0.0);
        for sample in 0..64 {
            let work = Work::tile(&scene, &rays, &settings, [0, 0], [16, 16], sample);
            trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
            sum += batch.radiance().iter().map(|[r, ..]| r).sum::<f32>() / 256.0;
        }
        sum / 64.0
    }

    /// Light reaches the wall through the sheets, and the viewer through them again: one bounce and two crossings for each sheet.
    #[test]
    fn light_needs_a_bounce_and_its_crossings() {
        let punctual_light = "lights = [{ point = { position = [0, 0, 5], intensity = 100 } }]";
        for (light, estimators) in [
            ("environment.radiance = 1", &[Estimator::Path, Estimator::Light, Estimator::Mis][..]),
            (punctual_light, &[Estimator::Light, Estimator::Mis][..]),
        ] {
            for estimator in estimators {
                let settings = |cap: u32, count_crossings: bool| RenderSettings {
                    estimator: *estimator,
                    max_bounces: Some(cap),
                    count_crossings,
                    ..RenderSettings::default()
                };
                let plain = radiance(light, 0, settings(1, true));
                for sheets in 1..=3 {
                    let enough = 1 + 2 * sheets as u32;
                    let all = radiance(light, sheets, settings(enough, true));
                    assert!((all / plain - 1.0).abs() < 0.02, "{light} {estimator:?} {sheets}: {all} {plain}");
                    // Some light of the sky comes from between the wall and the sheets.
                    let less = radiance(light, sheets, settings(enough - 1, true));
                    assert!(less < 0.01 * plain, "{light} {estimator:?} {sheets}: {less} {plain}");
                    let uncounted = radiance(light, sheets, settings(1, false));
                    assert!((uncounted / plain - 1.0).abs() < 0.02, "{light} {estimator:?} {sheets}: {uncounted} {plain}");
                }
            }
        }
    }
}
