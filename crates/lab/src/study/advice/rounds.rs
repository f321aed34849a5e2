//! Rounds of images: one of each candidate, all with the same seed. A temporary slowdown of the machine affects all candidates
//! equally.
use std::ops::Range;

use crate::study::{StudyError, measure::Bench};
use noisefall_render::render::film::Film;
use noisefall_scene::scene::RenderSettings;

/// Samples per pixel of every image.
pub const SPP: u32 = 16;

/// An image of one round.
pub struct RoundPicture {
    pub round: u32,
    /// Rendering time.
    pub seconds: f64,
    pub radiance: Vec<[f32; 3]>,
}

/// The images of some settings, at most one per round.
pub struct Series {
    pub settings: RenderSettings,
    pub pictures: Vec<RoundPicture>,
}

impl Series {
    pub fn of_round(&self, round: u32) -> Option<&RoundPicture> {
        self.pictures.iter().find(|picture| picture.round == round)
    }
}

/// All images so far.
pub struct Rounds<'a> {
    bench: Bench<'a>,
    pub series: Vec<Series>,
    film: Option<Film>,
}

impl<'a> Rounds<'a> {
    pub fn new(bench: Bench<'a>) -> Rounds<'a> {
        Rounds { bench, series: Vec::new(), film: None }
    }

    /// Renders an image of every candidate in each of these rounds. Calls `made` after every image.
    pub fn make(&mut self, candidates: &[RenderSettings], rounds: Range<u32>, made: &mut dyn FnMut()) -> Result<(), StudyError> {
        for round in rounds {
            for settings in candidates {
                let picture = self.picture(settings, round)?;
                match self.series.iter_mut().find(|series| series.settings == *settings) {
                    Some(series) => series.pictures.push(picture),
                    None => self.series.push(Series { settings: *settings, pictures: vec![picture] }),
                }
                made();
            }
        }
        Ok(())
    }

    fn picture(&mut self, settings: &RenderSettings, round: u32) -> Result<RoundPicture, StudyError> {
        // Reuses memory, because allocation would add to the measured time.
        let used = self.film.take();
        let mut film = used.map_or_else(|| self.bench.film(), |film| film.recycled(self.bench.camera.resolution));
        let seeded = RenderSettings { seed: settings.seed.wrapping_add(round), ..*settings };
        let (took, _) = self.bench.pass(&seeded, &mut film, SPP)?;
        let radiance = self.bench.frame(&film).radiance;
        self.film = Some(film);
        Ok(RoundPicture { round, seconds: took.as_secs_f64(), radiance })
    }
}
