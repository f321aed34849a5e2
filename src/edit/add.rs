//! Adds shapes and lamps where the pointer is.
use glam::DVec3;

use super::{Document, Edit, tree::Tree};
use crate::{
    declare::{OneOf, Path},
    material::{Lambertian, Material},
    scene::description::{EmissionDescription, MaterialDescription, ObjectDescription},
    shape::{ShapeKind, Transform},
};

/// Size of the scene relative to that of a new object.
const PART_OF_SCENE: f64 = 8.0;
/// The radiance of new lamps, W/(m² sr): about that of white paper on an overcast day.
const RADIANCE: f64 = 20.0;
/// Smallest y of the unit normal of a floor. On steeper surfaces new objects stand along the normal.
const STEEPEST_FLOOR: f64 = 0.7;

/// The point where an object is added.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// The point on a surface, metres.
    pub at: DVec3,
    /// The direction that the surface faces there.
    pub normal: DVec3,
    /// The extent of the scene, as [`Scene::size`](crate::scene::Scene::size) tells it.
    pub scene_size: f64,
}

impl Placement {
    /// The size of the new object: 1, 2 or 5 times a power of ten, metres.
    fn size(&self) -> f64 {
        let wanted = self.scene_size / PART_OF_SCENE;
        if !(wanted.is_finite() && wanted > 0.0) {
            return 1.0;
        }
        let exponent = wanted.log10().floor() as i32;
        let digit = [5, 2, 1].into_iter().find(|digit| f64::from(*digit) <= wanted * 10f64.powi(-exponent)).unwrap_or(1);
        // Read as it is written, so that it is as short as it can be.
        format!("{digit}e{exponent}").parse().unwrap_or(wanted)
    }

    /// The number of decimals that resolves a thousandth of the size.
    fn decimals(&self) -> usize {
        (3.0 - self.size().log10().floor()).max(0.0) as usize
    }

    /// The point, rounded to short coordinates.
    fn rounded(&self, p: DVec3) -> DVec3 {
        let decimals = self.decimals();
        // Adding 0 turns −0 into 0.
        p.to_array().map(|x| format!("{x:.decimals$}").parse::<f64>().unwrap_or(x) + 0.0).into()
    }

    /// The direction in which the object stands on the surface: up on floors.
    fn up(&self) -> DVec3 {
        let normal = self.normal.try_normalize().unwrap_or(DVec3::Y);
        if normal.y > STEEPEST_FLOOR { DVec3::Y } else { normal }
    }

    /// Two directions along the surface; their cross product is the direction that it faces.
    fn along(&self) -> [DVec3; 2] {
        let up = self.up();
        let side = if up.y.abs() > STEEPEST_FLOOR { DVec3::Z.cross(up) } else { DVec3::Y.cross(up) };
        let u = side.normalize();
        [u, up.cross(u)]
    }
}

impl Document {
    /// The edit that adds a shape of a kind, and the path of the new object. It rests on the surface, has the material `material`, or
    /// else the first diffuse one of the scene, and a name that is free. `None` if there is no such kind.
    pub fn add_shape(&self, kind: &str, placement: &Placement, material: Option<&str>) -> Option<(Edit, Path)> {
        let diffuse = |(name, material): (&String, &MaterialDescription)| {
            matches!(material.kind, Material::Lambertian(_)).then(|| name.clone())
        };
        let known = material.map(str::to_owned).or_else(|| self.description().materials.iter().find_map(diffuse));
        let name = known.clone().unwrap_or_else(|| self.free_name("materials", "grey"));
        let object = ObjectDescription { material: Some(name.clone()), ..ObjectDescription::default() };
        let (add, path) = self.add(kind, placement, object)?;
        if known.is_some() {
            return Some((add, path));
        }
        let mut grey =
            MaterialDescription { kind: Lambertian { albedo: [0.5; 3].into() }.into(), ..MaterialDescription::default() };
        let with_material = Edit::insert_tree(Path::of("materials").key(&name), Tree::of(&mut grey));
        Some((Edit::All(vec![with_material, add]), path))
    }

    /// The edit that adds a lamp with the shape of a kind, and the path of the new object. Flat ones emit away from the surface.
    pub fn add_lamp(&self, kind: &str, placement: &Placement) -> Option<(Edit, Path)> {
        let emission = EmissionDescription::radiance([RADIANCE; 3]);
        let object = ObjectDescription { name: "lamp".to_owned(), emission: Some(emission), ..ObjectDescription::default() };
        self.add(kind, placement, object)
    }

    fn add(&self, kind: &str, placement: &Placement, object: ObjectDescription) -> Option<(Edit, Path)> {
        let shape = ShapeKind::alternatives().into_iter().find(|shape| shape.name() == kind)?;
        let wanted = if object.name.is_empty() { kind.replace('_', " ") } else { object.name.clone() };
        let (shape, transform) = placed(shape, placement);
        let mut object = ObjectDescription { name: self.free_name("objects", &wanted), shape, transform, ..object };
        let path = Path::of("objects").item(self.description().objects.len());
        Some((Edit::insert_tree(path.clone(), Tree::of(&mut object)), path))
    }
}

/// Moves and scales a default shape to its new place: closed shapes touch the surface, flat ones lie just above it.
fn placed(mut shape: ShapeKind, placement: &Placement) -> (ShapeKind, Vec<Transform>) {
    let (size, up) = (placement.size(), placement.up());
    let half = size / 2.0;
    let reached = |height: f64| placement.rounded(placement.at + up * height);
    // A cube along the axes whose nearest corner, edge or face touches the surface.
    let middle = reached(half * (up.x.abs() + up.y.abs() + up.z.abs()));
    let corners = [placement.rounded(middle - DVec3::splat(half)), placement.rounded(middle + DVec3::splat(half))];
    let above = reached(10f64.powi(-(placement.decimals() as i32)));
    let [u, v] = placement.along().map(|direction| placement.rounded(direction * size));
    let mut transform = Vec::new();
    match &mut shape {
        ShapeKind::Sphere(sphere) => (sphere.center, sphere.radius) = (reached(half), half),
        ShapeKind::Cuboid(cuboid) => [cuboid.0.min, cuboid.0.max] = corners,
        ShapeKind::SphereField(field) => [field.bounds.min, field.bounds.max] = corners,
        ShapeKind::Cylinder(tube) => (tube.base, tube.top, tube.radius) = (reached(0.0), reached(size), half / 2.0),
        ShapeKind::Disk(disk) => (disk.center, disk.normal, disk.radius) = (above, up, half),
        ShapeKind::Rectangle(r) => (r.origin, r.edge_u, r.edge_v) = (placement.rounded(above - (u + v) / 2.0), u, v),
        ShapeKind::Triangle(t) => {
            let corner = placement.rounded(above - (u + v) / 2.0);
            (t.a, t.b, t.c) = (corner, corner + u, placement.rounded(corner + u / 2.0 + v));
        }
        // About as large as the cube from −1 to 1.
        ShapeKind::Mesh(_) | ShapeKind::Isosurface(_) => {
            transform = vec![Transform::Scale(DVec3::splat(half)), Transform::Translate(middle)];
        }
    }
    (shape, transform)
}
