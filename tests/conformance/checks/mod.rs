//! The checks, by name. Each gets an FMU in a process of its own, and panics where the FMU is wrong.

mod arguments;
mod arithmetic;
mod courses;
mod derivatives;
#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod glibc;
mod initial;
mod instances;
mod logging;
mod order;
mod process;
mod states;
mod times;
mod variables;

use crate::face::Face;

/// A check.
pub struct Check {
    pub name: &'static str,
    pub run: fn(&Face),
}

const fn check(name: &'static str, run: fn(&Face)) -> Check {
    Check { name, run }
}

pub const CHECKS: &[Check] = &[
    check("every function in every state", order::every_function_in_every_state),
    check("a reset instance is like a new one", order::a_reset_instance_is_like_a_new_one),
    check("no instance", arguments::no_instance),
    check("null arguments", arguments::null_arguments),
    check("empty arrays", arguments::empty_arrays),
    check("repeated and many references", arguments::repeated_and_many_references),
    check("wrong references", arguments::wrong_references),
    check("times", times::times),
    check("ways of counting time", times::ways_of_counting),
    check("statuses", times::statuses),
    check("names", instances::names),
    check("resource locations", instances::resource_locations),
    check("wrong arguments of fmi2Instantiate", instances::wrong_arguments),
    check("strings end with the call", instances::strings_end_with_the_call),
    check("no logger", instances::no_logger),
    check("every refusal is told", logging::every_refusal_is_told),
    check("a good run is silent", logging::a_good_run_is_silent),
    check("categories", logging::categories),
    check("discarded questions", logging::discarded_questions),
    check("warnings", logging::warnings),
    check("setting in every state", variables::setting_in_every_state),
    check("limits", variables::limits),
    check("start values", variables::start_values),
    check("inverse masses of no bodies", variables::inverse_masses),
    check("a state of every phase in every other", states::every_phase_into_every_other),
    check("saving into a state", states::saving_into_a_state),
    check("damaged bytes", states::damaged_bytes),
    check("derivatives of every output", derivatives::of_every_output),
    check("derivatives of a course", derivatives::are_those_of_the_course),
    check("derivatives of inputs", derivatives::of_inputs),
    check("derivatives in every direction", derivatives::in_every_direction),
    check("dependencies before the first step", initial::dependencies),
    check("derivatives before the first step", initial::derivatives),
    check("instances in turn", process::instances_in_turn),
    check("instances in threads", process::instances_in_threads),
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    check("memory", glibc::memory),
    check("a small stack", process::small_stack),
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    check("floating-point traps", glibc::floating_point_traps),
    check("modes of arithmetic", arithmetic::modes),
    check("values along a course", courses::values_along_a_course),
    check("work", courses::work),
    check("impulse", courses::impulse),
    check("steps and their parts", courses::steps_and_their_parts),
];
