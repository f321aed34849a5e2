//! Sessions of earlier images. A request that was rendered before continues with its samples.
use std::{sync::Arc, time::Duration};

use super::Session;
use crate::render::{film::Film, protocol::RenderRequest};
use noisefall_base::memory::{Reservation, TooMuch};
use noisefall_scene::scene::Scene;

/// Memory of all films that are kept, in bytes: four of 1920 × 1080 pixels. Scenes before an edit count too.
const MOST_BYTES: u64 = 512 << 20;
/// Most scenes before an edit whose images are kept.
const MOST_SCENES: usize = 8;
/// Samples per pixel from which an image is kept when its scene is edited. While something is dragged, each step has fewer, and its
/// film is used for the next one.
const LEAST_SPP: u32 = 4;

/// Sessions to go back to, within a budget of memory.
pub(in crate::render) struct SessionCache {
    kept: Vec<CachedSession>,
    most_bytes: u64,
    /// The number of sessions so far.
    count: u64,
    /// Identity of the scene that is rendered, once it is known.
    current: Option<Arc<()>>,
}

struct CachedSession {
    session: Session,
    /// The number of sessions that were kept before it.
    number: u64,
    bytes: u64,
}

impl Default for SessionCache {
    fn default() -> SessionCache {
        SessionCache::within(MOST_BYTES)
    }
}

impl SessionCache {
    pub fn within(most_bytes: u64) -> SessionCache {
        SessionCache { kept: Vec::new(), most_bytes, count: 0, current: None }
    }

    /// Keeps a session, or returns its film for another one to use.
    pub fn keep(&mut self, mut session: Session) -> Option<Film> {
        let bytes = Film::kept_bytes(session.request.camera.resolution);
        let scene = &session.request.scene;
        let of_scene = if is_current(&self.current, scene) { 0 } else { scene.memory.bytes() };
        if !session.is_worth_keeping() || bytes + of_scene > self.most_bytes {
            return Some(session.into_film());
        }
        // Its frames, half images and saved images are not kept.
        (session.memory, session.halves) = ([None, None], None);
        let is_full = |kept: &SessionCache| {
            let scenes = kept.scenes(Some(&session)).len();
            kept.bytes() + bytes + kept.bytes_of_scenes(Some(&session)) > kept.most_bytes || scenes > MOST_SCENES
        };
        while !self.kept.is_empty() && is_full(self) {
            self.drop_one();
        }
        let memory = self.reserve(|| Film::reserve_kept(session.request.camera.resolution));
        session.memory[0] = Some(memory?);
        self.count += 1;
        self.kept.push(CachedSession { session, number: self.count, bytes });
        None
    }

    /// The session of a request, if it is kept. It continues with the scene of the request.
    pub fn take(&mut self, request: &RenderRequest) -> Option<Session> {
        let at = self.kept.iter().position(|kept| kept.session.is_of(request))?;
        let mut session = self.kept.remove(at).session;
        session.set_scene(request.scene.clone());
        Some(session)
    }

    /// Renders a scene from now on. Drops the sessions of others, but keeps those from before an edit of this one, within the budget.
    pub fn retain_scene(&mut self, scene: &Arc<Scene>) {
        self.kept.retain(|kept| kept.session.request.scene.is_of_same_file(scene));
        self.current = Some(scene.identity.clone());
        while self.bytes() + self.bytes_of_scenes(None) > self.most_bytes && !self.kept.is_empty() {
            self.drop_one();
        }
    }

    /// Drops the sessions of scenes before an edit. Returns whether there were any.
    pub fn drop_other_scenes(&mut self) -> bool {
        let before = self.kept.len();
        let current = self.current.clone();
        self.kept.retain(|kept| is_current(&current, &kept.session.request.scene));
        self.kept.len() < before
    }

    /// The scenes of the kept sessions and of one more, without the current one.
    fn scenes<'s>(&'s self, more: Option<&'s Session>) -> Vec<&'s Arc<Scene>> {
        let sessions = self.kept.iter().map(|kept| &kept.session).chain(more);
        let mut scenes: Vec<&Arc<Scene>> = Vec::new();
        for scene in sessions.map(|session| &session.request.scene) {
            let is_known = scenes.iter().any(|known| known.has_same_image(scene));
            if !is_known && !is_current(&self.current, scene) {
                scenes.push(scene);
            }
        }
        scenes
    }

    /// Memory of these scenes, in bytes. They may share parts, so that it is at most this.
    fn bytes_of_scenes(&self, more: Option<&Session>) -> u64 {
        self.scenes(more).iter().map(|scene| scene.memory.bytes()).sum()
    }

    /// Makes a reservation. Drops sessions until there is memory for it.
    pub fn reserve(&mut self, reserve: impl Fn() -> Result<Reservation, TooMuch>) -> Option<Reservation> {
        loop {
            match reserve() {
                Ok(memory) => return Some(memory),
                Err(_) if self.kept.is_empty() => return None,
                Err(_) => self.drop_one(),
            }
        }
    }

    fn bytes(&self) -> u64 {
        self.kept.iter().map(|kept| kept.bytes).sum()
    }

    /// Drops the session with the least render time per session kept since: a drag of the camera leaves many short renders, which
    /// must not push out a long one.
    fn drop_one(&mut self) {
        let worth = |kept: &CachedSession| kept.session.elapsed.as_secs_f64() / (self.count - kept.number + 1) as f64;
        let least = (0..self.kept.len()).min_by(|a, b| worth(&self.kept[*a]).total_cmp(&worth(&self.kept[*b])));
        least.into_iter().for_each(|at| drop(self.kept.remove(at)));
    }
}

fn is_current(current: &Option<Arc<()>>, scene: &Scene) -> bool {
    current.as_ref().is_none_or(|current| Arc::ptr_eq(&scene.identity, current))
}

impl Session {
    /// Whether the image is worth keeping when the scene is edited.
    pub fn outlasts_edit(&self) -> bool {
        self.film.spp() >= LEAST_SPP
    }

    /// Whether this is the image of a request. A series is not, because it has another film.
    pub fn is_of(&self, request: &RenderRequest) -> bool {
        let RenderRequest { scene, camera, settings } = &self.request;
        scene.has_same_image(&request.scene)
            && (camera, settings) == (&request.camera, &request.settings)
            && !self.film.has_series()
    }

    /// Continues with another scene that has the same image.
    pub fn set_scene(&mut self, scene: Arc<Scene>) {
        self.request.scene = scene;
    }

    /// Continues the session as the image of a later generation. `steps` is the number of single passes that were requested before.
    pub fn resumed(mut self, generation: u64, steps: u64) -> Session {
        self.memory = [None, None];
        self.keep(0, Film::reserve(self.request.camera.resolution));
        (self.generation, self.steps_done) = (generation, steps);
        (self.coarse, self.last_frame, self.stale) = (None, None, true);
        self
    }

    fn is_worth_keeping(&self) -> bool {
        self.film.spp() > 0 && self.count.failure.is_none() && !self.film.has_series() && self.elapsed > Duration::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::tests::{session, threads, to},
        *,
    };
    use crate::render::protocol::Publish;

    /// A session of a few samples that took the given number of seconds.
    fn rendered(scene: &Arc<Scene>, seed: u32, seconds: u64) -> Session {
        let mut session = session([32, 32], Publish::Sparse, None);
        session.request.scene = scene.clone();
        session.request.settings.seed = seed;
        session.advance(&threads(), &to(2), Publish::Sparse, &|| false);
        session.elapsed = Duration::from_secs(seconds);
        session
    }

    fn request(session: &Session) -> RenderRequest {
        session.request.clone()
    }

    #[test]
    fn a_session_that_is_kept_continues_with_its_samples_as_another_generation() {
        let scene = Arc::new(noisefall_scene::scene::built_in());
        let mut kept = SessionCache::default();
        let first = rendered(&scene, 1, 5);
        let (of_first, samples) = (request(&first), first.film.samples());
        assert!(kept.keep(first).is_none() && kept.take(&of_first).is_some());
        assert!(kept.take(&of_first).is_none(), "it was taken");
        assert!(kept.keep(rendered(&scene, 1, 5)).is_none());
        let other = RenderRequest {
            settings: noisefall_scene::scene::RenderSettings { seed: 2, ..of_first.settings },
            ..of_first.clone()
        };
        assert!(kept.take(&other).is_none());
        let resumed = kept.take(&of_first).expect("it is kept").resumed(17, 3);
        assert_eq!((resumed.generation, resumed.steps_done, resumed.film.samples()), (17, 3, samples));
        assert!(resumed.frame_due(Publish::Live, true) && !resumed.is_coarse());
        assert!(kept.keep(resumed).is_none());
        kept.retain_scene(&Arc::new(noisefall_scene::scene::built_in()));
        assert!(kept.take(&of_first).is_none(), "it was of another scene");
    }

    #[test]
    fn a_session_that_is_kept_and_resumed_has_the_memory_of_its_film_alone() {
        let mut session = rendered(&Arc::new(noisefall_scene::scene::built_in()), 1, 1);
        session.memory = [None, Some(Reservation::none())];
        session.halves = Some(Reservation::none());
        let of_session = request(&session);
        let mut kept = SessionCache::default();
        assert!(kept.keep(session).is_none());
        let of_kept = &kept.kept[0].session;
        assert!(of_kept.memory.each_ref().map(Option::is_some) == [true, false] && of_kept.halves.is_none());
        let mut resumed = kept.take(&of_session).expect("it is kept").resumed(2, 0);
        assert_eq!(resumed.memory.each_ref().map(Option::is_some), [true, false]);
        resumed.keep_halves(true, &mut kept);
        assert!(resumed.halves.is_some(), "half images are reserved again");
    }

    #[test]
    fn short_renders_never_push_out_a_long_one() {
        let scene = Arc::new(noisefall_scene::scene::built_in());
        let mut kept = SessionCache::within(3 * Film::kept_bytes([32, 32]));
        let long = rendered(&scene, 0, 600);
        let of_long = request(&long);
        assert!(kept.keep(long).is_none());
        for seed in 1..20 {
            assert!(kept.keep(rendered(&scene, seed, 1)).is_none());
            assert!(kept.kept.len() <= 3);
        }
        assert!(kept.take(&of_long).is_some());
    }

    #[test]
    fn empty_and_too_large_sessions_give_their_films_back() {
        let scene = Arc::new(noisefall_scene::scene::built_in());
        let empty = session([32, 32], Publish::Sparse, None);
        assert!(SessionCache::default().keep(empty).is_some());
        assert!(SessionCache::within(1000).keep(rendered(&scene, 0, 1)).is_some());
    }
}
