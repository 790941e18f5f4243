//! `brinell ssp`: the FMU of a scene as a system (SSP 1.0), with its parameters in a separate file.
//!
//! Reference: *System Structure and Parameterization*, version 1.0 (Modelica Association, 2019). SystemStructure.ssd is the
//! system, a `.ssv` file contains the values of its parameters, and `resources/` contains the files that both refer to.

mod document;
mod structure;
mod values;
mod wiring;

use crate::arguments::SspArguments;
use crate::export::check_own;
use crate::files::{check_goal, check_kept, ending, write_whole};
use crate::messages::WrongCall;
use crate::package::{self, Exported};
use crate::scene_file;
use brinell_exporter::interface::Entry;
use brinell_exporter::layout::{json_line, paragraph, shown};
use brinell_exporter::package::archive;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::Causality;
use document::{COMPONENT, Files, document, of_kind};
use serde_json::json;
use std::error::Error;
use std::path::Path;
use wiring::Wiring;

/// The command: writes the system of a scene to the user's file or to the current folder.
///
/// # Errors
/// The error of the name, the scene, the connections, the export, or the file.
pub fn run(arguments: &SspArguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let SspArguments { scene: source, output, with, connect, platforms, way } = arguments;
    let output = output.as_deref();
    // rejected before anything is built
    ending(output, &["ssp"]).map_err(WrongCall)?;
    let way = way.chosen();
    let platforms = platforms.chosen(way)?;
    let scene = scene_file::read_aloud(source)?;
    let plan = Plan::of(&scene);
    let wiring = Wiring::read(&plan, with, connect).map_err(|error| -> Box<dyn Error> {
        if error.is_in_call() { WrongCall::of(error).into() } else { error.into() }
    })?;
    let path = output.map_or_else(|| format!("{}.ssp", scene.name).into(), Path::to_path_buf);
    let files = Files::of(&plan);
    check_goal(&path)?;
    check_kept(&path, source)?;
    if output.is_none() {
        check_own(&path, Some(&files.unit), &scene.text, Some(source))?;
    }
    for warning in &wiring.warnings {
        crate::messages::tell(&format!("brinell: warning: {warning}"));
    }
    crate::messages::tell(&format!("building {} ...", shown(&path)));
    let (unit, exported) = package::build(&plan, way, &platforms)?;
    let structure = document(|xml| structure::write(xml, &plan, &files, &wiring));
    let values = document(|xml| values::write(xml, &plan));
    let mut parts = vec![
        ("SystemStructure.ssd".into(), structure.as_bytes()),
        (files.values.clone(), values.as_bytes()),
        (files.unit.clone(), unit.as_slice()),
    ];
    parts.extend(wiring.peers.iter().map(|peer| (peer.file(), peer.bytes.as_slice())));
    let archive = archive(&parts)?;
    write_whole(&path, &archive)?;
    tell(&plan, &files, Exported { path, size: archive.len(), ..exported }, as_json);
    Ok(())
}

fn tell(plan: &Plan, files: &Files, system: Exported, as_json: bool) {
    let Exported { path, size, guid, .. } = system;
    let labels = |causality| -> Vec<_> { of_kind(plan, causality).map(Entry::label).collect() };
    let (inputs, outputs) = (labels(Causality::Input), labels(Causality::Output));
    let parameters = labels(Causality::Parameter);
    if as_json {
        let object = json!({
            "ssp": path.to_string_lossy(), "size": size, "guid": guid, "component": COMPONENT, "fmu": files.unit, "parameter_values": files.values,
            "inputs": inputs, "outputs": outputs, "parameters": parameters,
        });
        print!("{}", json_line(&object));
        return;
    }
    println!("{}", shown(&path));
    println!("  {size} bytes; the FMU is its component `{COMPONENT}`");
    for (heading, names) in [("inputs", inputs), ("outputs", outputs), ("parameters", parameters)] {
        print!("{}", paragraph(&format!("  {heading:<12}"), &names.join(", ")));
    }
}
