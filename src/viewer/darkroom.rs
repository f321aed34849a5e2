//! The darkroom: frames are developed to screen pixels, and held against the exact picture, off the UI thread.
use std::sync::{Arc, Mutex, PoisonError};

use crossbeam_channel::{Sender, unbounded};
use noisefall::render::{Display, Frame, display::to_srgb, truth::Reference};

/// What to develop.
#[derive(Clone)]
pub struct Order {
    pub frame: Arc<Frame>,
    pub display: Display,
    /// What the frame must converge to, if that is known.
    pub truth: Option<Arc<Reference>>,
    /// Textures cannot be larger.
    pub most_side: usize,
}

/// A frame ready to be shown.
pub struct Print {
    pub frame: Arc<Frame>,
    pub image: egui::ColorImage,
    /// relMSE against the exact picture.
    pub rel_mse: Option<f64>,
    /// No sample has found light.
    pub black: bool,
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

fn develop(order: Order, pixels: &mut Vec<[u8; 4]>) -> Print {
    let Order { frame, display, truth, most_side } = order;
    to_srgb(&frame, display, pixels);
    let [width, height] = [frame.width, frame.height].map(|side| side as usize);
    let step = width.max(height).div_ceil(most_side.max(1)).max(1);
    let image = if step == 1 {
        egui::ColorImage::from_rgba_unmultiplied([width, height], pixels.as_flattened())
    } else {
        // Every `step`-th pixel of what no texture can hold whole.
        let rows = pixels.chunks_exact(width).step_by(step);
        let thinned: Vec<u8> = rows.flat_map(|row| row.iter().step_by(step)).flatten().copied().collect();
        egui::ColorImage::from_rgba_unmultiplied([width.div_ceil(step), height.div_ceil(step)], &thinned)
    };
    let rel_mse = truth.and_then(|truth| truth.compare(&frame)).map(|comparison| comparison.rel_mse);
    Print { black: frame.is_black(), frame, image, rel_mse }
}
