//! The image at an end of a parameter's range is the limit of the images towards that end.
//!
//! Both images use the same random numbers, so they differ by the effect of the parameter and hardly by noise.
use noisefall_base::declare::{Choice, Declare, OneOf, Parameter, Parameters, Range, Textured, Value, write};
use noisefall_scene::{
    material::{
        Material,
        kinds::{Blend, DiffuseTransmission},
    },
    scene::{Estimator, RenderSettings, Roulette, Scene},
};

use crate::picture::{LUMINANCE, Picture, picture, scene, settings, sigmas_of_most};

/// A value at an end of the range, and one just inside it.
struct End {
    /// Text of the scene with `@` in place of the value.
    text: &'static str,
    at: f64,
    near: f64,
}

/// Largest difference of blocks that the step between the two values may cause, relative to the radiance of the scene of about 1.
const NEAR: f64 = 3e-3;

const fn end(text: &'static str, at: f64, near: f64) -> End {
    End { text, at, near }
}

const SMALL: f64 = 1e-5;
const WHOLE: f64 = 1.0 - SMALL;

/// Cases for every kind of material, for parameters that change the image smoothly.
const MATERIALS: [End; 54] = [
    end("lambertian.albedo = @", 0.0, SMALL),
    end("lambertian.albedo = @", 1.0, WHOLE),
    end("lambertian.albedo = [@, 0.6, 0.3]", 0.0, SMALL),
    end("lambertian.albedo = [@, 0.6, 0.3]", 1.0, WHOLE),
    end("mirror.reflectance = @", 0.0, SMALL),
    end("mirror.reflectance = @", 1.0, WHOLE),
    end("mirror.reflectance = [0.8, @, 0.3]", 0.0, SMALL),
    end("conductor.f0 = @", 0.0, SMALL),
    end("conductor.f0 = @", 1.0, WHOLE),
    end("conductor = { f0 = @, alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { f0 = @, alpha = 0.3 }", 1.0, WHOLE),
    end("conductor = { f0 = [0.9, @, 0.4], alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { f0 = [0.9, @, 0.4], alpha = 0.3 }", 1.0, WHOLE),
    end("conductor = { f0 = @, alpha = 0.3, energy_compensation = false }", 0.0, SMALL),
    end("conductor.reflectance = @", 0.0, SMALL),
    end("conductor.reflectance = @", 1.0, WHOLE),
    end("conductor = { reflectance = @, alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { reflectance = @, alpha = 0.3 }", 1.0, WHOLE),
    end("conductor = { eta = @, k = 2.0 }", 0.0, SMALL),
    end("conductor = { eta = @, k = 2.0, alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { eta = 1.5, k = @, alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { eta = 1.5, k = @ }", 0.0, SMALL),
    end("conductor = { eta = @, k = 2.0 }", 1000.0, 999.9),
    end("conductor = { eta = 1.5, k = @ }", 1000.0, 999.9),
    end("conductor = { eta = [0.2, 0.9, @], k = [3.9, 2.4, 1.8], alpha = 0.3 }", 0.0, SMALL),
    end("conductor = { eta = @, k = 2.0, alpha = 0.3 }", 1000.0, 999.9),
    end("conductor = { eta = 1.5, k = @, alpha = 0.3 }", 1000.0, 999.9),
    end("conductor = { f0 = 0.5, alpha = @ }", 1.0, WHOLE),
    end("conductor = { f0 = 0.5, roughness = @ }", 1.0, WHOLE),
    end("dielectric.ior = @", 0.05, 0.050_000_1),
    end("dielectric.ior = @", 20.0, 19.9999),
    end("dielectric.ior = @", 1.0, 1.0 + SMALL),
    end("dielectric = { ior = 1.5, ior_outside = @ }", 1.5, 1.5 + SMALL),
    end("dielectric = { ior = 1.5, ior_outside = @ }", 0.05, 0.050_000_1),
    end("dielectric = { ior = 1.5, ior_outside = @ }", 20.0, 19.9999),
    end("dielectric = { ior = @, alpha = 0.3 }", 1.0, 1.0 + SMALL),
    end("dielectric = { ior = 1.5, alpha = @ }", 1.0, WHOLE),
    end("dielectric = { ior = 1.5, roughness = @ }", 1.0, WHOLE),
    end("dielectric = { ior = 1.5, alpha = @, energy_compensation = false }", 1.0, WHOLE),
    end("dielectric = { ior = 1.5, transmittance = @ }", 0.0, 1e-30),
    end("dielectric = { ior = 1.5, transmittance = @ }", 1.0, WHOLE),
    end("dielectric = { ior = 1.5, transmittance = [0.4, @, 0.9] }", 0.0, 1e-30),
    end("dielectric = { ior = 1.5, transmittance = [0.4, @, 0.9] }", 1.0, WHOLE),
    end("plastic = { albedo = @, ior = 1.5 }", 0.0, SMALL),
    end("plastic = { albedo = @, ior = 1.5 }", 1.0, WHOLE),
    end("plastic = { albedo = [0.2, @, 0.6], ior = 1.5 }", 0.0, SMALL),
    end("plastic = { albedo = [0.2, @, 0.6], ior = 1.5 }", 1.0, WHOLE),
    end("plastic = { albedo = @, ior = 1.5, alpha = 0.3 }", 0.0, SMALL),
    end("plastic = { albedo = @, ior = 1.5, alpha = 0.3 }", 1.0, WHOLE),
    end("plastic = { albedo = 0.0, ior = @ }", 1.0, 1.0 + SMALL),
    end("plastic = { albedo = 0.5, ior = @, alpha = 0.3 }", 1.0, 1.0 + SMALL),
    end("plastic = { albedo = 0.5, ior = @ }", 20.0, 19.9999),
    end("plastic = { albedo = 0.5, ior = 1.5, alpha = @ }", 1.0, WHOLE),
    end("plastic = { albedo = 0.5, ior = 1.5, roughness = @ }", 1.0, WHOLE),
];

/// Cases from smooth to slightly rough, which have different lobes and so different random numbers.
const SMOOTHNESS: [End; 6] = [
    end("conductor = { f0 = 0.5, alpha = @ }", 0.0, 0.00101),
    end("conductor = { f0 = 0.0, roughness = @ }", 0.0, 0.032),
    end("dielectric = { ior = 1.5, alpha = @ }", 0.0, 0.00101),
    end("dielectric = { ior = 1.5, roughness = @ }", 0.0, 0.032),
    end("plastic = { albedo = 0.0, ior = 1.5, alpha = @ }", 0.0, 0.00101),
    end("plastic = { albedo = 0.0, ior = 1.5, roughness = @ }", 0.0, 0.032),
];

/// Cases for everything else in a scene, in place of the text of [`room`].
const REST: [End; 22] = [
    end("textures.t.checker = { even = @, odd = 0.5, scale = 4.0 }", 0.0, SMALL),
    end("textures.t.checker = { even = 0.5, odd = @, scale = 4.0 }", 1.0, WHOLE),
    end("textures.t.noise = { scale = 3.0, octaves = 2, low = @, high = 0.5 }", 0.0, SMALL),
    end("textures.t.noise = { scale = 3.0, octaves = 2, low = 0.5, high = @ }", 1.0, WHOLE),
    end("environment.radiance = @", 0.0, SMALL),
    end("environment = { image = '$/scenes/assets/sky.exr', scale = @ }", 1e-12, SMALL),
    end("environment = { image = '$/scenes/assets/sky.exr', scale = 0.3, rotate = @ }", 0.0, SMALL),
    end("environment = { image = '$/scenes/assets/sky.exr', scale = 0.3, rotate = @ }", 360.0, SMALL),
    end("light.emission.radiance = @", 1e-12, SMALL),
    end("light.emission = { texture = 't', scale = @ }", 1e-12, SMALL),
    end("light.motion = [{ translate = [@, 0.0, 0.0] }]", 0.0, SMALL),
    end("light.motion = [{ rotate = { axis = [0.3, 1.0, 0.0], degrees = @ } }]", 0.0, 1e-3),
    end("ball.transform = [{ scale = [1.0, @, 1.0] }]", 1.0, WHOLE),
    end("ball.transform = [{ rotate = { axis = [0.3, 1.0, 0.0], degrees = @ } }]", 360.0, 1e-3),
    end("camera.lens = { radius = @, focus = 4.0 }", 0.0, SMALL),
    end("camera.motion = [{ translate = [@, 0.0, 0.0] }]", 0.0, SMALL),
    end("camera.filter.tent = { radius = @ }", 0.01, 0.010_01),
    end("camera.filter.gaussian = { sigma = @ }", 0.01, 0.010_01),
    end("material.bump = { texture = 't', height = @ }", 0.0, SMALL),
    end("render.roulette.fixed = @", 1.0, 1.0 - 1e-6),
    end("render.roulette.throughput = { start = @ }", 1e4, 1e5),
    end("render.max_bounces = @", 1e5, 1e4),
];

/// A ball of the material above a textured floor, under a sky and beside a light. What `text` says of one of its parts is added to it,
/// or stands in its place.
fn room(material: &str, text: &str) -> Scene {
    let part = |key: &str, otherwise: &str| {
        text.lines()
            .find(|line| line.starts_with(&format!("{key}.")))
            .or(text.starts_with(&format!("{key} ")).then_some(text))
            .map_or(otherwise.to_owned(), str::to_owned)
    };
    let of = |key: &str| text.strip_prefix(&format!("{key}.")).unwrap_or_default();
    let environment = part("environment", "environment.radiance = 0.5");
    let texture = part("textures.t", "textures.t.checker = { even = 0.2, odd = 0.7, scale = 3.0 }");
    let light = if of("light").starts_with("emission") { "" } else { "emission.radiance = 4.0" };
    let render = part("render", "");
    scene(&format!(
        "{environment}
        {texture}
        {render}
        [camera]
        eye = [0.0, 1.0, 4.0]
        look_at = [0.0, 0.1, 0.0]
        fov = 40.0
        resolution = [24, 24]
        shutter = [0.0, 1.0]
        {}
        [materials.ball]
        {material}
        {}
        [materials.floor]
        lambertian.albedo.texture = 't'
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 0.9 }}
        material = 'ball'
        {}
        [[objects]]
        shape.rectangle = {{ origin = [-4.0, -1.0, 4.0], edge_u = [8.0, 0.0, 0.0], edge_v = [0.0, 0.0, -8.0] }}
        material = 'floor'
        [[objects]]
        shape.sphere = {{ center = [1.5, 1.8, 1.0], radius = 0.5 }}
        {light}
        {}",
        of("camera"),
        of("material"),
        of("ball"),
        of("light"),
    ))
}

fn written(text: &str, value: f64) -> String {
    let value = if value >= 100.0 && (text.contains("start") || text.contains("bounces")) {
        format!("{value:.0}")
    } else {
        format!("{value:?}")
    };
    text.replace('@', &value).replace('$', env!("CARGO_MANIFEST_DIR"))
}

/// Block means of the image of one seed.
fn rendered(scene: &Scene, estimator: Estimator, from_scene: bool) -> Picture {
    // As few random decisions as possible end paths, because a difference in length would be noise.
    let own = settings(estimator);
    let settings = if from_scene {
        RenderSettings { roulette: scene.settings.roulette, max_bounces: scene.settings.max_bounces, ..own }
    } else {
        RenderSettings { roulette: Roulette::Off, max_bounces: Some(8), ..own }
    };
    picture(scene, settings, LUMINANCE, 64)
}

/// The largest difference between blocks of 8 × 8 pixels.
fn difference(end: &End, room: impl Fn(&str) -> Scene, estimator: Estimator, from_scene: bool) -> f64 {
    let [at, near] = [end.at, end.near].map(|value| rendered(&room(&written(end.text, value)), estimator, from_scene).blocks(8));
    let differences = at.iter().zip(&near).map(|(at, near)| (at.mean - near.mean).abs() / (1.0 + near.mean));
    differences.fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
}

#[test]
fn materials_at_the_ends_of_their_ranges_equal_their_limits() {
    for end in &MATERIALS {
        for estimator in [Estimator::Path, Estimator::Mis] {
            let found = difference(end, |material| room(material, ""), estimator, false);
            assert!(found < NEAR, "{} at {}, {}: {found:.2e}", end.text, end.at, estimator.name());
        }
    }
}

/// More than any material has.
const NUMBERS: usize = 40;

/// Sets the n-th number of a material to an end of its range, or just inside it.
struct AtEnd {
    /// Numbers that are still to be skipped.
    left: usize,
    upper: bool,
    near: bool,
    /// Index of the alternative of every choice.
    variant: usize,
    found: Option<&'static str>,
}

impl AtEnd {
    fn put(&mut self, parameter: &Parameter, range: &Range) -> Option<f64> {
        if self.left > 0 || self.found.is_some() {
            self.left = self.left.saturating_sub(1);
            return None;
        }
        self.found = Some(parameter.key);
        let end = if self.upper { range.most } else { range.least };
        let inside = match (self.upper, end) {
            (false, 0.0) => 1e-30,
            (false, end) => end + 2e-6 * end.abs(),
            (true, end) => end * (1.0 - 2e-6),
        };
        Some(if self.near { inside } else { end })
    }
}

impl Parameters for AtEnd {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        match value {
            Value::Number(number, range) => *number = self.put(parameter, &range).unwrap_or(*number),
            Value::TexturedNumber(number, range) => {
                if let Some(end) = self.put(parameter, &range) {
                    *number = Textured::Constant(end);
                }
            }
            Value::Colour(colour, range) => *colour = self.put(parameter, &range).map_or(*colour, |end| [end; 3]),
            Value::Textured(colour, range) => {
                if let Some(end) = self.put(parameter, &range) {
                    *colour = Textured::grey(end);
                }
            }
            _ => {}
        }
    }
    fn choose(&mut self, choice: &Choice, _: usize) -> usize {
        self.variant % choice.alternatives.len()
    }
}

/// The material as text of a scene file.
struct Chosen(Material);

impl Declare for Chosen {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        self.0.chosen(p);
    }
}

/// A material whose other values allow any one of them to be at an end of its range.
fn valid(kind: Material) -> Material {
    match kind {
        Material::DiffuseTransmission(_) => {
            DiffuseTransmission { reflectance: Textured::grey(0.0), transmittance: Textured::grey(0.0) }.into()
        }
        Material::Blend(blend) => Blend { first: "floor".to_owned(), second: "floor".to_owned(), ..blend }.into(),
        kind => kind,
    }
}

#[test]
fn every_number_of_every_declared_material_is_continuous_at_its_ends() {
    let mut tried = std::collections::BTreeSet::new();
    for kind in Material::alternatives().into_iter().map(valid) {
        for (left, upper, variant) in
            (0..NUMBERS).flat_map(|left| [false, true].into_iter().flat_map(move |u| (0..3).map(move |v| (left, u, v))))
        {
            let [at, near] = [false, true].map(|near| {
                let mut end = AtEnd { left, upper, near, variant, found: None };
                let mut material = Chosen(kind.clone());
                material.parameters(&mut end);
                let text = write(&mut material).into_iter().map(|(key, value)| format!("{key} = {value}")).collect::<String>();
                (end.found, text)
            });
            let Some(key) = at.0.filter(|_| tried.insert(at.1.clone())) else { continue };
            let blocks = [at.1.as_str(), &near.1].map(|text| rendered(&room(text, ""), Estimator::Mis, false).blocks(8));
            for (at_end, inside) in blocks[0].iter().zip(&blocks[1]) {
                let difference = (at_end.mean - inside.mean).abs() / (1.0 + inside.mean);
                assert!(difference < NEAR, "{key} of {}: {difference:.2e}", at.1);
            }
        }
    }
    assert!(tried.len() > 25, "{tried:?}");
}

#[test]
fn the_rest_of_a_scene_at_the_ends_of_its_ranges_equals_its_limits() {
    for end in &REST {
        let from_scene = end.text.starts_with("render");
        let found = difference(end, |text| room("plastic = { albedo = 0.4, ior = 1.5 }", text), Estimator::Mis, from_scene);
        assert!(found < NEAR, "{} at {}: {found:.2e}", end.text, end.at);
    }
}

#[test]
fn smooth_surfaces_are_the_limit_of_rough_ones() {
    for end in &SMOOTHNESS {
        let blocks =
            [end.at, end.near].map(|value| rendered(&room(&written(end.text, value), ""), Estimator::Mis, false).blocks(8));
        let [at, near] = &blocks;
        let allowed = sigmas_of_most(at.len() * SMOOTHNESS.len());
        for (at, near) in at.iter().zip(near) {
            let noise = (at.variance_of_mean + near.variance_of_mean).sqrt();
            assert!((at.mean - near.mean).abs() < allowed * noise + NEAR, "{}: {at:?} and {near:?}", end.text);
        }
    }
}
