//! The worker: a thread that renders what was asked for last and publishes frames.
//!
//! Others say what they *want* ([`Job`], [`Budget`]); the worker takes the latest and forgets the rest. Whatever arrives while
//! it renders stops the pass between two bounces, so an answer never takes longer than that, some ten microseconds. A batch that
//! is stopped is thrown away and traced again.
//! A new job starts an empty film; a new budget goes on with the film there is.
//!
//! A second picture may be rendered beside the first. From then on both get the same time: the one that had less goes on.
use std::{
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    thread::JoinHandle,
    time::Duration,
};

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::{
    frame::Frame,
    pass::{Failure, SampleId, Threads},
    region::Region,
    session::Session,
};
use crate::scene::{Camera, RenderSettings, Scene};

/// A picture to render. Another generation is another picture.
#[derive(Clone)]
pub struct Job {
    pub generation: u64,
    pub scene: Arc<Scene>,
    pub camera: Camera,
    pub settings: RenderSettings,
}

/// How far to render it. A change goes on with the samples there are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    pub paused: bool,
    /// Single passes asked for so far while paused: a count that only grows.
    pub steps: u64,
    pub max_spp: Option<u32>,
    pub max_time: Option<Duration>,
    /// Relative noise at which to stop: the root of the estimated relMSE.
    pub noise: Option<f64>,
    /// What to render before the rest, until it has `max_spp` samples.
    pub region: Option<Region>,
}

/// A picture beside the first.
#[derive(Clone)]
pub enum Beside {
    /// Another one, as of the same scene by other settings.
    Picture(Job),
    /// The same one as a [`super::Series`]: only full frames.
    Series(Job),
}

/// What the worker is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum State {
    /// No job yet.
    #[default]
    Idle,
    Running,
    Paused,
    /// A target of the budget is reached.
    Converged,
    /// The renderer panicked; the picture so far stands.
    Failed(Failure),
}

/// Figures of the render, and what the worker is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    pub generation: u64,
    pub state: State,
    pub spp: u32,
    /// Samples per pixel of the region that is rendered before the rest.
    pub region_spp: Option<u32>,
    /// Camera samples taken.
    pub samples: u64,
    /// Path segments traced.
    pub rays: u64,
    /// Time spent rendering this picture.
    pub elapsed: Duration,
    pub rel_mse_estimate: Option<f64>,
    /// Pixels share what their paths find.
    pub shares: bool,
    /// Samples are spread by noise.
    pub adapts: bool,
    /// Samples dropped because they were not finite or negative.
    pub invalid_samples: u64,
    pub first_invalid: Option<SampleId>,
    /// Paths cut at [`RenderSettings::last_bounce`] without a cap that says so.
    pub cut_paths: u64,
}

impl Status {
    /// Why the expected picture differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self, settings: &RenderSettings) -> Option<String> {
        settings.bias().or((self.cut_paths > 0).then(|| format!("{} paths cut", self.cut_paths)))
    }

    /// Root of the estimated relMSE.
    pub fn relative_noise(&self) -> Option<f64> {
        self.rel_mse_estimate.map(f64::sqrt)
    }

    pub fn samples_per_second(&self) -> f64 {
        self.samples as f64 / self.elapsed.as_secs_f64().max(1e-9)
    }
}

/// The latest picture and figures.
#[derive(Clone, Default)]
pub struct Published {
    pub frame: Arc<Frame>,
    pub status: Status,
}

/// When frames are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Publish {
    /// A coarse one at once, then as the picture grows: for looking on.
    Live,
    /// Twice a second and at rest, full resolution only: for files.
    Sparse,
}

enum Message {
    Job(Box<Job>),
    Beside(Option<Box<Beside>>),
    Budget(Budget),
    Threads(Threads),
    Quit,
}

/// What both sides see.
struct Shared {
    /// Of the first picture and of the one beside it.
    published: Mutex<[Published; 2]>,
    /// Messages sent so far.
    sent: AtomicU64,
}

/// The handle to the worker. Dropping it stops the thread.
pub struct Renderer {
    sender: Sender<Message>,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Renderer {
    /// Starts the thread. `notify` is called on it after everything it publishes.
    pub fn new(threads: Threads, publish: Publish, notify: impl Fn() + Send + 'static) -> Renderer {
        let (sender, receiver) = unbounded();
        let shared = Arc::new(Shared { published: Mutex::default(), sent: AtomicU64::new(0) });
        let worker = Worker {
            threads,
            publish,
            receiver,
            shared: shared.clone(),
            seen: 0,
            budget: Budget::default(),
            sessions: [None, None],
            lead: Duration::ZERO,
        };
        let thread = std::thread::Builder::new().name("worker".to_owned()).spawn(move || worker.run(&notify));
        Renderer { sender, shared, thread: Some(thread.expect("a thread can be started")) }
    }

    /// Renders this instead of what came before.
    pub fn submit(&self, job: Job) {
        self.send(Message::Job(Box::new(job)));
    }

    /// Renders this beside the first picture, or nothing.
    pub fn submit_beside(&self, beside: Option<Beside>) {
        self.send(Message::Beside(beside.map(Box::new)));
    }

    /// Goes on with these threads.
    pub fn set_threads(&self, threads: Threads) {
        self.send(Message::Threads(threads));
    }

    pub fn set_budget(&self, budget: Budget) {
        self.send(Message::Budget(budget));
    }

    /// The latest frame and figures. Never waits for the render.
    pub fn latest(&self) -> Published {
        lock(&self.shared.published)[0].clone()
    }

    /// The same of the picture beside it.
    pub fn latest_beside(&self) -> Published {
        lock(&self.shared.published)[1].clone()
    }

    fn send(&self, message: Message) {
        // Counted before it is sent: a pass that sees the count stops and finds the message, at the latest a moment later.
        self.shared.sent.fetch_add(1, Ordering::SeqCst);
        let _ = self.sender.send(message);
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.send(Message::Quit);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn lock(published: &Mutex<[Published; 2]>) -> MutexGuard<'_, [Published; 2]> {
    published.lock().unwrap_or_else(PoisonError::into_inner)
}

struct Worker {
    threads: Threads,
    publish: Publish,
    receiver: Receiver<Message>,
    shared: Arc<Shared>,
    /// Messages received so far.
    seen: u64,
    budget: Budget,
    /// Of the first picture and of the one beside it.
    sessions: [Option<Session>; 2],
    /// Time that the first picture had had when the other one began.
    lead: Duration,
}

impl Worker {
    fn run(mut self, notify: &dyn Fn()) {
        loop {
            let busy = self.next().is_some();
            if self.receive(!busy).is_none() {
                return;
            }
            let next = self.next();
            if let Some(session) = next.and_then(|side| self.sessions[side].as_mut()) {
                let (sent, seen) = (&self.shared.sent, self.seen);
                session.advance(&self.threads, &self.budget, self.publish, &|| sent.load(Ordering::Relaxed) != seen);
            }
            for side in 0..self.sessions.len() {
                // A large frame that is out of date already would only hold up what was asked for since. A coarse one is quick,
                // and while the camera is dragged there is never anything but coarse ones.
                let is_coarse = self.sessions[side].as_ref().is_some_and(Session::is_coarse);
                if is_coarse || self.shared.sent.load(Ordering::Relaxed) == self.seen {
                    self.publish(side, notify);
                }
            }
        }
    }

    /// The side whose turn it is: of those that are not done, the one that had less time since both are there.
    fn next(&self) -> Option<usize> {
        let running = |session: &Session| session.state(&self.budget) == State::Running;
        let sides = self.sessions.iter().enumerate().filter_map(|(side, session)| Some((side, session.as_ref()?)));
        let running = sides.filter(|(_, session)| running(session));
        // The first look at a picture goes before the second sample of another one.
        let leads = [self.lead, Duration::ZERO];
        let time = |side: usize, session: &Session| session.elapsed().saturating_sub(leads[side]);
        running.min_by_key(|(side, session)| (!session.is_coarse(), time(*side, session))).map(|(side, _)| side)
    }

    /// Makes a frame if one is due, and tells what has changed.
    fn publish(&mut self, side: usize, notify: &dyn Fn()) {
        let Some(session) = &mut self.sessions[side] else { return };
        let at_rest = session.state(&self.budget) != State::Running;
        let frame = session.frame_due(self.publish, at_rest).then(|| self.threads.install(|| Arc::new(session.frame())));
        // The frame's noise estimate may itself be what the budget waits for.
        let status = session.status(&self.budget);
        let mut published = lock(&self.shared.published);
        let changed = frame.is_some() || published[side].status != status;
        published[side].status = status;
        if let Some(frame) = frame {
            published[side].frame = frame;
        }
        drop(published);
        if changed {
            notify();
        }
    }

    /// Takes all messages that have arrived, at least one if `wait`. `None` asks the worker to quit.
    fn receive(&mut self, wait: bool) -> Option<()> {
        if wait {
            let message = self.receiver.recv().ok()?;
            self.take(message)?;
        }
        while let Ok(message) = self.receiver.try_recv() {
            self.take(message)?;
        }
        Some(())
    }

    fn take(&mut self, message: Message) -> Option<()> {
        self.seen += 1;
        match message {
            Message::Quit => return None,
            Message::Budget(budget) => self.budget = budget,
            Message::Threads(threads) => self.threads = threads,
            Message::Job(job) => self.start(0, Beside::Picture(*job)),
            Message::Beside(None) => {
                self.sessions[1] = None;
                lock(&self.shared.published)[1] = Published::default();
            }
            Message::Beside(Some(beside)) => self.start(1, *beside),
        }
        Some(())
    }

    fn start(&mut self, side: usize, what: Beside) {
        let (Beside::Picture(job) | Beside::Series(job)) = &what;
        let sessions = || self.sessions.iter().flatten();
        let rate = sessions().filter(|old| Arc::ptr_eq(&old.job().scene, &job.scene)).find_map(Session::rate);
        let film = self.sessions[side].take().map(Session::into_film);
        self.lead = self.sessions[0].as_ref().map_or(Duration::ZERO, Session::elapsed);
        self.sessions[side] = Some(match what {
            Beside::Picture(job) => Session::new(job, self.publish, rate, &self.budget, film),
            Beside::Series(job) => Session::of_series(job, rate, &self.budget),
        });
    }
}
