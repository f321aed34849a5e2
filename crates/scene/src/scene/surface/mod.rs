//! Tables of the surfaces of primitives for the kernel, and the shading stages that they need.
mod applied;
mod blends;
mod rows;
#[cfg(test)]
mod tests;
mod word;

pub use self::word::{
    BLENDED, FLIPPED, FRONT, MIRRORED, ON_BOTH_SIDES, ONE_SIDED, SCATTERS_WHERE_BLACK, SELF_LIT, SHADOWED, SHEET, SQUARED,
    STAGE_SHIFT, is_set, material, stage, transmits,
};
use self::{
    applied::AppliedMaterial,
    rows::{SurfaceRow, VaryingRow, constant_and_texture, number_row, octaves_per_metre, texture_bits},
    word::word,
};
use super::{MaterialInstance, Object};
use crate::material::{AlphaSource, Materials, Stage};

/// Surfaces by primitive, and after them the parts of blends. Tables that a scene does not need are empty.
#[derive(Default)]
pub struct Surfaces {
    /// Colour, and the word `material | stage << 16 | flags`.
    pub rows: Vec<[f32; 4]>,
    /// α, textures of colour and of α, and the medium inside. An id is stored plus 1, as bits; 0 is none.
    pub varying: Vec<[f32; 4]>,
    /// Height texture, its scale, and normal texture (ids as above); 1 where tilted normals darken light at grazing angles.
    pub relief: Vec<[f32; 4]>,
    /// Diffuse transmittance and its texture (an id as above). Filled if some material has one.
    pub transmittance: Vec<[f32; 4]>,
    /// Opacity, its texture (an id as above), and 1 for surfaces that are not all opaque or are blends. Filled if there are such
    /// surfaces.
    pub opacity: Vec<[f32; 4]>,
    /// Weight of the second part of a blend or [`BY_SIDE`](super::BY_SIDE), its texture (an id as above), and the rows of both parts as
    /// bits.
    pub blends: Vec<[f32; 4]>,
    /// Extinction of media per metre, in octaves; the first is empty space. Without tinted media the table is empty.
    pub media: Vec<[f32; 4]>,
    /// Whether tilted normals of some surface darken light at grazing angles.
    pub normal_shadowing: bool,
    /// Whether the shading of some surface reads texture coordinates or the tangent.
    pub charted: bool,
    /// Whether the colour or α of some surface is textured.
    pub textured: bool,
    /// The stages that some surface uses.
    pub stages: Vec<Stage>,
    /// Whether some surface is glossy, so that light samples depend on its lobe.
    pub glossy: bool,
    /// Whether all surfaces are diffuse, two-sided, opaque, and of constant colour.
    pub plain: bool,
    /// Tables and constants of the materials.
    pub materials: Materials,
}

/// Materials have 16 bits and media 8. [`Surfaces::check`] rejects more.
const MOST_MATERIALS: usize = 1 << 16;
const MOST_MEDIA: usize = 1 << 8;

impl Surfaces {
    /// The surfaces of all pieces of the objects, in order.
    pub fn new(objects: &[Object], instances: &[MaterialInstance], materials: Materials) -> Surfaces {
        let inside = |instance: &MaterialInstance| instance.compiled.inside.unwrap_or([1.0; 3]);
        let used = used(objects, instances);
        let has_media = used.iter().any(|instance| inside(instance) != [1.0; 3]);
        let columns = Columns::new(objects, instances, &used);
        let mut surfaces = Surfaces { materials, ..Surfaces::default() };
        if has_media {
            surfaces.media.push([0.0; 4]);
            surfaces.media.extend(instances.iter().map(|instance| octaves_per_metre(inside(instance))));
        }
        for object in objects {
            let applied = AppliedMaterial::of_object(object, instances);
            for _ in 0..object.shape.piece_count() {
                surfaces.push(applied.as_ref(), columns);
            }
        }
        blends::add(&mut surfaces, objects, instances, columns);
        surfaces.stages.sort_unstable();
        surfaces.stages.dedup();
        surfaces.glossy = surfaces.stages.iter().any(|stage| stage.is_glossy());
        surfaces.plain = surfaces.are_plain();
        surfaces
    }

    /// Adds the row of a surface, which is black without a material.
    fn push(&mut self, applied: Option<&AppliedMaterial>, columns: Columns) {
        let Some(applied) = applied else {
            self.rows.push([0.0; 4]);
            self.varying.push([0.0; 4]);
            if columns.relief {
                self.relief.push([0.0; 4]);
            }
            if columns.opacity {
                self.opacity.push([1.0, 0.0, 0.0, 0.0]);
            }
            if columns.transmittance {
                self.transmittance.push([0.0; 4]);
            }
            return;
        };
        let AppliedMaterial { number, instance, .. } = *applied;
        let compiled = &instance.compiled;
        let stage = applied.stage(!self.media.is_empty());
        let (colour, colour_texture) = constant_and_texture(compiled.colour);
        let (alpha, alpha_texture, squared) = match compiled.alpha {
            AlphaSource::Constant(alpha) => (alpha, None, false),
            AlphaSource::Texture { id, squared } => (1.0, Some(id), squared),
        };
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let self_lit = stage.transmits() && stage.sees_lights() && applied.emits;
        let flags = flag(applied.flip, FLIPPED)
            | flag(applied.one_sided, ONE_SIDED)
            | flag(squared, SQUARED)
            | flag(self_lit, SELF_LIT)
            | flag(compiled.scatters_where_black, SCATTERS_WHERE_BLACK)
            | flag(compiled.sheet, SHEET);
        let medium = if self.media.is_empty() || compiled.inside.is_none() { 0 } else { number + 1 };
        self.charted |= compiled.charted;
        self.textured |= colour_texture.or(alpha_texture).is_some();
        self.rows.push(SurfaceRow { colour, word: word(number, stage) | flags }.pack());
        self.varying.push(VaryingRow { alpha, colour_texture, alpha_texture, medium }.pack());
        if columns.relief {
            let (heights, height) = applied.bump.map_or((None, 0.0), |(id, height)| (Some(id), height));
            let shadows = applied.normal_shadowing && applied.has_normals();
            self.normal_shadowing |= shadows;
            let of_normals = flag(shadows, SHADOWED)
                | flag(applied.mirrored_normals, MIRRORED)
                | flag(applied.two_sided_relief, ON_BOTH_SIDES);
            self.relief.push([texture_bits(heights), height, texture_bits(applied.normal_map), f32::from_bits(of_normals)]);
        }
        if columns.transmittance {
            let (transmittance, texture) = compiled.transmittance.map_or(([0.0; 3], None), constant_and_texture);
            let [r, g, b] = transmittance;
            self.transmittance.push([r, g, b, texture_bits(texture)]);
        }
        if columns.opacity {
            let layered = instance.properties.passes || instance.blend.is_some();
            let [opacity, texture] = number_row(instance.opacity);
            self.opacity.push([opacity, texture, f32::from(u8::from(layered)), 0.0]);
        }
        if compiled.scatters_where_black || colour != [0.0; 3] {
            self.stages.push(stage);
        }
    }

    /// Whether no light passes through surfaces, and none is a blend.
    pub fn are_opaque(&self) -> bool {
        self.opacity.is_empty()
    }

    /// The words of all rows.
    pub fn words(&self) -> impl Iterator<Item = u32> {
        self.rows.iter().map(|[.., word]| word.to_bits())
    }

    fn are_plain(&self) -> bool {
        !self.textured
            && self.are_opaque()
            && self.stages.iter().all(|stage| *stage == Stage::Plain)
            && self.words().all(|word| word & ONE_SIDED == 0)
    }

    /// Error if there are too many materials or media.
    pub fn check(&self) -> Result<(), String> {
        let too_many = |what: &str, most: usize| Err(format!("more than {most} {what}"));
        if self.materials.len() > MOST_MATERIALS {
            return too_many("materials", MOST_MATERIALS);
        }
        if self.media.len() > MOST_MEDIA {
            return too_many("materials in a scene with tinted media", MOST_MEDIA - 1);
        }
        Ok(())
    }
}

/// The materials of the objects and the parts of their blends. A material that nothing uses costs no table.
fn used<'a>(objects: &[Object], instances: &'a [MaterialInstance]) -> Vec<&'a MaterialInstance> {
    let mut is_used = vec![false; instances.len()];
    let mut waiting: Vec<u32> = objects.iter().filter_map(|object| object.material).collect();
    while let Some(number) = waiting.pop() {
        if !std::mem::replace(&mut is_used[number as usize], true) {
            waiting.extend(instances[number as usize].blend.iter().flat_map(|blend| blend.materials));
        }
    }
    instances.iter().zip(is_used).filter(|(_, is_used)| *is_used).map(|(instance, _)| instance).collect()
}

/// The tables that only some scenes need.
#[derive(Clone, Copy)]
struct Columns {
    relief: bool,
    opacity: bool,
    transmittance: bool,
}

impl Columns {
    fn new(objects: &[Object], instances: &[MaterialInstance], used: &[&MaterialInstance]) -> Columns {
        let is_layered = |number: u32| {
            let instance = &instances[number as usize];
            instance.properties.passes || instance.blend.is_some()
        };
        Columns {
            relief: used.iter().any(|instance| instance.bump.is_some() || instance.normal_map.is_some()),
            transmittance: used.iter().any(|instance| instance.compiled.transmittance.is_some()),
            opacity: objects.iter().filter_map(|object| object.material).any(is_layered),
        }
    }
}
