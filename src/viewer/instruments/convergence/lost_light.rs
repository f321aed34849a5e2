//! The bias of a cap on the number of bounces: the light that it loses.
use noisefall_render::render::Frame;

/// Samples per pixel after which the shares are known well enough for a plot.
const ENOUGH: u32 = 16;

/// Fractions of the light that caps would lose.
pub struct LostLight {
    spp: u32,
    by_cap: Vec<f64>,
}

impl LostLight {
    /// Returns the fractions for a frame that has the series of the image without a cap.
    pub fn of(frame: &Frame) -> Option<LostLight> {
        let series = frame.series.as_ref().filter(|_| frame.spp > 0)?;
        let by_cap = (0..series.shares.len().saturating_sub(1)).map(|cap| series.lost_by_cap(cap)).collect();
        Some(LostLight { spp: frame.spp, by_cap })
    }

    /// The fraction that a cap loses, if it is one that can be told from nothing.
    pub fn by_cap(&self, cap: u32) -> Option<f64> {
        self.by_cap.get(cap as usize).copied().filter(|lost| *lost > 0.0)
    }

    /// Whether more samples would tell more.
    pub fn is_rough(&self) -> bool {
        self.spp < ENOUGH
    }

    pub fn spp(&self) -> u32 {
        self.spp
    }
}

#[cfg(test)]
mod tests {
    use noisefall_render::render::Series;

    use super::*;

    #[test]
    fn a_cap_loses_the_light_of_more_bounces() {
        let series = Series { terms: Vec::new(), shares: vec![0.5, 0.25, 0.125, 0.125, 0.0] };
        let lost = LostLight::of(&Frame { spp: 8, series: Some(series), ..Frame::default() }).expect("it has a series");
        assert_eq!([0, 1, 2, 3, 9].map(|cap| lost.by_cap(cap)), [Some(0.5), Some(0.25), Some(0.125), None, None]);
        assert!(lost.is_rough() && LostLight::of(&Frame::default()).is_none());
    }
}
