//! The list of the laws of a kind, written once.

use super::loading::Elastic;
use crate::loading::two_bodies::TwoBodies;

/// Makes the laws of a kind public, and an enum of them for programs that choose a law while they run.
///
/// An entry has the module and the type of a law, its constants, its name in scenes, and their reference values; one type can be
/// several laws. Constants that no scene changes are those of `or`.
/// After the entries come the laws with the passivity guard, and those with a form for two bodies, each with the variant
/// of that form.
macro_rules! laws {
    (
        $(#[$says:meta])*
        pub enum $any:ident: $interface:ty {
            $($module:ident::$law:ident [$($constant:ident),*] $(or $others:ident::$of_others:ident)? {
                $($name:literal = $reference:expr),+ $(,)?
            })+
        }
        $(guarded { $($bare:ident as $guarded:ident),+ $(,)? })?
        $(paired { $($plain:ident as $paired:ident),+ $(,)? })?
        $(springs { $others_module:ident::$spring:ident })?
    ) => {
        $(pub use $module::$law;)+
        $(pub use $others_module::$spring;)?

        /// Numbers of the laws.
        #[derive(Clone, Copy)]
        enum Code {
            $($law,)+
            $($($guarded,)+)?
        }

        $(#[$says])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[allow(clippy::large_enum_variant, reason = "there is no heap for the table of a pair")]
        pub enum $any {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)+
            $($(#[doc = "See [`Guarded`]."] $guarded(Guarded<$bare>),)+)?
            $($(#[doc = "See [`Paired`]."] $paired(Paired),)+)?
            $(#[doc = "The spring of a rate-dependent law, which is no law of its own."] $spring($spring),)?
        }

        impl $any {
            /// All laws with their names in a scene and their reference constants.
            pub const ALL: [(&'static str, $any); [$($($name),+),+].len()] = [$($(($name, $any::$law($reference)),)+)+];

            /// The law as numbers. The form for two bodies has those of the law itself.
            pub fn numbers(&self) -> LawNumbers {
                match self {
                    $($any::$law(law) => {
                        let _ = law;
                        LawNumbers::new(Code::$law as u64, &[$(Constant::to_number(law.$constant)),*])
                    })+
                    $($($any::$guarded(Guarded(law)) => {
                        let plain = $any::$bare(*law).numbers();
                        LawNumbers { law: Code::$guarded as u64, ..plain }
                    })+)?
                    $($($any::$paired(form) => $any::$plain(form.law).numbers(),)+)?
                    $($any::$spring(_) => LawNumbers::NONE,)?
                }
            }

            fn law(&self) -> &$interface {
                match self {
                    $($any::$law(law) => law,)+
                    $($($any::$guarded(law) => law,)+)?
                    $($($any::$paired(law) => law,)+)?
                    $($any::$spring(law) => law,)?
                }
            }
        }

        $(impl Numbered for $law {
            const FIRST: $law = [$($reference),+][0];

            #[inline(always)]
            fn from_numbers(numbers: &LawNumbers) -> Option<$law> {
                let mut constants = numbers.constants.iter();
                let mut next = || constants.next().copied().unwrap_or(f64::NAN);
                let law = $law { $($constant: Constant::of_number(next())?,)* $(..$others::$of_others)? };
                let _ = next();
                Some(law)
            }
        })+

        impl Numbered for $any {
            const FIRST: $any = $any::ALL[0].1;

            fn from_numbers(numbers: &LawNumbers) -> Option<$any> {
                $(if numbers.law == Code::$law as u64 {
                    return Numbered::from_numbers(numbers).map($any::$law);
                })+
                $($(if numbers.law == Code::$guarded as u64 {
                    return Numbered::from_numbers(numbers).map($any::$guarded);
                })+)?
                None
            }

            $(fn of_bodies(self, bodies: TwoBodies) -> $any {
                match self {
                    $($any::$plain(law) => $any::$paired(Paired::new(law, bodies)),)+
                    $($any::$paired(form) => $any::$paired(form.of_bodies(bodies)),)+
                    law => law,
                }
            })?

            $(fn of_spring(spring: $spring) -> Option<$any> {
                Some($any::$spring(spring))
            })?
        }

        $(impl Numbered for $spring {
            const FIRST: $spring = $spring { force: 0.0, depth: 1.0, exponent: 1.0 };

            fn from_numbers(_numbers: &LawNumbers) -> Option<$spring> {
                None
            }

            #[inline(always)]
            fn of_spring(spring: $spring) -> Option<$spring> {
                Some(spring)
            }
        })?

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
            $(impl Numbered for Paired {
                const FIRST: Paired = Paired::new($plain::FIRST, TwoBodies::under_rigid(0.0));

                #[inline(always)]
                fn from_numbers(numbers: &LawNumbers) -> Option<Paired> {
                    Some(Paired::new($plain::from_numbers(numbers)?, Paired::FIRST.bodies))
                }

                #[inline(always)]
                fn of_bodies(self, bodies: TwoBodies) -> Paired {
                    Paired::new(self.law, bodies)
                }
            })+

            impl $any {
                /// Whether the law takes each of two bodies for itself.
                pub fn takes_both_bodies(&self) -> bool {
                    matches!(self, $($any::$plain(_) | $any::$paired(_))|+) || self.is_line()
                }

                /// Its form for two bodies, if it is one.
                fn form(&self) -> Option<&Paired> {
                    match self {
                        $($any::$paired(form) => Some(form),)+
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

/// More constants than a law has.
const MOST_CONSTANTS: usize = 14;

/// A law as numbers, for data that a program reads while it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LawNumbers {
    /// The number of the law.
    pub law: u64,
    /// Its constants, and zeros.
    pub constants: [f64; MOST_CONSTANTS],
}

impl LawNumbers {
    /// The numbers of no law.
    pub const NONE: LawNumbers = LawNumbers { law: u64::MAX, constants: [0.0; MOST_CONSTANTS] };

    /// The law of this number with these constants.
    pub(super) fn new(law: u64, constants: &[f64]) -> LawNumbers {
        let mut numbers = LawNumbers { law, ..LawNumbers::NONE };
        numbers.constants.iter_mut().zip(constants).for_each(|(slot, constant)| *slot = *constant);
        numbers
    }
}

/// A law that data give: its constants for the type of one law, and which law it is for a type of many.
pub trait Numbered: Copy {
    /// The law in place of one that numbers do not give.
    const FIRST: Self;

    /// The law with these numbers; `None` if they give none.
    fn from_numbers(numbers: &LawNumbers) -> Option<Self>;

    /// The law for these two bodies, if it takes each of them for itself.
    #[inline(always)]
    fn of_bodies(self, _bodies: TwoBodies) -> Self {
        self
    }

    /// The law of this spring, if it can be one.
    #[inline(always)]
    fn of_spring(_spring: Elastic) -> Option<Self> {
        None
    }
}

/// A constant of a law as a number.
pub(super) trait Constant: Sized {
    /// The number.
    fn to_number(self) -> f64;

    /// The constant with this number; `None` if there is none.
    fn of_number(number: f64) -> Option<Self>;
}

impl Constant for f64 {
    fn to_number(self) -> f64 {
        self
    }

    #[inline(always)]
    fn of_number(number: f64) -> Option<f64> {
        Some(number)
    }
}

/// A variant of a list as the number of its place.
macro_rules! numbered {
    ($list:ident) => {
        impl $crate::laws::Constant for $list {
            fn to_number(self) -> f64 {
                f64::from(self as u8)
            }

            #[inline(always)]
            fn of_number(number: f64) -> Option<$list> {
                // the variants have the order of the list, so that a compiler that knows the number need not search
                const _: () = {
                    let mut place = 0;
                    while place < $list::ALL.len() {
                        assert!($list::ALL[place].1 as usize == place);
                        place += 1;
                    }
                };
                let (_, found) = *$list::ALL.get(number as usize)?;
                (found.to_number() == number).then_some(found)
            }
        }
    };
}

pub(super) use numbered;
