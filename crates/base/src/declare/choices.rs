//! Families of kinds that are `Copy`, some of them without parameters.

/// Makes the enum of a family from the list of its kinds, each in a module of its own.
///
/// A line in the list is the only place outside a kind's own file that names it, except for the default kind. A kind with
/// parameters is named twice, so that its variant holds them. The last line names a macro: `in_family!(value, kind => call(kind))` is
/// the call with the kind of a value.
#[macro_export]
macro_rules! choices {
    (
        $(#[$attribute:meta])*
        pub enum $Family:ident, $what:literal, default $default:ident::$Default:ident {
            $($module:ident::$Kind:ident $(($Values:ident))?),+ $(,)?
        }
        $dispatch:ident
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum $Family {
            $(
                #[doc = concat!("The kind in `", stringify!($module), ".rs`.")]
                $Kind $(($module::$Values))?
            ),+
        }

        macro_rules! $dispatch {
            ($value:expr, $kind:ident => $call:expr) => {
                match $value {
                    $($Family::$Kind $(($kind @ $module::$Values { .. }))? => {
                        let $kind = $crate::declare::kind_of!($module::$Kind $(, $kind as $Values)?);
                        $call
                    })+
                }
            };
        }

        impl $crate::declare::OneOf for $Family {
            const WHAT: &'static str = $what;

            fn alternatives() -> Vec<Self> {
                vec![$(<$module::$Kind>::default().into()),+]
            }

            fn place(&self) -> usize {
                let names = [$(<$module::$Kind as $crate::declare::Kind>::KIND.key),+];
                names.iter().position(|name| *name == self.about().key).unwrap_or_default()
            }

            fn name(&self) -> &'static str {
                self.about().key
            }

            fn about(&self) -> $crate::declare::Parameter {
                match self {
                    $($Family::$Kind { .. } => <$module::$Kind as $crate::declare::Kind>::KIND),+
                }
            }

            fn chosen(&mut self, p: &mut dyn $crate::declare::Parameters) {
                $dispatch!(self, kind => $crate::declare::Kind::chosen(kind, p));
            }
        }

        impl $crate::declare::Declare for $Family {
            fn parameters(&mut self, p: &mut dyn $crate::declare::Parameters) {
                p.one_of(self);
            }
        }

        impl Default for $Family {
            fn default() -> Self {
                <$default::$Default>::default().into()
            }
        }

        $(impl From<$module::$Kind> for $Family {
            #[allow(unused_variables, reason = "a type without parameters is its name")]
            fn from(kind: $module::$Kind) -> Self {
                $Family::$Kind $(($module::$Values::from(kind)))?
            }
        })+
    };
}
pub use choices;

/// The kind of a variant: its content, or a kind without parameters.
#[macro_export]
macro_rules! kind_of {
    ($Kind:path) => {
        &mut <$Kind>::default()
    };
    ($Kind:path, $kind:ident as $Values:ident) => {
        $kind
    };
}
pub use kind_of;
