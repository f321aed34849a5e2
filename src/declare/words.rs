//! Families of kinds that are a word and code, without parameters.

/// Makes the enum of a family from the list of its kinds, which stand in a module each.
///
/// A line in the list is the only place outside a kind's own file that names it, but for the kind that is the default. Each kind is a
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

            /// How scene files, the command line and people call it.
            pub const fn word(self) -> $crate::declare::Word {
                match self {
                    $($Family::$Kind => <$module::$Kind as $Trait>::WORD),+
                }
            }

            /// What scene files and the command line call it.
            pub const fn name(self) -> &'static str {
                self.word().name
            }

            /// What the window calls it.
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
