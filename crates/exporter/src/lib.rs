//! From the text of a scene to the files of its FMU, and to the predictions of its impacts.
//!
//! | module | what it has |
//! |---|---|
//! | [`bisection`], [`numbers`], [`layout`], [`columns`], [`nearest`], [`mistake`], [`units`], [`xml`], [`html`], [`plot`] | words, tables and pictures; mistakes with their place in a file |
//! | [`table`], [`regime`] | variables, units, materials and laws, from the folder `modelDescription` |
//! | [`body`] | the two bodies of a contact |
//! | [`model`], [`parameters`], [`pairing`], [`law_check`], [`law_text`], [`validity`] | laws by name: their constants, which go together, where they hold |
//! | [`reading`], [`measurement`] | a hardness as people write it; tables of measurements, in any dialect |
//! | [`tension`], [`measured`] | the flow stress that a tensile test, a hardness or a tensile strength says |
//! | `own_curve` | the law through a loading curve of one's own |
//! | [`scene`] | a checked scene |
//! | [`schema`] | the JSON Schema of scenes |
//! | [`bodies`], [`rods`], [`laws`], [`energy`], [`guard`] | what is known of the bodies and laws of a scene |
//! | [`predict`], [`hardness`], [`accuracy`] | what an impact or a hardness test of a scene will do, and how near that is |
//! | [`curve`] | force, pressure and energies along loading and unloading |
//! | [`master`] | the ways to couple a contact with bodies |
//! | [`translate`] | numbers for the contact models of other tools, with their error |
//! | [`nominal`], [`interface`], [`plan`] | what all files of an FMU have in common |
//! | [`model_description`], [`documentation`] | these files |
//! | [`platform`], [`signature`], [`symbols`], [`c_source`], [`package`], [`prebuilt`] | libraries as bytes or as C source, and the archive |
//!
//! Each uses only those above it. Text and bytes come in; text, bytes and mistakes go out. No file is read here, no process or thread
//! started, no clock or environment looked at: a command, Python or a page in a browser may all use this crate.
//!
//! ```
//! use brinell_exporter::{model_description, plan::Plan, scene::Scene};
//! use std::path::Path;
//!
//! let text = "
//!     name = \"ball\"
//!     impactor = { radius = 5e-3 }
//!     target = { material = \"mild steel\" }
//!     impact = { mass = 4e-3, speed = 1.0 }
//! ";
//! let scene = Scene::parse(text.into(), Path::new("ball.toml"))?;
//! let impact = &scene.predictions[0];
//! assert!(impact.max_force > 300.0 && impact.restitution < 0.5);
//! let mut xml = Vec::new();
//! model_description::write(&Plan::of(&scene), "a GUID", None, &mut xml)?;
//! assert!(String::from_utf8(xml)?.contains("modelIdentifier=\"ball\""));
//! let mistake = Scene::parse(text.replace("5e-3", "-5e-3"), Path::new("ball.toml")).unwrap_err();
//! assert!(mistake.to_string().starts_with("ball.toml:3:"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod accuracy;
pub mod bisection;
pub mod bodies;
pub mod body;
pub mod c_source;
pub mod columns;
pub mod curve;
pub mod documentation;
pub mod energy;
mod first_lines;
mod friction_text;
pub mod guard;
pub mod hardness;
pub mod html;
pub mod interface;
pub mod law_check;
pub mod law_text;
pub mod laws;
pub mod layout;
pub mod library;
pub mod master;
pub mod measured;
pub mod measurement;
pub mod mistake;
pub mod model;
pub mod model_description;
pub mod nearest;
pub mod nominal;
pub mod numbers;
pub mod own_curve;
pub mod package;
pub mod pairing;
pub mod parameters;
pub mod plan;
pub mod platform;
pub mod plot;
pub mod prebuilt;
pub mod predict;
pub mod reading;
pub mod regime;
pub mod rods;
pub mod scene;
pub mod schema;
pub mod signature;
mod strength_text;
pub mod symbols;
pub mod table;
pub mod tension;
pub mod translate;
pub mod units;
pub mod validity;
pub mod xml;
