//! `render --tev`: shows the image in tev while it is rendered.
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use noisefall_render::render::{
    Frame,
    tev::{Tev, TevError, TevStream, check_address},
};

use super::{
    messages::{Failure, tell},
    stop::now_says,
};

/// Longest wait for the last frame: of a render that is finished, and of one that was interrupted.
const PATIENTLY: Duration = Duration::from_secs(10);
const BRIEFLY: Duration = Duration::from_secs(1);

/// Parses the address of tev.
pub fn address(text: &str) -> Result<String, String> {
    check_address(text).map(|()| text.to_owned())
}

/// The connection to tev, if one was asked for. When it is lost, the render continues.
pub struct LiveView {
    /// Name of the image in tev.
    name: String,
    stream: Option<TevStream>,
}

impl LiveView {
    /// Connects to tev if there is an address.
    pub fn connect(address: Option<&str>, name: String) -> Result<LiveView, Failure> {
        let connect = |address| Tev::connect(address).and_then(|tev| TevStream::start(tev, || ()));
        let stream = address.map(connect).transpose().map_err(|error| error.to_string())?;
        Ok(LiveView { name, stream })
    }

    /// Shows a frame. Returns a warning, once, if the connection is lost.
    pub fn show(&mut self, frame: &Arc<Frame>) -> Option<String> {
        let stream = self.stream.as_mut()?;
        if let Some(failure) = stream.failure() {
            self.stream = None;
            return Some(warning(&failure));
        }
        stream.show(&self.name, frame);
        None
    }

    /// Says what an interruption does from now on: all renders are finished.
    pub fn announce_end(&self) {
        if self.stream.is_some() {
            now_says("interrupted: closing the connection to tev");
        }
    }

    /// Waits until the last frame is sent, but not long. An interruption ends the connection.
    pub fn finish(self, stop: &AtomicBool) {
        let Some(stream) = self.stream else { return };
        let was_interrupted = stop.load(Ordering::Relaxed);
        let most = if was_interrupted { BRIEFLY } else { PATIENTLY };
        if let Err(failure) = stream.finish(most, || !was_interrupted && stop.load(Ordering::Relaxed)) {
            tell(&warning(&failure));
        }
    }
}

fn warning(failure: &TevError) -> String {
    format!("warning: {failure}")
}
