//! The handle to the worker.
use std::{
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
    thread::JoinHandle,
};

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};

use super::{Message, Shared, Worker, lock};
use crate::render::{
    checkpoint::{Checkpoint, CheckpointPlan},
    protocol::{Budget, Publish, Published, RenderRequest, RenderTask},
    scene_edit::{EditResult, SceneEdit},
    threads::Threads,
};

/// Asks the worker for checkpoints, from any thread.
#[derive(Clone)]
pub struct KeepHandle {
    sender: Sender<Message>,
    shared: Arc<Shared>,
}

impl KeepHandle {
    /// Keeps the first image once, if it has this number still. The events of the plan have the result.
    pub fn keep_once(&self, generation: u64, plan: CheckpointPlan) {
        send(&self.sender, &self.shared, Message::KeepOnce(generation, Box::new(plan)));
    }
}

fn send(sender: &Sender<Message>, shared: &Shared, message: Message) {
    // Counted before it is sent: a pass that sees the count stops and finds the message, at the latest a moment later.
    shared.sent.fetch_add(1, Ordering::SeqCst);
    let _ = sender.send(message);
}

/// The handle to the worker. Dropping it stops the thread.
pub struct Renderer {
    sender: Sender<Message>,
    shared: Arc<Shared>,
    edited: Receiver<EditResult>,
    thread: Option<JoinHandle<()>>,
}

impl Renderer {
    /// Starts the thread. `notify` is called on it after everything it publishes.
    pub fn new(threads: Threads, publish: Publish, notify: impl Fn() + Send + 'static) -> Renderer {
        let (sender, receiver) = unbounded();
        let shared = Arc::new(Shared { published: Mutex::default(), sent: AtomicU64::new(0) });
        let worker = Worker::new(threads, publish, receiver, shared.clone());
        let edited = worker.edits.results();
        let thread = std::thread::Builder::new().name("worker".to_owned()).spawn(move || worker.run(&notify));
        Renderer { sender, shared, edited, thread: Some(thread.expect("a thread can be started")) }
    }

    /// Renders this instead of earlier requests. Frames and figures carry `generation`, the number of the image.
    pub fn submit(&self, generation: u64, request: RenderRequest) {
        self.send(Message::First(generation, Box::new(request)));
    }

    /// Continues a render from its checkpoint instead of earlier requests.
    pub fn submit_checkpoint(&self, generation: u64, request: RenderRequest, kept: Checkpoint) {
        self.send(Message::Continue(generation, Box::new((request, kept))));
    }

    /// Keeps the first image by this plan from now on, or no longer.
    pub fn set_plan(&self, plan: Option<CheckpointPlan>) {
        self.send(Message::Keep(plan.map(Box::new)));
    }

    /// Writes a checkpoint by the plan. The receiver hears when it is on the disk or has failed.
    pub fn keep_now(&self) -> Receiver<()> {
        let (sender, receiver) = bounded(1);
        self.send(Message::KeepNow(sender));
        receiver
    }

    /// Returns a handle that requests checkpoints from other threads.
    pub fn keep_handle(&self) -> KeepHandle {
        KeepHandle { sender: self.sender.clone(), shared: self.shared.clone() }
    }

    /// Compiles a changed scene and renders it instead of earlier requests. The threads and the film stay.
    pub fn edit(&self, generation: u64, edit: SceneEdit) {
        self.send(Message::Edit(generation, Box::new(edit)));
    }

    /// The result of an edit, once. Edits that a later request replaced have none.
    pub fn take_edited(&self) -> Option<EditResult> {
        self.edited.try_recv().ok()
    }

    /// Renders this beside the first image.
    pub fn submit_second(&self, generation: u64, task: RenderTask) {
        self.send(Message::Second(generation, Box::new(task)));
    }

    /// Renders the first image alone.
    pub fn stop_second(&self) {
        self.send(Message::StopSecond);
    }

    /// Continues with these threads.
    pub fn set_threads(&self, threads: Threads) {
        self.send(Message::Threads(threads));
    }

    /// Continues up to this budget.
    pub fn set_budget(&self, budget: Budget) {
        self.send(Message::Budget(budget));
    }

    /// The latest frame and figures. Never waits for the render.
    pub fn latest(&self) -> Published {
        lock(&self.shared.published)[0].clone()
    }

    /// The latest frame and figures of the second image. Never waits for the render.
    pub fn latest_second(&self) -> Published {
        lock(&self.shared.published)[1].clone()
    }

    fn send(&self, message: Message) {
        send(&self.sender, &self.shared, message);
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
