//! Adds shapes and lights where the pointer is.
use super::{
    Document, Edit, put,
    references::{nameless_file, references},
    tree::Tree,
};
use noisefall_base::declare::{Family, OneOf, OwnedValue, Path};
use noisefall_scene::{
    light::punctual_light::PunctualLightKind,
    material::{Lambertian, Material},
    scene::description::{EmissionDescription, MaterialDescription, ObjectDescription, PunctualLightDescription},
    shape::{Placement, ShapeKind},
    texture::{TextureKind, noise::Noise},
};

/// The radiance of new lights, W·sr⁻¹·m⁻², for an image of exposure 0.
const RADIANCE: f64 = 20.0;
/// The irradiance of those without surface below them, W/m²: white surfaces are white there and not beyond.
const IRRADIANCE: f64 = 4.0;

/// Scales a brightness for exposure 0 to an image of this exposure, and rounds it to two digits.
fn brightness(brightness: f64, exposure: f64) -> f64 {
    let wanted = brightness * (-exposure).exp2();
    format!("{wanted:.1e}").parse().unwrap_or(wanted)
}

impl Document {
    /// The edit that adds a shape of a kind, and the path of the new object. It rests on the surface, has the material `material`, or
    /// else the first diffuse one of the scene, and a name that is free. `None` if there is no such kind.
    pub fn add_shape(&self, kind: &str, placement: &Placement, material: Option<&str>) -> Option<(Edit, Path)> {
        let (name, new_material) = self.diffuse_material(material);
        let object = ObjectDescription { material: Some(name), ..ObjectDescription::default() };
        let (add, path) = self.add(kind, placement, object)?;
        Some((with_material(new_material, add), path))
    }

    /// The material `wanted`, or else the first diffuse one of the scene, or else a new grey one with the edit that adds it.
    pub(super) fn diffuse_material(&self, wanted: Option<&str>) -> (String, Option<Edit>) {
        let diffuse = |(name, material): (&String, &MaterialDescription)| {
            matches!(material.kind, Material::Lambertian(_)).then(|| name.clone())
        };
        let known = wanted.map(str::to_owned).or_else(|| self.description().materials.iter().find_map(diffuse));
        known.map_or_else(
            || {
                let name = self.free_name("materials", "grey");
                let kind = Lambertian { albedo: [0.5; 3].into() }.into();
                let mut grey = MaterialDescription { kind, ..MaterialDescription::default() };
                let insert = Edit::insert_tree(Path::of("materials").key(&name), Tree::of(&mut grey));
                (name, Some(insert))
            },
            |name| (name, None),
        )
    }

    /// The edit that adds a light with the shape of a kind, and the path of the new object. Flat ones emit away from the surface. It is
    /// as bright as an image of this exposure, in stops, needs.
    pub fn add_light(&self, kind: &str, placement: &Placement, exposure: f64) -> Option<(Edit, Path)> {
        let emission = EmissionDescription::radiance([brightness(RADIANCE, exposure); 3]);
        let object = ObjectDescription { name: "light".to_owned(), emission: Some(emission), ..ObjectDescription::default() };
        self.add(kind, placement, object)
    }

    /// The edit that adds a punctual light of a kind at a height over the surface, in metres, and the path of the new light. It is
    /// as bright as an image of this exposure, in stops, needs.
    pub fn add_punctual_light(&self, kind: &str, placement: &Placement, height: f64, exposure: f64) -> Option<(Edit, Path)> {
        let kind = PunctualLightKind::alternatives().into_iter().find(|punctual_light| punctual_light.name() == kind)?;
        let (position, target) = (placement.reached(height), placement.rounded(placement.at));
        let name = self.free_name("lights", &kind.name().replace('_', " "));
        let kind = kind.kind().placed(position, target, brightness(IRRADIANCE, exposure));
        let mut punctual_light = PunctualLightDescription { name, kind, ..PunctualLightDescription::default() };
        let path = Path::of("lights").item(self.description().punctual_lights.len());
        Some((Edit::insert_tree(path.clone(), Tree::of(&mut punctual_light)), path))
    }

    /// The edit that adds an absent part with its defaults. A texture that it needs is the first of the scene, or else a new one.
    pub fn insert(&self, path: &Path) -> Edit {
        let mut scene = self.description().clone();
        if !put::insert(&mut scene, path, None) {
            return Edit::insert(path.clone());
        }
        let mut needed = Vec::new();
        references(&mut scene, path, |at, family, name| {
            needed.extend((family == Family::Texture && name.is_empty()).then(|| at.clone()));
        });
        let first = self.description().textures.keys().next().cloned();
        let name = first.clone().unwrap_or_else(|| self.free_name("textures", "noise"));
        let new_texture = (first.is_none() && !needed.is_empty()).then(|| {
            let mut noise = TextureKind::from(Noise::default());
            Edit::insert_tree(Path::of("textures").key(&name), Tree::of(&mut noise))
        });
        let set = |at: Path| Edit::set(at, OwnedValue::Text(name.clone()));
        let mut edits: Vec<Edit> = new_texture.into_iter().chain([Edit::insert(path.clone())]).collect();
        edits.extend(needed.into_iter().map(set));
        if edits.len() == 1 { edits.swap_remove(0) } else { Edit::All(edits) }
    }

    /// The path of a file that must be chosen for an edit of the part at a path to make sense: it would leave the file without a name.
    pub fn missing_file(&self, edit: &Edit, path: &Path) -> Option<Path> {
        let mut after = self.clone();
        let is_new = nameless_file(&mut self.description().clone(), path).is_none();
        after.apply(edit).ok()?;
        nameless_file(&mut after.description().clone(), path).filter(|_| is_new)
    }

    fn add(&self, kind: &str, placement: &Placement, object: ObjectDescription) -> Option<(Edit, Path)> {
        let shape = ShapeKind::alternatives().into_iter().find(|shape| shape.name() == kind)?;
        let wanted = if object.name.is_empty() { kind.replace('_', " ") } else { object.name.clone() };
        let (shape, transform) = match shape.kind().placed(placement) {
            Some(placed) => (placed, Vec::new()),
            None => (shape, placement.transforms()),
        };
        let mut object = ObjectDescription { name: self.free_name("objects", &wanted), shape, transform, ..object };
        let path = Path::of("objects").item(self.description().objects.len());
        Some((Edit::insert_tree(path.clone(), Tree::of(&mut object)), path))
    }
}

/// Adds an object after its material, if that is new.
pub fn with_material(new_material: Option<Edit>, add: Edit) -> Edit {
    match new_material {
        Some(insert) => Edit::All(vec![insert, add]),
        None => add,
    }
}
