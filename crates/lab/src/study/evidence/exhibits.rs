//! The contents of the chapter: findings and images, with their captions.
use crate::{
    report::sheet::{Cell, sheet},
    study::{
        Eligibility, Findings, Machine, Outcome, StudyError, StudyScene, differing_labels, labels::label, measure::Bench, report,
    },
};
use noisefall_render::render::{Display, tone::to_srgb};
use noisefall_scene::scene::{RenderSettings, Setting};

/// Bounce caps that are shown and measured.
pub const CAPS: [Option<u32>; 5] = [Some(0), Some(1), Some(2), Some(5), None];

pub struct Exhibits<'a> {
    pub study_scene: &'a StudyScene,
    /// Findings by the setting that they compare.
    pub findings: &'a [(Setting, Findings)],
    pub pictures: [SheetPicture; 2],
    pub spp: u32,
    pub repeats: u32,
    pub machine: &'a Machine,
}

/// A labelled sheet.
pub struct SheetPicture {
    pub name: &'static str,
    pub caption: String,
    pub png: Vec<u8>,
}

/// The numbers 1, 4, 16, … up to `most`.
fn quadrupling(most: u32) -> impl Iterator<Item = u32> {
    (0..u32::BITS / 2).map(|power| 1 << (2 * power)).take_while(move |samples| *samples <= most)
}

/// Sheets of images at growing sample counts and at growing caps.
pub fn pictures(bench: Bench, spp: u32, display: Display) -> Result<[SheetPicture; 2], StudyError> {
    /// Samples per pixel of the images with caps.
    const SPP_OF_CAPS: u32 = 64;
    let settings = RenderSettings { max_bounces: None, ..bench.scene.settings };
    let shown = |film: &_| {
        let mut pixels = Vec::new();
        to_srgb(&bench.frame(film).radiance, display, &mut pixels);
        pixels
    };
    let mut film = bench.film();
    let mut growing = Vec::new();
    for samples in quadrupling(spp) {
        bench.pass(&settings, &mut film, samples)?;
        growing.push(Cell { lines: vec![format!("N = {samples}")], pixels: shown(&film) });
    }
    let mut capped = Vec::new();
    for max_bounces in CAPS {
        let mut film = bench.film();
        bench.pass(&RenderSettings { max_bounces, ..settings }, &mut film, spp.min(SPP_OF_CAPS))?;
        let cap = max_bounces.map_or_else(|| "no cap".to_owned(), |cap| format!("at most {cap} bounces"));
        capped.push(Cell { lines: vec![cap], pixels: shown(&film) });
    }
    let of = |name, caption, cells: &[Cell]| {
        let png = bench.threads.install(|| sheet(bench.camera.resolution, 3, &[], cells)).map_err(StudyError::Renderer)?;
        Ok::<_, StudyError>(SheetPicture { name, caption, png })
    };
    let [width, height] = bench.camera.resolution;
    let how = format!("{}; {width} × {height} pixels", label(&settings));
    let by_cap = format!("The image with different bounce caps, {} samples per pixel: {how}.", spp.min(SPP_OF_CAPS));
    Ok([
        of("pictures_by_samples", format!("The image after N samples per pixel, without a cap: {how}."), &growing)?,
        of("pictures_by_cap", by_cap, &capped)?,
    ])
}

impl Exhibits<'_> {
    pub fn of(&self, setting: Setting) -> Option<&Findings> {
        self.findings.iter().find(|(of, _)| *of == setting).map(|(_, findings)| findings)
    }

    /// Resolution and number of runs, which all findings share.
    pub fn extent(&self) -> String {
        let [width, height] = self.study_scene.camera.resolution;
        format!("{width} × {height} pixels, up to {} samples per pixel, {} runs each", self.spp, self.repeats)
    }

    /// The end of every caption: the settings that all combinations share, and the circumstances of rendering.
    pub fn circumstances(&self, findings: &Findings) -> String {
        let all: Vec<RenderSettings> = findings.outcomes.iter().flat_map(Outcome::alike).copied().collect();
        let (common, _) = differing_labels(&all);
        format!("{common}; {}", self.rendering(findings))
    }

    /// The circumstances of rendering without the settings.
    pub fn rendering(&self, findings: &Findings) -> String {
        format!("{}; {}; against {}", path_reuse(findings), self.extent(), findings.reference)
    }

    /// Remark on a row, such as why it is not ranked.
    pub fn remark(&self, outcome: &Outcome) -> String {
        let of_eligibility = match outcome.eligibility {
            Eligibility::TooNoisy => "error near that of a black image".to_owned(),
            _ => report::remark(outcome),
        };
        let said = |holds: bool, remark: &str| if holds { remark.to_owned() } else { String::new() };
        let remarks = [
            of_eligibility,
            said(outcome.is_exact(), "no noise"),
            said(self.has_infinite_variance(outcome), "variance may be infinite"),
            said(outcome.mean_error.has_heavy_tails, "heavy tails"),
        ];
        remarks.into_iter().filter(|remark| !remark.is_empty()).collect::<Vec<_>>().join("; ")
    }

    fn has_infinite_variance(&self, outcome: &Outcome) -> bool {
        self.study_scene.scene.infinite_variance(&outcome.settings).is_some()
    }

    /// Whether the sample variance can be trusted: not if it may be infinite, nor if few samples make up most of it.
    pub fn trusts_variance(&self, outcome: &Outcome) -> bool {
        !self.has_infinite_variance(outcome) && !outcome.mean_error.has_heavy_tails
    }
}

/// Whether pixels shared, in words.
fn path_reuse(findings: &Findings) -> &'static str {
    let share = || findings.outcomes.iter().map(|outcome| outcome.path_reuse.correlates());
    match (share().any(|shares| shares), share().all(|shares| shares)) {
        (false, _) => "nothing shared between pixels",
        (true, true) => "light shared between neighbouring pixels",
        (true, false) => "light shared between neighbouring pixels with some of these settings",
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn samples_quadruple_from_picture_to_picture() {
        assert_eq!(super::quadrupling(100).collect::<Vec<_>>(), [1, 4, 16, 64]);
        assert_eq!(super::quadrupling(4096).last(), Some(4096));
    }
}
