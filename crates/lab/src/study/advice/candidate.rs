//! Candidate settings with their measurements, and the advice among them.
use crate::study::outcome::ROUNDING;
use noisefall_kernel::measure::student_95;
use noisefall_scene::scene::RenderSettings;

/// Settings that were measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The settings.
    pub settings: RenderSettings,
    /// Name: the differences from the settings in use.
    pub name: String,
    /// 1/(relMSE · seconds); 0 if these settings miss light that others found.
    pub efficiency: f64,
    /// Efficiency relative to that of the settings in use; infinite if those miss light that these found.
    pub relative: f64,
    /// Standard error of ln `relative`, that is, the relative standard error, from the spread over rounds.
    pub standard_error: f64,
    /// relMSE of an image of `spp` samples per pixel; a lower bound if it misses light.
    pub rel_mse: f64,
    /// Whether most of that error is light that other candidates found and these settings did not.
    pub misses_light: bool,
    /// Rendering time of such an image.
    pub seconds: f64,
    /// Samples per pixel.
    pub spp: u32,
    /// Number of images.
    pub rounds: usize,
}

/// Result of the measurements. The settings in use are always among the candidates.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The candidates, the most efficient first.
    pub candidates: Vec<Candidate>,
    /// Index of the recommended candidate: among those that are clearly better and nearly the best, the one with the fewest
    /// changes. If none is clearly better, it is the settings in use.
    pub best: usize,
    /// Index of the settings in use.
    pub current: usize,
}

impl Candidate {
    /// Whether it is better than the settings in use, significantly at 95 %, and by enough to matter.
    pub fn is_clearly_better(&self) -> bool {
        let by_chance = student_95(self.rounds as f64 - 1.0) * self.standard_error;
        self.relative >= LEAST_GAIN && self.relative.ln() > by_chance
    }

    /// Whether it was measured to be better by enough to matter, but not significantly.
    pub fn may_be_better(&self) -> bool {
        self.relative >= LEAST_GAIN && !self.is_clearly_better()
    }

    /// Whether the remaining error is rounding.
    pub fn is_exact(&self) -> bool {
        self.rel_mse <= ROUNDING && self.efficiency > 0.0
    }
}

impl Advice {
    /// The recommended candidate.
    pub fn best(&self) -> &Candidate {
        &self.candidates[self.best]
    }

    /// The settings in use.
    pub fn current(&self) -> &Candidate {
        &self.candidates[self.current]
    }
}

/// Smallest gain in efficiency that is worth a change.
pub(super) const LEAST_GAIN: f64 = 1.05;
