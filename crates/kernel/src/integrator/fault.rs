//! Faults that tests inject to prove that the validation notices them.
//!
//! [`trace`] decorates the path loop: it changes the cap, and the throughput of paths between two bounces.
use super::{
    batch::Batch,
    interrupted::Interrupted,
    queue::Queue,
    records::{Hit, Path},
    shading::{Reflected, Shading, shares_first},
    slots::SLOTS,
    tile_sample,
    trace::{Observer, trace_in},
    work::Work,
};
use noisefall_base::math::{F, M, One, SimdLevel};
use noisefall_scene::{
    material::{Shade, in_stage},
    scene::{InjectedFault, RenderSettings},
};

/// Bounce cap with a fault, which may let paths go on for ever.
const MOST_BOUNCES: u32 = 60;

/// `tile_sample::trace` with the fault that the settings name.
pub fn trace(level: SimdLevel, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
    let Some(fault) = work.settings.fault else { return tile_sample::trace(level, work, batch, interrupted) };
    let cap = work.settings.last_bounce().min(MOST_BOUNCES) + u32::from(fault == InjectedFault::OneBounceMore);
    let settings = RenderSettings { max_bounces: Some(cap), ..*work.settings };
    let work = Work { settings: &settings, ..*work };
    let mut faulty = FaultyPaths { fault, correct: Path::<One>::queue(SLOTS) };
    trace_in(One, &work, batch, interrupted, &mut faulty)
}

/// Changes the throughput of paths.
struct FaultyPaths {
    fault: InjectedFault,
    /// The paths of the next bounce before the change.
    correct: Queue,
}

impl Observer for FaultyPaths {
    fn at_shaded(&mut self, work: &Work, batch: &mut Batch) {
        let next = &mut batch.paths[((batch.bounce + 1) & 1) as usize].paths;
        std::mem::swap(&mut self.correct, next);
        next.clear();
        let mut at = 0;
        for stage in &work.scene.surfaces.stages {
            in_stage!(stage, K => at = self.spoil::<K>(work, batch, at));
        }
        assert_eq!(at, self.correct.len(), "the paths have the order of their hits");
    }
}

impl FaultyPaths {
    /// Queues the paths from index `at` on that are reflected at surfaces of a type, and returns the index after the last.
    fn spoil<K: Shade>(&self, work: &Work, batch: &mut Batch, mut at: usize) -> usize {
        let Batch { paths, hits, bounce, .. } = batch;
        let (reflection, hits) = (*bounce + 1, &hits[K::STAGE as usize]);
        let next = &mut paths[(reflection & 1) as usize].paths;
        for register in hits.registers(One) {
            let path = Path::read(One, &self.correct, at);
            if at == self.correct.len() || path.slot.0 != Hit::read(One, &hits.hits, register.start).slot.0 {
                // It has ended here.
                continue;
            }
            let reflected = || {
                let shading = Shading::<One, K>::read(One, work, hits, register, reflection);
                shading.reflect(One, work, shares_first::<K>(work, *bounce))
            };
            Path { throughput: path.throughput * self.factor(reflection, reflected), ..path }.push(M(true), next);
            at += 1;
        }
        at
    }

    /// Factor of the fault on the throughput at the `reflection`-th reflection.
    fn factor(&self, reflection: u32, reflected: impl Fn() -> Reflected<One>) -> F<One> {
        F(match self.fault {
            InjectedFault::WrongPdf => 1.0 / 1.03,
            // Once only: the light would grow without end.
            InjectedFault::DroppedCosine if reflection == 1 => 1.0 / reflected().sample.wi.z.0.abs().max(1e-3),
            InjectedFault::NoReweighting => reflected().survival.probability.0,
            InjectedFault::DroppedCosine | InjectedFault::OneBounceMore => 1.0,
        })
    }
}
