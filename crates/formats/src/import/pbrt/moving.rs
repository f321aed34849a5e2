//! Directives about the current transform.
use glam::{DAffine3, DVec3};

use super::{directives::Interpreter, source::TextSpan, transforms};
use noisefall_scene::scene::SceneError;

impl Interpreter {
    /// Runs a directive about the current transform; false if it is none.
    pub(super) fn transform(&mut self, word: &str, place: &TextSpan) -> Result<bool, SceneError> {
        match word {
            "Identity" => self.state.transform(|_| DAffine3::IDENTITY),
            "Translate" => {
                let n = self.numbers(3, place)?;
                self.multiply(DAffine3::from_translation(DVec3::new(n[0], n[1], n[2])));
            }
            "Scale" => {
                let n = self.numbers(3, place)?;
                self.multiply(DAffine3::from_scale(DVec3::new(n[0], n[1], n[2])));
            }
            "Rotate" => {
                let numbers = self.numbers(4, place)?;
                self.multiply(transforms::rotation(&numbers, place)?);
            }
            "LookAt" => {
                let numbers = self.numbers(9, place)?;
                self.multiply(transforms::look_at(&numbers, place)?);
            }
            "Transform" => {
                let map = transforms::matrix(&self.numbers(16, place)?, place)?;
                self.state.transform(|_| map);
            }
            "ConcatTransform" => {
                let map = transforms::matrix(&self.numbers(16, place)?, place)?;
                self.multiply(map);
            }
            "CoordinateSystem" => {
                let name = self.quoted(place)?;
                self.systems.insert(name, self.state.maps);
            }
            "CoordSysTransform" => {
                let name = self.quoted(place)?;
                let unknown =
                    || place.error(format!("`{name}` is not a coordinate system"), "name one by CoordinateSystem first");
                self.state.maps = *self.systems.get(&name).ok_or_else(unknown)?;
            }
            "ActiveTransform" => {
                let (_, name, at) = self.word(place)?;
                self.state.active = match name.as_str() {
                    "StartTime" => [true, false],
                    "EndTime" => [false, true],
                    "All" => [true, true],
                    _ => return Err(at.error(format!("`{name}` is not a time"), "StartTime, EndTime or All")),
                };
            }
            "TransformTimes" => {
                let numbers = self.numbers(2, place)?;
                self.import.times = [numbers[0], numbers[1]];
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn multiply(&mut self, by: DAffine3) {
        self.state.transform(|map| map * by);
    }
}
