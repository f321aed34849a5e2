//! The material of the first surface.
use super::{Field, Quantity, Sources};
use noisefall_base::declare::Word;

pub(super) struct Materials;

impl Quantity for Materials {
    const WORD: Word = Word { name: "materials", title: "Materials", doc: "Material of the first surface along a camera ray." };

    const SHOWS_FEATURES: bool = true;

    fn field(sources: &Sources) -> Field {
        Field::colours_of_features(sources, |features, i| match features.material[i] {
            u32::MAX => [24; 3],
            id => category(id),
        })
    }

    /// The visible materials, largest area first.
    fn entries(sources: &Sources) -> Vec<([u8; 3], String)> {
        let Some(features) = sources.features else { return Vec::new() };
        let mut seen = vec![0usize; sources.materials.len()];
        features.material.iter().for_each(|id| seen.get_mut(*id as usize).into_iter().for_each(|count| *count += 1));
        let mut ids: Vec<usize> = (0..seen.len()).filter(|id| seen[*id] > 0).collect();
        ids.sort_by_key(|id| std::cmp::Reverse(seen[*id]));
        ids.into_iter().take(MOST_ENTRIES).map(|id| (category(id as u32), sources.materials[id].clone())).collect()
    }
}

/// Maximum number of names.
const MOST_ENTRIES: usize = 10;

/// Distinct with any colour vision (M. Okabe and K. Ito, "Color Universal Design", 2008), then once more, lighter.
const CATEGORIES: [[u8; 3]; 8] =
    [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66], [150, 150, 150]];

/// The colour of a material by its number.
fn category(id: u32) -> [u8; 3] {
    let colour = CATEGORIES[id as usize % CATEGORIES.len()];
    let rounds = (id as usize / CATEGORIES.len()) % 3;
    colour.map(|c| c - (u32::from(c) * rounds as u32 / 4) as u8)
}
