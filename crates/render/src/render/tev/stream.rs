//! The latest frames of a render, sent to tev on a thread of their own.
use std::{
    net::{Shutdown, TcpStream},
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
    time::{Duration, Instant},
};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded};

use super::{Tev, TevError};
use crate::render::frame::Frame;

/// Shortest time between two images.
const INTERVAL: Duration = Duration::from_secs(1);

/// A frame to show.
struct NamedFrame {
    name: String,
    frame: Arc<Frame>,
}

/// Sends the latest frame to tev, at most once a second. [`TevStream::show`] never waits. Dropping it ends the connection at once.
pub struct TevStream {
    address: String,
    socket: TcpStream,
    /// The frame that is sent next.
    next: Arc<Mutex<Option<NamedFrame>>>,
    wake: Option<Sender<()>>,
    ended: Receiver<Result<(), TevError>>,
    /// The frame that was shown last.
    last: Weak<Frame>,
}

impl TevStream {
    /// Starts the thread. `notify` is called on it when the connection is lost.
    pub fn start(tev: Tev, notify: impl FnOnce() + Send + 'static) -> Result<TevStream, TevError> {
        let socket = tev.socket.try_clone().map_err(|error| tev.lost(&error))?;
        let (wake, woken) = bounded(1);
        let (sender, ended) = bounded(1);
        let (address, next) = (tev.address.clone(), Arc::new(Mutex::default()));
        let source = next.clone();
        std::thread::spawn(move || {
            let _ = sender.send(send_latest(tev, &woken, &source));
            notify();
        });
        Ok(TevStream { address, socket, next, wake: Some(wake), ended, last: Weak::new() })
    }

    /// The address of the connection.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Sends this frame instead of earlier ones that have not been sent. A frame that was shown already is not sent again.
    pub fn show(&mut self, name: &str, frame: &Arc<Frame>) {
        let of_frame = Arc::downgrade(frame);
        if !of_frame.ptr_eq(&self.last) {
            *lock(&self.next) = Some(NamedFrame { name: name.to_owned(), frame: frame.clone() });
            self.wake.iter().for_each(|wake| _ = wake.try_send(()));
            self.last = of_frame;
        }
    }

    /// Why the connection has ended, once; `None` while it lasts.
    pub fn failure(&self) -> Option<TevError> {
        self.ended.try_recv().ok()?.err()
    }

    /// Sends the last frame, and ends the connection. A server that has not taken the frame after some time, or when `is_dropped` says so,
    /// does not get it.
    pub fn finish(mut self, most: Duration, is_dropped: impl Fn() -> bool) -> Result<(), TevError> {
        /// Time between two looks at `is_dropped`.
        const TICK: Duration = Duration::from_millis(20);
        self.wake = None;
        let end = Instant::now() + most;
        while Instant::now() < end && !is_dropped() {
            match self.ended.recv_timeout(TICK) {
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
                Ok(ended) => return ended,
            }
        }
        Err(TevError::Slow { address: self.address.clone() })
    }
}

impl Drop for TevStream {
    fn drop(&mut self) {
        *lock(&self.next) = None;
        // A write that waits for tev ends. The connection may have ended before.
        let _ = self.socket.shutdown(Shutdown::Both);
    }
}

fn lock(next: &Mutex<Option<NamedFrame>>) -> MutexGuard<'_, Option<NamedFrame>> {
    next.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Sends frames until nobody can show any more.
fn send_latest(mut tev: Tev, woken: &Receiver<()>, next: &Mutex<Option<NamedFrame>>) -> Result<(), TevError> {
    let mut earliest = Instant::now();
    loop {
        let mut is_last = woken.recv().is_err();
        while !is_last {
            match woken.recv_deadline(earliest) {
                // A later frame took the place of the one that waits.
                Ok(()) => {}
                Err(RecvTimeoutError::Timeout) => break,
                Err(RecvTimeoutError::Disconnected) => is_last = true,
            }
        }
        let picture = lock(next).take();
        if let Some(NamedFrame { name, frame }) = picture {
            tev.show(&name, &frame)?;
            earliest = Instant::now() + INTERVAL;
        }
        if is_last {
            return Ok(());
        }
    }
}
