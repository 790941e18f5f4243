//! The variables and capabilities of an FMU according to its model description.

use super::functions::Functions;
use std::collections::HashMap;
use std::ffi::CString;
use std::fs;
use std::path::Path;

/// A variable.
#[derive(Clone, Debug)]
pub struct Variable {
    pub name: String,
    pub reference: u32,
    /// Real; otherwise an enumeration.
    pub is_real: bool,
    pub causality: String,
    pub variability: String,
    pub start: Option<f64>,
    pub minimum: Option<f64>,
    pub maximum: Option<f64>,
    /// The values of an enumeration.
    pub items: Vec<i32>,
}

/// An FMU: its functions and its variables.
pub struct Face {
    pub functions: Functions,
    pub guid: CString,
    pub variables: Vec<Variable>,
    /// The declared categories of log messages.
    pub categories: Vec<String>,
    /// The element `CoSimulation`.
    capabilities: String,
    /// Value references of all Real variables, of the others, and by causality.
    pub reals: Vec<u32>,
    pub integers: Vec<u32>,
    pub inputs: Vec<u32>,
    pub outputs: Vec<u32>,
    pub parameters: Vec<u32>,
    /// The rates of the contacts, which are the first inputs, and those along the surface, of contacts with friction.
    pub rates: Vec<u32>,
    pub sideways: Vec<u32>,
    /// Start values of Real variables.
    pub starts: HashMap<u32, f64>,
    /// Whether the contacts can yield.
    pub yields: bool,
    /// Whether the law is passive: the dissipated energy never falls.
    pub passive: bool,
    /// Smallest and largest value of each Real variable, as declared; infinite if not.
    pub limits: HashMap<u32, (f64, f64)>,
    /// References of Real outputs by name.
    pub named: HashMap<String, u32>,
    /// The variables whose values before the first step follow from others, with those, by their places among `variables`.
    pub initial_unknowns: Vec<(usize, Vec<usize>)>,
}

/// The value of an attribute.
pub fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split('"').next()
}

fn number(element: &str, name: &str) -> Option<f64> {
    attribute(element, name).and_then(|text| text.parse().ok())
}

/// The values of each declared enumeration.
fn enumerations(description: &str) -> HashMap<&str, Vec<i32>> {
    let types = description.split("<SimpleType").skip(1).filter_map(|element| element.split("</SimpleType>").next());
    let items = |element: &str| {
        element.split("<Item").skip(1).filter_map(|item| attribute(item, "value")?.parse().ok()).collect()
    };
    types.filter_map(|element| Some((attribute(element, "name")?, items(element)))).collect()
}

/// The initial unknowns with their dependencies. Indices in the XML start from 1.
fn initial_unknowns(description: &str) -> Vec<(usize, Vec<usize>)> {
    let (_, list) = description.split_once("<InitialUnknowns>").expect("every FMU has some");
    let (list, _) = list.split_once("</InitialUnknowns>").expect("an element ends");
    let place = |index: &str| index.parse::<usize>().expect("an index") - 1;
    let places = |list: &str| list.split_whitespace().map(place).collect();
    list.split("<Unknown")
        .skip(1)
        .map(|unknown| {
            let given = |name| attribute(unknown, name).expect("every unknown has it");
            (place(given("index")), places(given("dependencies")))
        })
        .collect()
}

impl Variable {
    fn read(element: &str, types: &HashMap<&str, Vec<i32>>) -> Variable {
        let text = |name| attribute(element, name).unwrap_or_default().to_string();
        Variable {
            name: text("name"),
            reference: text("valueReference").parse().expect("a number"),
            is_real: element.contains("<Real"),
            causality: text("causality"),
            variability: text("variability"),
            start: number(element, "start"),
            minimum: number(element, "min"),
            maximum: number(element, "max"),
            items: attribute(element, "declaredType").and_then(|name| types.get(name)).cloned().unwrap_or_default(),
        }
    }

    /// Smallest and largest value, as declared; infinite if not.
    pub fn limits(&self) -> (f64, f64) {
        (self.minimum.unwrap_or(f64::NEG_INFINITY), self.maximum.unwrap_or(f64::INFINITY))
    }
}

impl Face {
    /// The FMU that was unpacked around `library`.
    pub fn load(library: &Path) -> Face {
        Face::of(library, library)
    }

    /// `library`, instead of the one that was unpacked at `place`.
    pub fn of(library: &Path, place: &Path) -> Face {
        let root = place.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        let guid = attribute(&description, "guid").expect("a GUID");
        let types = enumerations(&description);
        let elements = description.split("<ScalarVariable").skip(1);
        let elements =
            elements.map(|element| element.split("</ScalarVariable>").next().expect("text has a first part"));
        let variables: Vec<Variable> = elements.map(|element| Variable::read(element, &types)).collect();
        let categories = description.split("<Category").skip(1);
        let capabilities = description.split("<CoSimulation").nth(1).and_then(|rest| rest.split('>').next());
        let references = |wanted: &dyn Fn(&Variable) -> bool| -> Vec<u32> {
            variables.iter().filter(|variable| wanted(variable)).map(|variable| variable.reference).collect()
        };
        let reals = || variables.iter().filter(|variable| variable.is_real);
        let outputs = || reals().filter(|variable| variable.causality == "output");
        let face = Face {
            functions: Functions::load(library),
            guid: CString::new(guid).expect("plain characters"),
            categories: categories.filter_map(|element| attribute(element, "name")).map(String::from).collect(),
            capabilities: capabilities.expect("an FMU for co-simulation").to_string(),
            reals: references(&|variable| variable.is_real),
            integers: references(&|variable| !variable.is_real),
            inputs: references(&|variable| variable.is_real && variable.causality == "input"),
            outputs: references(&|variable| variable.is_real && variable.causality == "output"),
            parameters: references(&|variable| {
                variable.is_real && !["input", "output"].contains(&&*variable.causality)
            }),
            rates: references(&|variable| variable.name.rsplit('.').next() == Some("indentation_rate")),
            sideways: references(&|variable| {
                variable.name.rsplit('.').next().is_some_and(|name| name.starts_with("tangential_rate"))
            }),
            starts: reals().filter_map(|variable| Some((variable.reference, variable.start?))).collect(),
            limits: reals().map(|variable| (variable.reference, variable.limits())).collect(),
            yields: description.contains("yield_strength"),
            passive: true,
            initial_unknowns: initial_unknowns(&description),
            named: outputs().map(|variable| (variable.name.clone(), variable.reference)).collect(),
            variables,
        };
        assert!(!face.inputs.is_empty() && !face.outputs.is_empty(), "{}", library.display());
        face
    }

    /// The largest value reference.
    pub fn largest_reference(&self) -> u32 {
        self.reals.iter().chain(&self.integers).copied().max().unwrap_or(0)
    }

    /// A capability of the FMU.
    pub fn capability(&self, name: &str) -> &str {
        attribute(&self.capabilities, name).unwrap_or_else(|| panic!("no {name} in the model description"))
    }

    /// Whether the FMU declares that it uses no memory of its importer.
    pub fn needs_no_memory(&self) -> bool {
        self.capability("canNotUseMemoryManagementFunctions") == "true"
    }
}
