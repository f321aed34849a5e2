//! Albedo tables of coats and interfaces, which materials share.
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use super::{
    Distribution, albedo,
    albedo_table::{self, Tabulated},
    anisotropic_interface, anisotropic_loss, dielectric_albedo,
    ggx::SMOOTH,
    missing_energy,
};
use noisefall_base::{declare::Precision, math::SimdLevel};

/// An interface with energy compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// Index of refraction.
    pub eta: f32,
    /// α; `None` if it varies.
    pub alpha: Option<f32>,
    /// Anisotropy of the facets.
    pub anisotropy: f32,
}

/// Parameters of a table.
#[derive(Clone, Copy, PartialEq)]
enum TableOf {
    /// A function of a coat.
    Coat(Tabulated),
    /// An interface, or none.
    Interface(Option<Interface>),
}

/// The rows of one table.
#[derive(Clone)]
struct MaterialTable {
    of: TableOf,
    precision: Precision,
    rows: Arc<Vec<[f32; 4]>>,
}

/// The tables of the materials of a scene, one after the other. Materials with the same parameters share them.
#[derive(Default)]
pub struct Tables {
    pub rows: Vec<[f32; 4]>,
    /// The table of compensated conductors; empty without any.
    pub loss: &'static [[f32; 4]],
    /// The table for anisotropic facets.
    anisotropic_loss: &'static [[f32; 4]],
    /// Whether some dielectric is compensated.
    pub compensates_dielectrics: bool,
    /// The tables so far, and their first rows.
    tables: Vec<(MaterialTable, u32)>,
    /// Tables of the previous compile, which are reused.
    before: Vec<MaterialTable>,
    precision: Precision,
    /// The time that each table took to make; `None` for tables that were reused.
    pub times: Vec<Option<Duration>>,
}

/// Tables of previous compiles that are kept though the last one did not need them.
const MOST_UNUSED: usize = 96;

impl Tables {
    /// No tables yet; those of previous compiles are reused, so that an edit that is undone takes no time.
    pub fn after(before: &Tables, precision: Precision) -> Tables {
        let used: Vec<MaterialTable> = before.tables.iter().map(|(table, _)| table.clone()).collect();
        let is_used = |table: &MaterialTable| used.iter().any(|used| used.of == table.of);
        let unused: Vec<MaterialTable> =
            before.before.iter().filter(|table| !is_used(table)).take(MOST_UNUSED).cloned().collect();
        let all = used.into_iter().chain(unused);
        let before = all.filter(|table| precision == Precision::Interactive || table.precision == Precision::Exact);
        Tables { before: before.collect(), precision, ..Tables::default() }
    }

    /// Whether all tables are exact.
    pub fn are_exact(&self) -> bool {
        self.tables.iter().all(|(table, _)| table.precision == Precision::Exact)
    }

    /// Adds the tables of compensated conductors.
    pub fn need_loss(&mut self, anisotropic: bool) {
        self.loss = &albedo::LOSS;
        if anisotropic {
            self.anisotropic_loss = &anisotropic_loss::PARTS;
        }
    }

    /// The tables of compensated conductors, for round and for anisotropic facets.
    #[inline(always)]
    pub fn losses(&self) -> [&'static [[f32; 4]]; 2] {
        [self.loss, self.anisotropic_loss]
    }

    /// The first row of the table of a coat.
    pub fn coat(&mut self, ior: f32) -> u32 {
        self.table(TableOf::Coat(Tabulated::Coat(ior)))
    }

    /// The first row of the table of light that is refracted once by a coat.
    pub fn refraction(&mut self, ior: f32, distribution: Distribution) -> u32 {
        self.table(TableOf::Coat(Tabulated::Refraction(ior, distribution)))
    }

    /// The first row of the table of an interface; without an interface, that of no compensation.
    pub fn interface(&mut self, interface: Option<Interface>) -> u32 {
        self.compensates_dielectrics |= interface.is_some();
        self.table(TableOf::Interface(interface))
    }

    fn table(&mut self, of: TableOf) -> u32 {
        if let Some((_, first)) = self.tables.iter().find(|(table, _)| table.of == of) {
            return *first;
        }
        let (table, took) = match self.before.iter().find(|table| table.of == of) {
            Some(table) => (table.clone(), None),
            None => {
                let start = Instant::now();
                let precision = if of.takes_long() { self.precision } else { Precision::Exact };
                (MaterialTable { of, precision, rows: Arc::new(of.rows(precision)) }, Some(start.elapsed()))
            }
        };
        self.times.push(took);
        let first = self.rows.len() as u32;
        self.rows.extend(table.rows.iter());
        self.tables.push((table, first));
        first
    }
}

impl TableOf {
    /// Whether it takes longer than a frame of the window.
    fn takes_long(self) -> bool {
        matches!(self, TableOf::Interface(Some(_)))
    }

    fn rows(self, precision: Precision) -> Vec<[f32; 4]> {
        match self {
            TableOf::Coat(of) => albedo_table::build(SimdLevel::best(), of),
            TableOf::Interface(None) => missing_energy::nothing_missing(),
            TableOf::Interface(Some(Interface { eta, alpha, anisotropy })) if anisotropy > 0.0 => {
                anisotropic_interface::rows(eta, alpha.map(|alpha| alpha.clamp(SMOOTH, 1.0)), anisotropy, precision)
            }
            TableOf::Interface(Some(Interface { eta, alpha: Some(alpha), .. })) => {
                dielectric_albedo::uniform_rows(eta, alpha.clamp(SMOOTH, 1.0), precision)
            }
            TableOf::Interface(Some(Interface { eta, alpha: None, .. })) => dielectric_albedo::textured_rows(eta, precision),
        }
    }
}
