//! Blends that are a single material: those of diffuse surfaces, and those whose weight is 0 or 1.
//!
//! The BSDF of a diffuse surface is proportional to its albedo, so a blend of two has the BSDF of their mixed albedo. The merged material
//! has the expectation of the blend, without the noise of a choice at every hit.
use crate::{
    scene::{MaterialInstance, Properties},
    texture::{NumberSource, TextureCompiler},
};

/// The material that a blend of two parts is. `None` if it is more than that.
pub fn merged(
    blend: &MaterialInstance,
    [first, second]: [&MaterialInstance; 2],
    weight: NumberSource,
    textures: &mut TextureCompiler,
) -> Option<MaterialInstance> {
    match weight {
        NumberSource::Constant(0.0) => within(blend, first),
        NumberSource::Constant(1.0) => within(blend, second),
        _ => mixed(within(blend, first)?, &within(blend, second)?, weight, textures),
    }
}

/// A part with what the blend around it changes. `None` if both have an opacity that only a product of textures could hold.
fn within(blend: &MaterialInstance, part: &MaterialInstance) -> Option<MaterialInstance> {
    let opacity = match (blend.opacity, part.opacity) {
        (NumberSource::Constant(a), NumberSource::Constant(b)) => NumberSource::Constant(a * b),
        (NumberSource::Constant(1.0), opacity) | (opacity, NumberSource::Constant(1.0)) => opacity,
        _ => return None,
    };
    Some(MaterialInstance {
        compiled: part.compiled.clone(),
        bump: part.bump.or(blend.bump),
        normal_map: part.normal_map.or(blend.normal_map),
        normal_shadowing: blend.normal_shadowing || part.normal_shadowing,
        mirrored_normals: blend.mirrored_normals || part.mirrored_normals,
        two_sided_relief: blend.two_sided_relief || part.two_sided_relief,
        one_sided: blend.one_sided || part.one_sided,
        opacity,
        blend: part.blend,
        properties: blend.properties.of_blend(part.properties),
        ..blend.clone()
    })
}

/// The mixture of two diffuse surfaces that differ in nothing but their albedo.
fn mixed(
    first: MaterialInstance,
    second: &MaterialInstance,
    weight: NumberSource,
    textures: &mut TextureCompiler,
) -> Option<MaterialInstance> {
    let normals = |part: &MaterialInstance| {
        let flags = [part.normal_shadowing, part.mirrored_normals, part.two_sided_relief];
        (part.bump, part.normal_map, flags)
    };
    let surface = |part: &MaterialInstance| (part.one_sided, part.opacity, normals(part));
    if surface(&first) != surface(second) || first.blend.or(second.blend).is_some() {
        return None;
    }
    let compiled = first.compiled.mixed(&second.compiled, weight, textures)?;
    Some(MaterialInstance { properties: Properties::new(&compiled, first.opacity), compiled, ..first })
}

#[cfg(test)]
mod tests {
    use crate::{
        material::{Material, Stage},
        scene::{MaterialInstance, Scene, parse},
        texture::{ColourSource, NumberSource},
    };

    /// A ball of the material `top`.
    fn scene(materials: &str) -> Scene {
        let text = format!(
            "format = 1\nenvironment.radiance = 1\n\
             camera = {{ eye = [0, 0, 9], look_at = [0, 0, 0], fov = 60, resolution = [8, 8] }}\n\
             textures.squares.checker = {{ even = 0.25, odd = 0.75, scale = 4 }}\n\
             textures.noise.noise = {{ scale = 3.0, octaves = 2, low = 0.1, high = 0.9 }}\n\
             materials.dark.lambertian.albedo = [0.125, 0.25, 0.5]\nmaterials.bright.lambertian.albedo = [0.875, 0.75, 0.5]\n\
             materials.tiles.lambertian.albedo = {{ texture = 'squares' }}\nmaterials.glass.dielectric.ior = 1.5\n\
             materials.gold.conductor = {{ f0 = [1.0, 0.75, 0.25], roughness = 0.5 }}\nmaterials.hole.null = {{}}\n{materials}\n\
             [[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = 'top'"
        );
        parse("blends.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
    }

    fn top(scene: &Scene) -> &MaterialInstance {
        scene.material(&scene.objects[0]).expect("it has one")
    }

    /// The colour of the top material after a merge.
    fn colour(materials: &str) -> ColourSource {
        let scene = scene(materials);
        assert!(top(&scene).blend.is_none() && scene.surfaces.blends.is_empty(), "{materials}");
        top(&scene).compiled.colour
    }

    #[test]
    fn constant_albedos_are_mixed_to_a_constant() {
        let mixture = colour("materials.top.blend = { first = 'dark', second = 'bright', weight = 0.25 }");
        assert_eq!(mixture, ColourSource::Constant([0.3125, 0.375, 0.5]));
        let nested = colour(
            "materials.inner.blend = { first = 'dark', second = 'bright', weight = 0.25 }\n\
             materials.top.blend = { first = 'inner', second = 'bright', weight = 0.5 }",
        );
        assert_eq!(nested, ColourSource::Constant([0.59375, 0.5625, 0.5]));
        let equal = colour("materials.top.blend = { first = 'tiles', second = 'tiles', weight = { texture = 'noise' } }");
        assert!(matches!(equal, ColourSource::Texture(_)));
    }

    #[test]
    fn textured_albedos_and_weights_become_a_texture_of_their_mean() {
        for (blend, mean, largest) in [
            ("first = 'tiles', second = 'bright', weight = 0.25", [0.59375, 0.5625, 0.5], 0.78125),
            ("first = 'dark', second = 'bright', weight = { texture = 'squares' }", [0.5, 0.5, 0.5], 0.6875),
        ] {
            let scene = scene(&format!("materials.top.blend = {{ {blend} }}"));
            let ColourSource::Texture(id) = top(&scene).compiled.colour else { panic!("{blend}: a texture") };
            let found = scene.textures.mean(id);
            assert!((0..3).all(|i| (found[i] - mean[i]).abs() < 1e-6), "{blend}: {found:?}");
            assert!(scene.surfaces.textured && scene.surfaces.are_opaque(), "{blend}");
            assert_eq!((top(&scene).properties.albedo, top(&scene).properties.diffuse), (largest, true), "{blend}");
        }
    }

    #[test]
    fn the_scene_keeps_the_blend_and_its_parts() {
        let scene = scene("materials.top.blend = { first = 'dark', second = 'bright' }");
        assert!(matches!(&top(&scene).material, Material::Blend(blend) if blend.first == "dark" && blend.second == "bright"));
        assert_eq!((top(&scene).name.as_str(), scene.materials.len()), ("top", 7));
    }

    #[test]
    fn the_merged_material_keeps_the_common_properties_of_the_blend_and_its_parts() {
        let scene = scene(
            "materials.a = { lambertian.albedo = 0.25, opacity = 0.5 }\n\
             materials.b = { lambertian.albedo = 0.75, opacity = 0.5, two_sided = false }\n\
             materials.top = { blend = { first = 'a', second = 'b' }, opacity = 0.5, two_sided = false, \
             bump = { texture = 'squares', height = 0.01 } }",
        );
        let top = top(&scene);
        assert_eq!((top.blend, top.opacity, top.one_sided), (None, NumberSource::Constant(0.25), true));
        assert!(top.bump.is_some() && top.properties.passes && scene.surfaces.stages == [Stage::Diffuse]);
    }

    #[test]
    fn other_blends_choose_one_of_their_parts() {
        let more = "materials.rear = { lambertian.albedo = 0.5, two_sided = false }\n\
                    materials.bumpy = { lambertian.albedo = 0.5, bump = { texture = 'squares', height = 0.01 } }\n\
                    materials.thin = { lambertian.albedo = 0.5, opacity = 0.5 }\n\
                    materials.cut = { lambertian.albedo = 0.5, opacity = { texture = 'squares' } }\n\
                    materials.other = { lambertian.albedo = 0.25, opacity = { texture = 'squares' } }\n\
                    materials.mixed.blend = { first = 'dark', second = 'gold' }\n";
        for parts in ["gold", "glass", "hole", "rear", "bumpy", "thin", "cut", "mixed"] {
            let scene = scene(&format!("{more}materials.top.blend = {{ first = 'dark', second = '{parts}' }}"));
            assert!(top(&scene).blend.is_some() && !scene.surfaces.blends.is_empty(), "{parts}");
        }
        let blend = "blend = { first = 'cut', second = 'other' }";
        assert!(top(&scene(&format!("{more}materials.top = {{ {blend} }}"))).blend.is_none());
        let cut_twice = scene(&format!("{more}materials.top = {{ {blend}, opacity = {{ texture = 'noise' }} }}"));
        assert!(top(&cut_twice).blend.is_some());
    }

    #[test]
    fn a_weight_of_0_or_1_leaves_one_material() {
        for (weight, kept) in [("0", "gold"), ("1", "glass")] {
            let scene = scene(&format!("materials.top.blend = {{ first = 'gold', second = 'glass', weight = {weight} }}"));
            let part = scene.materials.iter().find(|material| material.name == kept).expect("it is there");
            assert_eq!((&top(&scene).compiled, top(&scene).blend), (&part.compiled, None));
            assert_eq!(top(&scene).properties, part.properties);
            let tables = &scene.surfaces.materials;
            let number = |name: &str| scene.materials.iter().position(|material| material.name == name).expect("it is there");
            assert_eq!(tables.constants(number("top")), tables.constants(number(kept)));
            assert_eq!(tables.stage(number("top")), tables.stage(number(kept)));
        }
        let nested = scene(
            "materials.inner.blend = { first = 'gold', second = 'hole' }\n\
             materials.top.blend = { first = 'inner', second = 'glass', weight = 0 }",
        );
        assert_eq!(nested.surfaces.blends.len(), 1);
        assert!(top(&nested).properties.passes && !top(&nested).properties.has_inside);
    }

    /// Each level looks up the one before it twice: the fourth needs 75 lookups.
    #[test]
    fn a_blend_of_too_many_textures_stays_a_blend() {
        const NAMES: [&str; 5] = ["tiles", "one", "two", "three", "top"];
        let level = |pair: &[&str]| {
            let [before, name] = [pair[0], pair[1]];
            format!(
                "materials.{before}_dark.blend = {{ first = '{before}', second = 'dark', weight = {{ texture = 'squares' }} }}\n\
                 materials.{name}.blend = {{ first = '{before}', second = '{before}_dark', weight = {{ texture = 'noise' }} }}\n"
            )
        };
        let scene = scene(&NAMES.windows(2).map(level).collect::<String>());
        let blends: Vec<&str> =
            scene.materials.iter().filter(|material| material.blend.is_some()).map(|material| material.name.as_str()).collect();
        assert_eq!(blends, ["top"]);
        assert!((0..scene.textures.len()).all(|id| scene.textures.lookups(id as u32) <= 64));
    }
}
