//! The darkroom: frames are developed to screen pixels, and held against the true picture, off the UI thread.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError},
};

use crossbeam_channel::{Receiver, Sender, unbounded};
use noisefall::{
    integrator::Features,
    render::{
        Frame,
        truth::Reference,
        view::{Field, Legend, Look, Scale, Scores, Sources, View, draw},
    },
};

/// What to develop.
#[derive(Clone)]
pub struct Order {
    pub frame: Arc<Frame>,
    /// A second picture, to be seen with the first, or only held against the truth.
    pub beside: Option<Arc<Frame>>,
    pub shows_beside: bool,
    /// The term of a series to show in place of the frame's own radiance.
    pub term: Option<Term>,
    pub look: Look,
    /// What the frame must converge to, if that is known.
    pub truth: Option<Arc<Reference>>,
    pub pinned: Option<Arc<Frame>>,
    pub features: Option<Arc<Features>>,
    pub materials: Arc<[String]>,
    /// Textures cannot be larger.
    pub most_side: usize,
}

/// A part of a picture's series.
#[derive(Clone)]
pub struct Term {
    /// A frame with a series.
    pub of: Arc<Frame>,
    pub reflections: usize,
    /// Light of at most so many reflections.
    pub up_to: bool,
}

/// A frame ready to be shown.
pub struct Print {
    pub frame: Arc<Frame>,
    pub beside: Option<Arc<Frame>>,
    /// As shown, row by row: what a PNG of it has.
    pub pixels: Vec<[u8; 4]>,
    pub image: egui::ColorImage,
    pub image_beside: Option<egui::ColorImage>,
    pub legend: Option<Legend>,
    pub seen: Seen,
    /// Where z-scores are shown.
    pub scores: Option<Scores>,
    /// What errors are to.
    pub held_against: Option<Arc<Reference>>,
    pub truth: Option<Against>,
    pub truth_beside: Option<Against>,
    /// No sample has found light.
    pub black: bool,
}

/// What is seen of a frame in place of its radiance, by pixel.
#[derive(Default)]
pub struct Seen {
    /// The numbers of a view.
    pub numbers: Option<Vec<f32>>,
    /// Radiance of a term.
    pub radiance: Option<Vec<[f32; 3]>>,
}

/// A frame held against the true picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Against {
    pub rel_mse: f64,
    /// Of the mean over the picture, in standard errors.
    pub bias: Option<f64>,
}

pub struct Darkroom {
    orders: Sender<Order>,
    /// The other end, to take back what is out of date: it holds large pictures.
    waiting: Receiver<Order>,
    last: Option<Order>,
    ready: Arc<Mutex<Option<Print>>>,
}

/// Whether both are the same thing in memory, or neither is there.
fn same<T>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
    a.map(Arc::as_ptr) == b.map(Arc::as_ptr)
}

impl PartialEq for Order {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.frame, &other.frame)
            && same(self.beside.as_ref(), other.beside.as_ref())
            && self.shows_beside == other.shows_beside
            && self.look == other.look
            && same(self.truth.as_ref(), other.truth.as_ref())
            && same(self.pinned.as_ref(), other.pinned.as_ref())
            && same(self.features.as_ref(), other.features.as_ref())
            && self.term == other.term
    }
}

impl PartialEq for Term {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.of, &other.of) && (self.reflections, self.up_to) == (other.reflections, other.up_to)
    }
}

impl Term {
    /// Mean radiance of that light.
    fn radiance(&self) -> Option<Vec<[f32; 3]>> {
        let series = self.of.series.as_ref()?;
        Some(if self.up_to { series.up_to(self.reflections) } else { series.terms.get(self.reflections)?.clone() })
    }
}

impl Darkroom {
    pub fn new(ctx: &egui::Context) -> Darkroom {
        let (orders, inbox) = unbounded::<Order>();
        let ready = Arc::new(Mutex::new(None));
        let (ctx, shelf, waiting) = (ctx.clone(), ready.clone(), inbox.clone());
        let work = move || {
            while let Ok(order) = inbox.recv() {
                // A print that fails is not the end of all others.
                let Ok(print) = catch_unwind(AssertUnwindSafe(|| develop(order))) else { continue };
                *shelf.lock().unwrap_or_else(PoisonError::into_inner) = Some(print);
                ctx.request_repaint();
            }
        };
        std::thread::Builder::new().name("darkroom".to_owned()).spawn(work).expect("a thread can be started");
        Darkroom { orders, waiting, last: None, ready }
    }

    /// Develops this unless it is what was ordered last.
    pub fn order(&mut self, order: Order) {
        if !order.frame.radiance.is_empty() && self.last.as_ref() != Some(&order) {
            self.last = Some(order.clone());
            self.waiting.try_iter().for_each(drop);
            let _ = self.orders.send(order);
        }
    }

    /// The latest print, once.
    pub fn take(&self) -> Option<Print> {
        self.ready.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

pub fn develop(order: Order) -> Print {
    let Order { frame, beside, shows_beside, term, look, truth, pinned, features, materials, most_side } = order;
    let held_against = truth;
    let truth = held_against.as_deref();
    let picture = |frame: &Frame, radiance: Option<&[[f32; 3]]>, scale: Option<Scale>| {
        let mut pixels = Vec::new();
        let (pinned, features) = (pinned.as_deref(), features.as_deref());
        let shown = draw(look, &Sources { frame, radiance, truth, pinned, features, scale, materials: &materials }, &mut pixels);
        (image(frame, &pixels, most_side), shown, pixels)
    };
    let radiance = term.as_ref().filter(|term| term.of.radiance.len() == frame.radiance.len()).and_then(Term::radiance);
    let (image, shown, pixels) = picture(&frame, radiance.as_deref(), None);
    let (legend, field) = shown.unzip();
    let numbers = field.and_then(|field| if let Field::Numbers(numbers) = field { Some(numbers) } else { None });
    let scale = legend.as_ref().and_then(|legend| legend.scale);
    let image_beside = beside.as_ref().filter(|_| shows_beside).map(|beside| picture(beside, None, scale).0);
    let against = |frame: &Frame| {
        let truth = truth?;
        Some(Against { rel_mse: truth.compare(frame)?.rel_mse, bias: truth.bias(frame) })
    };
    let scores = truth.filter(|_| look.view == View::ZScore).and_then(|truth| Scores::of(&frame, truth));
    Print {
        truth: against(&frame),
        truth_beside: beside.as_ref().and_then(|beside| against(beside)),
        black: frame.is_black(),
        frame,
        beside,
        pixels,
        image,
        image_beside,
        legend,
        seen: Seen { numbers, radiance },
        scores,
        held_against,
    }
}

/// Pixels for a texture.
fn image(frame: &Frame, pixels: &[[u8; 4]], most_side: usize) -> egui::ColorImage {
    let [width, height] = [frame.width, frame.height].map(|side| side as usize);
    let step = width.max(height).div_ceil(most_side.max(1)).max(1);
    if step == 1 {
        return egui::ColorImage::from_rgba_unmultiplied([width, height], pixels.as_flattened());
    }
    // Every `step`-th pixel of what no texture can hold whole.
    let rows = pixels.chunks_exact(width).step_by(step);
    let thinned: Vec<u8> = rows.flat_map(|row| row.iter().step_by(step)).flatten().copied().collect();
    egui::ColorImage::from_rgba_unmultiplied([width.div_ceil(step), height.div_ceil(step)], &thinned)
}
