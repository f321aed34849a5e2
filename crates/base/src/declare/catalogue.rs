//! Families of kinds.

/// Makes the enum of a family from the list of its kinds, each in a module of its own.
///
/// A line in the list is the only place outside a kind's own file that names it. The enum holds the description of one kind; it reads,
/// writes and compares as that kind does, and lends it as `&dyn` of the family's trait.
#[macro_export]
macro_rules! catalogue {
    ($(#[$attribute:meta])* pub enum $Family:ident: $Trait:ident, $what:literal { $($module:ident::$Kind:ident),+ $(,)? }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq)]
        #[allow(clippy::large_enum_variant, reason = "scenes hold few descriptions, and edit them in place")]
        pub enum $Family {
            $(
                #[doc = concat!("The kind in `", stringify!($module), ".rs`.")]
                $Kind($module::$Kind)
            ),+
        }

        impl $crate::declare::OneOf for $Family {
            const WHAT: &'static str = $what;

            fn alternatives() -> Vec<Self> {
                vec![$($Family::$Kind(Default::default())),+]
            }

            fn place(&self) -> usize {
                let names = [$(<$module::$Kind as $crate::declare::Kind>::KIND.key),+];
                names.iter().position(|name| *name == self.name()).unwrap_or_default()
            }

            fn name(&self) -> &'static str {
                $Family::name(self)
            }

            fn about(&self) -> $crate::declare::Parameter {
                match self {
                    $($Family::$Kind(_) => <$module::$Kind as $crate::declare::Kind>::KIND),+
                }
            }

            fn chosen(&mut self, p: &mut dyn $crate::declare::Parameters) {
                match self {
                    $($Family::$Kind(kind) => $crate::declare::Kind::chosen(kind, p)),+
                }
            }
        }

        impl $Family {
            /// Name of the kind in scene files.
            pub fn name(&self) -> &'static str {
                match self {
                    $($Family::$Kind(_) => <$module::$Kind as $crate::declare::Kind>::KIND.key),+
                }
            }

            /// The kind, as the trait of its family.
            pub fn kind(&self) -> &dyn $Trait {
                match self {
                    $($Family::$Kind(kind) => kind),+
                }
            }
        }

        /// The descriptions of all kinds.
        pub mod kinds {
            $(pub use super::$module::$Kind;)+
        }

        impl Default for $Family {
            fn default() -> Self {
                <Self as $crate::declare::OneOf>::alternatives().swap_remove(0)
            }
        }

        $(impl From<$module::$Kind> for $Family {
            fn from(kind: $module::$Kind) -> Self {
                $Family::$Kind(kind)
            }
        })+
    };
}
pub use catalogue;
