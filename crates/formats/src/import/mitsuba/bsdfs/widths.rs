//! Facets whose widths along u and v vary apart: a mixture of surfaces with constant widths, in fractions that vary.
//!
//! Each axis has a few levels of its width; a place is a mixture of the two levels around its own. The mixtures are a binary tree, so that
//! each of its weights is one texture.
use super::{
    super::{context::Import, picture, tree::Element},
    adapters::blended,
};
use crate::import::pictures;
use noisefall_base::math::colour::luminance;
use noisefall_scene::{
    image::Encoding,
    scene::{
        SceneError,
        description::{MaterialDescription, TextureKind, Textured},
    },
    texture::{checker::Checker, image::Image},
};

/// Levels of an image, a power of two.
const LEVELS: usize = 8;
/// Narrower facets are as smooth.
const SMOOTH: f32 = 1e-3;

/// The levels of a width, and the weights of the upper half of each part of them: of all, then of the lower half and its parts, then of
/// the upper half and its parts.
struct Axis {
    levels: Vec<f64>,
    weights: Vec<Textured<f64>>,
}

/// The mixture of the surfaces that `build` makes of two widths; `None` if a texture is of a kind whose values are not known here.
pub fn mixture(
    import: &mut Import,
    element: Element,
    [u, v]: [&Textured<f64>; 2],
    build: &dyn Fn([f64; 2]) -> MaterialDescription,
) -> Result<Option<MaterialDescription>, SceneError> {
    let (Some(along), Some(across)) = (Axis::new(import, element, u)?, Axis::new(import, element, v)?) else { return Ok(None) };
    let row = |import: &mut Import, u: f64| {
        let surfaces = across.levels.iter().map(|v| build([u, *v])).collect();
        joined(import, element, surfaces, &mut across.weights.iter())
    };
    let rows = along.levels.iter().map(|u| row(import, *u)).collect();
    Ok(Some(joined(import, element, rows, &mut along.weights.iter())))
}

/// A tree of surfaces.
fn joined<'w>(
    import: &mut Import,
    element: Element,
    mut surfaces: Vec<MaterialDescription>,
    weights: &mut impl Iterator<Item = &'w Textured<f64>>,
) -> MaterialDescription {
    if surfaces.len() < 2 {
        return surfaces.pop().unwrap_or_default();
    }
    let weight = weights.next().cloned().unwrap_or(Textured::Constant(0.5));
    let upper = surfaces.split_off(surfaces.len() / 2);
    let [first, second] = [surfaces, upper].map(|half| {
        let half = joined(import, element, half, weights);
        import.part_of(element, "facets", half)
    });
    blended(import, first, second, weight)
}

impl Axis {
    fn new(import: &mut Import, element: Element, width: &Textured<f64>) -> Result<Option<Axis>, SceneError> {
        let name = match width {
            Textured::Constant(width) => return Ok(Some(Axis { levels: vec![*width], weights: Vec::new() })),
            Textured::Texture(name) => name,
        };
        match import.description.textures.get(name).cloned() {
            Some(TextureKind::Checker(squares)) => Ok(Axis::of_squares(import, name, &squares)),
            Some(TextureKind::Image(image)) => Axis::of_image(import, element, name, &image),
            _ => Ok(None),
        }
    }

    fn of_squares(import: &mut Import, name: &str, squares: &Checker) -> Option<Axis> {
        let (Textured::Constant(even), Textured::Constant(odd)) = (&squares.even, &squares.odd) else { return None };
        let levels = [even, odd].map(|color| f64::from(luminance(color.map(|x| x as f32)))).to_vec();
        let weight = Checker { even: Textured::grey(0.0), odd: Textured::grey(1.0), scale: squares.scale };
        let weights = vec![Textured::Texture(import.add_texture(&format!("{name} weight"), weight))];
        Some(Axis { levels, weights })
    }

    fn of_image(import: &mut Import, element: Element, name: &str, image: &Image) -> Result<Option<Axis>, SceneError> {
        let Some(picture) = picture::read(import, image) else { return Ok(None) };
        // Equal steps of the logarithm: highlights are brighter by the square of a width, and a mixture of two by no more than 6 %.
        let values: Vec<f32> = picture.radiance.iter().map(|pixel| luminance(*pixel).clamp(SMOOTH, 1.0).ln()).collect();
        let start = (f32::INFINITY, f32::NEG_INFINITY);
        let (least, most) = values.iter().fold(start, |(least, most), value| (least.min(*value), most.max(*value)));
        let step = (most - least) / (LEVELS - 1) as f32;
        if step < 1e-4 {
            return Ok(Some(Axis { levels: vec![f64::from(least).exp()], weights: Vec::new() }));
        }
        let mut weights = Vec::new();
        for [start, middle, end] in halves(0, LEVELS) {
            let pixels: Vec<[f32; 3]> =
                values.iter().map(|value| [upper((value - least) / step, [start, middle, end]); 3]).collect();
            let bytes = pictures::exr(picture.width, picture.height, &pixels);
            let bytes = bytes.ok_or_else(|| element.error("the weights of facets cannot be encoded", ""))?;
            let path = import.new_files.add_image(&format!("{name} weight"), "exr", bytes);
            let weight = Image { path, encoding: Encoding::Linear, ..image.clone() };
            weights.push(Textured::Texture(import.add_texture(&format!("{name} weight"), weight)));
        }
        let levels = (0..LEVELS).map(|level| f64::from(least + step * level as f32).exp()).collect();
        Ok(Some(Axis { levels, weights }))
    }
}

/// The start, middle and end of all levels, and of the halves of them that can be halved again.
fn halves(start: usize, end: usize) -> Vec<[usize; 3]> {
    if end - start < 2 {
        return Vec::new();
    }
    let middle = start.midpoint(end);
    [vec![[start, middle, end]], halves(start, middle), halves(middle, end)].concat()
}

/// The part of a place among the levels of `start..end` that falls to those from the middle on.
fn upper(place: f32, [start, middle, end]: [usize; 3]) -> f32 {
    let weight = |level: usize| (1.0 - (place - level as f32).abs()).max(0.0);
    let sum = |levels: std::ops::Range<usize>| levels.map(weight).sum::<f32>();
    let all = sum(start..end);
    if all > 0.0 { sum(middle..end) / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_mix_the_two_levels_around_a_place() {
        assert_eq!(halves(0, LEVELS).len(), LEVELS - 1);
        let nodes = halves(0, 4);
        assert_eq!(nodes, [[0, 2, 4], [0, 1, 2], [2, 3, 4]]);
        for place in [0.0, 0.25, 1.0, 1.5, 2.75, 3.0_f32] {
            let [root, lower, above] = [0, 1, 2].map(|node| upper(place, nodes[node]));
            let parts = [(1.0 - root) * (1.0 - lower), (1.0 - root) * lower, root * (1.0 - above), root * above];
            let mean: f32 = parts.iter().zip(0_u8..).map(|(part, level)| part * f32::from(level)).sum();
            assert!((mean - place).abs() < 1e-6 && parts.iter().filter(|part| **part > 1e-6).count() <= 2, "{place}: {parts:?}");
        }
    }
}
