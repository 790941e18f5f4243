//! What the files of a system have in common: their names, their XML, and the variables that they tell of.

use brinell_exporter::interface::Entry;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::Causality;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io::{self, Cursor};

pub type Xml = Writer<Cursor<Vec<u8>>>;

pub const TOOL: &str = concat!("Brinell ", env!("CARGO_PKG_VERSION"));
pub const COMMON: (&str, &str) = ("xmlns:ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon");

/// The name of the FMU in the system.
pub const COMPONENT: &str = "contact";

/// The names of the other files of the package.
pub struct Files {
    pub unit: String,
    pub values: String,
}

impl Files {
    pub fn of(plan: &Plan) -> Files {
        let name = &plan.scene.name;
        Files { unit: format!("resources/{name}.fmu"), values: format!("resources/{name}.ssv") }
    }
}

/// The variables of one kind.
pub fn of_kind<'a>(plan: &'a Plan, causality: Causality) -> impl Iterator<Item = &'a Entry<'a>> {
    plan.variables.iter().filter(move |entry| entry.variable.causality == causality)
}

/// An XML file with this content.
pub fn document(content: impl FnOnce(&mut Xml) -> io::Result<()>) -> String {
    let mut xml = Writer::new_with_indent(Cursor::new(Vec::new()), b' ', 2);
    let written = xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
    written.and_then(|()| content(&mut xml)).expect("memory takes everything");
    let mut text = String::from_utf8(xml.into_inner().into_inner()).expect("XML is written as UTF-8");
    text.push('\n');
    text
}
