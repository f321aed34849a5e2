//! Selection among few and many lights, against its own probabilities and against irradiance.
use glam::{DMat3, DVec3};

use super::{FEW, Item, Selection, Sky, outstanding};
use crate::chi_squared::chi_squared;
use crate::{
    geometry::{MISS, Motion, Outline, PrimitiveRef, Shape, Shapes},
    light::{
        Emission, Emitters, LightCoordinates, Lobe, PunctualLight, PunctualLights, ReferencePoint, Side,
        punctual_light::{MOST_DIRECTIONAL, Picture, spot::Falloff},
    },
    sampling::hash::hash_one,
};
use noisefall_base::math::{F, Lanes, M, One, Pick, SimdLevel, U, V};

struct Random(u32);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        (f64::from(hash_one(self.0) >> 9) + 0.5) / f64::from(1 << 23)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn direction(&mut self) -> DVec3 {
        let (z, turn) = (self.between(-1.0, 1.0), self.next() * std::f64::consts::TAU);
        DVec3::new(turn.cos() * (1.0 - z * z).sqrt(), turn.sin() * (1.0 - z * z).sqrt(), z)
    }

    fn point(&mut self, extent: f64) -> DVec3 {
        DVec3::new(self.between(-extent, extent), self.between(-extent, extent), self.between(-extent, extent))
    }
}

static STILL: Motion = Motion(Vec::new());

struct Set {
    name: &'static str,
    shapes: Vec<Shape>,
    emissions: Vec<Emission>,
    punctual_lights: Vec<PunctualLight>,
    sky: Sky,
}

impl Set {
    fn new(name: &'static str, lights: impl IntoIterator<Item = (Shape, f32, Side)>) -> Set {
        let emission = |light, side| Emission { radiance: [light; 3], mean: [light; 3], texture: None, side, translucent: false };
        let (shapes, emissions) = lights.into_iter().map(|(shape, light, side)| (shape, emission(light, side))).unzip();
        Set { name, shapes, emissions, punctual_lights: Vec::new(), sky: Sky::default() }
    }

    fn selection(&self) -> Selection {
        let still = |(shape, emission): (&Shape, &Emission)| (shape.clone(), Motion::default(), *emission);
        let lights: Vec<_> = self.shapes.iter().zip(&self.emissions).map(still).collect();
        Selection::new(&lights, &self.punctual_lights, self.sky, DVec3::ZERO)
    }

    /// Number of lights without the environment.
    fn count(&self) -> usize {
        self.shapes.len() + self.punctual_lights.len()
    }

    /// Probabilities of all lights, and last of the environment.
    fn pmf(&self, selection: &Selection, at: &ReferencePoint<One>) -> Vec<f64> {
        let lights = (0..self.count() as u32).map(|light| selection.probability(One, at, M(true), U(light)));
        lights.chain([selection.probability(One, at, M(false), U(MISS))]).map(|pmf| f64::from(pmf.0)).collect()
    }
}

fn ball(center: DVec3, radius: f64) -> Shape {
    Shape::sphere(center, radius)
}

/// Any shape, of about the given size.
fn any_shape(random: &mut Random, size: f64) -> Shape {
    let center = random.point(3.0);
    let axes = DMat3::from_cols(random.direction(), random.direction(), random.direction()) * size;
    let flat =
        |outline| Shape::Flat { outline, origin: center, edges: [axes.x_axis, axes.y_axis], mirrored: axes.determinant() < 0.0 };
    match (random.next() * 6.0) as u32 {
        0 => ball(center, size),
        1 => Shape::Ellipsoid { center, axes },
        2 => Shape::cylinder(center, center + axes.x_axis, size * 0.3, false),
        3 => flat(Outline::Triangle),
        4 => flat(Outline::Ellipse),
        _ => flat(Outline::Parallelogram),
    }
}

fn any_side(random: &mut Random) -> Side {
    [Side::Front, Side::Back, Side::Both][(random.next() * 3.0) as usize]
}

const MANY: usize = 300;

fn sets() -> Vec<Set> {
    let r = &mut Random(0);
    let front = Side::Front;
    let few: Vec<_> = (0..FEW).map(|_| (any_shape(r, 0.2), 1.0, any_side(r))).collect();
    let mut all = vec![Set::new("few", few)];
    let lights: Vec<_> = (0..3 * MANY)
        .map(|_| {
            let size = 10f64.powf(r.between(-3.0, 0.0));
            (any_shape(r, size), 10f64.powf(r.between(-4.0, 4.0)) as f32, any_side(r))
        })
        .collect();
    all.push(Set { sky: Sky { luminance: 0.3, is_even: false }, ..Set::new("of all kinds", lights) });
    let punctual_light = |_| (Shape::disk(r.point(3.0).with_y(2.0), -DVec3::Y, 0.05), 1.0, front);
    all.push(Set::new("a ceiling of lights", (0..MANY).map(punctual_light)));
    all.push(Set::new("identical", (0..MANY).map(|_| (ball(DVec3::X, 0.1), 1.0, front))));
    let turned = |_| (Shape::disk(DVec3::Y, r.direction(), 0.1), 1.0, any_side(r));
    all.push(Set::new("in one place", (0..MANY).map(turned)));
    all.push(Set::new("collinear", (0..MANY).map(|i| (ball(DVec3::X * (i as f64 * 0.1), 0.02), 1.0, front))));
    // Each ten times as far as the one before, and many near each.
    let spread = (0..MANY).map(|i| (ball(DVec3::X * 10f64.powi(i as i32 % 12 - 6) * (1.0 + i as f64 * 1e-3), 1e-8), 1.0, front));
    all.push(Set::new("further and further", spread));
    let mut lights: Vec<_> = (0..1000).map(|_| (ball(r.point(2.0), 1e-5), 1e6, front)).collect();
    lights.insert(500, (ball(DVec3::Y * -1e6, 1e6 - 3.0), 0.1, front));
    lights.push((ball(DVec3::ZERO, 1e3), 0.01, Side::Back));
    all.push(Set::new("two enormous, a thousand tiny", lights));
    all.push(with_punctual(r, "a few lights", [5, 20, 4]));
    all.push(with_punctual(r, "many lights", [100, 200, MOST_DIRECTIONAL]));
    all.push(Set::new("shells", (0..MANY).map(|_| (ball(r.point(3.0), 0.5), 1.0, any_side(r)))));
    all
}

/// Surfaces, lights with a position, and directional lights.
fn with_punctual(r: &mut Random, name: &'static str, [surfaces, positions, directions]: [usize; 3]) -> Set {
    let shapes: Vec<_> = (0..surfaces).map(|_| (any_shape(r, 0.1), 1.0, any_side(r))).collect();
    let mut punctual_lights: Vec<PunctualLight> = (0..positions).map(|_| any_light(r)).collect();
    punctual_lights.extend((0..directions).map(|_| PunctualLight::directional(r.direction(), [r.next(); 3])));
    Set { sky: Sky { luminance: 0.01, is_even: true }, punctual_lights, ..Set::new(name, shapes) }
}

/// A light with a position, of any kind.
fn any_light(r: &mut Random) -> PunctualLight {
    let (position, intensity, axis) = (r.point(3.0), [10f64.powf(r.between(-3.0, 0.0)); 3], r.direction());
    match (r.next() * 3.0) as u32 {
        0 => PunctualLight::point(position, intensity),
        1 => {
            let edge = r.between(0.1, 3.1);
            let falloff = Falloff::ALL[(r.next() * 3.0) as usize];
            PunctualLight::spot(position, intensity, axis, [edge * r.next(), edge], falloff)
        }
        _ => {
            let right = axis.any_orthonormal_vector();
            let axes = [right, right.cross(axis) * 2.0, axis];
            PunctualLight::projector(position, [1.0; 3], Picture { axes, flat: false, image: None, cone: None })
        }
    }
}

fn vector(v: DVec3) -> V<One> {
    let [x, y, z] = v.as_vec3().to_array().map(F);
    V { x, y, z }
}

/// A point among the lights, close to one of them, inside one, or far away.
fn reference_point(random: &mut Random, set: &Set) -> ReferencePoint<One> {
    let light = &set.shapes[(random.next() * set.shapes.len() as f64) as usize];
    let (center, radius) = light.bounding_sphere();
    let p = match (random.next() * 5.0) as u32 {
        0 | 1 => random.point(4.0),
        2 => center + random.direction() * radius * random.between(0.9, 1.5),
        3 => center + random.direction() * radius * random.next(),
        _ => random.direction() * 10f64.powf(random.between(1.0, 7.0)),
    };
    let alpha = if random.next() < 0.4 { 0.0 } else { random.between(1e-3, 1.0) };
    let lobe = Some(Lobe { wo: vector(random.direction()), alpha: F(alpha as f32) });
    ReferencePoint { p: vector(p), n: vector(random.direction()), transmits: M(random.next() < 0.3), lobe }
}

fn coordinates(random: &mut Random) -> LightCoordinates<One> {
    let [choice, a, b] = [0; 3].map(|_| F(random.next() as f32));
    LightCoordinates { choice, cell: (a, b), place: (a, b), sky: (a, b) }
}

#[test]
fn probabilities_sum_to_one() {
    let random = &mut Random(1 << 20);
    let mut lit = 0;
    for set in sets() {
        let selection = set.selection();
        for _ in 0..100 {
            let at = reference_point(random, &set);
            let pmf = set.pmf(&selection, &at);
            let sum: f64 = pmf.iter().sum();
            // Where it is seen at once that no light contributes, none is chosen.
            assert!(sum == 0.0 || (sum - 1.0).abs() < 1e-4, "{}: {sum}", set.name);
            lit += u32::from(sum > 0.0);
        }
    }
    assert!(lit > 600, "{lit}");
}

#[test]
fn a_choice_has_its_probability_at_every_level() {
    let random = &mut Random(2 << 20);
    for set in sets() {
        let selection = set.selection();
        for _ in 0..20 {
            let cases: Vec<_> = (0..16).map(|_| (reference_point(random, &set), coordinates(random))).collect();
            let one: Vec<_> = cases.iter().map(|(at, u)| selection.choose(One, at, u)).collect();
            for level in SimdLevel::available() {
                noisefall_base::math::in_lanes!(level, l => all_same(l, &selection, &cases, &one));
            }
        }
    }
}

type Case = (ReferencePoint<One>, LightCoordinates<One>);

fn lobe(case: &Case) -> Lobe<One> {
    case.0.lobe.expect("every reference_point has one")
}

fn all_same<L: Lanes>(l: L, selection: &Selection, cases: &[Case], one: &[(U<One>, F<One>)]) {
    for (cases, one) in cases.chunks(L::N).zip(one.chunks(L::N)) {
        let real = |get: &dyn Fn(&Case) -> f32| l.load(&cases.iter().map(get).collect::<Vec<_>>());
        let at = ReferencePoint {
            p: V { x: real(&|c| c.0.p.x.0), y: real(&|c| c.0.p.y.0), z: real(&|c| c.0.p.z.0) },
            n: V { x: real(&|c| c.0.n.x.0), y: real(&|c| c.0.n.y.0), z: real(&|c| c.0.n.z.0) },
            transmits: real(&|c| f32::from(u8::from(c.0.transmits.0))).above(0.5),
            lobe: Some(Lobe {
                wo: V { x: real(&|c| lobe(c).wo.x.0), y: real(&|c| lobe(c).wo.y.0), z: real(&|c| lobe(c).wo.z.0) },
                alpha: real(&|c| lobe(c).alpha.0),
            }),
        };
        let place = (real(&|c| c.1.place.0.0), real(&|c| c.1.place.1.0));
        let (target, pmf) =
            selection.choose(l, &at, &LightCoordinates { choice: real(&|c| c.1.choice.0), cell: place, place, sky: place });
        let again = selection.probability(l, &at, !target.is(MISS), target);
        for (lane, (target_of_one, pmf_of_one)) in one.iter().enumerate() {
            assert_eq!(target.to_array()[lane], target_of_one.0);
            assert_eq!(pmf.to_array()[lane].to_bits(), pmf_of_one.0.to_bits());
            assert_eq!(again.to_array()[lane].to_bits(), pmf_of_one.0.to_bits());
        }
    }
}

#[test]
fn choices_are_as_frequent_as_their_probability() {
    const CHOICES: usize = 60_000;
    let random = &mut Random(3 << 20);
    let mut tests = 0;
    for set in sets() {
        let selection = set.selection();
        for _ in 0..2 {
            let at = reference_point(random, &set);
            let pmf = set.pmf(&selection, &at);
            let mut counts = vec![0.0; pmf.len()];
            for _ in 0..CHOICES {
                let (target, _) = selection.choose(One, &at, &coordinates(random));
                counts[(target.0 as usize).min(set.count())] += 1.0;
            }
            let expected: Vec<f64> = pmf.iter().map(|pmf| pmf * CHOICES as f64).collect();
            let p = chi_squared(&counts, &expected);
            assert!(p > 1e-4 / 20.0, "{}: p = {p}", set.name);
            tests += u32::from(p < 1.0);
        }
    }
    assert!(tests > 12);
}

#[test]
fn every_light_that_can_contribute_can_be_chosen() {
    let random = &mut Random(4 << 20);
    let mut contributions = 0;
    for set in sets() {
        let selection = set.selection();
        let (shapes, emitters) =
            (Shapes::new(set.shapes.iter().map(|shape| (shape, &STILL)), DVec3::ZERO), Emitters::new(&set.emissions));
        for _ in 0..20_000 {
            let at = reference_point(random, &set);
            let light = U((random.next() * set.shapes.len() as f64) as u32);
            let place = PrimitiveRef::of(One, light);
            let toward = shapes.toward(One, &place, at.p, (F(random.next() as f32), F(random.next() as f32)));
            let (_, lit) = emitters.radiance(One, M(true), light, toward.front.pick(F(1.0), F(-1.0)));
            let visible = at.transmits.0 || toward.wi.dot(at.n).0 > 0.0;
            if lit.0 && visible && toward.pdf.0 > 0.0 {
                let pmf = selection.probability(One, &at, M(true), light).0;
                assert!(pmf > 0.0, "{}: light {} from {:?}", set.name, light.0, at.p.lane(0));
                contributions += 1;
            }
        }
    }
    assert!(contributions > 40_000, "{contributions}");
}

#[test]
fn a_light_that_shines_on_a_point_can_be_chosen() {
    let random = &mut Random(5 << 20);
    let mut contributions = 0;
    for set in sets().iter().filter(|set| !set.punctual_lights.is_empty()) {
        let (selection, punctual_lights) = (set.selection(), PunctualLights::new(&set.punctual_lights));
        for _ in 0..10_000 {
            let at = reference_point(random, set);
            let punctual_light = (random.next() * set.punctual_lights.len() as f64) as u32;
            let light = punctual_lights.sample(One, U(punctual_light), at.p);
            let visible = at.transmits.0 || light.wi.dot(at.n).0 > 0.0;
            if visible && light.irradiance.max_component().0 > 0.0 {
                let pmf = selection.probability(One, &at, M(true), U(set.shapes.len() as u32 + punctual_light)).0;
                assert!(pmf > 0.0, "{}: light {punctual_light} from {:?}", set.name, at.p.lane(0));
                contributions += 1;
            }
        }
    }
    assert!(contributions > 3000, "{contributions}");
}

#[test]
fn lights_that_all_others_could_hide_behind_stay_outside_of_the_tree() {
    let mut random = Random(3);
    let item = |random: &mut Random, light: u32, radius: f32| {
        let center = random.point(1.0).as_vec3();
        Item { center, radius, power: 1.0, axis: glam::Vec3::ZERO, two_sided: false, light }
    };
    let mut items: Vec<Item> = (0..100).map(|light| item(&mut random, light, 0.01)).collect();
    assert_eq!(outstanding(&mut items.clone()), 0);
    items[7].radius = 1.5;
    items[40].radius = 30.0;
    assert_eq!(outstanding(&mut items), 2);
    assert_eq!([items[98].light, items[99].light], [7, 40]);
}
