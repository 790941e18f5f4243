//! Parts of the exporter by themselves: what their modules compute and say. A test program, since the crate would be compiled
//! a second time for tests inside it.

mod c_source;
mod c_source_module;
mod hardness;
mod hostile_scenes;
mod html;
mod layout;
mod macho;
mod measured;
mod measurement;
mod nearest;
mod numbers;
mod own_curve;
mod package_archive;
mod package_resource;
mod platform;
mod plot;
mod rules;
mod scene_names;
mod scene_strength;
mod schema;
mod shared_bodies;
mod table;
mod table_names;
mod tension;
mod translate;
mod translate_runge_kutta;
mod units;
