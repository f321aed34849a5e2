//! The worker: a thread that renders the latest request and publishes frames.
//!
//! Others state what they *want* ([`RenderRequest`], [`Budget`]); the worker takes the latest request and drops earlier ones. A message
//! stops the pass between two bounces of a batch, which take some ten microseconds in a simple scene and longer where rays
//! descend trees. The interrupted batch is discarded and traced again. The compile of an edited scene ([`SceneEdit`]) cannot be
//! interrupted. A new request starts an empty film; a new budget continues the current film.
//!
//! An image that was rendered before continues with its samples; the image that is being rendered starts over if it is requested
//! again. A second image can be rendered beside the first. The one that had less time is next. A series by bounces, which is not compared,
//! does not catch up with the time before it.
mod checkpointing;
mod handle;
mod start;

use std::{
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use crossbeam_channel::{Receiver, Sender};

pub use self::handle::{KeepHandle, Renderer};
use super::{
    checkpoint::{Checkpoint, CheckpointPlan, CheckpointWriter},
    protocol::{Budget, Publish, Published, RenderRequest, RenderTask, State},
    scene_edit::{SceneEdit, SceneEdits},
    session::{Session, SessionCache},
    threads::Threads,
};

enum Message {
    First(u64, Box<RenderRequest>),
    /// The first image, from its checkpoint.
    Continue(u64, Box<(RenderRequest, Checkpoint)>),
    Edit(u64, Box<SceneEdit>),
    Second(u64, Box<RenderTask>),
    StopSecond,
    Budget(Budget),
    /// Keeps the first image from now on, or no longer.
    Keep(Option<Box<CheckpointPlan>>),
    /// Keeps it now, and answers when the file is there.
    KeepNow(Sender<()>),
    /// Keeps the first image once, if it has this number.
    KeepOnce(u64, Box<CheckpointPlan>),
    Threads(Threads),
    Quit,
}

/// State shared with the worker.
struct Shared {
    /// For the first image and the one beside it.
    published: Mutex<[Published; 2]>,
    /// Messages sent so far.
    sent: AtomicU64,
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
    /// For the first image and the one beside it.
    sessions: [Option<Session>; 2],
    /// Render time of both sides when a series began beside an image, or else zero.
    leads: [Duration; 2],
    /// Images to go back to.
    kept: SessionCache,
    edits: SceneEdits,
    /// Writes checkpoints of the first image.
    keeper: Option<CheckpointWriter>,
    /// Camera samples per second before an edit: a change of the scene rarely changes it much.
    rate: Option<f64>,
}

impl Worker {
    fn new(threads: Threads, publish: Publish, receiver: Receiver<Message>, shared: Arc<Shared>) -> Worker {
        Worker {
            threads,
            publish,
            receiver,
            shared,
            seen: 0,
            budget: Budget::default(),
            sessions: [None, None],
            leads: [Duration::ZERO; 2],
            kept: SessionCache::default(),
            edits: SceneEdits::default(),
            keeper: None,
            rate: None,
        }
    }

    fn run(mut self, notify: &dyn Fn()) {
        loop {
            let busy = self.next().is_some();
            if self.receive(!busy).is_none() {
                return;
            }
            self.compile_edit(notify);
            let next = self.next();
            if let Some(session) = next.and_then(|side| self.sessions[side].as_mut()) {
                let (sent, seen) = (&self.shared.sent, self.seen);
                session.advance(&self.threads, &self.budget, self.publish, &|| sent.load(Ordering::Relaxed) != seen);
            }
            self.keep_if_due();
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

    /// The next side: of those that are not done, the one with less time.
    fn next(&self) -> Option<usize> {
        let running = |session: &Session| session.state(&self.budget) == State::Running;
        let sides = self.sessions.iter().enumerate().filter_map(|(side, session)| Some((side, session.as_ref()?)));
        let running = sides.filter(|(_, session)| running(session));
        // The first look at an image goes before the second sample of another one.
        let time = |side: usize, session: &Session| session.elapsed().saturating_sub(self.leads[side]);
        running.min_by_key(|(side, session)| (!session.is_coarse(), time(*side, session))).map(|(side, _)| side)
    }

    /// Makes a frame if one is due, and notifies of changes.
    fn publish(&mut self, side: usize, notify: &dyn Fn()) {
        let Some(session) = &mut self.sessions[side] else { return };
        session.keep_halves(self.budget.halves && side == 0, &mut self.kept);
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
            Message::First(generation, request) => {
                self.edits.set(None);
                self.start(0, generation, RenderTask::Picture(*request));
            }
            Message::Continue(generation, render) => {
                self.edits.set(None);
                self.start_checkpoint(generation, *render);
            }
            Message::Keep(plan) => self.set_plan(plan.map(|plan| *plan)),
            Message::KeepNow(kept) => self.keep_now(&kept),
            Message::KeepOnce(generation, plan) => self.keep_once(generation, *plan),
            Message::Edit(generation, edit) => self.edits.set(Some((generation, edit))),
            Message::StopSecond => {
                self.sessions[1].take().into_iter().for_each(|session| drop(self.kept.keep(session)));
                // An edit may have replaced the scene since it began.
                self.sessions[0].iter().for_each(|first| self.kept.retain_scene(&first.request().scene));
                lock(&self.shared.published)[1] = Published::default();
            }
            Message::Second(generation, task) => self.start(1, generation, *task),
        }
        Some(())
    }
}

#[cfg(test)]
mod tests;
