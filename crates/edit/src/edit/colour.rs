//! The colour of a material, whatever its kind calls it.
use super::{Document, meaning::colour};
use noisefall_base::declare::Path;

impl Document {
    /// The path of the first colour of a material that can be a texture, such as its albedo. `None` if it has none.
    pub fn colour_of_material(&self, name: &str) -> Option<Path> {
        let colour = colour(self.description().materials.get(name)?)?;
        Some(Path(Path::of("materials").key(name).0.into_iter().chain(colour.0).collect()))
    }
}
