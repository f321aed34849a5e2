//! A request to turn frames into screen pixels.
use std::sync::Arc;

use noisefall_kernel::integrator::Features;
use noisefall_render::render::{Frame, reference::Reference, view::DisplaySettings};
use noisefall_scene::scene::Strategy;

/// Frames and how they are displayed.
#[derive(Clone)]
pub struct DisplayRequest {
    pub frame: Arc<Frame>,
    /// The frame of the second view: displayed if `shows_second`, and compared with the reference.
    pub second: Option<Arc<Frame>>,
    pub shows_second: bool,
    /// The term of a series to show in place of the frame's own radiance.
    pub term: Option<BounceTerm>,
    pub look: DisplaySettings,
    /// The image that the frame converges to, if it is known.
    pub reference: Option<Arc<Reference>>,
    /// The image that the difference subtracts, and whether that is side B of a comparison.
    pub pinned: Option<Arc<Frame>>,
    pub is_comparison: bool,
    pub features: Option<Arc<Features>>,
    /// The denoised radiance of the frame.
    pub denoised: Option<Arc<Vec<[f32; 3]>>>,
    pub materials: Arc<[String]>,
    /// Width and height of the image in screen pixels, if these are fewer.
    pub on_screen: Option<[u32; 2]>,
    /// Largest side of a texture.
    pub most_side: usize,
}

/// A part of the light: a term or a partial sum of the series over bounces, or the light of a strategy.
#[derive(Clone)]
pub struct BounceTerm {
    /// A frame with a series, or the frame of the strategy.
    pub of: Arc<Frame>,
    pub strategy: Option<Strategy>,
    pub k: usize,
    /// Whether to sum the terms up to this number of bounces.
    pub up_to: bool,
}

/// Whether both are the same allocation, or both are `None`.
fn same<T>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
    a.map(Arc::as_ptr) == b.map(Arc::as_ptr)
}

impl PartialEq for DisplayRequest {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.frame, &other.frame)
            && same(self.second.as_ref(), other.second.as_ref())
            && self.shows_second == other.shows_second
            && self.look == other.look
            && same(self.reference.as_ref(), other.reference.as_ref())
            && same(self.pinned.as_ref(), other.pinned.as_ref())
            && self.is_comparison == other.is_comparison
            && same(self.features.as_ref(), other.features.as_ref())
            && same(self.denoised.as_ref(), other.denoised.as_ref())
            && self.term == other.term
            && self.materials == other.materials
            && self.on_screen == other.on_screen
    }
}

impl PartialEq for BounceTerm {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.of, &other.of) && (self.k, self.up_to, self.strategy) == (other.k, other.up_to, other.strategy)
    }
}

impl BounceTerm {
    /// Mean radiance of this part.
    pub fn radiance(&self) -> Option<Vec<[f32; 3]>> {
        let Some(series) = self.of.series.as_ref() else {
            return self.strategy.is_some().then(|| self.of.radiance.clone());
        };
        Some(if self.up_to { series.up_to(self.k) } else { series.terms.get(self.k)?.clone() })
    }
}

#[cfg(test)]
pub mod tests {
    use noisefall_render::render::view::View;

    use super::*;

    /// A frame of grey pixels in a row.
    pub fn frame(greys: &[f32]) -> Arc<Frame> {
        let width = greys.len() as u32;
        let radiance = greys.iter().map(|grey| [*grey; 3]).collect();
        let standard_error = greys.iter().map(|grey| 0.1 * grey).collect();
        Arc::new(Frame { width, height: 1, full_resolution: [width, 1], radiance, standard_error, spp: 4, ..Frame::default() })
    }

    pub fn request(frame: Arc<Frame>) -> DisplayRequest {
        DisplayRequest {
            frame,
            second: None,
            shows_second: false,
            term: None,
            look: DisplaySettings::default(),
            reference: None,
            pinned: None,
            is_comparison: false,
            features: None,
            denoised: None,
            materials: Arc::from([]),
            on_screen: None,
            most_side: 1024,
        }
    }

    #[test]
    fn a_request_differs_if_anything_in_it_does() {
        let a = request(frame(&[1.0]));
        let term = |k, up_to| Some(BounceTerm { of: a.frame.clone(), strategy: None, k, up_to });
        let (reference, other) = (Arc::new(Reference::Constant([1.0; 3])), frame(&[1.0]));
        let look = DisplaySettings { view: View::Depth, ..a.look };
        let (normal, albedo, depth, position, object) = (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (material, cost) = (Vec::new(), Vec::new());
        let features = Features { width: 0, height: 0, normal, albedo, depth, position, object, material, cost };
        for changed in [
            DisplayRequest { frame: other.clone(), ..a.clone() },
            DisplayRequest { second: Some(other.clone()), ..a.clone() },
            DisplayRequest { shows_second: true, ..a.clone() },
            DisplayRequest { on_screen: Some([1, 1]), ..a.clone() },
            DisplayRequest { materials: Arc::from(["white".to_owned()]), ..a.clone() },
            DisplayRequest { look, ..a.clone() },
            DisplayRequest { reference: Some(reference), ..a.clone() },
            DisplayRequest { pinned: Some(other), ..a.clone() },
            DisplayRequest { features: Some(Arc::new(features)), ..a.clone() },
            DisplayRequest { term: term(1, false), ..a.clone() },
            DisplayRequest { denoised: Some(Arc::new(Vec::new())), ..a.clone() },
        ] {
            assert!(changed != a && changed == changed.clone());
        }
        let with = |term| DisplayRequest { term, ..a.clone() };
        assert!(with(term(1, false)) != with(term(2, false)) && with(term(1, false)) != with(term(1, true)));
    }
}
