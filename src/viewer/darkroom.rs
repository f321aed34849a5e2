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
    pub k: usize,
    /// Light of at most so many bounces.
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
    /// The part of the frame's pixels that have light.
    pub lit: f32,
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
        Arc::ptr_eq(&self.of, &other.of) && (self.k, self.up_to) == (other.k, other.up_to)
    }
}

impl Term {
    /// Mean radiance of that light.
    fn radiance(&self) -> Option<Vec<[f32; 3]>> {
        let series = self.of.series.as_ref()?;
        Some(if self.up_to { series.up_to(self.k) } else { series.terms.get(self.k)?.clone() })
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
        Some(Against { rel_mse: truth.compare(frame)?.rel_mse, bias: truth.bias(frame)?.z })
    };
    let scores = truth.filter(|_| look.view == View::ZScore).and_then(|truth| Scores::of(&frame, truth));
    Print {
        truth: against(&frame),
        truth_beside: beside.as_ref().and_then(|beside| against(beside)),
        lit: lit(&frame),
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

/// The part of the pixels that have light.
fn lit(frame: &Frame) -> f32 {
    let lit = frame.radiance.iter().filter(|radiance| **radiance != [0.0; 3]).count();
    lit as f32 / frame.radiance.len().max(1) as f32
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

#[cfg(test)]
mod tests {
    use noisefall::render::Series;

    use super::*;

    /// A frame of grey pixels in a row.
    fn frame(greys: &[f32]) -> Arc<Frame> {
        let width = greys.len() as u32;
        let radiance = greys.iter().map(|grey| [*grey; 3]).collect();
        let standard_error = greys.iter().map(|grey| 0.1 * grey).collect();
        Arc::new(Frame { width, height: 1, full_resolution: [width, 1], radiance, standard_error, spp: 4, ..Frame::default() })
    }

    fn order(frame: Arc<Frame>) -> Order {
        Order {
            frame,
            beside: None,
            shows_beside: false,
            term: None,
            look: Look::default(),
            truth: None,
            pinned: None,
            features: None,
            materials: Arc::from([]),
            most_side: 1024,
        }
    }

    #[test]
    fn each_picture_is_held_against_the_truth_by_itself() {
        let (a, b) = (frame(&[1.0, 1.0]), frame(&[2.0, 2.0]));
        let truth = Some(Arc::new(Reference::Constant([1.0; 3])));
        let print = develop(Order { beside: Some(b), truth: truth.clone(), ..order(a.clone()) });
        let [of_a, of_b] = [print.truth, print.truth_beside].map(|against| against.expect("the truth is known").rel_mse);
        assert!(of_a == 0.0 && of_b > 0.5, "{of_a} {of_b}");
        assert!(print.image_beside.is_none(), "it is not shown");
        assert!(print.held_against.as_ref().map(Arc::as_ptr) == truth.as_ref().map(Arc::as_ptr));
        let print = develop(order(a));
        assert!(print.truth.is_none() && print.truth_beside.is_none() && print.held_against.is_none());
    }

    #[test]
    fn pixels_with_light_are_counted_in_the_first_picture() {
        let (dark, bright) = (frame(&[0.0, 0.0]), frame(&[0.0, 0.5]));
        assert_eq!(develop(Order { beside: Some(bright.clone()), shows_beside: true, ..order(dark.clone()) }).lit, 0.0);
        let print = develop(Order { beside: Some(dark), shows_beside: true, ..order(bright) });
        assert_eq!(print.lit, 0.5);
        assert!(print.image.pixels[1] != print.image.pixels[0] && print.image_beside.expect("it is shown").pixels[1].r() == 0);
    }

    #[test]
    fn a_term_is_seen_alone_or_with_those_before_it() {
        let whole = frame(&[0.7, 0.7]);
        let terms = vec![vec![[0.1; 3]; 2], vec![[0.2; 3]; 2], vec![[0.4; 3]; 2]];
        let series = Some(Series { terms, shares: vec![0.2, 0.3, 0.5] });
        let of = Arc::new(Frame { series, ..Frame::default() });
        let of = Arc::new(Frame { radiance: whole.radiance.clone(), ..Arc::into_inner(of).expect("it is the only one") });
        let seen = |k, up_to| {
            let term = Some(Term { of: of.clone(), k, up_to });
            develop(Order { term, ..order(whole.clone()) }).seen.radiance.expect("a term is seen")[1][0]
        };
        assert_eq!((seen(0, false), seen(1, false), seen(2, false)), (0.1, 0.2, 0.4));
        assert!((seen(1, true) - 0.3).abs() < 1e-6 && (seen(2, true) - 0.7).abs() < 1e-6);
        // A series of another size is not of this picture.
        let small = Arc::new(Frame { radiance: vec![[1.0; 3]], ..Frame::default() });
        let term = Some(Term { of: small, k: 0, up_to: false });
        assert!(develop(Order { term, ..order(whole) }).seen.radiance.is_none());
    }

    #[test]
    fn numbers_of_a_view_are_those_of_its_pixels_and_two_pictures_have_one_scale() {
        let look = Look { view: View::StandardError, ..Look::default() };
        let beside = Some(frame(&[1.0, 1e4, 1e-4]));
        let print = develop(Order { look, beside, shows_beside: true, ..order(frame(&[0.5, 1.0, 4.0])) });
        let numbers = print.seen.numbers.expect("it is a view of numbers");
        assert!(numbers.iter().zip([0.05, 0.1, 0.4]).all(|(number, error)| (number - error).abs() < 1e-6), "{numbers:?}");
        let beside = print.image_beside.expect("it is shown");
        assert_eq!(beside.pixels[0], print.image.pixels[1], "the same number has the same colour");
        assert!(print.scores.is_none());
        let look = Look { view: View::ZScore, ..Look::default() };
        let truth = Some(Arc::new(Reference::Constant([1.0; 3])));
        assert!(develop(Order { look, truth, ..order(frame(&[0.9, 1.0, 1.1])) }).scores.is_some());
    }

    #[test]
    fn what_no_texture_can_hold_is_thinned() {
        let print = develop(Order { most_side: 2, ..order(frame(&[0.0, 0.2, 0.4, 0.6, 0.8])) });
        assert_eq!((print.image.size, print.pixels.len()), ([2, 1], 5));
        assert_eq!(print.image.pixels[1].r(), print.pixels[3][0], "every third pixel");
        assert_eq!(develop(Order { most_side: 5, ..order(frame(&[0.0; 5])) }).image.size, [5, 1]);
    }

    #[test]
    fn an_order_is_another_one_if_anything_in_it_is() {
        let a = order(frame(&[1.0]));
        let term = |k, up_to| Some(Term { of: a.frame.clone(), k, up_to });
        let (truth, other) = (Arc::new(Reference::Constant([1.0; 3])), frame(&[1.0]));
        let look = Look { view: View::Depth, ..a.look };
        let (normal, albedo, depth, object) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let features = Features { width: 0, height: 0, normal, albedo, depth, object, material: Vec::new(), cost: Vec::new() };
        for changed in [
            Order { frame: other.clone(), ..a.clone() },
            Order { beside: Some(other.clone()), ..a.clone() },
            Order { shows_beside: true, ..a.clone() },
            Order { look, ..a.clone() },
            Order { truth: Some(truth), ..a.clone() },
            Order { pinned: Some(other), ..a.clone() },
            Order { features: Some(Arc::new(features)), ..a.clone() },
            Order { term: term(1, false), ..a.clone() },
        ] {
            assert!(changed != a && changed == changed.clone());
        }
        let with = |term| Order { term, ..a.clone() };
        assert!(with(term(1, false)) != with(term(2, false)) && with(term(1, false)) != with(term(1, true)));
    }
}
