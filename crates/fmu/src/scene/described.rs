//! A scene from its data: the macro `scene!`, which the file that the exporter writes calls.
//!
//! The exporter writes data alone: numbers, names and lists. The code that they select is here, where the compiler, the
//! formatter and the reader see it. Conditions on the number of contacts and tables are constants, and cost nothing.

use super::variable::Parameter;
use brinell_contact::losses::{Fitted, Plate, Solid, Waves};

/// The value of each table of a scene, or one for all.
#[inline(always)]
pub fn of_table<T: Copy + Default>(values: &[T], table: usize) -> T {
    match values {
        [only] => *only,
        _ => values.get(table).copied().unwrap_or_default(),
    }
}

/// The start values of parameters that all contacts share: one of each.
pub const fn one_each<const PARAMETERS: usize, const VALUES: usize>(starts: &[f64; PARAMETERS]) -> [f64; VALUES] {
    let mut values = [0.0; VALUES];
    let mut place = 0;
    while place < VALUES && place < PARAMETERS {
        values[place] = starts[place];
        place += 1;
    }
    values
}

/// A loss below yield whose numbers are parameters of a scene.
pub trait LossOfScene {
    /// The loss with the parameters that `value` gives, for a target of this density \[kg/m^3\].
    fn given(value: impl Fn(Parameter) -> f64, density: f64) -> Self;
}

impl LossOfScene for Fitted {
    #[inline(always)]
    fn given(value: impl Fn(Parameter) -> f64, _density: f64) -> Fitted {
        Fitted { restitution: value(Parameter::ElasticRestitution) }
    }
}

impl LossOfScene for Waves {
    #[inline(always)]
    fn given(value: impl Fn(Parameter) -> f64, density: f64) -> Waves {
        Waves { target: target(value, density) }
    }
}

impl LossOfScene for Plate {
    #[inline(always)]
    fn given(value: impl Fn(Parameter) -> f64, density: f64) -> Plate {
        Plate { thickness: value(Parameter::TargetPlateThickness), target: target(value, density) }
    }
}

/// The target as a body in which waves travel.
#[inline(always)]
fn target(value: impl Fn(Parameter) -> f64, density: f64) -> Solid {
    let [youngs_modulus, poissons_ratio] = [Parameter::TargetYoungsModulus, Parameter::TargetPoissonsRatio].map(value);
    Solid { density, youngs_modulus, poissons_ratio }
}

/// The type of a law in one of its forms, or its value, which is a constant so that it is copied as a whole. `bodies` are what the
/// form for two bodies knows of them.
#[doc(hidden)]
#[macro_export]
macro_rules! __law {
    (type $kind:ident plain $law:ident) => { $crate::contact::$kind::$law };
    (type $kind:ident guarded $law:ident) => { $crate::contact::$kind::Guarded<$crate::contact::$kind::$law> };
    (type loading paired $law:ident) => { $crate::contact::loading::Paired };
    (value $kind:ident plain $law:ident $fields:tt $bodies:ident) => { const { $crate::contact::$kind::$law $fields } };
    (value $kind:ident guarded $law:ident $fields:tt $bodies:ident) => {
        const { $crate::contact::$kind::Guarded($crate::contact::$kind::$law $fields) }
    };
    (value loading paired $law:ident $fields:tt $bodies:ident) => {
        $crate::contact::loading::Paired::new(const { $crate::contact::loading::$law $fields }, $bodies)
    };
}

/// The types of the model and of the contact of a scene with these laws, its value for the bodies `pair`, and the function that
/// moves the bodies. `value` gives parameters, `density` \[kg/m^3\] is that of the target.
#[doc(hidden)]
#[macro_export]
macro_rules! __laws {
    (types damped $law:ident $fields:tt) => {
        type Model = $crate::contact::damped::Model<$crate::contact::damped::$law>;
        type Contact = $crate::contact::damped::History<$crate::contact::damped::$law>;
    };
    (types plain $($laws:tt)+) => {
        type Model = $crate::contact::Model<$crate::__laws!(loading $($laws)+), $crate::__laws!(unloading $($laws)+)>;
        type Contact = $crate::contact::History;
    };
    (types (loss $loss:ident) $($laws:tt)+) => {
        type Model = $crate::contact::losses::Model<
            $crate::__laws!(loading $($laws)+),
            $crate::__laws!(unloading $($laws)+),
            $crate::contact::losses::$loss,
        >;
        type Contact = $crate::contact::losses::History<$crate::contact::losses::$loss>;
    };
    (types (rate $($rates:tt)+) $($laws:tt)+) => {
        type Model = $crate::contact::rate::Model<$crate::__laws!(loading $($laws)+), $crate::__laws!(unloading $($laws)+)>;
        type Contact = $crate::contact::rate::History;
    };
    (types (friction $contact:ident $memory:literal $mean:literal $loss:ident) $($laws:tt)+) => {
        type Model = $crate::contact::tangential::RoughModel<
            $crate::__laws!(loading $($laws)+),
            $crate::__laws!(unloading $($laws)+),
            $crate::contact::losses::$loss,
        >;
        type Contact = $crate::contact::tangential::$contact<
            $memory,
            $mean,
            $crate::contact::losses::History<$crate::contact::losses::$loss>,
        >;
    };
    (types (friction $contact:ident $memory:literal $mean:literal) $($laws:tt)+) => {
        type Model = $crate::contact::tangential::RoughModel<
            $crate::__laws!(loading $($laws)+),
            $crate::__laws!(unloading $($laws)+),
        >;
        type Contact = $crate::contact::tangential::$contact<$memory, $mean>;
    };
    (loading $form:ident $loading:ident $of_loading:tt, $to:ident $unloading:ident $of_unloading:tt) => {
        $crate::__law!(type loading $form $loading)
    };
    (unloading $form:ident $loading:ident $of_loading:tt, $to:ident $unloading:ident $of_unloading:tt) => {
        $crate::__law!(type unloading $to $unloading)
    };

    (follow (friction $($contact:tt)+)) => { None };
    (follow plain) => { $crate::__laws!(follow_by $crate::contact::motion::follow) };
    (follow damped) => { $crate::__laws!(follow_by $crate::contact::damped::follow) };
    (follow (loss $loss:ident)) => { $crate::__laws!(follow_by $crate::contact::losses::follow) };
    (follow (rate $($rates:tt)+)) => { $crate::__laws!(follow_by $crate::contact::rate::follow) };
    (follow_by $follow:path) => {
        if Self::moves() {
            Some($follow)
        } else {
            None
        }
    };

    (together plain) => {
        #[inline(always)]
        fn follow_together<B: core::borrow::Borrow<Self::Model>>(
            contacts: &mut [Self::Contact],
            model: impl Fn(usize) -> B,
            masses: &$crate::contact::shared::InverseMasses,
            accelerations: &[f64],
            rates: &mut [f64],
            work: &mut [$crate::contact::shared::Work<Self::Contact>],
            step: f64,
        ) -> Result<$crate::contact::shared::Outcome, $crate::contact::shared::Refused> {
            $crate::contact::shared::follow(contacts, model, masses, accelerations, rates, work, step)
        }
    };
    (together (loss $loss:ident)) => { $crate::__laws!(together plain); };
    (together (friction $($contact:tt)+)) => { $crate::__laws!(together plain); };
    (together $other:tt) => {};

    (model $pair:ident $surface:ident $value:ident $density:ident; damped $law:ident $fields:tt) => {{
        // the names of approximations among the constants
        #[allow(unused_imports)]
        use $crate::contact::damped::{hunt_crossley::DampingFactor::*, tsuji::TsujiDamping::*};
        let restitution = $value($crate::scene::Parameter::Restitution);
        let mass = $value($crate::scene::Parameter::EffectiveMass);
        $crate::contact::damped::Model { pair: $pair, law: const { $crate::contact::damped::$law $fields }, restitution, mass }
    }};
    (model $pair:ident $surface:ident $value:ident $density:ident; plain $($laws:tt)+) => {
        $crate::__laws!(plastic $pair $surface $value; $($laws)+)
    };
    (model $pair:ident $surface:ident $value:ident $density:ident; (loss $loss:ident) $($laws:tt)+) => {
        $crate::contact::losses::Model {
            plastic: $crate::__laws!(plastic $pair $surface $value; $($laws)+),
            loss: <$crate::contact::losses::$loss as $crate::scene::described::LossOfScene>::given(&$value, $density),
        }
    };
    (model $pair:ident $surface:ident $value:ident $density:ident; (rate $of_target:ident $target:tt) $($laws:tt)+) => {
        $crate::contact::rate::Model {
            slow: $crate::__laws!(plastic $pair $surface $value; $($laws)+),
            rate: $crate::contact::rate::Rate::$of_target $target,
            harder: $crate::contact::rate::Rate::NONE,
        }
    };
    (model $pair:ident $surface:ident $value:ident $density:ident;
     (rate $of_target:ident $target:tt $of_impactor:ident $impactor:tt) $($laws:tt)+) => {{
        let [target, impactor] =
            [$crate::contact::rate::Rate::$of_target $target, $crate::contact::rate::Rate::$of_impactor $impactor];
        let impactor_yields = $crate::scene::impactor_yields(&$value);
        $crate::contact::rate::Model {
            slow: $crate::__laws!(plastic $pair $surface $value; $($laws)+),
            rate: if impactor_yields { impactor } else { target },
            harder: if impactor_yields { target } else { impactor },
        }
    }};
    (model $pair:ident $surface:ident $value:ident $density:ident;
     (friction $contact:ident $memory:literal $mean:literal $loss:ident) $($laws:tt)+) => {{
        let loss = <$crate::contact::losses::$loss as $crate::scene::described::LossOfScene>::given(&$value, $density);
        $crate::scene::with_friction($crate::__laws!(plastic $pair $surface $value; $($laws)+), loss, $value)
    }};
    (model $pair:ident $surface:ident $value:ident $density:ident; (friction $($contact:tt)+) $($laws:tt)+) => {
        $crate::scene::with_friction($crate::__laws!(plastic $pair $surface $value; $($laws)+), (), $value)
    };
    (plastic $pair:ident $surface:ident $value:ident; paired $($laws:tt)+) => {{
        let bodies = $crate::scene::two_bodies(&$value);
        $crate::__laws!(bodies $pair $surface bodies; paired $($laws)+)
    }};
    (plastic $pair:ident $surface:ident $value:ident; $($laws:tt)+) => {
        $crate::__laws!(bodies $pair $surface none; $($laws)+)
    };
    (bodies $pair:ident $surface:ident $bodies:ident;
     $form:ident $loading:ident $of_loading:tt, $to:ident $unloading:ident $of_unloading:tt) => {
        $crate::contact::Model {
            pair: $pair,
            loading: $crate::__law!(value loading $form $loading $of_loading $bodies),
            unloading: $crate::__law!(value unloading $to $unloading $of_unloading $bodies),
            surface: $surface,
        }
    };
}

/// The value of a parameter from its source: a constant, a value that can be set, one for each contact, or one for each table.
#[doc(hidden)]
#[macro_export]
macro_rules! __value {
    ($group:ident $table_of:ident $values:ident constant $value:expr) => {
        $value
    };
    ($group:ident $table_of:ident $values:ident set $place:expr) => {
        $values[$place]
    };
    ($group:ident $table_of:ident $values:ident own $place:expr) => {
        $values.get($group + $place).copied().unwrap_or(f64::NAN)
    };
    ($group:ident $table_of:ident $values:ident tables $sources:expr) => {{
        use $crate::scene::variable::Source::{self, *};
        static SOURCES: [Source; TABLES] = $sources;
        Source::value(SOURCES.get($table_of($group)), $group, $values)
    }};
}

/// The scene of an FMU, `Exported`, from its data; `crates/unit/src/exported.rs` has an example.
///
/// - `contacts`: number of contacts, and of groups of equal contacts;
/// - `tables`: for each table of the scene its name, whether its contacts are counted, and the contact after its last one;
/// - `surface`, `density`: one for all tables, or one for each; density of the target \[kg/m^3\];
/// - `laws`: what is added to them, the loading law and the unloading law, or a rate-dependent law, each in a form and with its
///   constants;
/// - `inverse_masses`: those of contacts that share bodies or, if they are inputs, their start values: the upper triangle row by row
///   \[1/kg\];
/// - `parts`: the parts of an instance;
/// - `settable`: name, unit, smallest, largest and start value of each parameter that can be set. `runs`, if contacts have own
///   values: where the values of each end, and its first contact. `tunable`: ranges of values that can be set between steps;
/// - `parameters`: the sources of those that have an effect;
/// - `kinds`: number of variables of a contact without parameters; `reals`, `integers`: the places among them.
#[doc(hidden)]
#[macro_export]
macro_rules! __scene {
    (
        guid: $guid:literal,
        contacts: $contacts:literal in $groups:literal,
        tables: [$(($name:literal, $counted:literal, $end:literal)),+],
        surface: [$($surface:ident),+],
        density: [$($density:expr),+],
        laws: $kind:tt { $($laws:tt)+ },
        $(guard: $guard:literal,)?
        $(impact_mass: $mass:expr,)?
        $(inverse_masses: [$($inverse_mass:expr),+],)?
        parts: { $($part:ident = $presence:ty),+ },
        settable: {
            $($set:literal $unit:literal [$minimum:expr, $maximum:expr] = $start:expr,)*
        },
        $(runs: [$(($last:literal, $first:expr)),+],)?
        $(tunable: [$($range:expr),+],)?
        parameters: { $($parameter:ident: $source:ident $given:expr,)* },
        kinds: $kinds:literal,
        reals: { $($place_of_real:literal: $real:ident),* },
        integers: { $($place_of_integer:literal: $integer:ident),* },
    ) => {
        #[allow(unused_imports)]
        use $crate::scene::{Absent, Coupled, Present};
        use $crate::contact::{Pair, Surface};
        use $crate::scene::described::{of_table, one_each};
        use $crate::scene::variable::{Run, kind_and_contact, name_in, run_of, spread};
        use $crate::scene::{Integer, Parameter, Real, Scene, Settable, identity_of};

        /// The scene of the FMU.
        pub struct Exported;

        const CONTACTS: usize = $contacts;
        const ROWS: usize = CONTACTS * (1 + DIRECTIONS);
        /// Of contacts that share bodies.
        const DIRECTIONS: usize = match <<Exported as Scene>::Shared as $crate::scene::Presence>::IS_PRESENT {
            true => <<Exported as Scene>::Contact as $crate::contact::Contact<<Exported as Scene>::Model>>::DIRECTIONS,
            false => 0,
        };
        const GROUPS: usize = $groups;

        /// The contact after the last one of each table.
        static ENDS: [usize; TABLES] = [$($end),+];
        const TABLES: usize = [$($end),+].len();

        /// The name of each table, and whether its contacts are counted.
        const NAMES: [(&[u8], bool); TABLES] = [$(($name.as_bytes(), $counted)),+];

        /// The parameters that can be set.
        static SETTABLE: [Settable; SETTABLES] = [$(
            Settable { name: $set.as_bytes(), unit: $unit.as_bytes(), minimum: $minimum, maximum: $maximum },
        )*];
        const SETTABLES: usize = <[&str]>::len(&[$($set),*]);

        /// Their start values.
        const STARTS: [f64; SETTABLES] = [$($start),*];

        /// The values of each, if contacts have own ones.
        const RUNS: &[Run] = &[$($(Run { end: $last, first_contact: $first }),+)?];
        const VALUES: usize = if RUNS.is_empty() { SETTABLES } else { RUNS[RUNS.len() - 1].end };

        const KINDS: u32 = $kinds;

        #[inline(always)]
        fn table_of_contact(contact: usize) -> usize {
            ENDS.partition_point(|&end| end <= contact)
        }

        /// The table of a group.
        #[inline(always)]
        fn table_of(group: usize) -> usize {
            if GROUPS == CONTACTS && TABLES < CONTACTS { table_of_contact(group) } else { group }
        }

        #[allow(unused_variables, unreachable_patterns, unreachable_code)]
        impl Scene for Exported {
            $crate::__laws!(types $kind $($laws)+);

            type Contacts<T: Copy> = [T; CONTACTS];
            type Rows<T: Copy> = [T; ROWS];
            type Groups<T: Copy> = [T; GROUPS];
            type Values = [f64; VALUES];

            $(type $part = $presence;)+

            #[inline(always)]
            fn follow() -> Option<$crate::contact::motion::Follow<Self::Contact, Self::Model>> {
                $crate::__laws!(follow $kind)
            }

            $(#[inline(always)]
            fn guard() -> Option<$crate::scene::Guard<Self>> {
                Some($crate::scene::Guard { words: $guard.as_bytes(), acts: <Self::Contact>::is_held_back })
            })?

            $crate::__laws!(together $kind);

            fn inverse_masses() -> &'static [f64] {
                &[$($($inverse_mass),+)?]
            }

            fn guid() -> &'static [u8] {
                $guid.as_bytes()
            }

            fn identity() -> u64 {
                const { identity_of($guid) }
            }

            fn group(contact: usize) -> usize {
                match GROUPS {
                    1 => 0,
                    CONTACTS => contact,
                    _ => table_of_contact(contact),
                }
            }

            fn end(group: usize) -> usize {
                match GROUPS {
                    1 => CONTACTS,
                    CONTACTS => group + 1,
                    _ => ENDS.get(group).copied().unwrap_or(CONTACTS),
                }
            }

            fn contact_name(contact: usize) -> (&'static [u8], usize) {
                match TABLES {
                    1 => (NAMES[0].0, if NAMES[0].1 { contact + 1 } else { 0 }),
                    CONTACTS => NAMES.get(contact).map_or((&[], 0), |&(name, counted)| (name, usize::from(counted))),
                    _ => name_in(&NAMES, &ENDS, table_of_contact(contact), contact),
                }
            }

            fn settable(index: usize) -> Option<(Settable, Option<usize>)> {
                if RUNS.is_empty() {
                    return SETTABLE.get(index).map(|settable| (*settable, None));
                }
                let (place, contact) = run_of(RUNS, index)?;
                Some((*SETTABLE.get(place)?, contact))
            }

            fn is_tunable(index: usize) -> bool {
                false $($(|| ($range).contains(&index))+)?
            }

            fn set_start_values(values: &mut Self::Values) {
                if RUNS.is_empty() { *values = const { one_each(&STARTS) } } else { spread(RUNS, &STARTS, values) }
            }

            fn parameter(parameter: Parameter, group: usize, values: &Self::Values) -> f64 {
                match parameter {
                    $(Parameter::$parameter => $crate::__value!(group table_of values $source $given),)*
                    _ => parameter.without_effect(),
                }
            }

            fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model {
                let value = |parameter| Self::parameter(parameter, group, values);
                let surface = of_table(&[$(Surface::$surface),+], table_of(group));
                let density = Self::density(group).unwrap_or(f64::NAN);
                $crate::__laws!(model pair surface value density; $kind $($laws)+)
            }

            fn density(group: usize) -> Option<f64> {
                of_table(&[$($density),+], table_of(group))
            }

            $(fn impact_mass() -> f64 {
                $mass
            })?

            #[inline]
            fn real(value_reference: u32) -> Option<(Real, usize)> {
                let (kind, contact) = kind_and_contact(value_reference, CONTACTS);
                let variable = match kind {
                    $($place_of_real => Real::$real,)*
                    KINDS.. => {
                        let index = (kind - KINDS) as usize * CONTACTS + contact;
                        let length = <Self::InverseMasses as $crate::scene::Store<f64>>::LENGTH;
                        let place = index.checked_sub(VALUES).filter(|&place| place < length);
                        let entry = place.map(|place| (Real::InverseMass, place));
                        return if index < VALUES { Some((Real::Parameter(index), 0)) } else { entry };
                    }
                    _ => return None,
                };
                Some((variable, contact))
            }

            fn integer(value_reference: u32) -> Option<(Integer, usize)> {
                let (kind, contact) = kind_and_contact(value_reference, CONTACTS);
                let variable = match kind {
                    $($place_of_integer => Integer::$integer,)*
                    _ => return None,
                };
                Some((variable, contact))
            }
        }
    };
}

pub use crate::__scene as scene;
