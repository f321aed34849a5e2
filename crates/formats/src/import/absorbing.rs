//! Media that absorb light and do not scatter it, within surfaces.
use std::collections::{HashMap, HashSet};

use super::{Names, Remark};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Dielectric, Material},
    scene::description::{MaterialDescription, SceneDescription},
};

/// How the light of punctual lights differs behind [`Filling::Interface`].
pub const INTERFACE: &str = "punctual lights shine through it on light paths only, as with `bidirectional`";

/// How a surface holds a medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filling {
    /// Exactly as in the scene.
    Exact,
    /// Behind an interface of index 1, through which light samples do not pass.
    Interface,
    /// It cannot.
    Refused,
}

/// The absorbing media of a scene, and the materials that hold them.
#[derive(Default)]
pub struct Absorbers {
    /// Those that fill a shape.
    inside: HashSet<String>,
    /// Those outside of a shape, with the remark if they fill no shape around it.
    outside: Vec<(String, Remark)>,
    /// Materials by the material without the medium, and its absorption.
    filled: HashMap<(String, [u64; 3]), String>,
}

impl Absorbers {
    /// Notes that a medium lies outside of a shape, at `place`.
    pub fn note_outside(&mut self, medium: &str, place: String, found: String) {
        let (used, effect) = ("empty space outside of the shape".to_owned(), "it does not absorb".to_owned());
        self.outside.push((medium.to_owned(), Remark { place, found, used, effect }));
    }

    /// The remarks about media that lie outside of shapes and fill none.
    pub fn remarks_of_open(&mut self) -> impl Iterator<Item = Remark> {
        self.outside.drain(..).filter(|(medium, _)| !self.inside.contains(medium)).map(|(_, remark)| remark)
    }

    /// The material of a shape that holds a medium: [`fill`].
    pub fn hold(
        &mut self,
        (description, names): (&mut SceneDescription, &mut Names),
        surface: String,
        (medium, absorption): (&str, [f64; 3]),
    ) -> (String, Filling) {
        self.inside.insert(medium.to_owned());
        let key = (surface.clone(), absorption.map(f64::to_bits));
        if let Some(known) = self.filled.get(&key) {
            return (known.clone(), Filling::Exact);
        }
        let Some(before) = description.materials.get(&surface) else { return (surface, Filling::Exact) };
        let mut material = before.clone();
        let filling = fill(&mut material, absorption);
        let mut name = surface;
        if material != *before {
            name = names.unique(&name, "material");
            description.materials.insert(name.clone(), material);
        }
        if filling != Filling::Refused {
            self.filled.insert(key, name.clone());
        }
        (name, filling)
    }
}

/// Fills the inside of a surface with a medium that absorbs the fraction `absorption` of light per metre, per channel: the `sigma_a` of
/// other programs, not negative.
pub fn fill(material: &mut MaterialDescription, absorption: [f64; 3]) -> Filling {
    if absorption == [0.0; 3] {
        return Filling::Exact;
    }
    let passed = absorption.map(|absorbed| (-absorbed).exp());
    if material.opacity.is_some() {
        return Filling::Refused;
    }
    match &mut material.kind {
        Material::Dielectric(glass) => {
            (0..3).for_each(|channel| glass.transmittance[channel] *= passed[channel]);
            Filling::Exact
        }
        Material::Principled(glass) if glass.transmission_weight != Textured::Constant(0.0) => {
            let is_clear = !glass.thin_walled && glass.transmission_color == Textured::grey(1.0);
            if is_clear {
                (glass.transmission_color, glass.transmission_depth) = (Textured::Constant(passed), 1.0);
            }
            if is_clear { Filling::Exact } else { Filling::Refused }
        }
        Material::Null(_) => {
            material.kind = Dielectric { ior: 1.0, transmittance: passed, ..Dielectric::default() }.into();
            Filling::Interface
        }
        // No light comes inside.
        Material::Lambertian(_)
        | Material::Mirror(_)
        | Material::Conductor(_)
        | Material::Plastic(_)
        | Material::RoughPlastic(_)
        | Material::Principled(_) => Filling::Exact,
        Material::Disney(plain) if plain.spec_trans == Textured::Constant(0.0) => Filling::Exact,
        _ => Filling::Refused,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::material::{
        Lambertian, Material, diffuse_transmission::DiffuseTransmission, null::Null, principled::Principled,
    };

    fn filled(kind: impl Into<Material>) -> (Material, Filling) {
        let mut material = MaterialDescription { kind: kind.into(), ..MaterialDescription::default() };
        let filling = fill(&mut material, [0.0, 0.5, 2.0]);
        (material.kind, filling)
    }

    #[test]
    fn glass_holds_media_by_its_transmittance() {
        let passed = [1.0, (-0.5_f64).exp(), (-2.0_f64).exp()];
        let (glass, filling) = filled(Dielectric { transmittance: [0.5, 1.0, 1.0], ..Dielectric::default() });
        let expected = [0.5, passed[1], passed[2]];
        assert!(filling == Filling::Exact && matches!(glass, Material::Dielectric(glass) if glass.transmittance == expected));
        let clear = Principled { transmission_weight: Textured::Constant(1.0), ..Principled::default() };
        let (glass, filling) = filled(clear.clone());
        assert!(
            filling == Filling::Exact
                && matches!(glass, Material::Principled(glass)
            if glass.transmission_color == Textured::Constant(passed) && glass.transmission_depth == 1.0)
        );
        assert_eq!(filled(Principled { transmission_color: Textured::grey(0.5), ..clear }).1, Filling::Refused);
        let (interface, filling) = filled(Null);
        assert!(filling == Filling::Interface && matches!(interface, Material::Dielectric(glass) if glass.ior == 1.0));
    }

    #[test]
    fn surfaces_that_let_no_light_in_stay_and_others_are_refused() {
        let white = Lambertian { albedo: Textured::grey(0.5) };
        assert!(matches!(filled(white), (Material::Lambertian(_), Filling::Exact)));
        let leaf = DiffuseTransmission { reflectance: Textured::grey(0.2), transmittance: Textured::grey(0.2) };
        assert_eq!(filled(leaf).1, Filling::Refused);
        let opacity = Some(Textured::Constant(0.5));
        let mut masked = MaterialDescription { kind: Dielectric::default().into(), opacity, ..MaterialDescription::default() };
        assert_eq!(fill(&mut masked, [1.0; 3]), Filling::Refused);
        assert_eq!(fill(&mut masked, [0.0; 3]), Filling::Exact);
    }
}
