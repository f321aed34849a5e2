//! A change of kind carries values over between parameters that mean the same, and no others.
use super::{
    super::{choose::choose, meaning::kept_by_kind, set::set},
    *,
};
use noisefall_base::declare::{Declare, Meaning, OneOf, Parameter, Parameters, Textured, Value};
use noisefall_scene::{
    light::punctual_light::PunctualLightKind, material::Material, scene::description::MaterialDescription, shape::ShapeKind,
    texture::TextureKind,
};

/// A table that has one of several kinds.
struct TableOf<T>(T);

impl<T: OneOf> Declare for TableOf<T> {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(&mut self.0);
    }
}

/// All values of a part, with their parameters. A second visit can set them first.
struct Values {
    sets: bool,
    found: Vec<(Parameter, OwnedValue)>,
}

impl Parameters for Values {
    fn value(&mut self, parameter: &Parameter, mut value: Value<'_>) {
        if self.sets {
            set_unusual(&mut value);
        }
        self.found.push((*parameter, OwnedValue::of(&value)));
    }
}

/// Gives a value a number that is no default.
fn set_unusual(value: &mut Value<'_>) {
    match value {
        Value::Textured(textured, range) => **textured = Textured::Constant([0.31, 0.32, 0.33].map(|x| range.least.max(x))),
        Value::TexturedNumber(textured, range) => **textured = Textured::Constant(0.37f64.clamp(range.least, range.most)),
        Value::Colour(rgb, _) => **rgb = [0.41, 0.42, 0.43],
        Value::Number(x, range) => **x = 1.43f64.clamp(range.least, range.most),
        Value::Flag(flag) => **flag ^= true,
        _ => {}
    }
}

fn values(part: &mut dyn Declare, sets: bool) -> Vec<(Parameter, OwnedValue)> {
    let mut values = Values { sets, found: Vec::new() };
    part.parameters(&mut values);
    values.found
}

/// Whether a value may come from another one: it means the same, or is the root of it or its square.
fn may_come_from(parameter: &Parameter, other: &Parameter) -> bool {
    let widths = [Some(Meaning::Roughness), Some(Meaning::SlopeWidth)];
    parameter.means_same(other) || (widths.contains(&parameter.meaning) && widths.contains(&other.meaning))
}

/// Changes the kind of a part from each to each. `change` makes the part of one kind another.
fn try_all<T: OneOf + Clone>(change: impl Fn(&T, &'static str) -> T) -> usize {
    let kinds = || T::alternatives().into_iter();
    let mut kept = 0;
    for from in kinds() {
        let before = values(&mut TableOf(from.clone()), false);
        let mut unusual = TableOf(from.clone());
        values(&mut unusual, true);
        let unusual = unusual.0;
        for plain in kinds().filter(|kind| kind.place() != from.place()) {
            let name = plain.name();
            let changed = |from: &T| values(&mut TableOf(change(from, name)), false);
            let usual = changed(&from);
            for (parameter, value) in changed(&unusual) {
                if usual.iter().any(|(known, default)| known.key == parameter.key && *default == value) {
                    continue;
                }
                let has_source = before.iter().any(|(source, _)| may_come_from(&parameter, source));
                assert!(has_source, "{} → {name}: `{}` is {value:?}", from.name(), parameter.key);
                kept += 1;
            }
        }
    }
    kept
}

/// A part of a kind as one of another kind.
fn chosen<T: OneOf + Clone>(from: &T, name: &str) -> T {
    let mut table = TableOf(from.clone());
    choose(&mut table, &Path::default(), T::WHAT, name);
    table.0
}

#[test]
fn only_values_that_mean_the_same_survive_any_change_of_kind() {
    let of_materials = try_all::<Material>(|from, name| {
        let mut material = MaterialDescription { kind: from.clone(), ..MaterialDescription::default() };
        let kept = kept_by_kind(&material, name);
        choose(&mut material, &Path::default(), Material::WHAT, name);
        kept.iter().for_each(|(path, value)| _ = set(&mut material, path, value));
        material.kind
    });
    assert!(of_materials > 20, "{of_materials}");
    let of_textures = try_all::<TextureKind>(chosen);
    let of_shapes = try_all::<ShapeKind>(chosen);
    let of_punctual = try_all::<PunctualLightKind>(chosen);
    assert!(of_textures > 0 && of_shapes > 0, "{of_textures} {of_shapes} {of_punctual}");
}

#[test]
fn a_diffuse_material_that_becomes_glass_is_clear() {
    for kind in ["dielectric", "thin_dielectric"] {
        let mut document = room();
        let change = document.change_kind(&path("materials.white"), "material", kind);
        does(&mut document, &change);
        let made = document.description().materials["white"].kind.clone();
        assert_eq!(Some(&made), Material::alternatives().iter().find(|plain| plain.name() == kind));
    }
}
