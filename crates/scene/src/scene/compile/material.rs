//! Materials of a description.
use std::collections::BTreeMap;

use super::problems::Problems;
use crate::{
    image::Encoding,
    material::Materials,
    scene::{
        MaterialInstance, Properties,
        description::{MaterialDescription, OPACITY},
    },
    texture::{ImagePattern, ImageTexture, NumberSource, Texture, TextureCompiler},
};
use noisefall_base::{
    declare::{Path, Problem, Range},
    quote,
};

/// The numbers of materials by their names; `None` for those that are wrong.
pub type Numbers = BTreeMap<String, Option<u32>>;

/// The textures of normal maps by the paths of their files.
type NormalMaps<'d> = BTreeMap<&'d str, u32>;

/// All materials that can be used, and their numbers by name.
pub fn materials(
    described: &BTreeMap<String, MaterialDescription>,
    textures: &mut TextureCompiler,
    tables: &mut Materials,
    problems: &mut Problems,
) -> (Vec<MaterialInstance>, Numbers) {
    let mut instances = Vec::new();
    let mut normal_maps = BTreeMap::new();
    // Without a number: what is wrong with it has been said, and objects may name it.
    let mut numbers: Numbers = problems.damage.names("materials").map(|name| (name.to_owned(), None)).collect();
    for (name, material) in described {
        if problems.are_many() {
            break;
        }
        let compiled =
            problems.keep(&Path::of("materials").key(name), || instance(name, material, &mut normal_maps, textures, tables));
        let number = compiled.map(|instance| {
            let number = tables.push(&instance.compiled);
            instances.push(instance);
            number
        });
        numbers.insert(name.clone(), number);
    }
    (instances, numbers)
}

fn instance<'d>(
    name: &str,
    described: &'d MaterialDescription,
    normal_maps: &mut NormalMaps<'d>,
    textures: &mut TextureCompiler,
    tables: &mut Materials,
) -> Result<MaterialInstance, Problem> {
    let bump = described.bump.as_ref().map(|bump| Ok((textures.id("bump.texture", &bump.texture)?, bump.height as f32)));
    let normal_map = described.normal_map.as_ref().map(|path| normal_map(path, normal_maps, textures));
    let opacity = opacity(described, textures)?;
    let compiled = tables.compile(&described.kind, textures)?;
    if compiled.stage.transmits() && described.two_sided == Some(false) {
        return Err(Problem::at("two_sided", format!("a {} has two sides", described.kind.name()), "remove this"));
    }
    Ok(MaterialInstance {
        name: quote::piece(name),
        material: described.kind.clone(),
        properties: Properties::new(&compiled, opacity),
        compiled,
        bump: bump.transpose()?,
        normal_map: normal_map.transpose()?,
        normal_shadowing: described.normal_shadowing == Some(true),
        mirrored_normals: described.mirrored_normals == Some(true),
        two_sided_relief: described.two_sided_relief == Some(true),
        one_sided: described.two_sided == Some(false),
        opacity,
        blend: None,
    })
}

/// The opacity of a material; 0 where all light passes.
fn opacity(described: &MaterialDescription, textures: &TextureCompiler) -> Result<NumberSource, Problem> {
    let opacity = described.opacity.as_ref().map(|opacity| textures.number(&OPACITY, opacity, &Range::UNIT)).transpose()?;
    let is_clear = described.kind.kind().is_clear();
    Ok(if is_clear { NumberSource::Constant(0.0) } else { opacity.unwrap_or(NumberSource::Constant(1.0)) })
}

/// A texture without a name, of normals. Materials share it.
fn normal_map<'d>(path: &'d str, known: &mut NormalMaps<'d>, textures: &mut TextureCompiler) -> Result<u32, Problem> {
    if let Some(id) = known.get(path) {
        return Ok(*id);
    }
    let picture = ImageTexture::read(textures.resources, "normal_map", path, Encoding::Linear)?;
    let id = textures.push(Texture::Image(ImagePattern::Plain(picture)));
    known.insert(path, id);
    Ok(id)
}

#[cfg(test)]
mod tests {
    use crate::scene::parse;

    #[test]
    fn a_sheet_may_not_scatter_more_than_it_receives() {
        let refused = |material: &str| {
            let text = format!(
                "format = 1\nenvironment.radiance = 1\n\
                 camera = {{ eye = [0, 0, 9], look_at = [0, 0, 0], fov = 60, resolution = [8, 8] }}\n\
                 textures.squares.checker = {{ even = 0.2, odd = 0.6, scale = 2 }}\nmaterials.leaf.diffuse_transmission = {material}"
            );
            parse("leaf.toml", text).err().expect("it scatters too much").report()
        };
        let constant = refused("{ reflectance = [0.5, 0.7, 0.5], transmittance = [0.5, 0.5, 0.5] }");
        assert!(constant.contains("add up to 1.2 in green"), "{constant}");
        let textured = refused("{ reflectance = 0.5, transmittance = { texture = 'squares' } }");
        assert!(textured.contains("add up to 1.1 in red") && textured.contains("their largest value"), "{textured}");
    }
}
