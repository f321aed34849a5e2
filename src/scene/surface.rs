//! Tables of the surfaces of primitives for the kernel, and the shading stages that they need.
mod applied;
mod blends;

use self::applied::AppliedMaterial;
use super::{MaterialInstance, Object};
use crate::{
    material::{AlphaSource, Materials, Stage},
    math::{Lanes, M, U},
    texture::{ColourSource, NumberSource},
};

/// Surfaces by primitive, and after them the parts of blends. Tables that a scene does not need are empty.
#[derive(Default)]
pub struct Surfaces {
    /// Colour, and the word `material | stage << 16 | flags`.
    pub rows: Vec<[f32; 4]>,
    /// α, textures of colour and of α, and the medium inside. An id is stored plus 1, as bits; 0 is none.
    pub varying: Vec<[f32; 4]>,
    /// Height texture, its scale, and normal texture (ids as above).
    pub relief: Vec<[f32; 4]>,
    /// Diffuse transmittance and its texture (an id as above). Filled if some material has one.
    pub transmittance: Vec<[f32; 4]>,
    /// Opacity, its texture (an id as above), and 1 for surfaces that are not all opaque or are blends. Filled if there are such
    /// surfaces.
    pub opacity: Vec<[f32; 4]>,
    /// Weight of the second part of a blend, its texture (an id as above), and the rows of both parts as bits.
    pub blends: Vec<[f32; 4]>,
    /// Extinction of media per metre, in octaves; the first is empty space. Without tinted media the table is empty.
    pub media: Vec<[f32; 4]>,
    /// Whether the shading of some surface reads texture coordinates or the tangent.
    pub charted: bool,
    /// Whether the colour or α of some surface is textured.
    pub textured: bool,
    /// The stages that some surface uses.
    pub stages: Vec<Stage>,
    /// Whether some surface is glossy, so lights are chosen with its lobe.
    pub glossy: bool,
    /// Whether all surfaces are diffuse, two-sided, opaque, and of constant colour.
    pub plain: bool,
    /// Tables and constants of the materials.
    pub materials: Materials,
}

const STAGE_SHIFT: u32 = 16;
const STAGE_MASK: u32 = 0xf;
/// Flag: the normal is reversed.
pub const FLIPPED: u32 = 1 << 20;
/// Flag: only the front reflects.
pub const ONE_SIDED: u32 = 1 << 21;
/// Flag: α is the square of its texture.
pub const SQUARED: u32 = 1 << 22;
/// Flag: the surface transmits and emits. Of lights, it samples only lamps without surface, because it would find its own back.
pub const SELF_LIT: u32 = 1 << 23;
/// Flag: black colours scatter light too; see [`crate::material::CompiledMaterial::scatters_where_black`].
pub const SCATTERS_WHERE_BLACK: u32 = 1 << 24;
/// Flag: light that passes stays in its medium; see [`crate::material::CompiledMaterial::sheet`].
pub const SHEET: u32 = 1 << 30;
/// Flag: a blend. The first column of the row holds its index in [`Surfaces::blends`] as bits.
pub const BLENDED: u32 = 1 << 25;
/// Flag, set while rendering: the path hit the front.
pub const FRONT: u32 = 1 << 31;
/// Materials have 16 bits and media 8. [`Surfaces::check`] rejects more.
const MOST_MATERIALS: usize = 1 << 16;
const MOST_MEDIA: usize = 1 << 8;

impl Surfaces {
    /// The surfaces of all pieces of the objects, in order.
    pub fn new(objects: &[Object], instances: &[MaterialInstance], materials: Materials) -> Surfaces {
        let inside = |instance: &MaterialInstance| instance.compiled.inside.unwrap_or([1.0; 3]);
        let has_media = instances.iter().any(|instance| inside(instance) != [1.0; 3]);
        let columns = Columns::new(objects, instances);
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
        self.rows.push(SurfaceRow { colour, word: number | (stage as u32) << STAGE_SHIFT | flags }.pack());
        self.varying.push(VaryingRow { alpha, colour_texture, alpha_texture, medium }.pack());
        if columns.relief {
            let (heights, height) = applied.bump.map_or((None, 0.0), |(id, height)| (Some(id), height));
            self.relief.push([texture_bits(heights), height, texture_bits(applied.normal_map), 0.0]);
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

    fn are_plain(&self) -> bool {
        let one_sided = |row: &[f32; 4]| row[3].to_bits() & ONE_SIDED != 0;
        !self.textured
            && self.are_opaque()
            && self.stages.iter().all(|stage| *stage == Stage::Plain)
            && !self.rows.iter().any(one_sided)
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

/// The tables that only some scenes need.
#[derive(Clone, Copy)]
struct Columns {
    relief: bool,
    opacity: bool,
    transmittance: bool,
}

impl Columns {
    fn new(objects: &[Object], instances: &[MaterialInstance]) -> Columns {
        let is_layered = |number: u32| {
            let instance = &instances[number as usize];
            instance.properties.passes || instance.blend.is_some()
        };
        Columns {
            relief: instances.iter().any(|instance| instance.bump.is_some() || instance.normal_map.is_some()),
            transmittance: instances.iter().any(|instance| instance.compiled.transmittance.is_some()),
            opacity: objects.iter().filter_map(|object| object.material).any(is_layered),
        }
    }
}

/// A row of [`Surfaces::rows`].
struct SurfaceRow {
    colour: [f32; 3],
    /// `material | stage << 16 | flags`.
    word: u32,
}

impl SurfaceRow {
    fn pack(&self) -> [f32; 4] {
        let [r, g, b] = self.colour;
        [r, g, b, f32::from_bits(self.word)]
    }
}

/// A row of [`Surfaces::varying`].
struct VaryingRow {
    alpha: f32,
    colour_texture: Option<u32>,
    alpha_texture: Option<u32>,
    /// The medium inside, as an index into [`Surfaces::media`].
    medium: u32,
}

impl VaryingRow {
    fn pack(&self) -> [f32; 4] {
        [self.alpha, texture_bits(self.colour_texture), texture_bits(self.alpha_texture), f32::from_bits(self.medium)]
    }
}

/// An id plus 1, as bits; 0 is none.
fn texture_bits(texture: Option<u32>) -> f32 {
    f32::from_bits(texture.map_or(0, |id| id + 1))
}

/// A colour and its texture, which replaces it.
fn constant_and_texture(source: ColourSource) -> ([f32; 3], Option<u32>) {
    match source {
        ColourSource::Constant(colour) => (colour, None),
        ColourSource::Texture(id) => ([1.0; 3], Some(id)),
    }
}

/// A number and its texture.
fn number_row(source: NumberSource) -> [f32; 2] {
    match source {
        NumberSource::Constant(number) => [number, texture_bits(None)],
        NumberSource::Texture(id) => [1.0, texture_bits(Some(id))],
    }
}

/// −log₂ of the transmittance of a metre. For transmittance 0 it is finite, so that a distance of 0 transmits everything.
fn octaves_per_metre(transmittance: [f32; 3]) -> [f32; 4] {
    let octaves = |t: f32| (-t.log2()).min(1e30);
    [octaves(transmittance[0]), octaves(transmittance[1]), octaves(transmittance[2]), 0.0]
}

/// The number of the material in a word.
#[inline(always)]
pub fn material<L: Lanes>(word: U<L>) -> U<L> {
    word & 0xffff
}

/// The stage in a word.
#[inline(always)]
pub fn stage<L: Lanes>(word: U<L>) -> U<L> {
    (word >> STAGE_SHIFT) & STAGE_MASK
}

/// Whether a flag is set in a word.
#[inline(always)]
pub fn is_set<L: Lanes>(word: U<L>, flag: u32) -> M<L> {
    !(word & flag).is(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        sampling::Directions,
        scene::{RenderSettings, Scene, parse},
    };

    /// Balls of these materials, each with further text.
    fn scene(balls: &[(&str, &str)]) -> Scene {
        let ball = |(i, (material, more)): (usize, &(&str, &str))| {
            format!(
                "[materials.m{i}]\n{material}\n[[objects]]\nshape.sphere = {{ center = [{i}, 0, 0], radius = 0.25 }}\nmaterial = 'm{i}'\n{more}\n"
            )
        };
        let text = format!(
            "format = 1\ncamera = {{ eye = [0, 0, 9], look_at = [0, 0, 0], fov = 60, resolution = [8, 8] }}\nbackground.radiance = 1\n\
             textures.squares.checker = {{ even = 0.2, odd = 0.4, scale = 2 }}\n{}",
            balls.iter().enumerate().map(ball).collect::<String>()
        );
        parse("balls.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
    }

    const WHITE: &str = "lambertian.albedo = 0.5";

    #[test]
    fn every_kind_of_bsdf_has_its_stage() {
        let stages = |material: &str| scene(&[(material, "")]).surfaces.stages;
        for (material, stage) in [
            (WHITE, Stage::Plain),
            ("lambertian.albedo = 0.5\nbump = { texture = 'squares', height = 0.01 }", Stage::Diffuse),
            ("mirror.reflectance = 0.5", Stage::Mirror),
            ("conductor = { f0 = 0.5, roughness = 0.5 }", Stage::Conductor),
            ("dielectric.ior = 1.5", Stage::Dielectric),
            ("dielectric = { ior = 1.5, roughness = 0.5 }", Stage::RoughDielectric),
            ("plastic = { albedo = 0.5, ior = 1.5 }", Stage::Plastic),
            ("conductor = { f0 = 0.5, roughness = 0.5, anisotropy = 0.5 }", Stage::AnisotropicConductor),
            ("conductor = { f0 = 0.5, anisotropy = 0.5 }", Stage::Mirror),
            ("dielectric = { ior = 1.5, roughness = 0.5, anisotropy = 0.5 }", Stage::PrincipledGlass),
            ("principled.base_color = 0", Stage::Principled),
            ("principled = { transmission_weight = 0.5 }", Stage::PrincipledGlass),
            ("principled = { transmission_weight = 0.5, base_metalness = 1 }", Stage::Principled),
            ("diffuse_transmission = { reflectance = 0.5, transmittance = 0.5 }", Stage::DiffuseTransmission),
        ] {
            assert_eq!(stages(material), [stage], "{material}");
        }
        assert_eq!(stages("lambertian.albedo = 0"), [], "black paint needs none");
        assert_eq!(stages("plastic = { albedo = 0, ior = 1.5 }"), [Stage::Plastic]);
    }

    #[test]
    fn flags_say_what_is_turned_one_sided_squared_or_lit_by_itself() {
        let word = |material: &str, more: &str| scene(&[(material, more)]).surfaces.rows[0][3].to_bits();
        let flags = |material: &str, more: &str| word(material, more) & !(STAGE_MASK << STAGE_SHIFT) & !0xffff;
        let rough = "dielectric = { ior = 1.5, roughness = 0.5 }";
        assert_eq!(flags(WHITE, ""), 0);
        assert_eq!(flags(WHITE, "flip = true"), FLIPPED);
        assert_eq!(flags("lambertian.albedo = 0.5\ntwo_sided = false", ""), ONE_SIDED);
        assert_eq!(flags("conductor = { reflectance = 0.5, roughness = { texture = 'squares' } }", "") & SQUARED, SQUARED);
        assert_eq!(flags("conductor = { reflectance = 0.5, alpha = { texture = 'squares' } }", "") & SQUARED, 0);
        assert_eq!(flags(rough, "emission.radiance = 1") & SELF_LIT, SELF_LIT);
        assert_eq!([flags(rough, "") & SELF_LIT, flags(WHITE, "emission.radiance = 1") & SELF_LIT], [0; 2]);
        assert_eq!(flags("plastic = { albedo = 0.5, ior = 1.5 }", "") & SCATTERS_WHERE_BLACK, SCATTERS_WHERE_BLACK);
        let two = scene(&[(WHITE, ""), ("mirror.reflectance = 0.5", "")]).surfaces;
        assert_eq!([0, 1].map(|row| two.rows[row][3].to_bits()), [0, 1 | (Stage::Mirror as u32) << STAGE_SHIFT]);
    }

    #[test]
    fn charts_are_for_textures_and_anisotropy_of_kinds_that_read_them() {
        let charted = |material: &str| scene(&[(material, "")]).surfaces.charted;
        for material in [
            "principled.base_metalness = { texture = 'squares' }",
            "principled.specular_roughness_anisotropy = 0.5",
            "conductor = { f0 = 0.5, roughness = 0.5, anisotropy = 0.5 }",
        ] {
            assert!(charted(material), "{material}");
        }
        for material in [
            "principled = {}",
            "principled = { base_color = { texture = 'squares' }, specular_roughness = { texture = 'squares' } }",
            "conductor = { f0 = 0.5, roughness = { texture = 'squares' } }",
        ] {
            assert!(!charted(material), "{material}");
        }
    }

    #[test]
    fn sheets_have_no_inside_and_clear_principled_materials_absorb_like_dielectrics() {
        let deep = "principled = { transmission_weight = 1, transmission_color = [0.5, 0.25, 1.0], transmission_depth = 2 }";
        let sheet =
            "principled = { transmission_weight = 1, transmission_color = 0.5, transmission_depth = 2, thin_walled = true }";
        let surfaces = scene(&[(deep, ""), (sheet, "")]).surfaces;
        assert_eq!(surfaces.media.len(), 3);
        for (octaves, expected) in surfaces.media[1].into_iter().zip([0.5, 1.0, 0.0, 0.0]) {
            assert!((octaves - expected).abs() < 1e-6, "{:?}", surfaces.media);
        }
        let sheets = [0, 1].map(|row| surfaces.rows[row][3].to_bits() & SHEET != 0);
        assert_eq!((sheets, surfaces.varying[1][3].to_bits()), ([false, true], 0));
    }

    #[test]
    fn media_are_octaves_a_metre_and_the_first_is_empty() {
        let tinted = "dielectric = { ior = 1.5, transmittance = [0.5, 0.125, 0.0] }";
        let surfaces = scene(&[(WHITE, ""), (tinted, "")]).surfaces;
        assert_eq!(surfaces.media, [[0.0; 4], [0.0; 4], [1.0, 3.0, 1e30, 0.0]]);
        assert_eq!([0, 1].map(|row| surfaces.varying[row][3].to_bits()), [0, 2]);
        assert!(scene(&[("dielectric.ior = 1.5", "")]).surfaces.media.is_empty());
    }

    #[test]
    fn what_has_no_material_has_no_colour_texture_or_medium() {
        let bumpy = "dielectric = { ior = 1.5, transmittance = 0.5 }\nbump = { texture = 'squares', height = 0.01 }";
        let bare = "[[objects]]\nshape.sphere = { center = [0, 3, 0], radius = 0.25 }";
        let surfaces = scene(&[(bumpy, bare)]).surfaces;
        for table in [&surfaces.rows, &surfaces.varying, &surfaces.relief] {
            assert_eq!((table.len(), table[0] == [0.0; 4], table[1]), (2, false, [0.0; 4]));
        }
    }

    #[test]
    fn only_scenes_with_opacity_or_blends_have_a_table_of_opacities() {
        let surfaces = |material: &str| scene(&[(material, ""), (WHITE, "")]).surfaces;
        for opaque in [WHITE, "lambertian.albedo = 0.5\nopacity = 1", "dielectric.ior = 1.5"] {
            let surfaces = surfaces(opaque);
            assert!(surfaces.are_opaque() && surfaces.blends.is_empty() && surfaces.transmittance.is_empty(), "{opaque}");
        }
        let rows = |material: &str| surfaces(material).opacity;
        assert_eq!(rows("lambertian.albedo = 0.5\nopacity = 0.25"), [[0.25, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0]]);
        assert_eq!(rows("null = {}")[0], [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(rows("null = {}\nopacity = 1")[0], [0.0, 0.0, 1.0, 0.0]);
        let textured = rows("lambertian.albedo = 0.5\nopacity = { texture = 'squares' }")[0];
        assert_eq!((textured[0], textured[1].to_bits() > 0, textured[2]), (1.0, true, 1.0));
        assert_eq!(surfaces("null = {}").stages, [Stage::Plain], "what is never met needs no stage");
    }

    #[test]
    fn plain_is_a_scene_of_diffuse_constant_two_sided_colour() {
        let is_plain = |balls: &[(&str, &str)]| scene(balls).surfaces.plain;
        assert!(is_plain(&[(WHITE, ""), (WHITE, "flip = true")]));
        for other in [
            "mirror.reflectance = 0.5",
            "lambertian.albedo = 0.5\ntwo_sided = false",
            "lambertian.albedo = { texture = 'squares' }",
            "lambertian.albedo = 0.5\nopacity = 0.5",
        ] {
            assert!(!is_plain(&[(WHITE, ""), (other, "")]), "{other}");
        }
    }

    #[test]
    fn paths_can_be_shared_from_diffuse_surfaces_in_empty_space_beyond_one_bounce() {
        let can = |scene: &Scene, change: fn(&mut RenderSettings)| {
            let mut settings = RenderSettings::default();
            change(&mut settings);
            scene.can_share(&scene.rays(&scene.camera), &settings)
        };
        let white = scene(&[(WHITE, "")]);
        assert!(can(&white, |_| ()) && can(&white, |settings| settings.directions = Directions::Cosine));
        assert!(!can(&white, |settings| settings.directions = Directions::Uniform));
        assert!(
            !can(&white, |settings| settings.max_bounces = Some(1)) && can(&white, |settings| settings.max_bounces = Some(2))
        );
        assert!(!can(&scene(&[("mirror.reflectance = 0.5", "")]), |_| ()));
        assert!(can(&scene(&[(WHITE, ""), ("mirror.reflectance = 0.5", "")]), |_| ()));
        assert!(!can(&scene(&[(WHITE, ""), ("dielectric = { ior = 1.5, transmittance = 0.5 }", "")]), |_| ()));
        assert!(!can(&scene(&[(WHITE, ""), ("null = {}", "")]), |_| ()), "a visibility ray does not know transmittances");
    }
}
