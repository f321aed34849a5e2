//! Albedo tables of coats and interfaces, which materials share.
use super::{albedo, albedo_table, dielectric_albedo, ggx::SMOOTH, missing_energy};
use crate::math::SimdLevel;

/// Index of refraction and roughness of an interface with energy compensation; the roughness is `None` if it varies.
pub type Interface = (f32, Option<f32>);

/// The tables of the materials of a scene, one after the other. Materials with the same parameters share them.
#[derive(Default)]
pub struct Tables {
    pub rows: Vec<[f32; 4]>,
    /// The table of compensated conductors; empty without any.
    pub loss: &'static [[f32; 4]],
    /// Whether some dielectric is compensated.
    pub compensates_dielectrics: bool,
    /// Parameters of the tables so far, and their first rows.
    coats: Vec<(f32, u32)>,
    interfaces: Vec<(Option<Interface>, u32)>,
}

impl Tables {
    /// Adds the table of compensated conductors.
    pub fn need_loss(&mut self) {
        self.loss = &albedo::LOSS;
    }

    /// The first row of the table of a coat.
    pub fn coat(&mut self, ior: f32) -> u32 {
        if let Some((_, table)) = self.coats.iter().find(|(index, _)| *index == ior) {
            return *table;
        }
        let table = self.append(albedo_table::build(SimdLevel::best(), Some(ior)));
        self.coats.push((ior, table));
        table
    }

    /// The first row of the table of an interface; without an interface, that of no compensation.
    pub fn interface(&mut self, interface: Option<Interface>) -> u32 {
        self.compensates_dielectrics |= interface.is_some();
        if let Some((_, table)) = self.interfaces.iter().find(|(of, _)| *of == interface) {
            return *table;
        }
        let table = self.append(match interface {
            None => missing_energy::nothing_missing(),
            Some((eta, Some(alpha))) => dielectric_albedo::uniform_rows(eta, alpha.clamp(SMOOTH, 1.0)),
            Some((eta, None)) => dielectric_albedo::textured_rows(eta),
        });
        self.interfaces.push((interface, table));
        table
    }

    fn append(&mut self, rows: Vec<[f32; 4]>) -> u32 {
        let first = self.rows.len() as u32;
        self.rows.extend(rows);
        first
    }
}
