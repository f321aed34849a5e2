//! Settings for which the variance of the estimate may be infinite.
use super::{MaterialInstance, RenderSettings, Roulette, Scene};
use crate::sampling::Directions;

impl Scene {
    /// Warning about settings whose samples may have infinite variance in this scene; `None` if their variance is finite.
    ///
    /// Between surfaces of albedo ρ the mean square of a sample is a series in ρ² E w²/q: q is the probability to survive roulette, and E w²
    /// the mean square of the weight of a direction, 4/3 for uniform ones at diffuse surfaces and 1 otherwise. Roulette by throughput
    /// keeps throughputs at about 1 or less as long as its upper bound q = [`Roulette::MOST`] is enough. A cap ends the series.
    /// Glass absorbs nothing, so it does not count.
    pub fn infinite_variance(&self, settings: &RenderSettings) -> Option<String> {
        let survival = settings.roulette.survival();
        let is_uniform = settings.directions == Directions::Uniform;
        // Without roulette, weights of 1 do not grow.
        if settings.max_bounces.is_some() || (survival == 1.0 && !is_uniform) {
            return None;
        }
        let square = |material: &MaterialInstance| {
            let weight_square = if is_uniform && material.properties.diffuse { 4.0 / 3.0 } else { 1.0 };
            material.properties.albedo.powi(2) * weight_square
        };
        let most = self.objects.iter().filter_map(|object| self.material(object)).map(square).fold(0.0, f32::max);
        if survival > most {
            return None;
        }
        let advice = if most < Roulette::MOST {
            format!("use more than {most:.2}, or roulette by throughput")
        } else if is_uniform {
            "use cosine directions".to_owned()
        } else {
            "turn roulette off".to_owned()
        };
        let what = settings.roulette.survival_words();
        Some(format!("{what}: the variance is infinite if light stays between bright surfaces; {advice}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::parse;

    fn scene(material: &str) -> Scene {
        let text = format!(
            "format = 1\ncamera = {{ eye = [0.0, 0.0, 0.0], look_at = [1.0, 0.0, 0.0], fov = 50.0, resolution = [8, 8] }}\n\
             materials.wall.{material}\ntextures.tiles.checker = {{ even = 0.2, odd = 0.9, scale = 2.0 }}\n\
             [[objects]]\nshape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}\nmaterial = 'wall'\nemission.radiance = 1.0"
        );
        parse("test", text).expect("a scene")
    }

    fn said(material: &str, settings: RenderSettings) -> Option<String> {
        scene(material).infinite_variance(&settings)
    }

    #[test]
    fn survival_at_most_the_square_of_the_albedo_is_told() {
        let fixed = |q: f32| RenderSettings { roulette: Roulette::fixed(q), ..Default::default() };
        for (material, most) in [
            ("lambertian = { albedo = [0.1, 0.8, 0.2] }", 0.64),
            ("lambertian = { albedo = { texture = 'tiles' } }", 0.81),
            ("mirror = { reflectance = 0.7 }", 0.49),
            ("conductor = { f0 = 0.6, roughness = 0.3 }", 0.36),
            // Gold reflects 0.967 of red light.
            ("conductor = { eta = [0.143, 0.374, 1.442], k = [3.983, 2.386, 1.603] }", 0.93),
            ("dielectric = { ior = 1.5 }", 0.0),
        ] {
            assert_eq!(said(material, fixed(most + 0.01)), None, "{material}");
            let warning = said(material, fixed((most - 0.01).max(Roulette::LEAST)));
            assert_eq!(warning.is_some(), most > 0.0, "{material}");
            assert!(warning.as_ref().is_none_or(|text| text.chars().count() < 150), "{warning:?}");
            assert!(warning.is_none_or(|text| text.contains(&format!("more than {most}")) && text.contains("infinite")));
        }
        let white = said("lambertian = { albedo = 1.0 }", fixed(0.99)).expect("no survival is enough");
        assert!(white.ends_with("turn roulette off"), "{white}");
    }

    #[test]
    fn roulette_by_throughput_is_bounded_and_so_are_the_albedos_that_it_can_bear() {
        let settings = |directions| RenderSettings { directions, ..Default::default() };
        let told =
            |albedo: f32, directions| said(&format!("lambertian = {{ albedo = {albedo} }}"), settings(directions)).is_some();
        assert_eq!([0.97, 0.98, 1.0].map(|albedo| told(albedo, Directions::Cosine)), [false, true, true]);
        assert_eq!([0.84, 0.85].map(|albedo| told(albedo, Directions::Uniform)), [false, true]);
    }

    #[test]
    fn uniform_directions_count_and_caps_end_it() {
        let settings = |roulette, directions| RenderSettings { roulette, directions, ..Default::default() };
        let grey = "lambertian = { albedo = 0.9 }";
        assert!(said(grey, settings(Roulette::Off, Directions::Uniform)).is_some_and(|text| text.contains("cosine directions")));
        assert_eq!(said(grey, settings(Roulette::Off, Directions::Cosine)), None);
        assert_eq!(said("lambertian = { albedo = 0.86 }", settings(Roulette::Off, Directions::Uniform)), None);
        assert_eq!(said("mirror = { reflectance = 0.9 }", settings(Roulette::Off, Directions::Uniform)), None);
        assert!(said("lambertian = { albedo = 0.8 }", settings(Roulette::fixed(0.7), Directions::Uniform)).is_some());
        assert_eq!(said("lambertian = { albedo = 0.8 }", settings(Roulette::fixed(0.7), Directions::Cosine)), None);
        let capped = RenderSettings { max_bounces: Some(9), ..settings(Roulette::fixed(0.2), Directions::Uniform) };
        assert_eq!(said(grey, capped), None);
    }
}
