//! BSDFs that change others: bumps, masks, sides and mixtures.
use super::{
    super::{
        bitmaps::is_placed,
        context::{Import, TextureValue},
        tree::Element,
    },
    one_or_two_sided, transparent,
};
use noisefall_scene::{
    image::Encoding,
    material::{Lambertian, blend::Blend, null::Null},
    scene::{
        SceneError,
        description::{Bump, MaterialDescription, Textured},
    },
    texture::{
        image::{Image, Wrap},
        product::Product,
    },
};

fn nested<'t>(element: Element<'t>) -> Result<Vec<Element<'t>>, SceneError> {
    Ok(element.objects(&["bsdf"])?.into_iter().map(|(_, bsdf)| bsdf).collect())
}

pub fn only<'t>(element: Element<'t>) -> Result<Element<'t>, SceneError> {
    match nested(element)?[..] {
        [bsdf] => Ok(bsdf),
        _ => Err(element.error(format!("a `{}` needs one BSDF within it", element.kind()), "nest one BSDF, or refer to one")),
    }
}

pub fn two_sided(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let sides = nested(element)?;
    match sides[..] {
        [front] => import.material(front, true),
        [front, back] if front.index == back.index => import.material(front, true),
        [front, back] => {
            let first = import.surface(front, true)?.material;
            let second = import.surface(back, true)?.material;
            Ok(transparent(Blend { first, second, by_side: true, ..Blend::default() }))
        }
        _ => Err(element.error("a `twosided` needs one or two BSDFs within it", "nest them, or refer to them")),
    }
}

pub fn mask(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let inner = import.material(only(element)?, two_sided)?;
    let opacity = import.fraction(element, "opacity", 0.5)?;
    let opacity = match (opacity, inner.opacity) {
        (opacity, None) => opacity,
        (Textured::Constant(a), Some(Textured::Constant(b))) => Textured::Constant(a * b),
        (Textured::Constant(a), Some(b)) | (b, Some(Textured::Constant(a))) => import.scaled(b, a),
        (Textured::Texture(a), Some(Textured::Texture(b))) => {
            let product = Product { a: Textured::Texture(a), b: Textured::Texture(b) };
            Textured::Texture(import.add_texture(&format!("{} opacity", element.label()), product))
        }
    };
    Ok(MaterialDescription { opacity: Some(opacity), ..inner })
}

pub fn blend(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let [first, second] = nested(element)?[..] else {
        return Err(element.error("a blend needs two BSDFs within it", "nest them, or refer to them"));
    };
    let weight = import.fraction(element, "weight", 0.5)?;
    let [first, second] = [import.surface(first, two_sided)?.material, import.surface(second, two_sided)?.material];
    Ok(blended(import, first, second, weight))
}

/// A mixture of two materials. Its back is black if those of both are.
pub fn blended(import: &Import, first: String, second: String, weight: Textured<f64>) -> MaterialDescription {
    let has_back = |name: &String| import.description.materials.get(name).is_none_or(|part| part.two_sided != Some(false));
    let two_sided = if has_back(&first) || has_back(&second) { None } else { Some(false) };
    MaterialDescription { two_sided, ..transparent(Blend { first, second, weight, by_side: false }) }
}

/// Any number of BSDFs with a weight each. What the weights lack of 1 is black.
pub fn mixture(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let parts = nested(element)?;
    let Some(weights) = element.property("weights")? else { return blend(import, element, two_sided) };
    let weights = weights.parse_numbers(weights.value()?)?;
    if weights.len() != parts.len() || weights.iter().any(|weight| *weight < 0.0) {
        return Err(
            element.error("a mixture needs a weight of 0 or more for each BSDF within it", "such as \"0.7, 0.3\" for two")
        );
    }
    let sum: f64 = weights.iter().sum();
    if sum > 1.0 {
        import.remark_value(element, "weights", "weights that add up to 1", "the surface is darker, and creates no light")?;
    }
    let mut mixed = one_or_two_sided(Lambertian { albedo: Textured::grey(0.0) }, two_sided);
    let mut total = (1.0 - sum).max(0.0);
    for (part, weight) in parts.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0) {
        let second = import.surface(part, two_sided)?.material;
        total += weight;
        if total == weight {
            mixed = import.description.materials.get(&second).cloned().unwrap_or_default();
            continue;
        }
        let first = import.part_of(element, "part", mixed);
        mixed = blended(import, first, second, Textured::Constant(weight / total));
    }
    Ok(mixed)
}

pub fn null(_: &mut Import, _: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    Ok(transparent(Null))
}

pub fn bump_map(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let inner = import.material(only(element)?, two_sided)?;
    let heights = element.objects(&["texture"])?;
    let [(_, heights)] = heights[..] else {
        return Err(element.error("a bump map needs one texture within it", "nest one texture, or refer to one"));
    };
    if inner.bump.is_some() {
        import.remark(element, "the inner bump map", "the outer one is missing");
        return Ok(inner);
    }
    let texture = import.texture(heights, TextureValue::Number)?;
    let height = element.number("scale", 1.0)?.clamp(-1e6, 1e6);
    let relief = relief(import, element, two_sided)?;
    Ok(MaterialDescription { bump: Some(Bump { texture, height }), ..relief.over(inner) })
}

pub fn normal_map(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let relief = relief(import, element, two_sided)?;
    let inner = import.material(only(element)?, two_sided)?;
    let normals = match element.property("normalmap")? {
        Some(normals) => normals,
        None => match element.objects(&["texture"])?[..] {
            [(_, normals)] => normals,
            _ => {
                return Err(element.error("a normal map needs its texture", "add `<texture name=\"normalmap\" type=\"bitmap\">`"));
            }
        },
    };
    if normals.kind() != "bitmap" {
        import.remark(normals, "no normal map", "the surface is smooth");
        return Ok(inner);
    }
    let image = import.bitmap(normals)?;
    if image.encoding != Encoding::Linear {
        import.remark(normals, "its linear values", "normals are tilted by other angles");
    }
    let plain = Image { path: image.path.clone(), encoding: image.encoding, filter: image.filter, ..Image::default() };
    if image != plain && (image.wrap_u != Wrap::Repeat || is_placed(&image)) {
        import.remark(normals, "the image over the unit square, repeated", "the normals lie elsewhere");
    }
    if inner.normal_map.is_some() {
        import.remark(element, "the inner normal map", "the outer one is missing");
        return Ok(inner);
    }
    Ok(MaterialDescription { normal_map: Some(image.path), ..relief.over(inner) })
}

/// Treatment of tilted normals, as in Mitsuba: since version 3.7.1, it shadows and mirrors them by default.
struct Relief {
    /// Whether they darken light at grazing angles.
    shadows: bool,
    /// Whether those that face away from the viewer are mirrored.
    mirrored: bool,
    /// Whether the back, which a `twosided` around it shows as it shows the front, has bumps too.
    two_sided: bool,
}

impl Relief {
    fn over(&self, inner: MaterialDescription) -> MaterialDescription {
        MaterialDescription {
            normal_shadowing: inner.normal_shadowing.or(self.shadows.then_some(true)),
            mirrored_normals: inner.mirrored_normals.or(self.mirrored.then_some(true)),
            two_sided_relief: inner.two_sided_relief.or(self.two_sided.then_some(true)),
            ..inner
        }
    }
}

fn relief(import: &mut Import, element: Element, two_sided: bool) -> Result<Relief, SceneError> {
    let mirrored = element.flag("flip_invalid_normals", true)?;
    if !mirrored {
        let used = "the normal of the surface for those that face away";
        import.remark_value(element, "flip_invalid_normals", used, "steep relief is brighter")?;
    }
    Ok(Relief { shadows: element.flag("use_shadowing_function", true)?, mirrored, two_sided })
}
