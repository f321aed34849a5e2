//! Blends of a description: the names of their parts become numbers, and their properties are those of their parts. Blends that are a
//! single material become that material (`merge.rs`).
use std::collections::BTreeMap;

use super::{material::Numbers, merge::merged, problems::Problems};
use crate::{
    material::{Material, Materials, blend::Blend},
    scene::{BY_SIDE, BlendParts, MaterialInstance, description::MaterialDescription},
    texture::{NumberSource, TextureCompiler},
};
use noisefall_base::{
    declare::{Family, Path, Problem, Range},
    quote,
};

/// Blends of blends may go this deep.
const DEEPEST: usize = 16;

/// Checks the parts of a blend, and theirs: all are defined, none leads in a circle or too deep. Other materials pass.
pub fn check_blend(described: &BTreeMap<String, MaterialDescription>, name: &str) -> Result<(), Problem> {
    let numbers = described.keys().map(|name| (name.clone(), None)).collect();
    Depths { described, numbers: &numbers, known: BTreeMap::new(), open: Vec::new() }.of(name).map(drop)
}

/// Gives the blends among the materials their parts.
pub fn blends(
    described: &BTreeMap<String, MaterialDescription>,
    numbers: &Numbers,
    instances: &mut [MaterialInstance],
    textures: &mut TextureCompiler,
    tables: &mut Materials,
    problems: &mut Problems,
) {
    let mut depths = Depths { described, numbers, known: BTreeMap::new(), open: Vec::new() };
    let mut order = Vec::new();
    for name in described.keys() {
        if let Some(depth) = problems.keep(&Path::default(), || depths.of(name)) {
            order.push((depth, name));
        }
    }
    // Parts first.
    order.sort();
    for (_, name) in order {
        let (material, Some(Some(number))) = (&described[name], numbers.get(name)) else { continue };
        let Material::Blend(blend) = &material.kind else { continue };
        let number = *number as usize;
        let at = Path::of("materials").key(name);
        problems.keep(&at, || link(blend, number, numbers, instances, textures, tables));
    }
}

/// Gives a blend its parts, which have theirs, or makes it the material that it is.
fn link(
    blend: &Blend,
    number: usize,
    numbers: &Numbers,
    instances: &mut [MaterialInstance],
    textures: &mut TextureCompiler,
    tables: &mut Materials,
) -> Result<(), Problem> {
    let within = |problem: Problem| problem.within(&Path::of("blend"));
    let weight = textures.number(&Blend::WEIGHT, &blend.weight, &Range::UNIT).map_err(within)?;
    // The problem of a part without a number has been reported.
    let part = |name: &String| numbers.get(name).copied().flatten();
    let (Some(first), Some(second)) = (part(&blend.first), part(&blend.second)) else { return Ok(()) };
    let parts = [first, second].map(|part| &instances[part as usize]);
    let of_parts = parts[0].properties.or(parts[1].properties);
    if of_parts.transmits && instances[number].one_sided {
        return Err(Problem::at("two_sided", "a blend with a material that transmits light has two sides", "remove this"));
    }
    let by_side = blend.by_side.then_some(NumberSource::Constant(BY_SIDE));
    let merged = if blend.by_side { None } else { merged(&instances[number], parts, weight, textures) };
    if let Some(merged) = merged {
        instances[number] = merged;
        tables.copy(if weight == NumberSource::Constant(1.0) { second } else { first }, number as u32);
        return Ok(());
    }
    let instance = &mut instances[number];
    instance.blend = Some(BlendParts { materials: [first, second], weight: by_side.unwrap_or(weight) });
    instance.properties = instance.properties.of_blend(of_parts);
    Ok(())
}

/// How deep blends are nested.
struct Depths<'a> {
    described: &'a BTreeMap<String, MaterialDescription>,
    numbers: &'a Numbers,
    known: BTreeMap<&'a str, usize>,
    /// The blends whose parts are being looked at, each a part of the one before it.
    open: Vec<&'a str>,
}

impl<'a> Depths<'a> {
    /// Number of blends within each other in a material: 0 for all other kinds. A problem is reported once: the blends that lead to it
    /// then count as known.
    fn of(&mut self, name: &'a str) -> Result<usize, Problem> {
        let found = self.depth(name);
        if found.is_err() {
            let open = std::mem::take(&mut self.open);
            self.known.extend(open.into_iter().map(|name| (name, 0)));
        }
        found
    }

    fn depth(&mut self, name: &'a str) -> Result<usize, Problem> {
        if let Some(depth) = self.known.get(name) {
            return Ok(*depth);
        }
        let Some(MaterialDescription { kind: Material::Blend(blend), .. }) = self.described.get(name) else { return Ok(0) };
        self.open.push(name);
        let mut depth = 0;
        for (key, part) in [("first", &blend.first), ("second", &blend.second)] {
            let at = || Path::of("materials").key(name).key("blend").key(key);
            let problem = |message: String, label: &str| Problem::at("", message, label).within(&at());
            if !self.numbers.contains_key(part) {
                return Err(Problem::not_defined("", Family::Material, part, self.numbers.keys()).within(&at()));
            }
            if let Some(start) = self.open.iter().position(|open| open == part) {
                let circle = self.open[start..].iter().chain([&self.open[start]]);
                let shown: Vec<String> = circle.map(|name| format!("`{}`", quote::piece(name))).collect();
                return Err(problem(format!("blends in a circle: {}", shown.join(" uses ")), "this closes the circle"));
            }
            if self.open.len() > DEEPEST {
                return Err(problem(format!("blends are nested deeper than {DEEPEST}"), "too deep"));
            }
            depth = depth.max(self.depth(part)?);
            if depth >= DEEPEST {
                return Err(problem(format!("blends are nested deeper than {DEEPEST}"), "too deep"));
            }
        }
        self.open.pop();
        self.known.insert(name, depth + 1);
        Ok(depth + 1)
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Scene, SceneError, parse};

    fn scene(materials: &str) -> Result<Scene, SceneError> {
        let text = format!(
            "format = 1\nenvironment.radiance = 1\n\
             camera = {{ eye = [0, 0, 9], look_at = [0, 0, 0], fov = 60, resolution = [8, 8] }}\n{materials}\n\
             [[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = 'top'"
        );
        parse("blends.toml", text)
    }

    const PARTS: &str =
        "materials.white.lambertian.albedo = 0.5\nmaterials.glass.dielectric.ior = 1.5\nmaterials.hole.null = {}\n";

    fn refused(materials: &str) -> String {
        scene(&format!("{PARTS}{materials}")).err().expect("it is wrong").report()
    }

    #[test]
    fn a_blend_has_the_properties_of_its_parts() {
        let blend = |parts: &str| {
            let scene = scene(&format!("{PARTS}materials.top.blend = {{ {parts} }}"))
                .unwrap_or_else(|error| panic!("{}", error.report()));
            scene.material(&scene.objects[0]).expect("it has one").properties
        };
        let with_glass = blend("first = 'white', second = 'glass'");
        assert!(with_glass.has_inside && with_glass.transmits && with_glass.diffuse && !with_glass.passes);
        assert_eq!(with_glass.albedo, 0.5);
        let with_hole = blend("first = 'white', second = 'hole', weight = 0.2");
        assert!(with_hole.passes && !with_hole.has_inside);
    }

    #[test]
    fn circles_depth_and_unknown_parts_are_refused_by_name() {
        let circle = refused(
            "materials.top.blend = { first = 'white', second = 'other' }\nmaterials.other.blend = { first = 'top', second = 'white' }",
        );
        assert!(circle.contains("blends in a circle: `other` uses `top` uses `other`"), "{circle}");
        let itself = refused("materials.top.blend = { first = 'top', second = 'white' }");
        assert!(itself.contains("`top` uses `top`"), "{itself}");
        let unknown = refused("materials.top.blend = { first = 'white', second = 'wite' }");
        assert!(unknown.contains("there is no material `wite`") && unknown.contains("did you mean `white`?"), "{unknown}");
        let nested = |depth: usize| {
            let level = |i: usize| {
                let name = if i + 1 == depth { "top".to_owned() } else { format!("level{i}") };
                let first = if i == 0 { "white".to_owned() } else { format!("level{}", i - 1) };
                format!("materials.{name}.blend = {{ first = '{first}', second = '{first}' }}\n")
            };
            format!("{PARTS}{}", (0..depth).map(level).collect::<String>())
        };
        assert!(scene(&nested(16)).is_ok());
        let deep = scene(&nested(17)).err().expect("it is too deep").report();
        assert!(deep.contains("blends are nested deeper than 16"), "{deep}");
    }

    #[test]
    fn a_blend_with_glass_has_two_sides() {
        let report = refused("materials.top = { blend = { first = 'white', second = 'glass' }, two_sided = false }");
        assert!(report.contains("a blend with a material that transmits light has two sides"), "{report}");
    }

    /// A blend of blends doubles its parts with every level, but not its rows.
    #[test]
    fn equal_parts_share_a_row() {
        let level = |i: usize| {
            let first = if i == 0 { "glass".to_owned() } else { format!("level{}", i - 1) };
            format!("materials.level{i}.blend = {{ first = '{first}', second = '{first}' }}\n")
        };
        let levels: String = (0..15).map(level).collect();
        let scene = scene(&format!("{PARTS}{levels}materials.top.blend = {{ first = 'level14', second = 'hole' }}"))
            .unwrap_or_else(|error| panic!("{}", error.report()));
        // The sphere, its blend, the 15 levels, and two other materials.
        assert_eq!((scene.surfaces.rows.len(), scene.surfaces.blends.len()), (19, 16));
    }
}
