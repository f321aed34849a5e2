//! A scene to try: its text and its expected outcome.
use glam::DVec3;

use super::dice::Dice;
use noisefall_kernel::measure::exact::furnace_capped;
use noisefall_scene::sampling::Sampler;

/// Expected outcome of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// Every sample has this radiance.
    Everywhere(f64),
    /// The mean over pixels and samples is this radiance.
    Mean(f64),
    /// Samples have this radiance except for a relative loss, whose mean must stay below a limit.
    Within { radiance: f64, loss: f64 },
    /// Samples are finite and not negative.
    Valid,
    /// The text is rejected with a position.
    Refused,
    /// The text is rejected, or samples are valid.
    ValidOrRefused,
}

pub struct TrialScene {
    /// The scene file without its first lines.
    pub text: String,
    pub expected: Expected,
    /// Samples per pixel.
    pub spp: u32,
    /// Size of the subject, metres.
    pub size: f64,
    /// Cap on bounces, if there is one.
    pub cap: Option<u32>,
}

impl TrialScene {
    pub fn of(text: String, expected: Expected) -> TrialScene {
        TrialScene { text, expected, spp: 8, size: 1.0, cap: None }
    }
}

/// A vector as TOML.
pub fn v(p: DVec3) -> String {
    format!("[{:?}, {:?}, {:?}]", p.x, p.y, p.z)
}

/// A camera at `eye` with a random direction and a field of view from 0.01° to 179°.
pub fn camera_at(dice: &mut Dice, eye: DVec3, reach: f64) -> String {
    let (look_at, up) = (eye + dice.direction() * reach * dice.decade(-1.0, 0.0), dice.direction());
    let fov = if dice.chance(0.5) { dice.within(20.0, 110.0) } else { dice.pick(&[0.01, 0.1, 1.0, 150.0, 170.0, 179.0]) };
    format!("eye = {}, look_at = {}, up = {}, fov = {fov:?}, resolution = [32, 32]", v(eye), v(look_at), v(up))
}

/// A camera at `eye` that looks at a point.
pub fn camera_towards(dice: &mut Dice, eye: DVec3, look_at: DVec3) -> String {
    let (up, fov) = (dice.direction(), dice.within(10.0, 60.0));
    format!("eye = {}, look_at = {}, up = {}, fov = {fov:?}, resolution = [32, 32]", v(eye), v(look_at), v(up))
}

/// A closed room in which every surface emits L_e and reflects ρ. With a cap of n its radiance is L_e (1 − ρⁿ⁺¹)/(1 − ρ)
/// everywhere, and so is every single sample with cosine directions.
pub struct Furnace {
    emission: f64,
    albedo: f64,
    cap: u32,
    /// Material of the bodies that are added next.
    pub material: &'static str,
    materials: String,
    objects: String,
}

impl Furnace {
    pub fn new(dice: &mut Dice) -> Furnace {
        let albedo = dice.pick(&[0.25, 0.5, 0.75, 0.9375]);
        let cap = dice.pick(&[1, 2, 3, 8, 40, 60]);
        Furnace { emission: dice.pick(&[1e-9, 1.0, 1.0, 1e9]), ..Furnace::of(albedo, cap) }
    }

    pub fn of(albedo: f64, cap: u32) -> Furnace {
        Furnace { emission: 1.0, albedo, cap, material: "grey", materials: String::new(), objects: String::new() }
    }

    fn add(&mut self, shape: &str, rest: &str) {
        let Furnace { material, emission, .. } = self;
        self.objects += &format!("[[objects]]\n{shape}\nmaterial = '{material}'\nemission.radiance = {emission:?}\n{rest}\n");
    }

    /// Adds a closed surface around everything, seen from inside.
    pub fn wall(&mut self, shape: &str) {
        self.add(shape, "flip = true");
    }

    /// Adds a closed body. It is dark inside, so rays that get in miss emission.
    pub fn body(&mut self, shape: &str) {
        self.add(shape, "");
    }

    /// Adds an open surface.
    pub fn sheet(&mut self, shape: &str) {
        self.add(shape, "emission.two_sided = true");
    }

    /// Adds a body that neither emits nor absorbs.
    pub fn lossless(&mut self, name: &str, material: &str, shape: &str) {
        self.materials += &format!("materials.{name}.{material}\n");
        self.objects += &format!("[[objects]]\n{shape}\nmaterial = '{name}'\n");
    }

    /// The scene as seen by a camera.
    pub fn trial_scene(&self, dice: &mut Dice, camera: &str, size: f64) -> TrialScene {
        let exact = if self.albedo < 1.0 {
            furnace_capped(self.emission, self.albedo, self.cap)
        } else {
            self.emission * f64::from(self.cap + 1)
        };
        let sampler = dice.pick(&Sampler::ALL).name();
        let text = format!(
            "camera = {{ {camera} }}\n\
             render = {{ estimator = 'path', directions = 'cosine', sampler = '{sampler}', roulette = 'off', max_bounces = {}, \
             seed = {} }}\n\
             reference.radiance = {exact:?}\n\
             materials.grey.lambertian.albedo = {albedo:?}\n\
             materials.mirror.mirror.reflectance = {albedo:?}\n\
             {}{}",
            self.cap,
            dice.below(1000),
            self.materials,
            self.objects,
            albedo = self.albedo,
        );
        TrialScene { size, cap: Some(self.cap), ..TrialScene::of(text, Expected::Everywhere(exact)) }
    }
}
