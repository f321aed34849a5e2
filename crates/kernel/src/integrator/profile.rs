//! Profile of the path loop: times and rays of its stages, by bounce.
use std::time::{Duration, Instant};

use super::{
    batch::Batch,
    interrupted::Interrupted,
    outlier_reuse::OutlierReuse,
    records::Path,
    trace::{Observer, PathStage, trace_in},
    work::Work,
};
use noisefall_base::math::{One, SimdLevel, in_lanes};
use noisefall_scene::geometry::Visits;

/// Cost of a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageCost {
    /// Time, summed over threads.
    pub time: Duration,
    /// Rays that the stage traced.
    pub rays: u64,
}

/// Rays that were traced once more to count their work.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CountedRays {
    /// Number of rays.
    pub rays: u64,
    /// Their visits to trees.
    pub visits: Visits,
}

/// One path in this many is counted.
const COUNTED: usize = 1024;

/// Costs of the stages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// For every bounce, the stages in the order of [`Profile::STAGES`]. The last of [`Profile::MOST`] entries has all further bounces.
    pub bounces: Vec<[StageCost; 4]>,
    /// Generation of camera rays.
    pub spawn: StageCost,
    /// Path reuse, and reuse of outliers.
    pub reuse: StageCost,
    /// Adding samples to the film.
    pub film: StageCost,
    /// Some of the rays of paths.
    pub counted: CountedRays,
    /// Camera samples.
    pub samples: u64,
}

impl Profile {
    /// The stages of a bounce.
    pub const STAGES: [PathStage; 4] = [PathStage::Intersect, PathStage::Surface, PathStage::Shade, PathStage::Shadow];
    /// Highest number of bounces with entries of their own.
    pub const MOST: usize = 16;

    /// The costs of a stage over all bounces.
    pub fn of_stage(&self, stage: PathStage) -> StageCost {
        match (stage, Profile::STAGES.iter().position(|known| *known == stage)) {
            (_, Some(place)) => self.bounces.iter().map(|bounce| bounce[place]).fold(StageCost::default(), StageCost::plus),
            (PathStage::Reuse, _) => self.reuse,
            _ => self.spawn,
        }
    }

    /// The costs of everything.
    pub fn whole(&self) -> StageCost {
        let besides = [self.spawn, self.reuse, self.film];
        self.bounces.as_flattened().iter().chain(&besides).copied().fold(StageCost::default(), StageCost::plus)
    }

    /// The costs of both.
    pub fn plus(mut self, other: &Profile) -> Profile {
        let longest = self.bounces.len().max(other.bounces.len());
        self.bounces.resize(longest, Default::default());
        let bounces = self.bounces.as_flattened_mut().iter_mut().zip(other.bounces.as_flattened());
        bounces.for_each(|(sum, cost)| *sum = sum.plus(*cost));
        let [spawn, reuse, film] =
            [(self.spawn, other.spawn), (self.reuse, other.reuse), (self.film, other.film)].map(|(a, b)| a.plus(b));
        let counted = self.counted.plus(other.counted);
        Profile { spawn, reuse, film, counted, samples: self.samples + other.samples, ..self }
    }

    fn entry(&mut self, stage: PathStage, bounce: usize) -> &mut StageCost {
        let Some(place) = Profile::STAGES.iter().position(|known| *known == stage) else {
            return if stage == PathStage::Reuse { &mut self.reuse } else { &mut self.spawn };
        };
        let bounce = bounce.min(Profile::MOST - 1);
        if self.bounces.len() <= bounce {
            self.bounces.resize(bounce + 1, Default::default());
        }
        &mut self.bounces[bounce][place]
    }
}

impl StageCost {
    fn plus(self, other: StageCost) -> StageCost {
        StageCost { time: self.time + other.time, rays: self.rays + other.rays }
    }
}

impl CountedRays {
    fn plus(self, other: CountedRays) -> CountedRays {
        let visits = self.visits + other.visits;
        CountedRays { rays: self.rays + other.rays, visits }
    }
}

/// Reads the clock after each stage of a batch, and counts some of its rays while the clock stands.
struct Clock<'a> {
    profile: &'a mut Profile,
    last: Instant,
    rays: u64,
    bright: Option<OutlierReuse<'a>>,
}

impl Observer for Clock<'_> {
    fn before_reuse(&mut self, _work: &Work, batch: &mut Batch) {
        if let Some(path_reuse) = self.bright {
            path_reuse.set_aside(batch);
        }
    }

    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        let paths = batch.current();
        for at in (0..paths.len()).step_by(COUNTED) {
            let path = Path::read(One, &paths.paths, at);
            let visits = work.scene.shapes.visits((path.o, path.d), work.time(One, path.slot));
            self.profile.counted = self.profile.counted.plus(CountedRays { rays: 1, visits });
        }
        self.last = Instant::now();
    }

    fn after(&mut self, stage: PathStage, batch: &Batch) {
        let now = Instant::now();
        let cost = StageCost { time: now - self.last, rays: batch.rays - self.rays };
        let entry = self.profile.entry(stage, batch.bounce as usize);
        *entry = entry.plus(cost);
        (self.last, self.rays) = (now, batch.rays);
    }
}

/// Traces one sample of every pixel of a tile, and adds the costs of the stages to a profile. The radiance is that of
/// [`super::trace()`].
pub fn trace_profiled(
    level: SimdLevel,
    work: &Work,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
    profile: &mut Profile,
) -> Result<(), Interrupted> {
    let bright = work.thresholds.map(|thresholds| OutlierReuse { work, thresholds });
    let mut clock = Clock { profile, last: Instant::now(), rays: batch.rays, bright };
    in_lanes!(level, l => trace_in(l, work, batch, interrupted, &mut clock))?;
    if let Some(path_reuse) = bright {
        clock.last = Instant::now();
        path_reuse.share(level, batch, interrupted)?;
        clock.after(PathStage::Reuse, batch);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::{TILE, thresholds, trace};
    use noisefall_scene::scene::{RenderSettings, Reuse, parse};

    #[test]
    fn a_profile_has_the_rays_of_a_trace_and_changes_no_bit_of_it() {
        let text = include_str!("../../../../scenes/room_window.toml").to_owned();
        let scene = parse("room_window.toml", text).expect("a shipped scene compiles");
        let rays = scene.rays(&scene.camera);
        let level = SimdLevel::best();
        for reuse in [Reuse::Off, Reuse::Suffixes, Reuse::Outliers, Reuse::Both] {
            let settings = RenderSettings { reuse, ..RenderSettings::default() };
            let (mut batch, mut profile) = (Batch::default(), Profile::default());
            let first = Work::tile(&scene, &rays, &settings, [320, 224], [TILE; 2], 3);
            let thresholds = thresholds(level, &first, &mut batch, &|| false).expect("nobody interrupts");
            let work = Work { thresholds: thresholds.as_ref(), ..first };
            trace_profiled(level, &work, &mut batch, &|| false, &mut profile).expect("nobody interrupts");
            let (radiance, traced) = (batch.radiance().to_vec(), batch.rays);
            trace(level, &work, &mut batch, &|| false).expect("nobody interrupts");
            assert!(radiance == batch.radiance(), "{reuse:?}");
            assert_eq!((profile.whole().rays, profile.bounces[0][0].rays), (traced, u64::from(TILE * TILE)));
            assert_eq!(profile.reuse.rays > 0, reuse != Reuse::Off, "{reuse:?}");
            assert!(profile.bounces.len() > 4 && profile.bounces.len() <= Profile::MOST);
            let twice = profile.clone().plus(&profile);
            assert_eq!(twice.of_stage(PathStage::Shadow).rays, 2 * profile.of_stage(PathStage::Shadow).rays);
        }
    }
}
