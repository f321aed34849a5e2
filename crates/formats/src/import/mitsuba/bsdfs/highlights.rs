//! The highlights of Mitsuba 0.6 over a diffuse surface: Phong and Ward, each as a mixture with rough metal.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    adapters::blended,
    one_or_two_sided,
    roughness::{self, Facets},
};
use noisefall_scene::{
    material::{Conductor, Distribution, Lambertian, Reflectance, Roughness},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn phong(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    const EXPONENT: f64 = 30.0;
    let exponent = match import.textured_number(element, "exponent", EXPONENT)? {
        Textured::Constant(exponent) => exponent.max(0.0),
        Textured::Texture(_) => {
            import.remark_value(element, "exponent", "30", "the highlight has the same width everywhere")?;
            EXPONENT
        }
    };
    // The normals spread equally (Walter et al., "Microfacet models for refraction through rough surfaces", 2007).
    let facets = Facets {
        roughness: Roughness::Alpha(Textured::Constant((2.0 / (exponent + 2.0)).sqrt())),
        distribution: Distribution::Beckmann,
        anisotropy: 0.0,
        tangent_rotation: 0.0,
    };
    let lobes = Lobes::read(import, element)?;
    let highlight = lobes.highlight(facets, two_sided);
    Ok(lobes.over_diffuse(import, element, highlight, two_sided))
}

pub fn ward(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    element.ignore(&["variant"]);
    // Ward's slopes are those of Beckmann.
    let lobes = Lobes::read(import, element)?;
    let highlight = roughness::rough(import, element, |facets| lobes.highlight(facets, two_sided))?;
    Ok(lobes.over_diffuse(import, element, highlight, two_sided))
}

/// The sum of a diffuse and a specular part, as the mean of both, each divided by its fraction.
struct Lobes {
    diffuse: Textured,
    specular: Textured,
    /// Fraction of the specular part.
    fraction: f64,
}

impl Lobes {
    fn read(import: &mut Import, element: Element) -> Result<Lobes, SceneError> {
        let diffuse = import.colour(element, "diffuse_reflectance", 0.5, Role::Reflectance)?;
        let specular = import.colour(element, "specular_reflectance", 0.2, Role::Reflectance)?;
        let effect = "the highlight has another shape; textured colours are dimmer";
        import.remark(element, "a mixture of diffuse and rough metal", effect);
        let [matt, bright] = [&diffuse, &specular].map(largest);
        Ok(Lobes { diffuse, specular, fraction: if bright > 0.0 { bright / (matt + bright) } else { 0.0 } })
    }

    fn highlight(&self, facets: Facets, two_sided: bool) -> MaterialDescription {
        let Facets { roughness, distribution, anisotropy, tangent_rotation } = facets;
        let fresnel = Reflectance::Constant(divided(self.specular.clone(), self.fraction));
        let metal = Conductor { fresnel, roughness, distribution, anisotropy, tangent_rotation, energy_compensation: false };
        one_or_two_sided(metal, two_sided)
    }

    fn over_diffuse(
        self,
        import: &mut Import,
        element: Element,
        highlight: MaterialDescription,
        two_sided: bool,
    ) -> MaterialDescription {
        let matte = one_or_two_sided(Lambertian { albedo: divided(self.diffuse, 1.0 - self.fraction) }, two_sided);
        if self.fraction == 0.0 {
            return matte;
        }
        if self.fraction == 1.0 {
            return highlight;
        }
        let [first, second] =
            [("diffuse", matte), ("highlight", highlight)].map(|(part, material)| import.part_of(element, part, material));
        blended(import, first, second, Textured::Constant(self.fraction))
    }
}

/// The largest channel; that of a texture is not known here.
fn largest(colour: &Textured) -> f64 {
    match colour {
        Textured::Constant(colour) => colour.iter().copied().fold(0.0, f64::max),
        Textured::Texture(_) => 0.5,
    }
}

/// A colour over its fraction of the surface. A texture could exceed 1, and stays.
fn divided(colour: Textured, fraction: f64) -> Textured {
    match colour {
        Textured::Constant(colour) if fraction > 0.0 => Textured::Constant(colour.map(|x| (x / fraction).min(1.0))),
        colour => colour,
    }
}
