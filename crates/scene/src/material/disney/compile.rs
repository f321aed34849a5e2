//! Compiles Disney's BSDF.
use super::{
    super::{
        Compile, CompiledMaterial, MaterialCompiler, Stage,
        lookup::{id, value},
        refraction::FAINT,
    },
    Disney, parameters as of,
    row::DisneyRow,
};
use crate::texture::ColourSource;
use noisefall_base::declare::{Parameter, Problem, Range, Textured};

/// Clear materials whose index is nearer to 1 have this one, as in Mitsuba: half vectors of refraction need a bend.
const LEAST_INDEX: f32 = 1.0 + FAINT;

impl Compile for Disney {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let base_color = compiler.colour(&of::BASE_COLOR, &self.base_color, &Range::REFLECTANCE)?;
        let (alpha, _) = compiler.alpha_of(&of::ROUGHNESS, &self.roughness, true)?;
        let sources = self.sources(compiler)?;
        let is_clear = compiler.largest(sources.spec_trans) > 0.0;
        let only_passes = is_constant(sources.spec_trans, 1.0) && is_constant(sources.metallic, 0.0);
        let is_charted =
            !is_constant(sources.anisotropic, 0.0) || sources.pack(sources.ior).as_flattened().iter().any(is_textured);
        let mut numbers = sources.map(|source| value(source)[0]);
        if is_clear && (numbers.ior - 1.0).abs() < FAINT {
            numbers.ior = LEAST_INDEX;
        }
        let plain = CompiledMaterial::new(if is_clear { Stage::DisneyGlass } else { Stage::Disney }, base_color, compiler);
        Ok(CompiledMaterial {
            alpha,
            rows: numbers.pack(0.0),
            further: sources.map(id).pack(0.0).to_vec(),
            charted: is_charted,
            inside: is_clear.then_some([1.0; 3]),
            scatters_where_black: true,
            albedo: if only_passes { 0.0 } else { plain.albedo },
            ..plain
        })
    }
}

impl Disney {
    fn sources(&self, compiler: &MaterialCompiler) -> Result<DisneyRow<ColourSource>, Problem> {
        let number = |parameter: &Parameter, value: &Textured<f64>| compiler.number(parameter, value, &Range::UNIT);
        Ok(DisneyRow {
            ior: ColourSource::Constant([self.ior as f32; 3]),
            metallic: number(&of::METALLIC, &self.metallic)?,
            anisotropic: number(&of::ANISOTROPIC, &self.anisotropic)?,
            spec_tint: number(&of::SPEC_TINT, &self.spec_tint)?,
            spec_trans: number(&of::SPEC_TRANS, &self.spec_trans)?,
            flatness: number(&of::FLATNESS, &self.flatness)?,
            sheen: number(&of::SHEEN, &self.sheen)?,
            sheen_tint: number(&of::SHEEN_TINT, &self.sheen_tint)?,
            clearcoat: number(&of::CLEARCOAT, &self.clearcoat)?,
            clearcoat_gloss: number(&of::CLEARCOAT_GLOSS, &self.clearcoat_gloss)?,
        })
    }
}

fn is_constant(source: ColourSource, number: f32) -> bool {
    source == ColourSource::Constant([number; 3])
}

fn is_textured(source: &ColourSource) -> bool {
    matches!(source, ColourSource::Texture(_))
}
