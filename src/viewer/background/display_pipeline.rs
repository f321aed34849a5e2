//! The display pipeline turns frames into screen pixels off the UI thread. The latest request wins.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError},
};

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::{display_image::DisplayImage, display_image::render, display_request::DisplayRequest};

pub struct DisplayPipeline {
    requests: Sender<DisplayRequest>,
    /// The other end of the channel, to drop outdated requests, which hold large images.
    waiting: Receiver<DisplayRequest>,
    last: Option<DisplayRequest>,
    ready: Arc<Mutex<Option<DisplayImage>>>,
}

impl DisplayPipeline {
    pub fn new(ctx: &egui::Context) -> DisplayPipeline {
        let (requests, inbox) = unbounded::<DisplayRequest>();
        let ready = Arc::new(Mutex::new(None));
        let (ctx, slot, waiting) = (ctx.clone(), ready.clone(), inbox.clone());
        let work = move || {
            while let Ok(request) = inbox.recv() {
                // A panic in one image must not end the thread.
                let Ok(image) = catch_unwind(AssertUnwindSafe(|| render(request))) else { continue };
                *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(image);
                ctx.request_repaint();
            }
        };
        std::thread::Builder::new().name("display".to_owned()).spawn(work).expect("a thread can be started");
        DisplayPipeline { requests, waiting, last: None, ready }
    }

    /// Renders this unless it equals the last request.
    pub fn request(&mut self, request: DisplayRequest) {
        if !request.frame.radiance.is_empty() && self.last.as_ref() != Some(&request) {
            self.last = Some(request.clone());
            self.waiting.try_iter().for_each(drop);
            let _ = self.requests.send(request);
        }
    }

    /// The latest image, once.
    pub fn take(&self) -> Option<DisplayImage> {
        self.ready.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}
