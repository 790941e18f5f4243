//! The contents of a scene file: tables and keys, without interpretation.

use super::own_materials::{self, MaterialTable, OwnMaterial, ReferencedFiles};
use super::parser_words;
use super::quantities::{Quantity, quantity_of};
use super::rules::{self, Closed};
use crate::layout::shortened;
use crate::mistake::{Mistake, SceneError, Spanned};
use crate::numbers::out_of_range;
use crate::own_curve::{self, Rows};
use crate::pairing::{DEFAULT_LOADING, LINE, TABLE};
use crate::parameters::ConstantTable;
use crate::table::{MATERIALS, Material};
use crate::tension::{self, Specimen};
use crate::units;
use brinell_contact::Surface;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{SeqAccess, Visitor};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use toml::de::{DeTable, DeValue, Deserializer};

/// A scene: one contact of two bodies, or several, and the FMU that is made of it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Name of the FMU and of its library: a C identifier, and no keyword of C or C++.
    pub name: Spanned<String>,
    /// One line for the XML and the page inside the FMU.
    pub description: Option<Spanned<String>>,
    /// Who answers for the FMU: the attribute of this name in the XML.
    pub author: Option<Spanned<String>>,
    /// The body that presses.
    #[schemars(extend("x-default" = "required, unless every contact has its own"))]
    pub impactor: Option<Spanned<Impactor>>,
    /// The body that it meets.
    #[schemars(extend("x-default" = "required, unless every contact has its own"))]
    pub target: Option<Spanned<BodyTable>>,
    /// The laws.
    #[serde(default)]
    pub law: LawTable,
    /// The variables of the FMU, and how it is built.
    #[serde(default)]
    pub fmu: Fmu,
    /// The impact that the scene is made for.
    #[schemars(extend("x-default" = "1 m/s"))]
    pub impact: Option<Spanned<ImpactTable>>,
    /// A tangential force: every contact has [friction](friction.md), and the FMU the input `tangential_rate`.
    pub friction: Option<Spanned<FrictionTable>>,
    /// The FMU moves the bodies itself within a step, see [coupling](coupling.md).
    pub coupling: Option<Spanned<CouplingTable>>,
    /// The bodies that [several contacts share](#contacts-that-share-bodies).
    #[schemars(extend("minItems" = 1))]
    pub body: Option<Spanned<Vec<Spanned<SharedBodyTable>>>>,
    /// The [contacts](#several-contacts), if there are several, or if they share bodies.
    #[schemars(extend("minItems" = 1, "x-default" = "one, whose variables have plain names"))]
    pub contact: Option<Spanned<Vec<Spanned<ContactTable>>>>,
    /// [Materials of one's own](#materials-of-your-own), which go before the built-in ones.
    pub material: Option<Vec<Spanned<Material>>>,
    /// The materials of the scene's own, and those of tables beside it that it uses.
    #[serde(skip)]
    pub(super) own: Vec<OwnMaterial>,
    /// The text with what it uses of the files beside it.
    #[serde(skip)]
    pub(super) alone: String,
    /// The first mistake by what its keys say of each other, and of their own numbers.
    #[serde(skip)]
    pub(super) broken: Option<Mistake>,
    /// The same of the laws, once these are chosen: if nothing yields, and if a body does.
    #[serde(skip)]
    pub(super) broken_by_laws: [Option<Mistake>; 2],
}

/// Largest number of contacts of an FMU. The model description then has a few hundred megabytes.
pub const MOST_CONTACTS: i64 = 100_000;

/// A table of materials of one's own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialsFile {
    #[serde(default)]
    material: Vec<Spanned<Material>>,
}

impl MaterialTable {
    /// The table with this `text`. `path` is used in messages, `place` in what is printed of its materials.
    ///
    /// # Errors
    /// [`SceneError`] with line and column of the first error, and what is allowed there.
    pub fn parse(text: &str, path: &Path, place: &'static str) -> Result<MaterialTable, SceneError> {
        let checked =
            deserialized(text, &BTreeMap::new()).and_then(|file: MaterialsFile| own_materials::check(file.material));
        let materials = checked.map_err(|mistake| mistake.in_file(text, path))?;
        Ok(MaterialTable { place, materials })
    }
}

/// One of the two bodies: `[target]`, and with fewer keys [`Impactor`].
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct BodyTable {
    /// A [built-in material](#built-in-materials) or [one of your own](#materials-of-your-own), which gives moduli, strength and
    /// density.
    pub material: Option<Spanned<String>>,
    /// Young's modulus.
    #[schemars(extend("x-default" = "that of the material", "examples" = ["206 GPa"]))]
    pub youngs_modulus: Option<Spanned<f64>>,
    /// Poisson's ratio.
    #[schemars(extend("x-default" = "that of the material", "examples" = [0.3]))]
    pub poissons_ratio: Option<Spanned<f64>>,
    /// Yield strength.
    #[schemars(extend("x-default" = "that of the material, else elastic", "examples" = ["300 MPa"]))]
    pub yield_strength: Option<Spanned<f64>>,
    /// Increase of the flow stress per plastic strain, `sigma = S + H eps_p`; for the law
    /// [`brinell`](laws.md#hardening-and-poissons-ratio).
    #[schemars(extend("x-default" = "0: no hardening", "examples" = ["2 GPa"]))]
    pub hardening_modulus: Option<Spanned<f64>>,
    /// The same as the slope of a tensile test beyond yield, `E_t = H/(1 + H/E)`, below Young's modulus; give one of the two.
    pub tangent_modulus: Option<Spanned<f64>>,
    /// `{ coefficient = K, exponent = n }`: flow stress `K eps_p^n` instead of yield strength and hardening; approximated as
    /// [linear](laws.md#power-law-hardening) over the strains of the scene's impact.
    pub power_law: Option<Spanned<PowerLawTable>>,
    /// A hardness with its scale, instead of the yield strength: the [flow stress that it says](hardness.md#strength-from-a-hardness),
    /// at the strain of the scene's impact.
    #[schemars(with = "Option<String>", extend("examples" = ["200 HBW 10/3000", "640 HV10", "58 HRC", "90 HRB", "700 HLD", "180-220 HBW"]))]
    pub hardness: Option<Spanned<toml::Value>>,
    /// Tensile strength, from which the same follows.
    #[schemars(extend("examples" = ["480 MPa"]))]
    pub tensile_strength: Option<Spanned<f64>>,
    /// A [tensile test](hardness.md#strength-from-a-tensile-test): the name of a CSV file, relative to the scene, or `{ curve = "test.csv" }`
    /// with `section`, `gauge_length` or `compliance_correction`; or
    /// `{ proof_stress = "240 MPa", tensile_strength = "480 MPa" }`; or the points `{ true_strain = [...], true_stress = [...] }`,
    /// with `plastic_strain` instead where the elastic part is subtracted.
    pub tensile_test: Option<Spanned<TensileTestTable>>,
    /// `n` of the flow stress `K eps^n` between the strain of that test and the strain of the impact; other metals than steel and
    /// aluminium need it.
    #[schemars(extend("x-default" = "that of its class", "examples" = [0.15]))]
    pub hardening_exponent: Option<Spanned<f64>>,
    /// `{ model = "johnson-cook", c = 0.014, reference_rate = 1.0 }` or `{ model = "cowper-symonds", d = 40.4, q = 5 }`: strength as a
    /// function of the [strain rate](laws.md#strain-rate): of the scene's impact, or with `[coupling]` of each impact.
    #[schemars(extend("x-default" = "none; that of AISI 4340 with `hardness`, `tensile_strength` or `tensile_test` of steel"))]
    pub rate: Option<Spanned<RateTable>>,
    /// Density; the warning of [fast impacts](limits.md) and two [losses](losses.md) need it.
    #[schemars(extend("x-default" = "that of the material", "examples" = ["7.85 g/cm^3"]))]
    pub density: Option<Spanned<f64>>,
    /// A ball or a [cylinder](line.md); the target of a cylinder is a plane, a cylinder or a bore.
    #[schemars(extend("x-default" = "that of the impactor"))]
    pub shape: Option<Spanned<ShapeName>>,
    /// Length of a [rod](limits.md#long-bodies), such as a piston, a chisel or a pin, with its `area`; needs density and moduli.
    #[schemars(extend("x-default" = "compact"))]
    pub length: Option<Spanned<f64>>,
    /// Area of the rod's cross-section.
    #[schemars(extend("x-default" = "compact"))]
    pub area: Option<Spanned<f64>>,
    /// Thickness of the plate, or of the wall, below the contact of a [cylinder](line.md#size): its depth depends on it.
    #[schemars(extend("x-default" = "none: a target with a radius is a solid roller", "examples" = ["40 mm"]))]
    pub thickness: Option<Spanned<f64>>,
    /// What the plate lies on.
    #[schemars(extend("default" = "smooth"))]
    pub base: Option<Spanned<BaseName>>,
    /// Radius of a curved target; negative for a socket, which must be wider than the impactor. A list of two is that of an [ellipse](ellipse.md).
    #[schemars(with = "Option<f64>", extend("x-default" = "flat", "examples" = ["-50 mm"]))]
    pub radius: Option<Spanned<Radius>>,
    /// Thickness of a thin plate that [gives way](losses.md#a-thin-plate) to the force; needs the density.
    #[schemars(extend("x-default" = "thick", "examples" = ["4 mm"]))]
    pub plate_thickness: Option<Spanned<f64>>,
    /// What a contact meets after a separation.
    #[schemars(extend("default" = "dented"))]
    pub surface: Option<SurfaceName>,
}

/// The keys of `[impactor]`, which is no plate and has no surface that remembers, in the order of messages. Those without a line are
/// as for the target.
#[derive(Deserialize, JsonSchema)]
#[serde(remote = "BodyTable", deny_unknown_fields, expecting = "a table")]
struct ImpactorKeys {
    /// A [built-in material](#built-in-materials) or [one of your own](#materials-of-your-own), which makes the impactor elastic; if it
    /// is softer than the target, [the impactor yields](laws.md#which-body-yields).
    pub material: Option<Spanned<String>>,
    /// Radius of the sphere; or `["5 mm", "40 mm"]`, the [radii along x and along y](ellipse.md) of the contact, of which one may be `"flat"`.
    #[schemars(with = "Option<f64>", extend("x-default" = "required", "examples" = ["5 mm"]))]
    pub radius: Option<Spanned<Radius>>,
    /// Young's modulus; give Poisson's ratio too.
    #[schemars(extend("x-default" = "that of the material, else rigid", "examples" = ["210 GPa"]))]
    pub youngs_modulus: Option<Spanned<f64>>,
    #[schemars(extend("x-default" = "that of the material, else rigid"))]
    pub poissons_ratio: Option<Spanned<f64>>,
    /// Yield strength of an elastic impactor; the [softer body](laws.md#which-body-yields) yields first.
    #[schemars(extend("x-default" = "that of the material"))]
    pub yield_strength: Option<Spanned<f64>>,
    pub hardening_modulus: Option<Spanned<f64>>,
    pub tangent_modulus: Option<Spanned<f64>>,
    pub power_law: Option<Spanned<PowerLawTable>>,
    #[schemars(with = "Option<String>")]
    pub hardness: Option<Spanned<toml::Value>>,
    pub tensile_strength: Option<Spanned<f64>>,
    pub tensile_test: Option<Spanned<TensileTestTable>>,
    pub hardening_exponent: Option<Spanned<f64>>,
    pub rate: Option<Spanned<RateTable>>,
    /// Density: with it, `[impact]` may leave out the mass, which is then that of a solid ball, or of the rod.
    pub density: Option<Spanned<f64>>,
    /// A ball, or a [cylinder](line.md), whose contact has the `length` of a line.
    #[schemars(extend("default" = "ball"))]
    pub shape: Option<Spanned<ShapeName>>,
    /// Length of the contact of a cylinder; or length of a [rod](limits.md#long-bodies), with its `area`; needs density and moduli.
    #[schemars(extend("x-default" = "compact", "examples" = ["20 mm"]))]
    pub length: Option<Spanned<f64>>,
    pub area: Option<Spanned<f64>>,
    #[serde(skip)]
    thickness: Option<Spanned<f64>>,
    #[serde(skip)]
    base: Option<Spanned<BaseName>>,
    #[serde(skip)]
    plate_thickness: Option<Spanned<f64>>,
    #[serde(skip)]
    surface: Option<SurfaceName>,
}

/// `[impactor]`.
#[derive(Default, Deserialize, JsonSchema)]
pub struct Impactor(#[serde(with = "ImpactorKeys")] pub BodyTable);

/// The radius of a body, or its principal radii along x and along y of the contact \[m\].
#[derive(Clone, Copy)]
pub enum Radius {
    One(f64),
    Two([f64; 2]),
}

impl BodyTable {
    /// Its radius, if it has one.
    pub fn one_radius(&self) -> Option<Spanned<f64>> {
        let radius = self.radius.as_ref()?;
        match radius.get_ref() {
            Radius::One(one) => Some(Spanned::new(radius.span(), *one)),
            Radius::Two(_) => None,
        }
    }
}

impl<'de> Deserialize<'de> for Radius {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Radius, D::Error> {
        struct OneOrTwo;
        impl<'de> Visitor<'de> for OneOrTwo {
            type Value = Radius;

            fn expecting(&self, text: &mut std::fmt::Formatter) -> std::fmt::Result {
                text.write_str("f64")
            }

            fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Radius, E> {
                Ok(Radius::One(number))
            }

            fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Radius, E> {
                Ok(Radius::One(number as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Radius, A::Error> {
                let list = Vec::deserialize(SeqAccessDeserializer::new(list))?;
                match list[..] {
                    [along_x, along_y] => Ok(Radius::Two([along_x, along_y])),
                    _ => Err(serde::de::Error::custom(format!(
                        "this is a list of {}, expected a number or two",
                        list.len()
                    ))),
                }
            }
        }
        deserializer.deserialize_any(OneOrTwo)
    }
}

/// How the flow stress grows with the strain rate.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RateTable {
    /// The model.
    pub model: Spanned<String>,
    /// `C` of `1 + C ln(rate/reference_rate)`, of Johnson and Cook.
    pub c: Option<Spanned<f64>>,
    /// The strain rate of the test that the strength is from.
    pub reference_rate: Option<Spanned<f64>>,
    /// `D` of `1 + (rate/D)^(1/q)`, of Cowper and Symonds.
    pub d: Option<Spanned<f64>>,
    /// `q` of the same.
    pub q: Option<Spanned<f64>>,
}

/// Flow stress `coefficient eps_p^exponent`.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerLawTable {
    /// `K`, the flow stress at a strain of 1.
    pub coefficient: Spanned<f64>,
    /// `n`.
    pub exponent: Spanned<f64>,
}

/// A tensile test: two numbers, or a curve. The name of a file stands for a curve.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct TensileTestTable {
    /// Proof stress at 0.2 % plastic strain.
    pub proof_stress: Option<Spanned<f64>>,
    /// Tensile strength.
    pub tensile_strength: Option<Spanned<f64>>,
    /// True strains of the points.
    pub true_strain: Option<Spanned<Vec<f64>>>,
    /// True strains less their elastic part.
    pub plastic_strain: Option<Spanned<Vec<f64>>>,
    /// True stresses of the points.
    pub true_stress: Option<Spanned<Vec<f64>>>,
    /// The name of a file with the points, beside keys that say how it is read.
    pub curve: Option<Spanned<CurveTable>>,
    /// Initial cross section of the specimen, for a file with its force.
    pub section: Option<Spanned<f64>>,
    /// Initial gauge length of the specimen, for a file with its change of length.
    pub gauge_length: Option<Spanned<f64>>,
    /// Whether the compliance of the machine is taken off the strain, so that the curve begins with Young's modulus.
    #[schemars(extend("default" = false))]
    pub compliance_correction: Option<Spanned<bool>>,
}

/// The points of a curve.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct CurveTable {
    /// True strains of the points.
    pub true_strain: Option<Spanned<Vec<f64>>>,
    /// True strains less their elastic part.
    pub plastic_strain: Option<Spanned<Vec<f64>>>,
    /// True stresses of the points.
    pub true_stress: Option<Spanned<Vec<f64>>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ShapeName {
    /// Round in all directions: a contact at one point.
    Ball,
    /// A contact along a line.
    Cylinder,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BaseName {
    /// On a rigid base, along which it can move.
    Smooth,
    /// Bonded to a rigid base.
    Bonded,
}

#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceName {
    /// Each contact hits the same dent again.
    Dented,
    /// Each contact after a separation meets an untouched surface.
    Fresh,
}

impl From<SurfaceName> for Surface {
    fn from(name: SurfaceName) -> Surface {
        match name {
            SurfaceName::Dented => Surface::Dented,
            SurfaceName::Fresh => Surface::Fresh,
        }
    }
}

#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LawTable {
    /// A [loading law](all-laws.md#loading-laws) or a [rate-dependent law](rate-dependent.md), or `{ table = "file.csv" }` with a
    /// [curve of one's own](laws.md#a-curve-of-ones-own).
    #[schemars(extend("x-default" = "`\"brinell\"`; without a yield strength `\"hertz\"`"))]
    pub loading: Option<Spanned<String>>,
    /// The table in place of the name: [`deserialized`] takes it apart.
    #[schemars(skip)]
    #[serde(rename = "loading table")]
    pub(super) own_curve: Option<Spanned<OwnCurveTable>>,
    /// Constants of the loading law, or of the rate-dependent law, by name.
    #[schemars(with = "Option<ConstantKeys>", extend("x-default" = "those of the reference"))]
    pub loading_parameters: Option<ConstantTable>,
    /// An [unloading law](all-laws.md#unloading-laws).
    #[schemars(extend("x-default" = "the law that `loading` was published with, else `\"contact-radius\"`"))]
    pub unloading: Option<Spanned<String>>,
    /// Coefficient of restitution that a rate-dependent law is made for.
    #[schemars(extend("examples" = [0.8]))]
    pub restitution: Option<Spanned<f64>>,
    /// A restitution, or `"waves"`: a [loss below yield](losses.md), on top of any plastic law.
    #[schemars(with = "Option<f64>", extend("x-default" = "nothing is lost below yield", "examples" = [0.95, "waves"]))]
    pub elastic_restitution: Option<Spanned<toml::Value>>,
    /// Damping factor of a rate-dependent law.
    #[schemars(extend("x-default" = "that of the law"))]
    pub damping: Option<Spanned<String>>,
    /// `C` of a [line contact](line.md#size), in place of the sizes from which it follows: the elastic depth is `F'/(pi E*) (C - ln(F/F_y))`.
    #[schemars(extend("x-default" = "that of the sizes", "examples" = [11.5]))]
    pub size_constant: Option<Spanned<f64>>,
    /// Constants of the unloading law, by name.
    #[schemars(with = "Option<ConstantKeys>", extend("x-default" = "those of the reference"))]
    pub unloading_parameters: Option<ConstantTable>,
    /// Shorten the elastic recovery where the laws would return [more energy than they took](laws.md#energy).
    #[schemars(extend("default" = false))]
    pub passivity_guard: Option<Spanned<bool>>,
}

/// A loading curve of one's own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "the name of a law, or { table = \"file.csv\" }")]
pub struct OwnCurveTable {
    pub table: Spanned<Rows>,
}

/// A [`ConstantTable`] as a scene has it: numbers.
type ConstantKeys = BTreeMap<String, f64>;

#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fmu {
    /// [Outputs](variables.md#outputs) beside `force`.
    #[serde(default)]
    pub outputs: Vec<Spanned<String>>,
    /// Naming convention in the XML; some tools turn structured names into buses.
    #[schemars(extend("x-default" = "`\"flat\"`; several contacts: `\"structured\"`"))]
    pub names: Option<NamesName>,
    /// The [parameters](variables.md#parameters) that can be set; the others become constants of the binary.
    #[schemars(extend("x-default" = "all"))]
    pub parameters: Option<Vec<Spanned<String>>>,
    /// Distance of the bodies at the start; negative: pressed in along the loading curve.
    #[schemars(extend("default" = 0))]
    pub initial_gap: Option<Spanned<f64>>,
    /// Step that the FMU suggests to importers (`DefaultExperiment`); any other works, too.
    #[schemars(extend("x-default" = "one that suits the [coupling](fmu.md#which-force-belongs-to-which-step)", "examples" = ["1 us"]))]
    pub step_size: Option<Spanned<f64>>,
    /// Stop time that it suggests, not before the end of the first step.
    #[schemars(extend("x-default" = "one that suits the impact", "examples" = ["1 ms"]))]
    pub stop_time: Option<Spanned<f64>>,
    /// A library that needs nothing from its process, see [hosts that share nothing](standalone.md).
    #[schemars(extend("default" = false))]
    pub standalone: Option<bool>,
    /// The [rate may change within a step](fmu.md); `false` makes an FMU a twentieth smaller. Not with `[coupling]`; rate-dependent laws
    /// have none.
    #[schemars(extend("default" = true))]
    pub input_derivatives: Option<bool>,
}

/// The naming convention of variables for importers.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NamesName {
    /// Flat names, in which dots have no meaning.
    Flat,
    /// Structured names: dots and brackets form a tree.
    Structured,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingTable {
    /// The mass that the contact force accelerates: `1/m = 1/m1 + 1/m2`.
    #[schemars(extend("x-default" = "required, unless contacts [share bodies](#contacts-that-share-bodies)", "examples" = ["4.11 g"]))]
    pub effective_mass: Option<Spanned<f64>>,
    /// The contacts [share bodies](#contacts-that-share-bodies), and the entries of the matrix of inverse effective masses are inputs
    /// [1/kg].
    pub inverse_masses: Option<Spanned<InverseMassesName>>,
    /// Order of execution of the importer, see [coupling](coupling.md).
    #[schemars(extend("default" = "serial"))]
    pub master: Option<MasterName>,
    /// What becomes an input, instead of a derivative and a parameter.
    #[serde(default)]
    pub inputs: Vec<Spanned<String>>,
}

/// Where the inverse masses of contacts that share bodies come from, if the scene has no bodies.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum InverseMassesName {
    Input,
}

/// Friction of all contacts.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionTable {
    /// Coulomb's coefficient of friction.
    pub coefficient: Spanned<f64>,
    /// Number of tangential directions; with 2, rates and forces along the surface are [vectors](friction.md#two-directions).
    #[schemars(extend("default" = 1, "enum" = [1, 2]))]
    pub directions: Option<Spanned<i64>>,
}

/// Friction of one contact.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnFriction {
    /// Coulomb's coefficient of friction; 0 is a contact without friction.
    #[schemars(extend("x-default" = "that of the scene"))]
    pub coefficient: Option<Spanned<f64>>,
}

/// The order in which an importer steps FMUs.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MasterName {
    /// The contact first; its force is applied over the same step.
    Serial,
    /// All at the same time.
    Parallel,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImpactTable {
    /// Effective mass `m1 m2/(m1 + m2)`: that of the impactor if the target is held.
    #[schemars(extend("x-default" = "that of a solid impactor of known density, else required", "examples" = ["4.11 g"]))]
    pub mass: Option<Spanned<f64>>,
    /// Closing speed.
    #[schemars(extend("x-default" = "required, or `drop_height`", "examples" = ["1 m/s"]))]
    pub speed: Option<Spanned<f64>>,
    /// Height from which the impactor falls, instead of the speed.
    #[schemars(extend("examples" = ["0.5 m"]))]
    pub drop_height: Option<Spanned<f64>>,
    /// Warn of [unstable steps](coupling.md#warnings-about-coupling), for FMUs that do not know the mass.
    #[schemars(extend("default" = true))]
    pub watch: Option<bool>,
}

/// A body that contacts share.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct SharedBodyTable {
    /// Name of the body, a C identifier; `ground` always exists and never moves.
    pub name: Spanned<String>,
    /// Mass.
    pub mass: Spanned<f64>,
    /// Moments of inertia about the centre of mass: one number (a ball), three (principal, along x, y and z of the scene) or six (the
    /// elements xx, yy, zz, xy, xz, yz of the tensor, which is positive definite).
    #[schemars(with = "Option<Vec<f64>>", extend("x-default" = "forces don't turn the body"))]
    pub inertia: Option<Spanned<toml::Value>>,
}

/// One contact, or `count` equal contacts, with the values that differ from the tables above.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct ContactTable {
    /// Name of the contact, or of the group: a C identifier.
    pub name: Spanned<String>,
    /// Number of equal contacts in the group.
    #[schemars(range(min = 1, max = MOST_CONTACTS), extend("x-default" = "a single contact"))]
    pub count: Option<Spanned<i64>>,
    /// The names of the two bodies, `["box", "ground"]`.
    #[schemars(extend("minItems" = 2, "maxItems" = 2, "x-default" = "required with `[[body]]`"))]
    pub between: Option<Spanned<Vec<Spanned<String>>>>,
    /// On a line: 1 if the second body is on the positive side of the first, else -1; the closing rate is the velocity of the first minus
    /// that of the second, times this.
    #[schemars(extend("default" = 1, "enum" = [1, -1]))]
    pub direction: Option<Spanned<i64>>,
    /// In space: direction `[x, y, z]` from the first body to the second, of any length; all contacts have one, or none.
    #[schemars(extend("minItems" = 3, "maxItems" = 3, "x-default" = "bodies on one line"))]
    pub normal: Option<Spanned<Vec<f64>>>,
    /// With `normal`: the contact's place `[x, y, z]` relative to the centre of mass of each of the two bodies; `[]` is the centre of mass
    /// itself, and the arm of `ground`.
    #[schemars(extend("minItems" = 2, "maxItems" = 2, "default" = [[], []]))]
    pub arms: Option<Spanned<Vec<Spanned<Vec<f64>>>>>,
    /// With `[[body]]` and `[friction]`: the first direction `[x, y, z]` of the tangential rates, at right angles to the normal; the second
    /// is `normal x tangent`.
    #[schemars(extend("minItems" = 3, "maxItems" = 3, "x-default" = "required with `[friction]`"))]
    pub tangent: Option<Spanned<Vec<f64>>>,
    /// Keys of `[impactor]` that differ.
    #[serde(default)]
    #[schemars(extend("x-default" = "that of the scene"))]
    pub impactor: Impactor,
    /// Keys of `[target]` that differ.
    #[serde(default)]
    #[schemars(extend("x-default" = "that of the scene"))]
    pub target: BodyTable,
    /// Distance at the start.
    #[schemars(extend("x-default" = "that of `[fmu]`"))]
    pub initial_gap: Option<Spanned<f64>>,
    /// Mass that the contact's force accelerates.
    #[schemars(extend("x-default" = "that of `[coupling]`"))]
    pub effective_mass: Option<Spanned<f64>>,
    /// `{ coefficient = 0.1 }`, if the scene has a table `[friction]`.
    #[serde(default)]
    #[schemars(extend("x-default" = "that of the scene"))]
    pub friction: OwnFriction,
    /// Parameters that each contact of the group has for itself: `bead[7].target.yield_strength`.
    #[serde(default)]
    pub parameters_per_contact: Vec<Spanned<String>>,
}

impl SceneFile {
    /// Reads the `text` of a scene, with the files `referenced` by it.
    ///
    /// # Errors
    /// Text that is not TOML, has a wrong type, or is unknown, with its place.
    pub fn read(text: &str, referenced: &ReferencedFiles) -> Result<SceneFile, Mistake> {
        let (mut file, added) = with_tree(text, &referenced.files, |tree| {
            let mut file: SceneFile = of_tree(text, tree)?;
            let own = own_materials::check(file.material.take().unwrap_or_default())?;
            file.own = own.into_iter().map(OwnMaterial::of_scene).collect();
            let used: Vec<_> = file.materials_used().cloned().collect();
            let added = own_materials::take_in(&used, &mut file.own, &referenced.materials);
            let own = file.own.iter().map(|own| own.material.name.as_str());
            let materials: Vec<_> = own.chain(MATERIALS.iter().map(|material| material.name.as_str())).collect();
            file.broken = rules::check(tree.get_ref(), &materials).err();
            let yielding = if file.is_line() { LINE } else { DEFAULT_LOADING };
            let of_laws = |loading| rules::check_chosen(tree.get_ref(), loading).err();
            file.broken_by_laws = ["hertz", yielding].map(of_laws);
            Ok((file, added))
        })?;
        file.alone = with_curves(text, &referenced.files)?;
        // beside the FMU there is no schema
        if file.alone.starts_with("#:schema ") {
            file.alone.drain(..file.alone.find('\n').map_or(0, |end| end + 1));
        }
        if !added.is_empty() {
            file.alone = format!("{}\n{added}", file.alone.trim_end());
            // a list in the text can't go on in tables
            deserialized::<SceneFile>(&file.alone, &BTreeMap::new()).map_err(|_| {
                let message = "the scene has `material` in another form than tables [[material]], to which those of materials.toml can't be added";
                Mistake(0..0, message.into())
            })?;
        }
        Ok(file)
    }

    /// Whether the contacts of the scene are lines, by the shape of its impactor.
    pub fn is_line(&self) -> bool {
        let shape = self.impactor.as_ref().and_then(|impactor| impactor.get_ref().0.shape.as_ref());
        shape.is_some_and(|shape| *shape.get_ref() == ShapeName::Cylinder)
    }

    /// The names of the materials of all bodies.
    pub fn materials_used(&self) -> impl Iterator<Item = &Spanned<String>> {
        let impactor = self.impactor.iter().map(|impactor| &impactor.get_ref().0);
        let contacts = self.contact.iter().flat_map(|contacts| contacts.get_ref()).map(Spanned::get_ref);
        let of_contacts = contacts.flat_map(|contact| [&contact.impactor.0, &contact.target]);
        let bodies = impactor.chain(self.target.iter().map(Spanned::get_ref)).chain(of_contacts);
        bodies.filter_map(|body| body.material.as_ref())
    }
}

/// The tables of this `text`, with the `files` that it names.
fn deserialized<T: for<'a> Deserialize<'a>>(text: &str, files: &Files) -> Result<T, Mistake> {
    with_tree(text, files, |tree| of_tree(text, tree))
}

/// What is `made` of the tree of this `text`, with the `files` that it names.
fn with_tree<T>(
    text: &str,
    files: &Files,
    made: impl FnOnce(&toml::Spanned<DeTable<'_>>) -> Result<T, Mistake>,
) -> Result<T, Mistake> {
    let (tree, values) = parsed(text, files)?;
    // it borrows the values from here on
    let mut tree = tree;
    tree.get_mut().iter_mut().for_each(|(_, value)| put(value, &values));
    name_own_curve(tree.get_mut());
    made(&tree)
}

fn of_tree<T: for<'a> Deserialize<'a>>(text: &str, tree: &toml::Spanned<DeTable<'_>>) -> Result<T, Mistake> {
    T::deserialize(Deserializer::from(tree.clone())).map_err(|error| of_parser(text, &error))
}

/// Puts the name of the law in place of a curve of one's own, which gets a key for itself.
fn name_own_curve(tree: &mut DeTable) {
    let Some(DeValue::Table(law)) = tree.get_mut("law").map(toml::Spanned::get_mut) else { return };
    let Some(loading) = law.get_mut("loading").filter(|loading| loading.get_ref().is_table()) else { return };
    let span = loading.span();
    let name = DeValue::String(TABLE.into());
    let curve = std::mem::replace(loading, toml::Spanned::new(span.clone(), name));
    law.insert(toml::Spanned::new(span, "loading table".into()), curve);
}

/// What the scene with this `text` can't have beside what it has, by key or `key=value`; its loading law is `loading` if it names none.
/// Nothing, if it is no TOML.
pub fn closed(text: &str, loading: &str) -> BTreeMap<String, Closed> {
    with_tree(text, &BTreeMap::new(), |tree| Ok(rules::closed(tree.get_ref(), loading))).unwrap_or_default()
}

/// The bytes of files by the name that a scene gives them.
type Files = BTreeMap<String, Result<Vec<u8>, String>>;

/// The key of a tensile test, which may be the name of a file, and the key in it that may be one.
const TEST: &str = "tensile_test";
const CURVE: &str = "curve";

/// In place of one of two radii.
pub const FLAT: &str = "flat";

/// The names of the files in the `text` of a scene, relative to it: [`ReferencedFiles`] takes their bytes. None, if it is no TOML.
pub fn files_named(text: &str) -> Vec<String> {
    fn named(value: &DeValue, key: &str, found: &mut Vec<String>) {
        match value {
            DeValue::Table(table) => {
                table.iter().for_each(|(key, value)| named(value.get_ref(), key.get_ref(), found));
            }
            DeValue::Array(list) => list.iter().for_each(|value| named(value.get_ref(), key, found)),
            DeValue::String(name) if [TEST, CURVE, TABLE].contains(&key) => found.push(name.to_string()),
            _ => {}
        }
    }
    let mut found = Vec::new();
    // most scenes name none, and may be large
    if !text.contains(TEST) && !text.contains(TABLE) {
        return found;
    }
    let tree = DeTable::parse(text);
    tree.iter().flat_map(|tree| tree.get_ref().iter()).for_each(|(key, value)| {
        named(value.get_ref(), key.get_ref(), &mut found);
    });
    found
}

/// The mistake of this `message` of the parser about a place in the `text`.
fn in_words(text: &str, span: Range<usize>, message: &str) -> Mistake {
    let start = text[..span.start].rfind('\n').map_or(0, |end| end + 1);
    let line = text[start..].lines().next().unwrap_or_default();
    if let Some((place, message)) = parser_words::typographic(line) {
        return Mistake(start + place..start + place, message);
    }
    let line = line.trim();
    Mistake(span.clone(), parser_words::words(message, line, &text[span]))
}

fn of_parser(text: &str, error: &toml::de::Error) -> Mistake {
    in_words(text, error.span().unwrap_or(0..0), error.message())
}

/// The tree of the `text`, and the values that stand for texts in it: numbers with a unit, and files.
fn parsed<'text>(text: &'text str, files: &Files) -> Result<(toml::Spanned<DeTable<'text>>, InSi), Mistake> {
    let tree = DeTable::parse(text).map_err(|error| of_parser(text, &error))?;
    let mut found = Found { files, values: InSi::new() };
    found.in_table("", tree.get_ref())?;
    Ok((tree, found.values))
}

/// The `text` with the `values` in place of the texts for which they stand.
fn with_values(text: &str, values: InSi) -> String {
    let (mut made, mut end) = (String::new(), 0);
    for (start, (until, value)) in values {
        made = made + &text[end..start] + &value;
        end = until;
    }
    made + &text[end..]
}

/// The `text` of a scene with all numbers in SI units, and all files taken in: a bare number in place of each text with a unit.
///
/// # Errors
/// Text that is not TOML, and a wrong unit, with its place.
pub fn in_si(text: &str, files: &Files) -> Result<String, Mistake> {
    Ok(with_values(text, parsed(text, files)?.1))
}

/// The `text` of a scene with curves in place of the names of `files`.
fn with_curves(text: &str, files: &Files) -> Result<String, Mistake> {
    if files.is_empty() {
        return Ok(text.into());
    }
    let values = parsed(text, files)?.1.into_iter().filter(|(_, (_, value))| value.starts_with('{'));
    Ok(with_values(text, values.collect()))
}

/// Numbers in SI units and curves as TOML writes them, with the end of the text for which each stands, by its beginning.
type InSi = BTreeMap<usize, (usize, String)>;

/// What stands for texts of a scene.
struct Found<'a> {
    files: &'a Files,
    values: InSi,
}

impl Found<'_> {
    /// Finds the texts with a value, such as `"5 mm"`, in a `table` at this `path`.
    fn in_table(&mut self, path: &str, table: &DeTable) -> Result<(), Mistake> {
        table.iter().try_for_each(|(key, value)| {
            let key = key.get_ref();
            let unit = quantity_of(path.rsplit('.').next().unwrap_or_default(), key).unit;
            let path = if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
            if let (TEST | CURVE, DeValue::String(name)) = (key.as_ref(), value.get_ref()) {
                let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(name)));
                let owner = path.rsplit_once('.').map_or("", |(owner, _)| owner);
                let curve = self.curve(name, &specimen(owner, table)?).map_err(wrong)?;
                self.values.insert(value.span().start, (value.span().end, curve));
                return Ok(());
            }
            if let ("law.loading.table", DeValue::String(name)) = (path.as_str(), value.get_ref()) {
                let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(name)));
                let rows = match self.files.get(name.as_ref()) {
                    Some(Ok(bytes)) => own_curve::read(bytes).map(|rows| rows.in_toml()),
                    Some(Err(why)) => Err(why.clone()),
                    None => Err("the file isn't at hand".into()),
                };
                self.values.insert(value.span().start, (value.span().end, rows.map_err(wrong)?));
                return Ok(());
            }
            self.in_value(&path, unit, value)
        })
    }

    /// The same in a `value`, which is a number in this `unit`, a list, or a table.
    fn in_value(
        &mut self,
        path: &str,
        unit: Option<&'static str>,
        value: &toml::Spanned<DeValue>,
    ) -> Result<(), Mistake> {
        let is_flat = |value: &toml::Spanned<DeValue>| {
            path.ends_with(".radius") && matches!(value.get_ref(), DeValue::String(text) if text == FLAT)
        };
        let (text, unit) = match (value.get_ref(), unit) {
            (DeValue::Table(table), _) => return self.in_table(path, table),
            (DeValue::Array(list), _) => {
                let flat = list.iter().filter(|value| is_flat(value)).map(toml::Spanned::span);
                self.values.extend(flat.map(|span| (span.start, (span.end, "inf".into()))));
                return list
                    .iter()
                    .filter(|value| !is_flat(value))
                    .try_for_each(|value| self.in_value(path, unit, value));
            }
            (DeValue::String(text), Some(unit)) => (text, unit),
            _ => return Ok(()),
        };
        let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(text)));
        let number = units::with_unit(text, unit).transpose().map_err(wrong)?;
        self.values.extend(number.map(|number| (value.span().start, (value.span().end, format!("{number:e}")))));
        Ok(())
    }

    /// The curve of a tensile test in the file `name`, as a table of a scene.
    fn curve(&self, name: &str, specimen: &Specimen) -> Result<String, String> {
        match self.files.get(name) {
            Some(Ok(bytes)) => Ok(tension::read(bytes, specimen)?.in_toml()),
            Some(Err(why)) => Err(why.clone()),
            None => Err("the file isn't at hand; give the points as true_strain and true_stress, or proof_stress and tensile_strength".into()),
        }
    }
}

/// What a `table` beside a curve says of its specimen. `owner` is its path.
fn specimen(owner: &str, table: &DeTable) -> Result<Specimen, Mistake> {
    let number = |key: &str| {
        let Quantity { unit, allowed } = quantity_of(TEST, key);
        let Some((unit, value)) = unit.zip(table.get(key)) else { return Ok(None) };
        let number = match value.get_ref() {
            DeValue::String(text) => units::with_unit(text, unit)
                .transpose()
                .map_err(|why| Mistake(value.span(), format!("{owner}.{key} = \"{}\": {why}", shortened(text))))?,
            DeValue::Float(number) => number.as_str().replace('_', "").parse().ok(),
            DeValue::Integer(number) => number.as_str().replace('_', "").parse().ok(),
            // of another type: the parser tells
            _ => None,
        };
        let is_out = |number: &f64| !allowed.contains(number);
        match number.filter(is_out) {
            Some(number) => {
                Err(Mistake(value.span(), format!("{owner}.{key} {}", out_of_range(number, &allowed, unit))))
            }
            None => Ok(number),
        }
    };
    Ok(Specimen { section: number("section")?, gauge_length: number("gauge_length")? })
}

/// Puts the `values` in place of their texts in this `value`.
fn put<'text>(value: &mut toml::Spanned<DeValue<'text>>, values: &'text InSi) {
    let found = values.get(&value.span().start);
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| put(value, values)),
        DeValue::Array(list) => list.iter_mut().for_each(|value| put(value, values)),
        text @ DeValue::String(_) => {
            if let Some((_, found)) = found {
                *text = DeValue::parse(found).expect("a value of TOML").into_inner();
            }
        }
        _ => {}
    }
}
