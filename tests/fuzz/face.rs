//! The variables of an FMU according to its model description.

use crate::functions::Functions;
use std::collections::HashMap;
use std::ffi::CString;
use std::fs;
use std::path::Path;

/// An FMU: its functions and its variables.
pub struct Face {
    pub functions: Functions,
    pub guid: CString,
    /// Value references of all Real variables, of the others, and by causality.
    pub reals: Vec<u32>,
    pub integers: Vec<u32>,
    pub inputs: Vec<u32>,
    pub outputs: Vec<u32>,
    pub parameters: Vec<u32>,
    /// Start values of Real variables.
    pub starts: HashMap<u32, f64>,
    /// Whether the contacts can yield.
    pub yields: bool,
    /// References of Real outputs by name.
    pub named: HashMap<String, u32>,
}

/// The value of an attribute.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split('"').next()
}

impl Face {
    /// The FMU that was unpacked around `library`.
    pub fn load(library: &Path) -> Face {
        let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        let guid = attribute(&description, "guid").expect("a GUID");
        let mut face = Face {
            functions: Functions::load(library),
            guid: CString::new(guid).expect("plain characters"),
            reals: Vec::new(),
            integers: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            parameters: Vec::new(),
            starts: HashMap::new(),
            yields: description.contains("yield_strength"),
            named: HashMap::new(),
        };
        for element in description.split("<ScalarVariable").skip(1) {
            let element = element.split("</ScalarVariable>").next().expect("text has a first part");
            let reference: u32 =
                attribute(element, "valueReference").and_then(|text| text.parse().ok()).expect("a number");
            let name = attribute(element, "name").expect("a name").to_string();
            if !element.contains("<Real") {
                face.integers.push(reference);
                continue;
            }
            face.reals.push(reference);
            if let Some(start) = attribute(element, "start").and_then(|text| text.parse().ok()) {
                face.starts.insert(reference, start);
            }
            match attribute(element, "causality") {
                Some("input") => face.inputs.push(reference),
                Some("output") => {
                    face.outputs.push(reference);
                    face.named.insert(name, reference);
                }
                _ => face.parameters.push(reference),
            }
        }
        assert!(!face.inputs.is_empty() && !face.outputs.is_empty(), "{}", library.display());
        face
    }

    /// The largest value reference.
    pub fn largest_reference(&self) -> u32 {
        self.reals.iter().chain(&self.integers).copied().max().unwrap_or(0)
    }
}
