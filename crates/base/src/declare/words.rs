//! Families of kinds that are a word and code, without parameters.

/// Makes the enum of a family from the list of its kinds, each in a module of its own.
///
/// A line in the list is the only place outside a kind's own file that names it, except for the default kind. Each kind is a
/// type that implements the family's trait, whose `WORD` is its name in files, its title in the window and its sentence. The last line
/// names a macro: `in_family!(value, K => call::<K>(…))` is the call with the type of a value.
#[macro_export]
macro_rules! word_kinds {
    (
        $(#[$attribute:meta])*
        pub enum $Family:ident: $Trait:ident, default $Default:ident { $($module:ident::$Kind:ident),+ $(,)? }
        $dispatch:ident
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $Family {
            $(
                #[doc = concat!("The kind in `", stringify!($module), ".rs`.")]
                $Kind
            ),+
        }

        impl $Family {
            /// All kinds, in the order of the catalogue.
            pub const ALL: [$Family; [$(<$module::$Kind as $Trait>::WORD.name),+].len()] = [$($Family::$Kind),+];

            /// Its name in scene files, on the command line and in messages.
            pub const fn word(self) -> $crate::declare::Word {
                match self {
                    $($Family::$Kind => <$module::$Kind as $Trait>::WORD),+
                }
            }

            /// Its name in scene files and on the command line.
            pub const fn name(self) -> &'static str {
                self.word().name
            }

            /// Its title in the window.
            pub const fn title(self) -> &'static str {
                self.word().title
            }
        }

        impl $crate::declare::Words for $Family {
            fn words() -> &'static [($crate::declare::Word, Self)] {
                const { &[$((<$module::$Kind as $Trait>::WORD, $Family::$Kind)),+] }
            }
        }

        impl Default for $Family {
            fn default() -> Self {
                $Family::$Default
            }
        }

        macro_rules! $dispatch {
            ($value:expr, $K:ident => $call:expr) => {
                match $value {
                    $($Family::$Kind => {
                        type $K = $module::$Kind;
                        $call
                    })+
                }
            };
        }
    };
}
pub use word_kinds;
