//! Turns frames into screen pixels and compares them with the reference.
use std::sync::Arc;

use noisefall_kernel::{integrator::Features, measure::LogRatio};
use noisefall_render::render::{
    Frame,
    reference::Reference,
    view::{Field, Legend, Scale, Sources, View, ZScoreHistogram, draw},
};

use super::{
    display_request::{BounceTerm, DisplayRequest},
    reduction::{averaged, averaged_codes, texture_size},
};

/// A frame ready to be shown.
pub struct DisplayImage {
    pub frame: Arc<Frame>,
    pub second: Option<Arc<Frame>>,
    /// Display pixels row by row, as a PNG stores them; those of the image if the image is reduced.
    pub pixels: Vec<[u8; 4]>,
    pub image: egui::ColorImage,
    /// Whether the image has fewer pixels than the frame.
    pub is_reduced: bool,
    pub second_image: Option<egui::ColorImage>,
    pub legend: Option<Legend>,
    pub values: PixelValues,
    pub second_values: PixelValues,
    /// The histogram, in the view of z-scores.
    pub scores: Option<ZScoreHistogram>,
    /// The reference of the comparisons.
    pub reference: Option<Arc<Reference>>,
    pub comparison: Option<ReferenceComparison>,
    pub second_comparison: Option<ReferenceComparison>,
    /// The error of the first frame over that of the second, as a logarithm: against the reference, or as estimated.
    pub error_ratio: Option<LogRatio>,
    /// Fraction of the frame's pixels that have light.
    pub lit: f32,
}

/// The values that a view displays in place of the radiance of the frame, by pixel.
#[derive(Default)]
pub struct PixelValues {
    /// The numbers of a view.
    pub numbers: Option<Vec<f32>>,
    /// Radiance of a term.
    pub radiance: Option<Vec<[f32; 3]>>,
    /// The features of a view that shows them as colours.
    pub features: Option<(View, Arc<Features>)>,
    /// The view has no data.
    pub is_missing: bool,
}

impl PixelValues {
    fn of(view: View, field: Option<Field>, features: Option<&Arc<Features>>) -> PixelValues {
        match field {
            None => PixelValues::default(),
            Some(Field::Missing) => PixelValues { is_missing: true, ..PixelValues::default() },
            Some(Field::Numbers(numbers)) => PixelValues { numbers: Some(numbers), ..PixelValues::default() },
            Some(Field::Colours(_)) => {
                PixelValues { features: features.map(|features| (view, features.clone())), ..PixelValues::default() }
            }
        }
    }
}

/// A frame compared with its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceComparison {
    pub rel_mse: f64,
    /// Bias of the mean over the image, in standard errors.
    pub bias: Option<f64>,
}

/// Renders the pixels of a request.
pub fn render(request: DisplayRequest) -> DisplayImage {
    let DisplayRequest { frame, second, shows_second, term, look, reference, pinned, features, denoised, materials, .. } =
        request;
    let is_comparison = request.is_comparison;
    let (on_screen, most_side) = (request.on_screen, request.most_side);
    let known = reference.as_deref();
    let picture = |frame: &Frame, radiance: Option<&[[f32; 3]]>, scale: Option<Scale>| {
        let mut pixels = Vec::new();
        let (pinned, features) = (pinned.as_deref(), features.as_deref());
        let size = [frame.width, frame.height].map(|side| side as usize);
        let to = texture_size(size, on_screen, most_side);
        let reduced = (to != size && (look.view == View::Radiance || radiance.is_some() && look.view.is_denoised()))
            .then(|| averaged(radiance.unwrap_or(&frame.radiance), size, to));
        let radiance = reduced.as_deref().or(radiance);
        let sources =
            Sources { frame, radiance, reference: known, pinned, is_comparison, features, scale, materials: &materials };
        let shown = draw(look, &sources, &mut pixels);
        if to != size && reduced.is_none() {
            pixels = averaged_codes(&pixels, size, to);
        }
        (egui::ColorImage::from_rgba_unmultiplied(to, pixels.as_flattened()), shown, pixels)
    };
    let is_of_frame = |radiance: &Vec<[f32; 3]>| radiance.len() == frame.radiance.len();
    let radiance = if look.view.is_denoised() {
        denoised.map(|radiance| radiance.to_vec()).filter(is_of_frame)
    } else {
        term.as_ref().and_then(BounceTerm::radiance).filter(is_of_frame)
    };
    let (image, shown, pixels) = picture(&frame, radiance.as_deref(), None);
    let (legend, field) = shown.unzip();
    let scale = legend.as_ref().and_then(|legend| legend.scale);
    let second_picture = second.as_ref().filter(|_| shows_second).map(|second| picture(second, None, scale));
    let (second_image, second_shown) = second_picture.map(|(image, shown, _)| (image, shown)).unzip();
    let second_field = second_shown.flatten().map(|(_, field)| field);
    let values = |field| PixelValues::of(look.view, field, features.as_ref());
    let compare = |frame: &Frame| {
        let known = known?;
        Some(ReferenceComparison { rel_mse: known.compare(frame)?.rel_mse, bias: known.bias(frame)?.z })
    };
    let scores = known.filter(|_| look.view.has_scores()).and_then(|known| ZScoreHistogram::of(&frame, known));
    DisplayImage {
        is_reduced: image.size != [frame.width, frame.height].map(|side| side as usize),
        comparison: compare(&frame),
        second_comparison: second.as_ref().and_then(|second| compare(second)),
        error_ratio: second.as_ref().and_then(|second| error_ratio([&frame, second], known)),
        lit: lit(&frame),
        frame,
        second,
        pixels,
        image,
        second_image,
        legend,
        values: PixelValues { radiance, ..values(field) },
        second_values: values(second_field),
        scores,
        reference,
    }
}

/// The error of a frame over that of another one.
fn error_ratio([first, second]: [&Frame; 2], reference: Option<&Reference>) -> Option<LogRatio> {
    if first.is_coarse() || second.is_coarse() || first.width != second.width {
        return None;
    }
    match reference {
        Some(known) => LogRatio::jackknife(&known.block_errors(first)?, &known.block_errors(second)?),
        None => LogRatio::jackknife(first.block_errors.as_ref()?, second.block_errors.as_ref()?),
    }
}

/// Fraction of the pixels that have light.
fn lit(frame: &Frame) -> f32 {
    let lit = frame.radiance.iter().filter(|radiance| **radiance != [0.0; 3]).count();
    lit as f32 / frame.radiance.len().max(1) as f32
}

#[cfg(test)]
mod tests {
    use noisefall_render::render::{
        Series,
        tone::to_srgb,
        view::{DisplaySettings, View},
    };

    use super::{super::display_request::tests::frame, super::display_request::tests::request, *};

    #[test]
    fn each_picture_is_held_against_the_truth_by_itself() {
        let (a, b) = (frame(&[1.0, 1.0]), frame(&[2.0, 2.0]));
        let truth = Some(Arc::new(Reference::Constant([1.0; 3])));
        let shown = render(DisplayRequest { second: Some(b), reference: truth.clone(), ..request(a.clone()) });
        let [of_a, of_b] = [shown.comparison, shown.second_comparison].map(|known| known.expect("the truth is known").rel_mse);
        assert!(of_a == 0.0 && of_b > 0.5, "{of_a} {of_b}");
        assert!(shown.second_image.is_none(), "it is not shown");
        assert!(shown.reference.as_ref().map(Arc::as_ptr) == truth.as_ref().map(Arc::as_ptr));
        let shown = render(request(a));
        assert!(shown.comparison.is_none() && shown.second_comparison.is_none() && shown.reference.is_none());
    }

    #[test]
    fn pixels_with_light_are_counted_in_the_first_picture() {
        let (dark, bright) = (frame(&[0.0, 0.0]), frame(&[0.0, 0.5]));
        assert_eq!(render(DisplayRequest { second: Some(bright.clone()), shows_second: true, ..request(dark.clone()) }).lit, 0.0);
        let shown = render(DisplayRequest { second: Some(dark), shows_second: true, ..request(bright) });
        assert_eq!(shown.lit, 0.5);
        assert!(shown.image.pixels[1] != shown.image.pixels[0] && shown.second_image.expect("it is shown").pixels[1].r() == 0);
    }

    #[test]
    fn a_term_is_seen_alone_or_with_those_before_it() {
        let whole = frame(&[0.7, 0.7]);
        let terms = vec![vec![[0.1; 3]; 2], vec![[0.2; 3]; 2], vec![[0.4; 3]; 2]];
        let series = Some(Series { terms, shares: vec![0.2, 0.3, 0.5] });
        let of = Arc::new(Frame { series, ..Frame::default() });
        let of = Arc::new(Frame { radiance: whole.radiance.clone(), ..Arc::into_inner(of).expect("it is the only one") });
        let seen = |k, up_to| {
            let term = Some(BounceTerm { of: of.clone(), strategy: None, k, up_to });
            render(DisplayRequest { term, ..request(whole.clone()) }).values.radiance.expect("a term is seen")[1][0]
        };
        assert_eq!((seen(0, false), seen(1, false), seen(2, false)), (0.1, 0.2, 0.4));
        assert!((seen(1, true) - 0.3).abs() < 1e-6 && (seen(2, true) - 0.7).abs() < 1e-6);
        // A series of another size is not of this image.
        let small = Arc::new(Frame { radiance: vec![[1.0; 3]], ..Frame::default() });
        let term = Some(BounceTerm { of: small, strategy: None, k: 0, up_to: false });
        assert!(render(DisplayRequest { term, ..request(whole) }).values.radiance.is_none());
    }

    #[test]
    fn numbers_of_a_view_are_those_of_its_pixels_and_two_pictures_have_one_scale() {
        let look = DisplaySettings { view: View::StandardError, ..DisplaySettings::default() };
        let second = Some(frame(&[1.0, 1e4, 1e-4]));
        let shown = render(DisplayRequest { look, second, shows_second: true, ..request(frame(&[0.5, 1.0, 4.0])) });
        let numbers = shown.values.numbers.expect("it is a view of numbers");
        assert!(numbers.iter().zip([0.05, 0.1, 0.4]).all(|(number, error)| (number - error).abs() < 1e-6), "{numbers:?}");
        let second = shown.second_image.expect("it is shown");
        assert_eq!(second.pixels[0], shown.image.pixels[1], "the same number has the same colour");
        assert!(shown.scores.is_none());
        let look = DisplaySettings { view: View::ZScore, ..DisplaySettings::default() };
        let truth = Some(Arc::new(Reference::Constant([1.0; 3])));
        assert!(render(DisplayRequest { look, reference: truth, ..request(frame(&[0.9, 1.0, 1.1])) }).scores.is_some());
    }

    #[test]
    fn an_image_with_more_pixels_than_the_screen_or_a_texture_is_averaged() {
        let row = frame(&[0.0, 0.2, 0.4, 0.6, 0.8]);
        let code = |light: f32| {
            let mut pixels = Vec::new();
            to_srgb(&[[light; 3]], DisplaySettings::default().display, &mut pixels);
            pixels[0][0]
        };
        for request in [
            DisplayRequest { most_side: 2, ..request(row.clone()) },
            DisplayRequest { on_screen: Some([2, 1]), ..request(row.clone()) },
        ] {
            let shown = render(request);
            assert_eq!((shown.image.size, shown.is_reduced), ([2, 1], true));
            assert!([0.16, 0.64].iter().zip(&shown.image.pixels).all(|(light, pixel)| pixel.r().abs_diff(code(*light)) <= 1));
        }
        let whole = render(DisplayRequest { most_side: 5, ..request(row) });
        assert_eq!((whole.image.size, whole.is_reduced), ([5, 1], false));
    }

    /// One pixel in a hundred that is ten times as bright as white is a tenth of white.
    #[test]
    fn light_is_averaged_before_the_tone_map() {
        let mut greys = vec![0.0; 100];
        greys[40] = 10.0;
        let shown = render(DisplayRequest { on_screen: Some([1, 1]), ..request(frame(&greys)) });
        assert!(shown.image.pixels[0].r().abs_diff(89) <= 1, "{:?}", shown.image.pixels[0]);
        // Colours of numbers are averaged as they are seen.
        let look = DisplaySettings { view: View::StandardError, ..DisplaySettings::default() };
        let shown = render(DisplayRequest { look, on_screen: Some([1, 1]), ..request(frame(&greys)) });
        assert_eq!((shown.image.size, shown.values.numbers.map(|numbers| numbers.len())), ([1, 1], Some(100)));
    }
}
