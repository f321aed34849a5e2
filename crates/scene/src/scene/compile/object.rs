//! Objects of a description.
use super::{light::emission, material::Numbers, problems::Problems};
use crate::{
    geometry::{Motion, Shape},
    scene::{Object, description::ObjectDescription},
    shape::{ShapeBuilder, motion, product},
    texture::TextureCompiler,
};
use noisefall_base::{
    declare::{Family, Path, Problem, Resources, short},
    quote,
};

/// Shapes that are smaller, larger or farther away cannot be distinguished from nothing in f32.
const LARGEST: f64 = 1e12;
const SMALLEST: f64 = 1e-12;

/// The objects that are described, emitting ones first. A shape that is many makes an object each.
pub fn objects(
    described: &[ObjectDescription],
    materials: &Numbers,
    textures: &TextureCompiler,
    resources: &Resources,
    problems: &mut Problems,
) -> Vec<Object> {
    let mut shapes = ShapeBuilder::new(resources);
    let mut objects: Vec<Object> = Vec::new();
    for (place, object) in described.iter().enumerate() {
        if problems.are_many() {
            break;
        }
        objects.extend(these(object, place as u32, materials, textures, &mut shapes, problems));
    }
    // A stable sort: emitting primitives first, as the table of emitters wants it.
    objects.sort_by_key(|object| object.emission.is_none());
    objects
}

/// The object, or, of a shape that is many, one each; none where something is wrong.
fn these(
    o: &ObjectDescription,
    described: u32,
    materials: &Numbers,
    textures: &TextureCompiler,
    builder: &mut ShapeBuilder,
    problems: &mut Problems,
) -> Vec<Object> {
    let at = &Path::of("objects").item(described as usize);
    let shapes = problems.keep(at, || placed(o, builder));
    let material = o.material.as_ref().map(|name| {
        let unknown = || Problem::not_defined("", Family::Material, name, materials.keys());
        problems.keep(&at.key("material"), || materials.get(name).copied().ok_or_else(unknown)).flatten()
    });
    let motion = shapes.as_deref().and_then(|shapes| problems.keep(at, || moved(o, shapes)));
    let emission =
        o.emission.as_ref().map(|described| problems.keep(&at.key("emission"), || emission(described, o.flip, textures)));
    // The problem has been reported, so nothing will be rendered.
    let (Some(shapes), Some(motion)) = (shapes, motion) else { return Vec::new() };
    let many = shapes.len() > 1;
    let name = |number: usize| if many { format!("{} {}", quote::piece(&o.name), number + 1) } else { quote::piece(&o.name) };
    let object = |(number, shape): (usize, Shape)| Object {
        described,
        name: if o.name.is_empty() { String::new() } else { name(number) },
        shape,
        motion: motion.clone(),
        flip: o.flip,
        material: material.flatten(),
        emission: emission.flatten(),
    };
    shapes.into_iter().enumerate().map(object).collect()
}

/// The shapes where the transforms put them, and what carries them.
pub fn placed_and_moved(o: &ObjectDescription, builder: &mut ShapeBuilder) -> Result<(Vec<Shape>, Motion), Problem> {
    let shapes = placed(o, builder)?;
    let motion = moved(o, &shapes)?;
    Ok((shapes, motion))
}

/// The shapes where the transforms put them.
fn placed(o: &ObjectDescription, builder: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
    let map = product(&o.transform).map_err(|problem| problem.within(&Path::of("transform")))?;
    let built = builder.build(&o.shape).map_err(|problem| problem.within(&Path::of("shape")))?;
    let shapes: Vec<Shape> = built.iter().map(|shape| shape.transformed(&map)).collect();
    shapes.iter().try_for_each(extent)?;
    Ok(shapes)
}

/// Shapes after their transforms: neither too small nor too large or far away.
fn extent(shape: &Shape) -> Result<(), Problem> {
    let (center, radius) = shape.bounding_sphere();
    if center.abs().max_element() <= LARGEST && (SMALLEST..=LARGEST).contains(&radius) {
        return Ok(());
    }
    let [x, y, z] = center.to_array().map(short);
    let message = format!("after its transforms the {} has a radius of {} m around {x}, {y}, {z}", shape.name(), short(radius));
    Err(Problem::at("shape", message, format!("expected {SMALLEST:e} to {LARGEST:e} m")))
}

/// The motion of the shapes from time 0 to 1.
fn moved(o: &ObjectDescription, shapes: &[Shape]) -> Result<Motion, Problem> {
    let motion = motion(&o.motion).map_err(|problem| problem.within(&Path::of("motion")))?;
    if let Some(last) = o.motion.len().checked_sub(1) {
        let reach = shapes.iter().map(|shape| shape.reach(&motion)).fold(0.0, f64::max);
        if reach > 4.0 * LARGEST || reach.is_nan() {
            let message = format!("its motion takes it {reach:e} m away from the origin");
            return Err(Problem::at(&format!("motion.{last}"), message, format!("expected at most {LARGEST:e} m")));
        }
    }
    Ok(motion)
}
