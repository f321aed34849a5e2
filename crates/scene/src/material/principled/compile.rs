//! Compiles a principled material.
use super::{
    super::{
        AlphaSource, Compile, CompiledMaterial, MaterialCompiler, Stage, ggx,
        lookup::{id, value},
        refraction::FAINT,
        tables::Interface,
    },
    Principled, layout, parameters as of,
    point::{index, roughened},
};
use crate::texture::ColourSource;
use noisefall_base::{
    declare::{Parameter, Problem, Range, Textured},
    math::{F, One},
};

impl Compile for Principled {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let sources = Sources::new(self, compiler)?;
        let base_color = compiler.colour(&of::BASE_COLOR, &self.base_color, &Range::REFLECTANCE)?;
        let (alpha, _) = compiler.alpha_of(&of::SPECULAR_ROUGHNESS, &self.specular_roughness, true)?;
        let clear = sources.most(layout::TRANSMISSION, 3) > 0.0 && sources.constant(layout::BASE, 1) != Some(1.0);
        let stage = if clear { Stage::PrincipledGlass } else { Stage::Principled };
        let flags = self.flags(&sources);
        let constants = self.constants(&sources, alpha, flags, clear, compiler);
        let passes_all = sources.constant(layout::TRANSMISSION, 3) == Some(1.0) && sources.most(layout::BASE, 1) == 0.0;
        let plain = CompiledMaterial::new(stage, base_color, compiler);
        Ok(CompiledMaterial {
            alpha,
            rows: constants.pack(),
            inside: (clear && !self.thin_walled).then(|| self.inside(sources.colors[layout::TRANSMISSION as usize], compiler)),
            sheet: clear && self.thin_walled,
            scatters_where_black: true,
            albedo: if passes_all { 0.0 } else { plain.albedo },
            charted: sources.are_textured() || flags & layout::ANISOTROPIC != 0,
            further: sources.pack(),
            ..plain
        })
    }
}

impl Principled {
    fn flags(&self, sources: &Sources) -> u32 {
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let some = |row: u32, column: usize| sources.most(row, column) > 0.0;
        let anisotropic = some(layout::BASE, 3) || some(layout::COATING, 3) && some(layout::LAYERS, 1);
        flag(some(layout::BASE, 1), layout::METAL)
            | flag(some(layout::COATING, 3), layout::COAT)
            | flag(some(layout::FIBRES, 3), layout::FUZZ)
            | flag(some(layout::INTERFERENCE, 0), layout::FILM)
            | flag(anisotropic, layout::ANISOTROPIC)
            | flag(self.thin_walled, layout::SHEET)
            | flag(self.thin_walled || self.transmission_depth == 0.0, layout::TINTED)
    }

    /// The constants, and the tables that they refer to.
    fn constants(
        &self,
        sources: &Sources,
        alpha: AlphaSource,
        flags: u32,
        clear: bool,
        compiler: &mut MaterialCompiler,
    ) -> layout::Constants<f32, u32> {
        let (ior, coat_ior) = (self.specular_ior as f32, self.coat_ior as f32);
        let table_ior = self.table_ior(sources);
        let coated = flags & layout::COAT != 0;
        compiler.tables.need_loss(flags & layout::ANISOTROPIC != 0);
        let base_table = compiler.tables.coat(table_ior);
        let coat_table = if coated { compiler.tables.coat(coat_ior) } else { base_table };
        let constant = self.constant_alpha(sources, alpha);
        let rough = constant.is_none_or(|alpha| alpha >= ggx::SMOOTH);
        let solid = clear && rough && !self.thin_walled && (ior - 1.0).abs() >= FAINT;
        let anisotropy = sources.constant(layout::BASE, 3);
        // Of textured anisotropy, the table is that of round facets of all widths.
        let alpha = constant.filter(|_| anisotropy.is_some());
        let interface = Interface { eta: ior, alpha, anisotropy: anisotropy.unwrap_or(0.0) };
        let interface_table = if clear { compiler.tables.interface(solid.then_some(interface)) } else { base_table };
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let of_table = flag(solid && alpha.is_none(), layout::VARIES) | flag(solid && interface.anisotropy > 0.0, layout::TURNED);
        let (sin, cos) = self.tangent_rotation.to_radians().sin_cos();
        layout::Constants {
            ior,
            coat_ior,
            film_ior: self.thin_film_ior as f32,
            table_ior,
            turn: (cos as f32, sin as f32),
            flags: flags | of_table,
            base_table,
            coat_table,
            interface_table,
            further: 0,
        }
    }

    /// α of the base under its coat, if it is the same everywhere.
    fn constant_alpha(&self, sources: &Sources, alpha: AlphaSource) -> Option<f32> {
        let AlphaSource::Constant(alpha) = alpha else { return None };
        let (weight, root) = (sources.constant(layout::COATING, 3)?, sources.constant(layout::LAYERS, 0)?);
        Some(roughened::<One>(F(alpha), F(root * root), F(weight)).0)
    }

    /// The index of the table of E/F: the effective one to the next multiple of 0.05, so that materials share tables.
    fn table_ior(&self, sources: &Sources) -> f32 {
        const STEPS: f32 = 20.0;
        let coat = sources.constant(layout::COATING, 3).unwrap_or(0.0);
        let weight = sources.constant(layout::SPECULAR, 3).unwrap_or(1.0);
        let exact = index::<One>(F(self.specular_ior as f32), F(self.coat_ior as f32), F(coat), F(weight)).0;
        ((exact * STEPS).round() / STEPS).max(1.0 + 1.0 / STEPS)
    }

    /// Transmittance of a metre of the inside: the colour after the depth. A texture counts with its mean.
    fn inside(&self, color: ColourSource, compiler: &MaterialCompiler) -> [f32; 3] {
        if self.transmission_depth == 0.0 {
            return [1.0; 3];
        }
        compiler.typical(color).map(|channel| f64::from(channel).powf(1.0 / self.transmission_depth) as f32)
    }
}

/// Colours and numbers of the parameters by the rows of [`layout`].
struct Sources {
    colors: [ColourSource; 4],
    weights: [ColourSource; 4],
    numbers: [[ColourSource; 4]; 3],
    /// The largest value of each number, first of the weights.
    most: [[f32; 4]; 4],
}

impl Sources {
    fn new(material: &Principled, compiler: &MaterialCompiler) -> Result<Sources, Problem> {
        let color = |parameter: &Parameter, value: &Textured| compiler.colour(parameter, value, &Range::REFLECTANCE);
        let number = |parameter: &Parameter, value: &Textured<f64>| compiler.number(parameter, value, &Range::UNIT);
        let none = ColourSource::Constant([0.0; 3]);
        let colors = [
            color(&of::SPECULAR_COLOR, &material.specular_color)?,
            color(&of::TRANSMISSION_COLOR, &material.transmission_color)?,
            color(&of::COAT_COLOR, &material.coat_color)?,
            color(&of::FUZZ_COLOR, &material.fuzz_color)?,
        ];
        let weights = [
            number(&of::SPECULAR_WEIGHT, &material.specular_weight)?,
            number(&of::TRANSMISSION_WEIGHT, &material.transmission_weight)?,
            number(&of::COAT_WEIGHT, &material.coat_weight)?,
            number(&of::FUZZ_WEIGHT, &material.fuzz_weight)?,
        ];
        let base = [
            number(&of::BASE_WEIGHT, &material.base_weight)?,
            number(&of::BASE_METALNESS, &material.base_metalness)?,
            number(&of::BASE_DIFFUSE_ROUGHNESS, &material.base_diffuse_roughness)?,
            number(&of::SPECULAR_ROUGHNESS_ANISOTROPY, &material.specular_roughness_anisotropy)?,
        ];
        let layers = [
            number(&of::COAT_ROUGHNESS, &material.coat_roughness)?,
            number(&of::COAT_ROUGHNESS_ANISOTROPY, &material.coat_roughness_anisotropy)?,
            number(&of::COAT_DARKENING, &material.coat_darkening)?,
            number(&of::FUZZ_ROUGHNESS, &material.fuzz_roughness)?,
        ];
        let thickness = compiler.number(&of::THIN_FILM_THICKNESS, &material.thin_film_thickness, &of::THICKNESS)?;
        let film = [number(&of::THIN_FILM_WEIGHT, &material.thin_film_weight)?, thickness, none, none];
        let most = [weights, base, layers, film].map(|row| row.map(|source| compiler.largest(source)));
        Ok(Sources { colors, weights, numbers: [base, layers, film], most })
    }

    /// The number in a row and a column; the weights are in the last column of their rows.
    fn number(&self, row: u32, column: usize) -> ColourSource {
        if row < layout::BASE { self.weights[row as usize] } else { self.numbers[(row - layout::BASE) as usize][column] }
    }

    /// The largest value of a number.
    fn most(&self, row: u32, column: usize) -> f32 {
        if row < layout::BASE { self.most[0][row as usize] } else { self.most[1 + (row - layout::BASE) as usize][column] }
    }

    /// A number that is the same everywhere.
    fn constant(&self, row: u32, column: usize) -> Option<f32> {
        match self.number(row, column) {
            ColourSource::Constant([number, ..]) => Some(number),
            ColourSource::Texture(_) => None,
        }
    }

    fn are_textured(&self) -> bool {
        let mut all = self.colors.iter().chain(&self.weights).chain(self.numbers.as_flattened());
        all.any(|source| matches!(source, ColourSource::Texture(_)))
    }

    fn pack(&self) -> Vec<[f32; 4]> {
        let mut rows = Vec::with_capacity(layout::FURTHER);
        rows.extend(self.colors.iter().zip(&self.weights).map(|(color, weight)| {
            let ([r, g, b], [w, ..]) = (value(*color), value(*weight));
            [r, g, b, w]
        }));
        rows.extend(self.numbers.iter().map(|row| row.map(|source| value(source)[0])));
        rows.extend([self.colors, self.weights].iter().chain(&self.numbers).map(|row| row.map(id)));
        rows
    }
}
