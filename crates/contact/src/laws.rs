//! The list of the laws of a kind, written once.

/// Makes the laws of a kind public, and an enum of them for programs that choose a law while they run.
///
/// An entry has the module and the type of a law, its name in scenes, and its reference constants; one type can be several laws.
/// After the entries come the laws with the passivity guard, and those with a form for two bodies, each with the variant
/// of that form.
macro_rules! laws {
    (
        $(#[$says:meta])*
        pub enum $any:ident: $interface:ty {
            $($module:ident::$law:ident { $($name:literal = $reference:expr),+ $(,)? })+
        }
        $(guarded { $($bare:ident as $guarded:ident),+ $(,)? })?
        $(paired { $($plain:ident as $paired:ident),+ $(,)? })?
    ) => {
        $(pub use $module::$law;)+

        $(#[$says])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum $any {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)+
            $($(#[doc = "See [`Guarded`]."] $guarded(Guarded<$bare>),)+)?
            $($(#[doc = "See [`Paired`]."] $paired(Paired),)+)?
        }

        impl $any {
            /// All laws with their names in a scene and their reference constants.
            pub const ALL: [(&'static str, $any); [$($($name),+),+].len()] = [$($(($name, $any::$law($reference)),)+)+];

            fn law(&self) -> &$interface {
                match self {
                    $($any::$law(law) => law,)+
                    $($($any::$guarded(law) => law,)+)?
                    $($($any::$paired(law) => law,)+)?
                }
            }
        }

        $(
            $(impl guarded::Hertzian for $bare {})+

            impl $any {
                /// The law with the passivity guard; `None` for a law that has no guarded form.
                pub fn guarded(self) -> Option<$any> {
                    match self {
                        $($any::$bare(law) => Some($any::$guarded(Guarded(law))),)+
                        _ => None,
                    }
                }
            }
        )?

        $(
            impl $any {
                /// Whether the law takes each of two bodies for itself.
                pub fn takes_both_bodies(&self) -> bool {
                    matches!(self, $($any::$plain(_) | $any::$paired(_))|+)
                }

                /// The law for these two bodies, with their Poisson's ratios; `None` for a law that has no such form.
                pub fn paired(self, bodies: TwoBodies) -> Option<$any> {
                    match self {
                        $($any::$plain(law) => Some($any::$paired(Paired { law, bodies })),)+
                        $($any::$paired(form) => Some($any::$paired(Paired { bodies, ..form })),)+
                        _ => None,
                    }
                }

                /// The law with its form for two bodies changed, if it is one.
                fn with_form(self, change: impl Fn(Paired) -> Paired) -> $any {
                    match self {
                        $($any::$paired(form) => $any::$paired(change(form)),)+
                        law => law,
                    }
                }
            }
        )?
    };
}

pub(super) use laws;
