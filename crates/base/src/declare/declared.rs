//! The traits of what is declared: tables of parameters, kinds of a family, and choices between kinds.
use super::{parameter::Parameter, visitor::Parameters};

/// Something with parameters.
pub trait Declare {
    /// Visits every parameter, in reading order.
    fn parameters(&mut self, p: &mut dyn Parameters);
}

/// A kind of a family: a table of its own at the key of its name.
pub trait Kind: Declare + Default {
    /// Name and description of the kind.
    const KIND: Parameter;

    /// The kind as its family's choice sees it: its parameters, in a table that must be given at the key of its name.
    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND.required(), self);
    }
}

/// Mutually exclusive alternatives, distinguished by their keys.
pub trait OneOf: Sized {
    /// Name of the choice: "material", "environment".
    const WHAT: &'static str;

    /// Every alternative with its default values, in the order of the catalogue.
    fn alternatives() -> Vec<Self>;

    /// The place of this one among the alternatives.
    fn place(&self) -> usize;

    /// Name of this alternative in scene files and messages.
    fn name(&self) -> &'static str;

    /// Its name, with its title and description in the window.
    fn about(&self) -> Parameter {
        Parameter::new(self.name(), "")
    }

    /// The parameters of this alternative.
    fn chosen(&mut self, p: &mut dyn Parameters);
}
