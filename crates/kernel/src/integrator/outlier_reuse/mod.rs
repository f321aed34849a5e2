//! Reuses outliers between the pixels of a group.
//!
//! A sample of pixel j is a function f_j(u) of its random numbers u. A sample that pixel i has found with f_i(u) above a threshold t_i is
//! replayed: it is traced with the same u from the other pixels of the group ("random replay" in D. Lin et al., "Generalized Resampled
//! Importance Sampling: Foundations of ReSTIR", SIGGRAPH 2022). Where f_j(u) > t_j, the samples of all n pixels k with f_k(u) > t_k are
//! strategies with the same pdf, so the balance heuristic (Veach 1997, equation 9.8) weights each by 1/n: pixel j adds f_j(u)/n. Samples
//! below the threshold stay with their pixel. The mean does not change, and rare bright light, which makes most of the noise of caustics,
//! is found by n pixels in place of one. Where path suffixes are shared as well, f is the rest of the sample.
mod pilot;

pub use self::pilot::thresholds;
use super::{
    batch::Batch,
    interrupted::Interrupted,
    outliers::{Outlier, OutlierBuffers, Replays, Thresholds, brightness},
    slots::{SLOTS, TILE},
    trace::{Observer, trace_alone, trace_in},
    work::Work,
};
use noisefall_base::math::{One, SimdLevel, U, in_lanes};
use noisefall_scene::sampling::hash::hash_one;

/// Width and height of a group in pixels.
const WIDTH: u32 = 4;
/// Number of pixels in a group.
const MEMBERS: usize = (WIDTH * WIDTH) as usize;

/// Shares the outliers of a tile.
#[derive(Clone, Copy)]
pub struct OutlierReuse<'a> {
    pub work: &'a Work<'a>,
    pub thresholds: &'a Thresholds,
}

/// Takes the outliers out of a batch whose paths have all ended.
impl Observer for OutlierReuse<'_> {
    fn before_reuse(&mut self, _work: &Work, batch: &mut Batch) {
        self.set_aside(batch);
    }
}

impl OutlierReuse<'_> {
    /// Traces one sample of every pixel of the tile, and shares those that are bright.
    pub fn trace(mut self, level: SimdLevel, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
        in_lanes!(level, l => trace_in(l, self.work, batch, interrupted, &mut self))?;
        self.share(level, batch, interrupted)
    }

    /// Takes the outliers out of a batch, before path suffixes are shared.
    pub fn set_aside(self, batch: &mut Batch) {
        let OutlierReuse { work, thresholds } = self;
        debug_assert!(work.blocks.is_none(), "groups are those of a tile");
        let found = batch.bright.get_or_insert_default();
        found.samples.clear();
        for (index, radiance) in batch.radiance[..work.slots() as usize].iter_mut().enumerate() {
            let (column, row) = work.place::<One>(U(index as u32));
            let place = [column.0, row.0];
            let is_inside = column.0 < work.size[0] && row.0 < work.size[1];
            if is_inside && is_bright(radiance, thresholds.at(place)) {
                found.samples.push(Outlier { place, radiance: std::mem::take(radiance), n: 1 });
            }
        }
    }

    /// Replays the samples that were set aside, as many at a time as a batch takes, and adds them to the radiance of all pixels that
    /// share them.
    pub fn share(self, level: SimdLevel, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
        let OutlierBuffers { mut samples, mut replays, mut radiance } = *std::mem::take(batch.bright.get_or_insert_default());
        radiance.clear();
        radiance.extend_from_slice(batch.radiance());
        for some in samples.chunks_mut(SLOTS / MEMBERS) {
            fill(&mut replays, self.work, some);
            if !replays.is_empty() {
                let replay = Work { replays: Some(&replays), blocks: None, thresholds: None, ..*self.work };
                trace_alone(level, &replay, batch, interrupted)?;
            }
            let mut replayed = batch.radiance();
            for sample in some {
                let (of_others, rest) = replayed.split_at(others(self.work, sample.place).count());
                self.divide(sample, of_others, &mut radiance);
                replayed = rest;
            }
        }
        batch.radiance[..SLOTS].copy_from_slice(&radiance);
        batch.bright = Some(Box::new(OutlierBuffers { samples, replays, radiance }));
        Ok(())
    }

    /// Divides a sample among the pixels of its group where it is bright. `replayed` is that of the others.
    fn divide(self, sample: &mut Outlier, replayed: &[[f32; 4]], sums: &mut [[f32; 4]]) {
        let of_others = || others(self.work, sample.place).zip(replayed);
        let all = std::iter::once((sample.place, &sample.radiance)).chain(of_others());
        let shares = |(place, radiance): &([u32; 2], &[f32; 4])| is_bright(radiance, self.thresholds.at(*place));
        let n = all.clone().filter(shares).count() as u32;
        for (place, radiance) in all.filter(shares) {
            let sum = &mut sums[slot(place)];
            sum.iter_mut().zip(radiance).for_each(|(sum, x)| *sum += x / n as f32);
        }
        sample.n = n;
    }
}

/// The replays of samples in the other pixels of their groups.
fn fill(replays: &mut Replays, work: &Work, samples: &[Outlier]) {
    let pixel = |place: [u32; 2]| [0, 1].map(|axis| work.origin[axis] + place[axis]);
    replays.clear();
    for sample in samples {
        others(work, sample.place).for_each(|place| replays.push(pixel(place), pixel(sample.place)));
    }
}

fn is_bright(radiance: &[f32; 4], threshold: f32) -> bool {
    brightness(radiance).is_some_and(|sum| sum > threshold)
}

fn slot([x, y]: [u32; 2]) -> usize {
    (y * TILE + x) as usize
}

/// The other pixels of the group of a pixel. Groups are shifted in every sample, so that their edges are not visible. At the edges of the
/// tile they are smaller.
fn others(work: &Work, source: [u32; 2]) -> impl Iterator<Item = [u32; 2]> + Clone {
    let shift = hash_one(work.sample);
    let range = |axis: usize, shift: u32| {
        let start = (source[axis] + shift) / WIDTH * WIDTH;
        start.saturating_sub(shift)..(start + WIDTH - shift).min(work.size[axis])
    };
    let (columns, rows) = (range(0, shift % WIDTH), range(1, (shift >> 16) % WIDTH));
    rows.flat_map(move |y| columns.clone().map(move |x| [x, y])).filter(move |place| *place != source)
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::{RenderSettings, built_in};

    const BRIGHT: f32 = 50.0;
    const SIZE: [u32; 2] = [13, 10];

    fn places() -> impl Iterator<Item = [u32; 2]> {
        (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
    }

    /// The sample of a pixel for random numbers u: a third is bright, as chance will have it.
    fn f([x, y]: [u32; 2], u: u32) -> [f32; 4] {
        let chance = hash_one(x + 64 * y + 4096 * u) % 3;
        [if chance == 0 { 2.0 * BRIGHT + x as f32 } else { chance as f32 }, y as f32, 0.0, 0.0]
    }

    fn with_work(test: impl Fn(&Work)) {
        let scene = built_in();
        let (rays, settings) = (scene.rays(&scene.camera), RenderSettings::default());
        (0..9).for_each(|sample| test(&Work::tile(&scene, &rays, &settings, [32, 0], SIZE, sample)));
    }

    #[test]
    fn every_pixel_is_in_one_group_of_at_most_sixteen() {
        with_work(|work| {
            for place in places() {
                let group: Vec<[u32; 2]> = others(work, place).collect();
                assert!(group.len() < MEMBERS && !group.contains(&place));
                assert!(group.iter().all(|other| others(work, *other).any(|back| back == place)));
            }
        });
    }

    /// The sum over all random numbers, each of which every pixel draws once, is the same with and without path reuse.
    #[test]
    fn bright_samples_are_divided_without_loss() {
        const ALL: u32 = 40;
        let thresholds = Thresholds::uniform(BRIGHT);
        with_work(|work| {
            let mut sums = vec![[0.0; 4]; SLOTS];
            for (place, u) in places().flat_map(|place| (0..ALL).map(move |u| (place, u))) {
                if is_bright(&f(place, u), BRIGHT) {
                    let replayed: Vec<[f32; 4]> = others(work, place).map(|other| f(other, u)).collect();
                    let mut sample = Outlier { place, radiance: f(place, u), n: 0 };
                    OutlierReuse { work, thresholds: &thresholds }.divide(&mut sample, &replayed, &mut sums);
                }
            }
            for place in places() {
                for c in 0..2 {
                    let alone: f32 = (0..ALL).map(|u| f(place, u)).filter(|of| is_bright(of, BRIGHT)).map(|of| of[c]).sum();
                    let shared = sums[slot(place)][c];
                    assert!((shared - alone).abs() <= 1e-4 * alone, "{place:?}: {shared} {alone}");
                }
            }
        });
    }
}
