//! `brinell laws`: the laws as the table describes them, with their constants.

mod laws;
mod text;

use crate::messages::WrongCall;
use crate::scene_file;
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::laws::loading_names;
use brinell_exporter::layout::json_line;
use brinell_exporter::nearest::unknown;
use laws::those;
use std::error::Error;

/// The arguments of `brinell laws`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// A law to show with its formulas, constants, validity and accuracy [default: list all]
    pub name: Option<String>,
}

/// The command: lists the laws, or shows those of one name: a loading law and an unloading law may share it.
pub fn run(Arguments { name }: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let list = those(&scene_file::default_scene()?, |known| name.as_deref().is_none_or(|name| name == known));
    if let (Some(name), true) = (name, list.loading.is_empty() && list.unloading.is_empty() && list.damped.is_empty()) {
        let unloading = AnyUnloading::ALL.into_iter().map(|(name, _)| name);
        return Err(WrongCall(unknown("law", name, loading_names().chain(unloading))).into());
    }
    match name {
        _ if as_json => print!("{}", json_line(&list)),
        Some(_) => print!("{}", text::one(&list)),
        None => print!("{}", text::list(&list)),
    }
    Ok(())
}
