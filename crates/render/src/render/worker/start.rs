//! Starts images: of requests, of tasks beside them, and of edited scenes.
use std::time::Duration;

use super::Worker;
use crate::render::{
    checkpoint::Checkpoint,
    film::Film,
    protocol::{RenderRequest, RenderTask},
    session::Session,
};

impl Worker {
    /// Compiles the edit that waits, if any, and starts its image.
    pub(super) fn compile_edit(&mut self, notify: &dyn Fn()) {
        let kept = &mut self.kept;
        let Some((request, result)) = self.edits.compile(&self.threads, || kept.drop_other_scenes()) else { return };
        if let Some(request) = request
            && !self.follows(&request)
        {
            self.rate = self.sessions[0].as_ref().and_then(Session::rate);
            self.start(0, result.generation, RenderTask::Picture(request));
        }
        self.edits.tell(result);
        notify();
    }

    /// Whether the first image is that of a request already. It then continues with the scene of the request.
    fn follows(&mut self, request: &RenderRequest) -> bool {
        let first = self.sessions[0].as_mut().filter(|first| first.is_of(request));
        first.map(|first| first.set_scene(request.scene.clone())).is_some()
    }

    /// Starts the image of a task on a side, or continues it if it was rendered before.
    pub(super) fn start(&mut self, side: usize, generation: u64, task: RenderTask) {
        let (RenderTask::Picture(request) | RenderTask::Series(request)) = &task;
        let sessions = || self.sessions.iter().flatten();
        let is_of_scene = |session: &Session| session.request().scene.has_same_image(&request.scene);
        let rate = sessions().filter(|session| is_of_scene(session)).find_map(Session::rate).or(self.rate.take());
        self.kept.retain_scene(&request.scene);
        let old = self.sessions[side].take();
        let starts_over = old.as_ref().is_some_and(|old| old.is_of(request));
        let is_earlier = |old: &Session| old.request().scene.is_of_same_file(&request.scene) && old.outlasts_edit();
        let is_kept = !starts_over && old.as_ref().is_some_and(|old| is_of_scene(old) || is_earlier(old));
        let film = old.and_then(|old| if is_kept { self.kept.keep(old) } else { Some(old.into_film()) });
        let earlier = if starts_over { None } else { self.earlier(side, &task) };
        if earlier.is_none() {
            self.make_room(&task);
        }
        self.sessions[side] = Some(match (earlier, task) {
            (Some(earlier), RenderTask::Picture(_)) => earlier.resumed(generation, self.budget.steps),
            (_, RenderTask::Picture(request)) => Session::new(generation, request, self.publish, rate, &self.budget, film),
            (_, RenderTask::Series(request)) => Session::of_series(generation, request, rate, &self.budget),
        });
        self.note_leads();
    }

    /// Continues an image from its checkpoint.
    pub(super) fn start_checkpoint(&mut self, generation: u64, (request, kept): (RenderRequest, Checkpoint)) {
        self.kept.retain_scene(&request.scene);
        let old = self.sessions[0].take();
        old.into_iter().for_each(|old| drop(self.kept.keep(old)));
        let state = kept.into_state();
        self.make_room(&RenderTask::Picture(request.clone()));
        self.sessions[0] = Some(Session::of_kept(generation, request, &self.budget, state));
        self.note_leads();
    }

    fn note_leads(&mut self) {
        let has_series = self.sessions.iter().flatten().any(Session::has_series);
        let elapsed =
            |session: &Option<Session>| session.as_ref().filter(|_| has_series).map_or(Duration::ZERO, Session::elapsed);
        self.leads = self.sessions.each_ref().map(elapsed);
    }

    /// The session that has samples of a task: one that is kept, or that of the other side, which starts over.
    fn earlier(&mut self, side: usize, task: &RenderTask) -> Option<Session> {
        let RenderTask::Picture(request) = task else { return None };
        if let Some(kept) = self.kept.take(request) {
            return Some(kept);
        }
        let other = self.sessions[1 - side].take_if(|other| other.is_of(request))?;
        let again = Session::new(other.generation(), other.request().clone(), self.publish, other.rate(), &self.budget, None);
        self.sessions[1 - side] = Some(again);
        Some(other)
    }

    /// Drops kept images that take the memory of a new one.
    fn make_room(&mut self, task: &RenderTask) {
        let (RenderTask::Picture(request) | RenderTask::Series(request)) = task;
        let film = self.kept.reserve(|| Film::reserve(request.camera.resolution));
        if matches!(task, RenderTask::Series(_)) {
            drop(self.kept.reserve(|| Film::reserve_series(request.camera.resolution)));
        }
        drop(film);
    }
}
