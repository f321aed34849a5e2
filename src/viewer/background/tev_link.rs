//! The connection to tev. Connecting and sending are done on other threads.
use std::sync::Arc;

use noisefall_render::render::{
    Frame,
    tev::{DEFAULT_ADDRESS, Tev, TevStream},
};

use super::background_task::BackgroundTask;

pub struct TevLink {
    ctx: egui::Context,
    /// The address that was used last in this session.
    pub address: String,
    connecting: Option<BackgroundTask<Result<TevStream, String>>>,
    stream: Option<TevStream>,
}

/// State of the connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TevState {
    Off,
    Connecting,
    /// The image is sent while it is rendered.
    Live,
}

impl TevLink {
    pub fn new(ctx: &egui::Context) -> TevLink {
        TevLink { ctx: ctx.clone(), address: DEFAULT_ADDRESS.to_owned(), connecting: None, stream: None }
    }

    /// Connects to an address, and ends an earlier connection.
    pub fn connect(&mut self, address: String) {
        self.stop();
        self.address.clone_from(&address);
        let ctx = self.ctx.clone();
        self.connecting = Some(BackgroundTask::start(&self.ctx, move |_| {
            let stream = Tev::connect(&address).and_then(|tev| TevStream::start(tev, move || ctx.request_repaint()));
            stream.map_err(|error| error.to_string())
        }));
    }

    /// Ends the connection.
    pub fn stop(&mut self) {
        (self.connecting, self.stream) = (None, None);
    }

    pub fn state(&self) -> TevState {
        match (&self.connecting, &self.stream) {
            (Some(_), _) => TevState::Connecting,
            (None, Some(_)) => TevState::Live,
            (None, None) => TevState::Off,
        }
    }

    /// Takes up a new connection. Returns a message, once, if there is none or if it was lost.
    pub fn receive(&mut self) -> Option<String> {
        let failed = |_| Err("Connecting to tev failed unexpectedly".to_owned());
        match BackgroundTask::take(&mut self.connecting).map(|found| found.unwrap_or_else(failed)) {
            Some(Ok(stream)) => self.stream = Some(stream),
            Some(Err(error)) => return Some(error),
            None => {}
        }
        let failure = self.stream.as_ref()?.failure()?;
        self.stream = None;
        Some(failure.to_string())
    }

    /// Sends a frame as the image of this name, if there is a connection.
    pub fn show(&mut self, name: &str, frame: &Arc<Frame>) {
        self.stream.iter_mut().for_each(|stream| stream.show(name, frame));
    }
}
