//! The darkroom: frames are developed to screen pixels, and held against the exact picture, off the UI thread.
use std::sync::{Arc, Mutex, PoisonError};

use crossbeam_channel::{Sender, unbounded};
use noisefall::{
    measure::compare,
    render::{Display, Frame, display::to_srgb},
};

/// What to develop.
#[derive(Clone)]
pub struct Order {
    pub frame: Arc<Frame>,
    pub display: Display,
    /// The exact picture, if the scene names one.
    pub truth: Option<Arc<Vec<[f32; 3]>>>,
}

/// A frame ready to be shown.
pub struct Print {
    pub frame: Arc<Frame>,
    pub image: egui::ColorImage,
    /// relMSE against the exact picture.
    pub rel_mse: Option<f64>,
}

pub struct Darkroom {
    orders: Sender<Order>,
    last: Option<Order>,
    ready: Arc<Mutex<Option<Print>>>,
}

impl PartialEq for Order {
    fn eq(&self, other: &Self) -> bool {
        let same_truth = self.truth.as_ref().map(Arc::as_ptr) == other.truth.as_ref().map(Arc::as_ptr);
        Arc::ptr_eq(&self.frame, &other.frame) && self.display == other.display && same_truth
    }
}

impl Darkroom {
    pub fn new(ctx: &egui::Context) -> Darkroom {
        let (orders, inbox) = unbounded::<Order>();
        let ready = Arc::new(Mutex::new(None));
        let (ctx, shelf) = (ctx.clone(), ready.clone());
        let work = move || {
            let mut pixels = Vec::new();
            while let Ok(order) = inbox.recv() {
                // Only the latest order matters.
                let order = inbox.try_iter().last().unwrap_or(order);
                *shelf.lock().unwrap_or_else(PoisonError::into_inner) = Some(develop(order, &mut pixels));
                ctx.request_repaint();
            }
        };
        std::thread::Builder::new().name("darkroom".to_owned()).spawn(work).expect("a thread can be started");
        Darkroom { orders, last: None, ready }
    }

    /// Develops this unless it is what was ordered last.
    pub fn order(&mut self, order: Order) {
        if !order.frame.radiance.is_empty() && self.last.as_ref() != Some(&order) {
            self.last = Some(order.clone());
            let _ = self.orders.send(order);
        }
    }

    /// The latest print, once.
    pub fn take(&self) -> Option<Print> {
        self.ready.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

fn develop(Order { frame, display, truth }: Order, pixels: &mut Vec<[u8; 4]>) -> Print {
    to_srgb(&frame, display, pixels);
    let size = [frame.width as usize, frame.height as usize];
    let image = egui::ColorImage::from_rgba_unmultiplied(size, pixels.as_flattened());
    let truth = truth.filter(|truth| truth.len() == frame.radiance.len());
    let rel_mse = truth.map(|truth| compare(&frame.radiance, &truth).rel_mse);
    Print { frame, image, rel_mse }
}
