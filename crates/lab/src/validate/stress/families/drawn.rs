//! Materials, shapes and settings as their declarations draw them: a new kind is tried without an edit here.
use glam::DVec3;

use crate::validate::stress::{dice::Dice, trial_scene::v};
use noisefall_base::declare::{self, Choice, Declare, OneOf, Parameter, Parameters, Range, Resources, Textured, Value, write};
use noisefall_scene::{
    geometry::Shape,
    material::Material,
    scene::RenderSettings,
    shape::{ShapeBuilder, ShapeKind},
};

/// A value of a declaration as the text of a scene.
fn text(value: &mut dyn Declare) -> String {
    toml::Value::Table(write(value)).to_string()
}

/// Settings anywhere in their ranges, but with a cap of 12.
pub fn settings(dice: &mut Dice) -> String {
    let mut settings = RenderSettings { max_bounces: Some(12), ..RenderSettings::default() };
    settings.parameters(&mut declare::Dice::new(dice));
    text(&mut settings)
}

/// A material of each kind, with values anywhere in their ranges. Blends are of the materials `parts`.
pub fn materials(dice: &mut Dice, parts: [&str; 2]) -> Vec<String> {
    let drawn = |kind| {
        let mut kind = OfKind(kind);
        kind.parameters(&mut declare::Dice::new(dice));
        match &mut kind.0 {
            Material::Blend(blend) => (blend.first, blend.second) = (parts[0].to_owned(), parts[1].to_owned()),
            // Both fractions may be the largest of their range, but not together.
            Material::DiffuseTransmission(sheet) => {
                for fraction in [&mut sheet.reflectance, &mut sheet.transmittance] {
                    if let Textured::Constant(rgb) = fraction {
                        *rgb = rgb.map(|x| 0.5 * x);
                    }
                }
            }
            _ => {}
        }
        text(&mut kind)
    };
    Material::alternatives().into_iter().map(drawn).collect()
}

/// A shape of any kind around a point. Values that make no shape are drawn again.
pub fn shape(dice: &mut Dice, center: DVec3, size: f64) -> String {
    loop {
        let mut kinds = ShapeKind::alternatives();
        let kind = kinds.swap_remove(dice.below(kinds.len()));
        let mut kind = OfKind(kind);
        kind.parameters(&mut ShapeDice(dice));
        let Some((middle, radius)) = extent(&kind.0) else { continue };
        let [there, here] = [-middle, center].map(|way| format!("{{ translate = {} }}", v(way)));
        return format!("shape = {}\ntransform = [{there}, {{ scale = {:?} }}, {here}]", text(&mut kind), size / radius);
    }
}

/// A sphere around a shape; `None` if its values make none.
fn extent(kind: &ShapeKind) -> Option<(DVec3, f64)> {
    let shapes = ShapeBuilder::new(&Resources::new("")).build(kind).ok()?;
    let spheres: Vec<(DVec3, f64)> = shapes.iter().map(Shape::bounding_sphere).collect();
    let (middle, _) = *spheres.first()?;
    let radius = spheres.iter().map(|(center, radius)| middle.distance(*center) + radius).fold(0.0, f64::max);
    (1e-6..1e6).contains(&radius).then_some((middle, radius))
}

/// A value whose kind is not drawn, but all of its parameters are.
struct OfKind<T>(T);

impl<T: OneOf> Declare for OfKind<T> {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        self.0.chosen(p);
    }
}

/// Draws lengths of the order of coordinates: families of scales and slivers go to the ends of their range.
struct ShapeDice<'d>(&'d mut Dice);

impl Parameters for ShapeDice<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        match value {
            Value::Number(number, range) if range == Range::LENGTH => *number = self.0.decade(-2.0, 1.0),
            other => declare::Dice::new(self.0).value(parameter, other),
        }
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        declare::Dice::new(self.0).present(parameter, now)
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        declare::Dice::new(self.0).choose(choice, now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::parse;

    #[test]
    fn every_kind_of_shape_is_drawn_and_can_be_placed() {
        let mut dice = Dice::new("shapes", 1);
        let mut seen = std::collections::BTreeSet::new();
        for _ in 0..300 {
            let drawn = shape(&mut dice, DVec3::new(1.0, -2.0, 0.5), 0.3);
            let text = format!(
                "format = 1\ncamera = {{ eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }}\n\
                 [[objects]]\n{drawn}\nemission.radiance = 1.0"
            );
            let scene = parse("drawn", text).unwrap_or_else(|error| panic!("{}\n{drawn}", error.report()));
            assert!(scene.objects.iter().all(|object| {
                let (center, radius) = object.shape.bounding_sphere();
                center.distance(DVec3::new(1.0, -2.0, 0.5)) + radius < 1.0
            }));
            seen.extend(ShapeKind::alternatives().iter().map(OneOf::name).find(|name| drawn.contains(&format!("{{ {name} = "))));
        }
        assert_eq!(seen.len(), ShapeKind::alternatives().len(), "{seen:?}");
    }
}
