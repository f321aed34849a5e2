//! The materials of a scene as tables for the kernel.
use super::{Material, albedo, albedo_table, fresnel, ggx::SMOOTH};
use crate::math::{F, Lanes, M, SimdLevel, U, V};

/// Which shading a material needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BsdfKind {
    Lambertian,
    Mirror,
    Conductor,
    Dielectric,
    RoughDielectric,
    Plastic,
}

/// What a bsdf depends on besides its material, lane by lane.
pub struct Local<L: Lanes> {
    /// Number of the material in [`Materials`].
    pub material: U<L>,
    /// Albedo, or reflectance at normal incidence, at the point; white for kinds without.
    pub colour: V<L>,
    /// Width of the distribution of microfacet slopes; those of rough kinds are kept from [`SMOOTH`] up.
    pub alpha: F<L>,
    /// The viewer is on the side of the geometric normal.
    pub front: M<L>,
}

/// Constants of the materials, by number.
///
/// | kind | row 0 | row 1 | row 2 |
/// |---|---|---|---|
/// | mirror, conductor | average Fresnel of an index, mode | η, compensated | k, – |
/// | dielectric | inside over outside index, α, table, compensated | transmittance, – | – |
/// | plastic | index, T_avg of a smooth coat, table, rough | – | – |
///
/// A table is the number of its first row in `tables`, as bits.
#[derive(Default)]
pub struct Materials {
    pub(super) rows: Vec<[f32; 4]>,
    pub(super) tables: Vec<[f32; 4]>,
    /// Of compensated conductors; empty when there is none.
    pub(super) loss: &'static [[f32; 4]],
    kinds: Vec<BsdfKind>,
}

const ROWS: u32 = 3;

impl Materials {
    pub fn new(materials: &[Material]) -> Self {
        let mut coats = Vec::new();
        let mut all = Materials { kinds: materials.iter().map(Material::kind).collect(), ..Materials::default() };
        for material in materials {
            let rows = all.describe(material, &mut coats);
            all.rows.extend(rows);
        }
        all
    }

    pub fn kind(&self, material: usize) -> BsdfKind {
        self.kinds[material]
    }

    #[inline(always)]
    pub(super) fn first_row<L: Lanes>(material: U<L>) -> U<L> {
        material * ROWS
    }

    fn describe(&mut self, material: &Material, coats: &mut Vec<f32>) -> [[f32; 4]; ROWS as usize] {
        let mut rows = [[0.0; 4]; ROWS as usize];
        match *material {
            Material::Lambertian { .. } | Material::Mirror { .. } => {}
            Material::Conductor { ref fresnel, compensated, .. } => {
                rows = fresnel::rows(fresnel);
                if compensated {
                    rows[1][3] = 1.0;
                    self.loss = &albedo::LOSS;
                }
            }
            Material::Dielectric { ior, ior_outside, alpha, transmittance: [r, g, b], compensated } => {
                rows[0] = [ior / ior_outside, alpha, 0.0, f32::from(u8::from(compensated))];
                rows[1] = [r, g, b, 0.0];
            }
            Material::Plastic { ior, alpha, .. } => {
                let smooth = 1.0 - fresnel::dielectric_average(ior);
                rows[0] = [ior, smooth, 0.0, 0.0];
                if alpha >= SMOOTH {
                    rows[0] = [ior, smooth, f32::from_bits(self.coat(ior, coats)), 1.0];
                }
            }
        }
        rows
    }

    /// The first row of the table of a coat; coats of the same index share it.
    fn coat(&mut self, ior: f32, coats: &mut Vec<f32>) -> u32 {
        let known = coats.iter().position(|known| *known == ior).unwrap_or_else(|| {
            coats.push(ior);
            self.tables.extend(albedo_table::build(SimdLevel::best(), Some(ior)));
            coats.len() - 1
        });
        (known * albedo_table::ROWS) as u32
    }
}

impl Material {
    /// Which shading it needs; smooth below the roughness [`SMOOTH`].
    pub fn kind(&self) -> BsdfKind {
        match *self {
            Material::Lambertian { .. } => BsdfKind::Lambertian,
            Material::Mirror { .. } => BsdfKind::Mirror,
            Material::Conductor { alpha, .. } if alpha < SMOOTH => BsdfKind::Mirror,
            Material::Conductor { .. } => BsdfKind::Conductor,
            Material::Dielectric { alpha, .. } if alpha < SMOOTH => BsdfKind::Dielectric,
            Material::Dielectric { .. } => BsdfKind::RoughDielectric,
            Material::Plastic { .. } => BsdfKind::Plastic,
        }
    }
}
