//! Substitutes for kinds that a format has no translation of, each with a remark by name.
//!
//! They know the traits of the families alone, so a new kind can be exported before a format learns about it.
use glam::DAffine3;

use super::{notes::Notes, textures::Colors};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::{
        PunctualLight,
        emission::{EmissionSource, Side},
    },
    material::{Material, Materials},
    scene::description::{EnvironmentDescription, PunctualLightDescription},
    shape::product,
};

impl Colors<'_> {
    /// The albedo of a diffuse surface in place of a material: its mean color.
    pub fn diffuse_substitute(&self, kind: &Material, notes: &mut Notes) -> [f64; 3] {
        let effect = "it has no highlights, and no light passes";
        notes.add(format!("a material `{}`", kind.name()), "a diffuse surface of its mean colour", effect);
        let compiled = self.compiled(kind);
        compiled.map_or([0.0; 3], |color| color.map(|x| f64::from(x.clamp(0.0, 1.0))))
    }

    /// The colour of a material head-on; white for kinds without one. `None` if it cannot be compiled.
    fn compiled(&self, kind: &Material) -> Option<[f32; 3]> {
        let compiled = Materials::default().compile(kind, self.compiler()).ok()?;
        Some(self.compiler().typical(compiled.colour))
    }

    /// The radiance of an emission, without its factor: a colour or a texture.
    pub fn radiance(&self, source: &EmissionSource, notes: &mut Notes) -> Textured {
        match source {
            EmissionSource::Radiance(radiance) => Textured::Constant(radiance.radiance),
            EmissionSource::Texture(texture) => Textured::Texture(texture.name.clone()),
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            other => self.emission_substitute(other, notes),
        }
    }

    /// The mean of an emission.
    fn emission_substitute(&self, source: &EmissionSource, notes: &mut Notes) -> Textured {
        notes.add(format!("emission by `{}`", source.name()), "its mean", "the light has one colour");
        let emission = source.kind().compile(1.0, Side::Front, self.compiler());
        Textured::Constant(emission.map_or([0.0; 3], |emission| emission.mean.map(f64::from)))
    }

    /// A point light or a directional light with the power of a light; `None` if it cannot be compiled.
    pub fn punctual_substitute(
        &self,
        punctual_light: &PunctualLightDescription,
        notes: &mut Notes,
    ) -> Option<PunctualLightDescription> {
        let map = product(&punctual_light.transform).unwrap_or(DAffine3::IDENTITY);
        let kind = punctual_light.kind.kind().compile(&map, self.compiler().resources).ok().map(PunctualLight::plain);
        let used = kind.as_ref().map_or("nothing".to_owned(), |kind| format!("a light `{}` of the same power", kind.name()));
        notes.add(format!("a light `{}`", punctual_light.kind.name()), used, "its light has another distribution");
        Some(PunctualLightDescription { name: punctual_light.name.clone(), kind: kind?, transform: Vec::new() })
    }

    /// The radiance of a constant environment in place of another one: its mean.
    pub fn environment_substitute(&self, environment: &EnvironmentDescription, notes: &mut Notes) -> [f64; 3] {
        let found = format!("an environment `{}`", environment.name());
        notes.add(found, "its mean colour", "light comes from all directions alike");
        let compiled = environment.compile(self.compiler().resources).ok().flatten();
        compiled.map_or([0.0; 3], |environment| environment.mean().map(f64::from))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use noisefall_base::declare::{Assets, Resources};
    use noisefall_scene::{
        light::{
            emission::kinds::Texture,
            environment::kinds::Sky,
            punctual_light::{PunctualLightKind, kinds::Spot},
        },
        scene::describe,
    };

    const SCENE: &str = "format = 1\n[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [8, 8]\n\
        [textures.squares]\nchecker = { even = [0.2, 0.4, 0.6], odd = [0.4, 0.6, 0.8], scale = 4.0 }\n\
        [materials.paint]\nplastic = { albedo = { texture = \"squares\" }, ior = 1.5 }\n";

    /// The result and the remarks of a substitution.
    fn substituted<T>(make: impl FnOnce(&Colors, &mut Notes) -> T) -> (T, Vec<String>) {
        let description = describe("scene", SCENE.to_owned()).unwrap_or_else(|error| panic!("{}", error.report()));
        let resources = Resources::new(Path::new("")).with_assets(Assets::default());
        let mut notes = Notes::default();
        let made = make(&Colors::new(&description, &resources), &mut notes);
        (made, notes.remarks.iter().map(|counted| format!("{} → {}", counted.remark.found, counted.remark.used)).collect())
    }

    fn is_near(found: [f64; 3], expected: [f64; 3]) -> bool {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn a_material_becomes_diffuse_with_its_mean_color() {
        let description = describe("scene", SCENE.to_owned()).unwrap_or_else(|error| panic!("{}", error.report()));
        let (color, remarks) =
            substituted(|colors, notes| colors.diffuse_substitute(&description.materials["paint"].kind, notes));
        assert!(is_near(color, [0.3, 0.5, 0.7]), "{color:?}");
        assert!(remarks.len() == 1 && remarks[0].contains("a material `plastic`"), "{remarks:?}");
    }

    #[test]
    fn an_emission_becomes_its_mean() {
        let source = Texture { name: "squares".to_owned() }.into();
        let (radiance, remarks) = substituted(|colors, notes| colors.emission_substitute(&source, notes));
        let Textured::Constant(radiance) = radiance else { panic!("a constant") };
        assert!(is_near(radiance, [0.3, 0.5, 0.7]), "{radiance:?}");
        assert!(remarks.len() == 1 && remarks[0].contains("emission by `texture`"), "{remarks:?}");
    }

    #[test]
    fn a_light_becomes_a_point_light_and_an_environment_its_mean() {
        let spot = PunctualLightDescription { name: "desk".to_owned(), kind: Spot::default().into(), transform: Vec::new() };
        let (punctual_light, remarks) = substituted(|colors, notes| colors.punctual_substitute(&spot, notes));
        let punctual_light = punctual_light.expect("it can be compiled");
        assert!(
            punctual_light.name == "desk"
                && matches!(&punctual_light.kind, PunctualLightKind::Point(point) if point.intensity[0] > 0.0)
        );
        assert!(remarks.len() == 1 && remarks[0].contains("a light `spot`") && remarks[0].contains("`point`"), "{remarks:?}");
        let (radiance, remarks) = substituted(|colors, notes| colors.environment_substitute(&Sky::default().into(), notes));
        assert!(radiance.iter().all(|x| *x > 0.0), "{radiance:?}");
        assert!(remarks.len() == 1 && remarks[0].contains("an environment `sky`"), "{remarks:?}");
    }
}
