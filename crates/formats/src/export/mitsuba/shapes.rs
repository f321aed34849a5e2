//! Shapes, and the light that they emit.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::{
    super::{
        ExportError,
        geometry::{fineness, model_of, triangles},
        notes,
    },
    context::Export,
    markup::{Element, FILE},
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    geometry::{MeshData, Outline, Shape},
    model::{Model, encode_ply},
    scene::description::{EmissionDescription, ObjectDescription},
};

/// Relative error of lengths and angles that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// Adds the shapes of an object.
pub fn object(export: &mut Export, number: usize, object: &ObjectDescription, shapes: &[Shape]) -> Result<(), ExportError> {
    let (made, _) = export.at(notes::element("object", number, &object.name), |export| {
        if !object.motion.is_empty() {
            export.remark("`motion`", "the place at time 0", "the object is sharp");
        }
        shapes.iter().try_for_each(|shape| add(export, object, shape))
    });
    made
}

fn add(export: &mut Export, object: &ObjectDescription, shape: &Shape) -> Result<(), ExportError> {
    let description = export.description;
    let mut inner = vec![export.surface(object.material.as_deref())];
    let opacity = object.material.as_ref().and_then(|name| description.materials.get(name)?.opacity.as_ref());
    if let Some(emission) = &object.emission {
        if opacity.is_some_and(|opacity| *opacity != Textured::Constant(1.0)) {
            export.remark("emission of a surface with `opacity`", "all of its light", "holes in the surface shine too");
        }
        inner.push(export.emission(emission));
    }
    // Each shape of an object depends on its own textures alone.
    let uses_coordinates = std::mem::take(&mut export.uses_coordinates);
    for geometry in export.geometry(shape, &object.name, uses_coordinates)? {
        let id = export.id(&object.name, "object");
        let flips = object.flip ^ geometry.flip;
        let element = if flips { geometry.element.flag("flip_normals", true) } else { geometry.element };
        export.scene.push(element.attribute("id", id).with_all(inner.iter().cloned()));
    }
    Ok(())
}

/// A shape of Mitsuba.
struct Geometry {
    element: Element,
    /// Whether its front is the back of ours.
    flip: bool,
}

impl Geometry {
    fn new(element: Element) -> Geometry {
        Geometry { element, flip: false }
    }
}

impl Export<'_> {
    fn emission(&mut self, emission: &EmissionDescription) -> Element {
        if emission.two_sided {
            self.remark("`two_sided` emission", "the front alone", "the back is dark");
        }
        let scale = emission.scale;
        let radiance = match self.colors.radiance(&emission.source, &mut self.notes) {
            Textured::Constant(radiance) => Element::color("radiance", radiance.map(|x| x * scale)),
            Textured::Texture(name) if scale != 1.0 => self.scaled(&name, scale),
            texture => self.color("radiance", &texture),
        };
        Element::plugin("emitter", "area").with(radiance)
    }

    /// A texture of radiance times a factor.
    fn scaled(&mut self, name: &str, scale: f64) -> Element {
        let found = format!("the texture `{name}` times `scale`");
        let image = if self.colors.is_flat(name) { self.baked(name, &found, |color| color.map(|x| x * scale)) } else { None };
        image.map_or_else(
            || {
                self.remark(found, "its mean", "the light has one colour");
                let mean = self.colors.mean(&Textured::Texture(name.to_owned()));
                Element::color("radiance", mean.map(|x| x * scale))
            },
            |image| image.attribute("name", "radiance"),
        )
    }

    /// The shapes of Mitsuba for a shape of ours; several for a closed cylinder.
    fn geometry(&mut self, shape: &Shape, name: &str, uses_coordinates: bool) -> Result<Vec<Geometry>, ExportError> {
        Ok(match shape {
            Shape::Sphere { center, radius, turn } => {
                vec![sphere(*center, *radius, uses_coordinates.then(|| turn.unwrap_or(DMat3::IDENTITY)))]
            }
            Shape::Flat { outline: Outline::Parallelogram, origin, edges, mirrored } => {
                vec![rectangle(*origin, *edges, *mirrored, uses_coordinates)]
            }
            Shape::Flat { outline: Outline::Ellipse, origin, edges, mirrored } if !uses_coordinates => {
                vec![disk(*origin, *edges, *mirrored)]
            }
            Shape::Cuboid { origin, edges } if !uses_coordinates => vec![cube(*origin, edges)],
            Shape::Cylinder { base, axes, .. } if is_round(axes) && !uses_coordinates => shape
                .pieces()
                .iter()
                .map(|piece| match piece {
                    Shape::Flat { origin, edges, mirrored, .. } => disk(*origin, *edges, *mirrored),
                    _ => cylinder(*base, axes),
                })
                .collect(),
            Shape::Mesh { data, map, .. } => vec![self.mesh(data, map, name)?],
            Shape::Isosurface { .. } => {
                self.remark("an isosurface", "nothing", "it is missing");
                Vec::new()
            }
            curved => self.tessellated(curved, name)?.into_iter().collect(),
        })
    }

    /// Triangles that stand for a shape.
    fn tessellated(&mut self, shape: &Shape, name: &str) -> Result<Option<Geometry>, ExportError> {
        let fineness = fineness(shape);
        let is_curved = fineness.is_some();
        if let Some(used) = fineness {
            let what = if matches!(shape, Shape::Ellipsoid { .. }) { "" } else { " with coordinates, or stretched" };
            self.remark(format!("a shape `{}`{what}", shape.name()), used, "its outline is a polygon");
        }
        let origin = center(shape);
        let Some(model) = triangles(shape, origin) else { return Ok(None) };
        let path = self.add_model(name, model)?;
        let element = ply(&path, !is_curved).transform("to_world", &DAffine3::from_translation(origin));
        Ok(Some(Geometry::new(element)))
    }

    fn mesh(&mut self, data: &Arc<MeshData>, map: &DAffine3, name: &str) -> Result<Geometry, ExportError> {
        let key = Arc::as_ptr(data) as usize;
        let path = match self.meshes.get(&key) {
            Some(path) => path.clone(),
            None => {
                let path = self.add_model(name, model_of(data))?;
                self.meshes.insert(key, path.clone());
                path
            }
        };
        let is_flat = data.normals.is_empty();
        // Our front stays the front under a mirror. Mitsuba's normals of triangles turn round.
        let flip = is_flat && map.matrix3.determinant() < 0.0;
        Ok(Geometry { element: ply(&path, is_flat).transform("to_world", map), flip })
    }

    /// Adds the file of a mesh. Mitsuba knows colours of vertices by other names.
    fn add_model(&mut self, name: &str, model: Model) -> Result<String, ExportError> {
        if model.colours.is_none() {
            return Ok(self.new.add("meshes", name, "ply", model));
        }
        let mut bytes = encode_ply(&model)?;
        const END: &[u8] = b"end_header\n";
        let end = bytes.windows(END.len()).position(|window| window == END).unwrap_or(0);
        let mut header = String::from_utf8_lossy(&bytes[..end]).into_owned();
        for (ours, theirs) in [("float red\n", "float r\n"), ("float green\n", "float g\n"), ("float blue\n", "float b\n")] {
            header = header.replace(ours, theirs);
        }
        bytes.splice(..end, header.into_bytes());
        Ok(self.new.add("meshes", name, "ply", bytes))
    }
}

fn ply(path: &str, face_normals: bool) -> Element {
    let element = Element::plugin("shape", "ply").text(FILE, path).flag("flip_tex_coords", true);
    if face_normals { element.flag("face_normals", true) } else { element }
}

/// Mitsuba's coordinates turn about z, and ours about y, or as `coordinates` turns them.
fn sphere(center: DVec3, radius: f64, coordinates: Option<DMat3>) -> Geometry {
    let element = Element::plugin("shape", "sphere");
    let Some(turn) = coordinates else {
        return Geometry::new(element.point("center", center).float("radius", radius));
    };
    let turned = turn * DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
    Geometry::new(element.transform("to_world", &DAffine3 { matrix3: turned * radius, translation: center }))
}

/// Mitsuba's square reaches from −1 to 1 with its front at +z. Its v runs against our second edge, which matters with textures alone.
fn rectangle(origin: DVec3, [u, v]: [DVec3; 2], mirrored: bool, uses_coordinates: bool) -> Geometry {
    let upwards = if uses_coordinates { -0.5 } else { 0.5 };
    let map = DMat3::from_cols(u / 2.0, v * upwards, front([u, v], mirrored));
    let translation = origin + (u + v) / 2.0;
    Geometry::new(Element::plugin("shape", "rectangle").transform("to_world", &DAffine3 { matrix3: map, translation }))
}

fn disk(center: DVec3, [a, b]: [DVec3; 2], mirrored: bool) -> Geometry {
    let map = DAffine3 { matrix3: DMat3::from_cols(a, b, front([a, b], mirrored)), translation: center };
    Geometry::new(Element::plugin("shape", "disk").transform("to_world", &map))
}

/// The unit normal of the front.
fn front([a, b]: [DVec3; 2], mirrored: bool) -> DVec3 {
    a.cross(b).normalize() * if mirrored { -1.0 } else { 1.0 }
}

fn cube(origin: DVec3, edges: &DMat3) -> Geometry {
    let map = DAffine3 { matrix3: *edges * 0.5, translation: origin + *edges * DVec3::splat(0.5) };
    Geometry { element: Element::plugin("shape", "cube").transform("to_world", &map), flip: false }
}

fn cylinder(base: DVec3, axes: &DMat3) -> Geometry {
    let element = Element::plugin("shape", "cylinder").point("p0", base).point("p1", base + axes.z_axis);
    Geometry::new(element.float("radius", axes.x_axis.length()))
}

/// Whether a cylinder is upright and circular.
fn is_round(axes: &DMat3) -> bool {
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis];
    let is_perpendicular = |a: DVec3, b: DVec3| a.dot(b).abs() <= ROUNDING * a.length() * b.length();
    let same_length = (x.length() - y.length()).abs() <= ROUNDING * x.length();
    same_length && is_perpendicular(x, y) && is_perpendicular(x, z) && is_perpendicular(y, z)
}

/// A point in the middle of a shape.
fn center(shape: &Shape) -> DVec3 {
    shape.bounding_sphere().0
}
