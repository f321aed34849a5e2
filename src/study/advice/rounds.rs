//! Pictures in rounds: one of each of the settings, with the same seed, so that what slows the machine for a while slows all alike.
use std::ops::Range;

use crate::{
    render::film::Film,
    scene::RenderSettings,
    study::{StudyError, measure::Bench},
};

/// Samples per pixel of every picture.
pub const SPP: u32 = 16;

/// A picture of one round.
pub struct Picture {
    pub round: u32,
    /// How long it took.
    pub seconds: f64,
    pub radiance: Vec<[f32; 3]>,
}

/// The pictures of some settings, no two of the same round.
pub struct Series {
    pub settings: RenderSettings,
    pub pictures: Vec<Picture>,
}

/// All pictures so far.
pub struct Rounds<'a> {
    bench: Bench<'a>,
    pub series: Vec<Series>,
    film: Option<Film>,
}

impl<'a> Rounds<'a> {
    pub fn new(bench: Bench<'a>) -> Rounds<'a> {
        Rounds { bench, series: Vec::new(), film: None }
    }

    /// Makes a picture of each of the candidates in each of these rounds; `made` is called after every one.
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

    fn picture(&mut self, settings: &RenderSettings, round: u32) -> Result<Picture, StudyError> {
        // Memory that is there already: taking it would add to the time of all.
        let used = self.film.take();
        let mut film = used.map_or_else(|| self.bench.film(), |film| film.recycled(self.bench.camera.resolution));
        let seeded = RenderSettings { seed: settings.seed.wrapping_add(round), ..*settings };
        let (took, _) = self.bench.pass(&seeded, &mut film, SPP)?;
        let radiance = self.bench.frame(&film).radiance;
        self.film = Some(film);
        Ok(Picture { round, seconds: took.as_secs_f64(), radiance })
    }
}
