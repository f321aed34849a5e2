//! The materials of a scene as tables for the kernel.
use super::{Material, albedo, albedo_table, dielectric_albedo, fresnel, ggx::SMOOTH, missing_energy, rough_dielectric::FAINT};
use crate::math::{F, Lanes, M, SimdLevel, U, V};

/// The type of BSDF that a material needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BsdfKind {
    Lambertian,
    Mirror,
    Conductor,
    Dielectric,
    RoughDielectric,
    Plastic,
}

/// Local parameters of a BSDF, per lane.
pub struct Local<L: Lanes> {
    /// Number of the material in [`Materials`].
    pub material: U<L>,
    /// Albedo, or reflectance at normal incidence, at the point; white for types without.
    pub colour: V<L>,
    /// Width α of the GGX distribution; at least [`SMOOTH`] for rough types.
    pub alpha: F<L>,
    /// Lanes whose viewer is on the side of the geometric normal.
    pub front: M<L>,
}

/// Constants of the materials, by number.
///
/// | type | row 0 | row 1 | row 2 |
/// |---|---|---|---|
/// | mirror, conductor | average Fresnel of an index, mode | η, compensated | k, – |
/// | dielectric | inside over outside index, table, roughness varies, – | – | – |
/// | plastic | index, T_avg of a smooth coat, table, rough | – | – |
///
/// A table is the number of its first row in `tables`, as bits.
#[derive(Default)]
pub struct Materials {
    pub(super) rows: Vec<[f32; 4]>,
    pub(super) tables: Vec<[f32; 4]>,
    /// Table of compensated conductors; empty if there are none.
    pub(super) loss: &'static [[f32; 4]],
    /// Whether any dielectric is compensated.
    pub(super) compensated_dielectrics: bool,
    kinds: Vec<BsdfKind>,
}

const ROWS: u32 = 3;

impl Materials {
    pub fn new(materials: &[Material]) -> Self {
        let mut known = KnownTables::default();
        let mut all = Materials { kinds: materials.iter().map(Material::kind).collect(), ..Materials::default() };
        for material in materials {
            let rows = all.describe(material, &mut known);
            all.rows.extend(rows);
        }
        all
    }

    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }

    pub fn kind(&self, material: usize) -> BsdfKind {
        self.kinds[material]
    }

    #[inline(always)]
    pub(super) fn first_row<L: Lanes>(material: U<L>) -> U<L> {
        material * ROWS
    }

    fn describe(&mut self, material: &Material, known: &mut KnownTables) -> [[f32; 4]; ROWS as usize] {
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
            Material::Dielectric { ior, ior_outside, alpha, varies, compensated } => {
                let eta = ior / ior_outside;
                rows[0] = [eta, 0.0, 0.0, 0.0];
                if alpha >= SMOOTH {
                    let compensated = compensated && (eta - 1.0).abs() >= FAINT;
                    self.compensated_dielectrics |= compensated;
                    let table = compensated.then_some((eta, if varies { None } else { Some(alpha) }));
                    rows[0][1] = f32::from_bits(self.interface(table, known));
                    rows[0][2] = f32::from(u8::from(varies && compensated));
                }
            }
            Material::Plastic { ior, alpha, .. } => {
                let smooth = 1.0 - fresnel::dielectric_average(ior);
                rows[0] = [ior, smooth, 0.0, 0.0];
                if alpha >= SMOOTH {
                    rows[0] = [ior, smooth, f32::from_bits(self.coat(ior, known)), 1.0];
                }
            }
        }
        rows
    }

    /// The first row of the table of a coat; coats of the same index share it.
    fn coat(&mut self, ior: f32, known: &mut KnownTables) -> u32 {
        if let Some((_, table)) = known.coats.iter().find(|(index, _)| *index == ior) {
            return *table;
        }
        let table = self.append(albedo_table::build(SimdLevel::best(), Some(ior)));
        known.coats.push((ior, table));
        table
    }

    /// The first row of the table of an interface. `None` has no compensation.
    fn interface(&mut self, interface: Option<Interface>, known: &mut KnownTables) -> u32 {
        if let Some((_, table)) = known.interfaces.iter().find(|(of, _)| *of == interface) {
            return *table;
        }
        let table = self.append(match interface {
            None => missing_energy::nothing_missing(),
            Some((eta, Some(alpha))) => dielectric_albedo::uniform_rows(eta, alpha.clamp(SMOOTH, 1.0)),
            Some((eta, None)) => dielectric_albedo::textured_rows(eta),
        });
        known.interfaces.push((interface, table));
        table
    }

    fn append(&mut self, rows: Vec<[f32; 4]>) -> u32 {
        let first = self.tables.len() as u32;
        self.tables.extend(rows);
        first
    }
}

/// Index of refraction and roughness, which is `None` if it is textured.
type Interface = (f32, Option<f32>);

/// Keys of the existing tables, with their first rows.
#[derive(Default)]
struct KnownTables {
    coats: Vec<(f32, u32)>,
    interfaces: Vec<(Option<Interface>, u32)>,
}

impl Material {
    /// The type of BSDF; smooth below the roughness [`SMOOTH`].
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
