//! The loops of the bidirectional paths.
use fearless_simd_macros::simd;

use super::{
    arrive::{arrive_from_camera, arrive_from_lights},
    camera::shade_camera_paths,
    direct::test_light_samples,
    emit::emit,
    join::join,
    light::shade_light_paths,
    merge::prepare,
    observer::Observer,
};
use crate::integrator::{
    batch::Batch, interrupted::Interrupted, intersect::intersect, light_paths::paths::LightPaths, queues::HitQueues,
    spawn::spawn, transparent_ray::Decisions, work::Work,
};
use noisefall_base::math::Lanes;
use noisefall_scene::light::LightRays;

/// Traces one sample of every pixel of a tile from camera and light. The result is [`Batch::radiance`] and [`Batch::splats`].
pub(in crate::integrator) fn trace_bidirectional<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
    observer: &mut O,
) -> Result<(), Interrupted> {
    let mut state = batch.light_paths.take().unwrap_or_default();
    batch.splats.clear();
    let traced = trace_light_paths(l, work, rays, batch, &mut state, interrupted, observer)
        .and_then(|()| trace_camera_paths(l, work, rays, batch, &mut state, interrupted, observer));
    batch.light_paths = Some(state);
    traced
}

#[simd]
fn trace_light_paths<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    interrupted: &dyn Fn() -> bool,
    observer: &mut O,
) -> Result<(), Interrupted> {
    state.clear();
    let stages = &work.scene.surfaces.stages;
    if work.settings.estimator.traces_only_caustics() && stages.iter().all(|stage| stage.is_diffuse()) {
        return Ok(());
    }
    emit(l, work, rays, batch, state, observer);
    while !batch.current().is_empty() && batch.bounce < work.settings.last_bounce() {
        if interrupted() {
            return Err(Interrupted);
        }
        intersect(l, work, batch, Decisions::RandomFromLight);
        arrive_from_lights(l, work, batch, state, observer);
        shade_light_paths(l, work, rays, batch, state, observer);
        join(l, work, batch, state, observer);
        batch.bounce += 1;
    }
    Ok(())
}

#[simd]
fn trace_camera_paths<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    interrupted: &dyn Fn() -> bool,
    observer: &mut O,
) -> Result<(), Interrupted> {
    let last_bounce = work.settings.last_bounce();
    let cut_short = work.settings.max_bounces != Some(last_bounce);
    if work.scene.merges(work.settings) {
        prepare(work, state);
    }
    spawn(l, work, batch);
    while !batch.current().is_empty() {
        if interrupted() {
            return Err(Interrupted);
        }
        let last = batch.bounce == last_bounce;
        intersect(l, work, batch, Decisions::Random);
        arrive_from_camera(l, work, rays, batch, state, last && !cut_short, observer);
        if last {
            batch.cut_paths += if cut_short { batch.hits.iter().map(HitQueues::len).sum::<usize>() as u64 } else { 0 };
            break;
        }
        shade_camera_paths(l, work, batch, state, interrupted, observer)?;
        test_light_samples(l, work, rays, batch, state, observer);
        batch.bounce += 1;
    }
    Ok(())
}
