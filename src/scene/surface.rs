//! What the primitives' surfaces are, as tables for the kernel, and which shading stages they need.
use super::{
    Object,
    compile::{Coating, Roughness},
    textures::ColourSource,
};
use crate::{
    geometry::Shape,
    material::{BsdfKind, Materials},
    math::{Lanes, M, U},
};

/// The shading stages: one for every kind of bsdf, and one for diffuse surfaces of which nothing but the colour matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    Plain,
    Diffuse,
    Mirror,
    Conductor,
    Dielectric,
    RoughDielectric,
    Plastic,
}

impl Stage {
    pub const COUNT: usize = Stage::Plastic as usize + 1;
}

/// Surfaces by primitive. Tables that a scene does not need are empty.
#[derive(Default)]
pub struct Surfaces {
    /// Colour, and the surface's word: `material | stage << 16 | flags`.
    pub rows: Vec<[f32; 4]>,
    /// α, textures of colour and of α, and the medium inside. An id is stored plus 1, as bits; 0 is none.
    pub varying: Vec<[f32; 4]>,
    /// Texture of heights, their scale, and texture of normals (ids like above).
    pub relief: Vec<[f32; 4]>,
    /// What a metre of a medium takes away, in octaves; the first is empty space. Empty when all media are.
    pub media: Vec<[f32; 4]>,
    /// Colour or α of some surface is textured.
    pub textured: bool,
    pub stages: Vec<Stage>,
    /// All surfaces are diffuse, from both sides, and of constant colour.
    pub plain: bool,
    pub materials: Materials,
}

const STAGE_SHIFT: u32 = 16;
const STAGE_MASK: u32 = 0xf;
/// The normal is reversed.
pub const FLIPPED: u32 = 1 << 20;
/// Only the front reflects.
pub const ONE_SIDED: u32 = 1 << 21;
/// α is the square of what its texture says.
pub const SQUARED: u32 = 1 << 22;
/// It transmits and emits: no light is looked for from it, as it would find itself, seen from the wrong side.
pub const SELF_LIT: u32 = 1 << 23;
/// It scatters light even where its colour is black: see [`crate::material::Material::scatters_where_black`].
pub const SCATTERS_WHERE_BLACK: u32 = 1 << 24;
/// Set while rendering where a path met the front.
pub const FRONT: u32 = 1 << 31;
/// Materials have 16 bits, media 8: what is beyond is refused by [`Surfaces::check`].
const MOST_MATERIALS: usize = 1 << 16;
const MOST_MEDIA: usize = 1 << 8;

impl Surfaces {
    /// Surfaces of the pieces of the objects in their order.
    pub fn new(objects: &[Object]) -> Surfaces {
        let mut coatings: Vec<&Coating> = Vec::new();
        for coating in objects.iter().filter_map(|object| object.coating.as_ref()) {
            if !coatings.contains(&coating) {
                coatings.push(coating);
            }
        }
        let materials: Vec<_> = coatings.iter().map(|coating| coating.material).collect();
        let has_media = coatings.iter().any(|coating| coating.transmittance != [1.0; 3]);
        let has_relief = coatings.iter().any(|coating| coating.bump.or(coating.normal_map.map(|id| (id, 0.0))).is_some());
        let mut surfaces = Surfaces { materials: Materials::new(&materials), ..Surfaces::default() };
        if has_media {
            surfaces.media.push([0.0; 4]);
            surfaces.media.extend(coatings.iter().map(|coating| octaves_per_metre(coating.transmittance)));
        }
        for object in objects {
            let material = object.coating.as_ref().and_then(|coating| coatings.iter().position(|known| *known == coating));
            for _ in 0..object.shape.piece_count() {
                surfaces.push(object, material, has_relief);
            }
        }
        surfaces.stages.sort_unstable();
        surfaces.stages.dedup();
        surfaces.plain = surfaces.are_plain();
        surfaces
    }

    fn push(&mut self, object: &Object, material: Option<usize>, has_relief: bool) {
        let (Some(coating), Some(material)) = (&object.coating, material) else {
            self.rows.push([0.0; 4]);
            self.varying.push([0.0; 4]);
            if has_relief {
                self.relief.push([0.0; 4]);
            }
            return;
        };
        let is_smooth = matches!(&object.shape, Shape::Mesh { data, .. } if !data.normals.is_empty());
        let stage = self.stage(coating, material, is_smooth);
        let id = |texture: Option<u32>| f32::from_bits(texture.map_or(0, |id| id + 1));
        let ([r, g, b], colour_texture) = match coating.colour {
            ColourSource::Constant(colour) => (colour, None),
            ColourSource::Texture(id) => ([1.0; 3], Some(id)),
        };
        let (alpha, alpha_texture, squared) = match coating.roughness {
            Roughness::Constant(alpha) => (alpha, None, false),
            Roughness::Texture { id, squared } => (1.0, Some(id), squared),
        };
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let self_lit = stage == Stage::RoughDielectric && object.emission.is_some();
        let scatters_where_black = coating.material.scatters_where_black();
        let flags = flag(object.flip, FLIPPED)
            | flag(coating.one_sided, ONE_SIDED)
            | flag(squared, SQUARED)
            | flag(self_lit, SELF_LIT)
            | flag(scatters_where_black, SCATTERS_WHERE_BLACK);
        let medium = if self.media.is_empty() { 0 } else { material as u32 + 1 };
        self.textured |= colour_texture.or(alpha_texture).is_some();
        self.rows.push([r, g, b, f32::from_bits(material as u32 | (stage as u32) << STAGE_SHIFT | flags)]);
        self.varying.push([alpha, id(colour_texture), id(alpha_texture), f32::from_bits(medium)]);
        if has_relief {
            let height = coating.bump.map_or(0.0, |(_, height)| height);
            self.relief.push([id(coating.bump.map(|(id, _)| id)), height, id(coating.normal_map), 0.0]);
        }
        if scatters_where_black || [r, g, b] != [0.0; 3] {
            self.stages.push(stage);
        }
    }

    fn stage(&self, coating: &Coating, material: usize, is_smooth: bool) -> Stage {
        let has_normals = coating.bump.is_some() || coating.normal_map.is_some();
        match self.materials.kind(material) {
            BsdfKind::Lambertian if has_normals || is_smooth || !self.media.is_empty() => Stage::Diffuse,
            BsdfKind::Lambertian => Stage::Plain,
            BsdfKind::Mirror => Stage::Mirror,
            BsdfKind::Conductor => Stage::Conductor,
            BsdfKind::Dielectric => Stage::Dielectric,
            BsdfKind::RoughDielectric => Stage::RoughDielectric,
            BsdfKind::Plastic => Stage::Plastic,
        }
    }

    fn are_plain(&self) -> bool {
        let one_sided = |row: &[f32; 4]| row[3].to_bits() & ONE_SIDED != 0;
        !self.textured && self.stages.iter().all(|stage| *stage == Stage::Plain) && !self.rows.iter().any(one_sided)
    }

    /// What is too many for the tables.
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

/// −log₂ of what a metre lets pass; black lets nothing pass, but at no distance everything.
fn octaves_per_metre(transmittance: [f32; 3]) -> [f32; 4] {
    let octaves = |t: f32| (-t.log2()).min(1e30);
    [octaves(transmittance[0]), octaves(transmittance[1]), octaves(transmittance[2]), 0.0]
}

#[inline(always)]
pub fn material<L: Lanes>(word: U<L>) -> U<L> {
    word & 0xffff
}

#[inline(always)]
pub fn stage<L: Lanes>(word: U<L>) -> U<L> {
    (word >> STAGE_SHIFT) & STAGE_MASK
}

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

    /// Balls of these materials, each with more of its own.
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
    fn media_are_octaves_a_metre_and_the_first_is_empty() {
        let tinted = "dielectric = { ior = 1.5, transmittance = [0.5, 0.125, 0.0] }";
        let surfaces = scene(&[(WHITE, ""), (tinted, "")]).surfaces;
        assert_eq!(surfaces.media, [[0.0; 4], [0.0; 4], [1.0, 3.0, 1e30, 0.0]]);
        assert_eq!([0, 1].map(|row| surfaces.varying[row][3].to_bits()), [1, 2]);
        assert!(scene(&[("dielectric.ior = 1.5", "")]).surfaces.media.is_empty());
    }

    #[test]
    fn plain_is_a_scene_of_diffuse_constant_two_sided_colour() {
        let is_plain = |balls: &[(&str, &str)]| scene(balls).surfaces.plain;
        assert!(is_plain(&[(WHITE, ""), (WHITE, "flip = true")]));
        for other in [
            "mirror.reflectance = 0.5",
            "lambertian.albedo = 0.5\ntwo_sided = false",
            "lambertian.albedo = { texture = 'squares' }",
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
    }
}
