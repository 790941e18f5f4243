//! FMUs from prebuilt libraries: the same outputs, bit for bit, as of compiled ones, and errors where there is none for a scene.
#![cfg(target_os = "linux")]

#[path = "support/command.rs"]
mod command;
#[path = "support/loaded.rs"]
mod loaded;
#[path = "support/physics.rs"]
mod physics;
#[path = "support/prebuilt.rs"]
mod prebuilt;
#[path = "support/pytest.rs"]
mod pytest;
#[path = "support/python.rs"]
mod python;
#[path = "support/unit.rs"]
mod unit;

use command::{assert_same, brinell, contents, empty_folder, output, run};
use loaded::{Instance, OK, Unit, take_message};
use physics::Random;
use prebuilt::{LAWS, export, store};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Every output that a scene without known mass can have, and more if it has one.
const STATE: [&str; 11] = [
    "indentation",
    "max_indentation",
    "residual_indentation",
    "contact_radius",
    "mean_pressure",
    "stiffness",
    "work",
    "elastic_energy",
    "dissipated_energy",
    "predicted_force",
    "regime",
];

/// A scene with these outputs and these lines besides.
fn scene(law: &str, outputs: &[&str], more: &str) -> String {
    let (loading, partner) = law.split_once('/').map_or((law, None), |(loading, partner)| (loading, Some(partner)));
    let damped = ["hunt-crossley", "kelvin-voigt", "tsuji", "kuwabara-kono", "adams-impact"].contains(&loading);
    let mut table = format!("[law]\nloading = {loading:?}\n");
    if let Some(partner) = partner {
        table += &format!("{} = {partner:?}\n", if damped { "damping" } else { "unloading" });
    }
    if ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&loading) {
        table += "restitution = 0.6\n";
    }
    // what a test says of its bodies comes first
    let bodies = match more.contains("[impactor]") {
        true => "",
        false => "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n",
    };
    let fmu = match more.contains("[fmu]") {
        true => more.replacen("[fmu]", &format!("[fmu]\noutputs = {outputs:?}"), 1),
        false => format!("[fmu]\noutputs = {outputs:?}\n{more}"),
    };
    format!("name = \"unit\"\n{bodies}{table}{fmu}")
}

/// The same scene in both ways.
struct Both {
    /// That of the prebuilt library.
    kind: String,
    compiled: Unit,
    prebuilt: Unit,
    variables: Vec<Variable>,
}

#[derive(Clone, Debug)]
struct Variable {
    name: String,
    reference: u32,
    causality: String,
    is_real: bool,
    start: f64,
    minimum: f64,
    maximum: f64,
}

/// The model description of an FMU.
fn description(fmu: &Path) -> String {
    let library = unit::library(fmu);
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library")
}

/// The text of an attribute.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    element.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

fn variables(description: &str) -> Vec<Variable> {
    let elements = description.split("<ScalarVariable").skip(1);
    let number = |element, name| attribute(element, name).map_or(f64::NAN, |text| text.parse().expect("a number"));
    elements
        .map(|element| {
            let element = element.split("</ScalarVariable>").next().unwrap();
            Variable {
                name: attribute(element, "name").unwrap().into(),
                reference: attribute(element, "valueReference").unwrap().parse().unwrap(),
                causality: attribute(element, "causality").unwrap().into(),
                is_real: element.contains("<Real"),
                start: number(element, "start"),
                minimum: number(element, "min"),
                maximum: number(element, "max"),
            }
        })
        .collect()
}

impl Both {
    fn of(text: String, store: &Path) -> Both {
        let (compiled, (prebuilt, kind)) = (export(&text, None), prebuilt::export_by_kind(&text, store));
        let [one, other] = [&compiled, &prebuilt].map(|fmu| {
            let text = description(fmu);
            let guid = attribute(&text, "guid").unwrap().to_string();
            assert_eq!(guid.len(), 32);
            (text.replace(&guid, "GUID"), guid)
        });
        assert!(one.0 == other.0, "the model descriptions differ in more than the GUID: {text}");
        assert_ne!(one.1, other.1, "{text}");
        let variables = variables(&one.0);
        Both { kind, compiled: Unit::open(&compiled), prebuilt: Unit::open(&prebuilt), variables }
    }

    fn of_causality(&self, causality: &str) -> Vec<Variable> {
        self.variables.iter().filter(|variable| variable.causality == causality).cloned().collect()
    }

    /// Runs both through the same calls, as many as `calls`, and compares all that they say and show; how many messages that were.
    fn compare(&self, calls: usize, random: &mut Random) -> usize {
        let outputs = self.of_causality("output");
        let reals: Vec<u32> = outputs.iter().filter(|output| output.is_real).map(|output| output.reference).collect();
        let regime = outputs.iter().find(|output| !output.is_real);
        let parameters = self.of_causality("parameter");
        let inputs = self.of_causality("input");
        let mut pair = Pair::new(&self.compiled, &self.prebuilt);
        // what a scene doesn't request isn't there, whatever the library could show
        let beyond = self.variables.len() as u32;
        assert_ne!(pair.both(|unit| unit.set(&[beyond], &[1.0])), OK);
        pair.both(|unit| unit.status_of("fmi2Reset"));
        pair.begin(&parameters, random);
        let (mut time, mut step) = (0.0, 1e-6);
        let mut depth_of_state = None;
        for _ in 0..calls {
            for input in &inputs {
                let value = match input.name.as_str() {
                    "effective_mass" => positive(random, -6.0, 2.0),
                    _ => signed(random, -6.0, 2.0),
                };
                if below(random, 4) != 0 || input.name == "indentation_rate" {
                    pair.both(|unit| unit.set(&[input.reference], &[value]));
                }
            }
            if below(random, 5) == 0 {
                let derivative = signed(random, 0.0, 6.0);
                pair.both(|unit| unit.set_derivatives(&[0], 1, &[derivative]));
            }
            if below(random, 3) == 0 {
                step = positive(random, -9.0, -4.0);
            }
            if pair.both(|unit| unit.step(time, step)) == OK {
                time += step;
            } else {
                // too deep, or too long: all that is left is to begin anew
                pair.both(|unit| unit.status_of("fmi2Reset"));
                pair.begin(&parameters, random);
                (time, depth_of_state) = (0.0, None);
                continue;
            }
            pair.read(|unit, values| unit.get(&reals, values), reals.len());
            if let Some(regime) = regime {
                pair.both(|unit| unit.integer(&regime.name));
            }
            match below(random, 12) {
                0 => pair.read(|unit, values| unit.output_derivatives(&reals, 1, values), reals.len()),
                1 => pair.read(|unit, values| unit.output_derivatives(&reals, 2, values), reals.len()),
                2 => pair.read(|unit, values| unit.directional(&reals, 0, values), reals.len()),
                3 => {
                    pair.save();
                    depth_of_state = Some(time);
                }
                4 => {
                    if let Some(saved) = depth_of_state {
                        pair.restore();
                        time = saved;
                    }
                }
                5 => {
                    // refused, in the same words
                    let any = &parameters.get(below(random, parameters.len().max(1)));
                    let reference = any.map_or(99, |parameter| parameter.reference);
                    let value = positive(random, -9.0, 12.0);
                    if pair.both(|unit| unit.set(&[reference], &[value])) != OK {
                        pair.both(|unit| unit.status_of("fmi2Reset"));
                        pair.begin(&parameters, random);
                        (time, depth_of_state) = (0.0, None);
                    }
                }
                _ => {}
            }
        }
        pair.messages
    }
}

/// A random number below `count`.
fn below(random: &mut Random, count: usize) -> usize {
    (random.next() * count as f64) as usize
}

/// A random number between two others.
fn between(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * random.next()
}

/// A number of random size, between powers of ten.
fn positive(random: &mut Random, from: f64, to: f64) -> f64 {
    10f64.powf(between(random, from, to))
}

/// The same with a random sign.
fn signed(random: &mut Random, from: f64, to: f64) -> f64 {
    let size = positive(random, from, to);
    if below(random, 2) == 0 { size } else { -size }
}

/// Two instances that get the same calls.
struct Pair<'a> {
    compiled: Instance<'a>,
    prebuilt: Instance<'a>,
    states: Option<[*mut std::ffi::c_void; 2]>,
    /// How many messages there were.
    messages: usize,
}

impl<'a> Pair<'a> {
    fn new(compiled: &'a Unit, prebuilt: &'a Unit) -> Pair<'a> {
        let [mut compiled, mut prebuilt] = [compiled, prebuilt].map(Unit::instantiate);
        compiled.log_everything();
        prebuilt.log_everything();
        Pair { compiled, prebuilt, states: None, messages: 0 }
    }

    /// The same call for both, with the same result and message.
    fn both<T: PartialEq + std::fmt::Debug>(&mut self, call: impl Fn(&mut Instance) -> T) -> T {
        take_message();
        let one = (call(&mut self.compiled), take_message());
        let other = (call(&mut self.prebuilt), take_message());
        assert_eq!(one, other);
        self.messages += usize::from(!one.1.is_empty());
        one.0
    }

    /// The same reading of both, with the same bits.
    fn read(&mut self, call: impl Fn(&mut Instance, &mut [f64]) -> i32, count: usize) {
        self.both(|unit| {
            let mut values = vec![0.0; count];
            let status = call(unit, &mut values);
            (status, values.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        });
    }

    /// Sets parameters and initializes, until some are taken.
    fn begin(&mut self, parameters: &[Variable], random: &mut Random) {
        self.states = None;
        loop {
            let mut taken = true;
            for Variable { name, reference, start, minimum, maximum, .. } in parameters {
                if below(random, 3) == 0 {
                    continue;
                }
                let value = match name.rsplit('.').next().unwrap() {
                    "poissons_ratio" => between(random, -0.2, 0.5),
                    "initial_gap" => signed(random, -8.0, -5.0),
                    "restitution" => between(random, 0.2, 1.0),
                    _ => start * positive(random, -0.5, 0.5),
                };
                // one in a while is beyond the limits
                let value = if below(random, 40) == 0 { 2.0 * maximum + 1.0 } else { value.clamp(*minimum, *maximum) };
                taken &= self.both(|unit| unit.set(&[*reference], &[value])) == OK;
            }
            if taken {
                self.both(|unit| unit.enter_initialization());
                if self.both(|unit| unit.status_of("fmi2ExitInitializationMode")) == OK {
                    return;
                }
            }
            self.both(|unit| unit.status_of("fmi2Reset"));
        }
    }

    fn save(&mut self) {
        self.forget();
        let states = [&self.compiled, &self.prebuilt].map(|unit| {
            let state = unit.save();
            // through bytes and back
            let bytes = unit.serialize(state);
            unit.free(state);
            unit.deserialize(&bytes).expect("its own state")
        });
        self.states = Some(states);
    }

    fn restore(&mut self) {
        let [one, other] = self.states.expect("a saved state");
        self.compiled.restore(one);
        self.prebuilt.restore(other);
    }

    fn forget(&mut self) {
        if let Some([one, other]) = self.states.take() {
            self.compiled.free(one);
            self.prebuilt.free(other);
        }
    }
}

impl Drop for Pair<'_> {
    fn drop(&mut self) {
        self.forget();
    }
}

/// Lines of scenes with all that data can differ in.
const BODIES: &str = "[impactor]\nradius = 10e-3\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\n\
                      [target]\nmaterial = \"aluminium 6061-T6\"\nradius = -50e-3\nsurface = \"fresh\"\n";
const NAMED: &str =
    "[[contact]]\nname = \"left\"\ntarget = { yield_strength = 9e8, density = 5e3 }\ninitial_gap = 1e-6\n";
const COUNTED: &str = "[[contact]]\nname = \"bead\"\ncount = 1\n";
const IMPACT: &str = "[impact]\nmass = 4e-3\nspeed = 1.0\n";

/// What a scene of one law may have, in the smallest library and in the largest ones.
fn scenes(law: &str, damped: bool) -> Vec<String> {
    let momentum: Vec<_> = STATE.into_iter().chain(["impulse", "mean_force"]).collect();
    let known: Vec<_> = momentum.iter().copied().chain(["closing_speed"]).collect();
    let mut scenes = vec![
        scene(law, &["indentation"], ""),
        scene(law, &STATE, IMPACT),
        scene(law, &momentum, &format!("{BODIES}[fmu]\ninitial_gap = 1e-6\n{IMPACT}watch = false\n")),
    ];
    if !damped {
        let coupling = |more: &str| format!("[coupling]\neffective_mass = 4e-3\n{more}");
        scenes.push(scene(law, &["indentation", "regime"], NAMED));
        scenes.push(scene(law, &["work"], &format!("[fmu]\nparameters = [\"target.yield_strength\"]\n{COUNTED}")));
        scenes.push(scene(law, &known, &coupling("")));
        scenes.push(scene(law, &["closing_speed"], &coupling("master = \"parallel\"\n")));
        scenes.push(scene(
            law,
            &known,
            &coupling("master = \"parallel\"\ninputs = [\"external_acceleration\", \"effective_mass\"]\n"),
        ));
        scenes.push(scene(law, &["work"], &coupling("inputs = [\"effective_mass\"]\n")));
        scenes.push(scene(law, &["work"], &coupling("inputs = [\"external_acceleration\"]\n")));
    }
    scenes
}

/// Compares all scenes of a law in both ways.
fn compare(law: &str, store: &Path) {
    let damped = ["hunt-crossley", "kelvin-voigt", "tsuji", "kuwabara-kono", "adams-impact"];
    let is_damped = damped.contains(&law.split('/').next().unwrap());
    let mut random = Random(14);
    let (mut messages, mut kinds) = (0, BTreeSet::new());
    for text in scenes(law, is_damped) {
        let both = Both::of(text, store);
        for _ in 0..20 {
            messages += both.compare(200, &mut random);
        }
        kinds.insert(both.kind);
    }
    assert_eq!(kinds.len(), if is_damped { 3 } else { 5 }, "{law}: a kind was not compared: {kinds:?}");
    assert!(messages > 100, "{law}: {messages} messages were compared");
}

#[test]
fn a_prebuilt_library_shows_the_same_bits_and_says_the_same_as_a_compiled_one() {
    LAWS.iter().for_each(|law| compare(law, store()));
}

/// The same for every law: some 450 libraries are compiled for it.
#[test]
#[ignore = "takes half an hour: cargo test --release --test prebuilt -- --ignored"]
fn every_prebuilt_library_shows_the_same_bits_and_says_the_same_as_a_compiled_one() {
    let store = prebuilt::folder().join("every");
    prebuilt::prebuild(&store, &[]).with_status(0);
    let list = prebuilt::list(&store);
    let streams = list["streams"].as_array().unwrap().iter();
    let names = streams.flat_map(|stream| stream["libraries"].as_array().unwrap());
    let laws: BTreeSet<_> = names.map(|library| library["name"].as_str().unwrap().split(' ').next().unwrap()).collect();
    assert!(laws.len() >= 35, "{laws:?}");
    laws.iter().for_each(|law| compare(law, &store));
}

/// One scene for each kind of library.
fn one_of_each_kind() -> Vec<(&'static str, String)> {
    let scenes = scenes("big-alabo", false);
    // a slow constant rate must reach the surface
    let of_kind = |kind, index: usize| (kind, scenes[index].replace("initial_gap = 1e-6", "initial_gap = 0.0"));
    vec![
        of_kind("force", 0),
        of_kind("state", 1),
        of_kind("everything", 2),
        of_kind("serial", 5),
        of_kind("parallel", 7),
    ]
}

#[test]
fn fmus_of_every_kind_pass_the_check_and_are_the_same_bytes_each_time() {
    for (kind, text) in one_of_each_kind() {
        let (fmu, again) = (export(&text, Some(store())), export(&text, Some(store())));
        assert_same(&fs::read(&fmu).unwrap(), &fs::read(again).unwrap());
        let check = run(fmu.parent().unwrap(), ["check", "unit.fmu", "--json"]).with_status(0).json();
        assert_eq!(check["passed"], true, "{kind}: {check}");
    }
}

#[test]
fn fmpy_takes_fmus_of_every_kind() {
    let fmu = |(kind, text): (&str, String)| (kind.to_string(), export(&text, Some(store())));
    let fmus = one_of_each_kind().into_iter().map(fmu).collect();
    for file in [
        "test_model_description_is_valid.py",
        "test_initial_values.py",
        "test_parameter_limits.py",
        "test_inputs.py",
        "test_state_is_restored.py",
        "test_simulate_fmu.py",
    ] {
        pytest::pytest(file, &fmus);
    }
}

/// With a compiler the scene is compiled, unless the user says otherwise; without one it is not.
#[test]
fn the_summary_tells_how_the_fmu_was_made_and_what_the_other_way_would_save() {
    let folder = empty_folder();
    let text = scene("big-alabo", &["indentation"], "");
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let with = |option: Option<&str>, compiler: bool| {
        let mut command = match compiler {
            true => brinell(folder.path()),
            false => prebuilt::without_compiler(folder.path(), store()),
        };
        let run = output(command.env("BRINELL_PREBUILT", store()).args(["export", "scene.toml"]).args(option));
        run.with_status(0).out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let compiled = with(None, true);
    assert!(compiled.contains("compiled in ") && compiled.contains("would save"), "{compiled}");
    for prebuilt in [with(Some("--prebuilt"), true), with(None, false)] {
        let parts = ["from the prebuilt library `big-alabo/contact-radius force`", "compiling (--compile) would save"];
        assert!(parts.iter().all(|part| prebuilt.contains(part)), "{prebuilt}");
    }
}

/// The one line that an export without compiler ends with.
#[track_caller]
fn refusal(text: &str, store: &Path) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let run = output(prebuilt::without_compiler(folder.path(), store).args(["export", "scene.toml"])).with_status(1);
    assert_eq!(contents(folder.path()), ["scene.toml"]);
    run.err.lines().last().unwrap_or_default().into()
}

#[test]
fn a_scene_that_needs_a_compiler_is_refused_by_the_key_that_needs_it() {
    let law = |more: &str| scene("big-alabo", &[], "").replacen("[law]\n", &format!("[law]\n{more}\n"), 1);
    let long = "n".repeat(100);
    let cases = [
        (
            law("unloading = \"thornton\""),
            "law.unloading = \"thornton\": big-alabo is prebuilt with unloading = \"contact-radius\"",
        ),
        (law("loading_parameters = { fully_plastic = 80.0 }"), "law.loading_parameters: "),
        (law("unloading = \"contact-radius\"\npassivity_guard = true"), "law.passivity_guard: "),
        (
            scene("hunt-crossley/exact", &[], "[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\n"),
            "[[contact]]: there are 2",
        ),
        (
            scene(
                "big-alabo",
                &[],
                &format!(
                    "[[contact]]\nname = \"{long}\"\nimpactor = {{ radius = 1e-3, youngs_modulus = 2e11, \
             poissons_ratio = 0.3 }}\ntarget = {{ youngs_modulus = 2e11, poissons_ratio = 0.3, yield_strength = 3e8 }}\n"
                ),
            ),
            "[[contact]] name = \"nnn",
        ),
    ];
    for (text, expected) in cases {
        let said = refusal(&text, store());
        assert!(said.contains("needs a compiler") && said.contains(expected), "{said}\n{text}");
    }
}

#[test]
fn libraries_that_are_missing_damaged_or_of_another_version_are_told() {
    let text = scene("big-alabo", &[], "");
    let none = empty_folder();
    let said = refusal(&text, none.path());
    assert!(said.contains("no prebuilt libraries in") && said.contains("BRINELL_PREBUILT"), "{said}");
    let said = refusal(&scene("thornton", &[], ""), store());
    assert!(said.contains("no prebuilt library `thornton/thornton force`"), "{said}");
    type Change<'a> = &'a dyn Fn(Vec<u8>) -> Vec<u8>;
    let copy = |file: &str, change: Change| {
        let folder = empty_folder();
        for name in ["linux64.br", "linux64.json"] {
            let bytes = fs::read(store().join(name)).unwrap();
            fs::write(folder.path().join(name), if name == file { change(bytes) } else { bytes }).unwrap();
        }
        folder
    };
    let replaced = |from: &'static str, to: &'static str| {
        move |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().replacen(from, to, 1).into_bytes()
    };
    let flipped = |mut bytes: Vec<u8>| {
        bytes[1000] ^= 16;
        bytes
    };
    let cut = |bytes: Vec<u8>| bytes[..1000].to_vec();
    let cases: [(&str, Change, &str); 5] = [
        ("linux64.json", &replaced("\"sources\": \"", "\"sources\": \"0"), "another version"),
        ("linux64.json", &replaced("\"archive\"", "\"arch\""), "linux64.json is damaged"),
        ("linux64.json", &replaced("\"sha256\": \"", "\"sha256\": \"0"), "linux64.br is damaged"),
        ("linux64.br", &flipped, "linux64.br is damaged"),
        ("linux64.br", &cut, "linux64.br is damaged"),
    ];
    for (file, change, expected) in cases {
        let folder = copy(file, change);
        let said = refusal(&text, folder.path());
        assert!(said.contains(expected), "{said}");
    }
}

/// Any bit of the data that isn't as the exporter wrote it.
#[test]
fn a_library_with_damaged_data_makes_no_instance_and_says_why() {
    let fmu = export(&scene("big-alabo", &["work"], IMPACT), Some(store()));
    let place = unit::library(&fmu);
    let good = fs::read(&place).unwrap();
    let begin = good.windows(8).position(|bytes| bytes == b"brinell\0").expect("the data begin with their magic");
    // head, numbers, value references, GUID, texts
    let length = 5 * 8 + 5 * 8 + 30 * 8 + 64 + 32 + 512;
    let folder = empty_folder();
    let mut random = Random(15);
    for byte in (0..length).step_by(3) {
        let mut bad = good.clone();
        bad[begin + byte] ^= 1 << below(&mut random, 8);
        let path = folder.path().join(format!("{byte}.so"));
        fs::write(&path, bad).unwrap();
        take_message();
        let said = {
            let unit = Unit::open_library(&path, &place);
            assert!(unit.try_to_instantiate().is_none(), "byte {byte}");
            take_message()
        };
        let expected = match byte / 8 {
            0 | 1 => "another version",
            2 => "another library",
            _ => "damaged",
        };
        assert!(said.starts_with("fmi2Instantiate: ") && said.contains(expected), "byte {byte}: {said}");
    }
    // the whole library is as it was
    assert!(Unit::open(&fmu).try_to_instantiate().is_some());
}

/// Compiled and prebuilt, of one law and of another, with other numbers: none takes a state of another one.
#[test]
fn states_of_other_scenes_are_refused() {
    let texts = [
        scene("big-alabo", &["work"], ""),
        scene("big-alabo", &["work"], "[fmu]\ninitial_gap = 1e-9\n"),
        scene("big-alabo", &["work", "regime"], ""),
    ];
    let mut fmus: Vec<_> = texts.iter().map(|text| Unit::open(&export(text, Some(store())))).collect();
    fmus.push(Unit::open(&export(&texts[0], None)));
    let instances: Vec<_> = fmus.iter().map(Unit::ready).collect();
    for (index, instance) in instances.iter().enumerate() {
        let state = instance.save();
        let bytes = instance.serialize(state);
        for (other, taker) in instances.iter().enumerate() {
            let taken = taker.deserialize(&bytes);
            assert_eq!(taken.is_some(), index == other, "{index} to {other}");
            taken.into_iter().for_each(|state| taker.free(state));
        }
        instance.free(state);
    }
}

#[test]
fn the_kind_in_the_source_tree_is_that_of_the_default_scene() {
    let folder = empty_folder();
    let kind = run(folder.path(), ["kind".as_ref(), command::scene("steel_ball").as_os_str()]).with_status(0);
    let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene/kind.rs")).unwrap();
    assert!(kind.out == source, "src/scene/kind.rs is not what the program writes:\n{}", kind.out);
}

/// The same bytes, whoever makes them and how many at a time.
#[test]
fn prebuilding_is_reproducible_and_refuses_unknown_laws() {
    let again = prebuilt::folder().join("again");
    prebuilt::prebuild(&again, &["--laws", "hunt-crossley/flores", "--kinds", "force"]).with_status(0);
    let library = |store: &Path| {
        let list = prebuilt::list(store);
        let all = list["streams"][0]["libraries"].as_array().unwrap().clone();
        all.into_iter().find(|library| library["name"] == "hunt-crossley/flores force").expect("it is there")
    };
    assert_eq!(library(&again), library(store()));
    let said = prebuilt::prebuild(&again, &["--laws", "nobody"]).with_status(1).err;
    assert!(said.contains("no law `nobody`") && said.contains("big-alabo"), "{said}");
    let said = prebuilt::prebuild(&again, &["--kinds", "all"]).with_status(1).err;
    assert!(said.contains("no kind `all`") && said.contains("parallel"), "{said}");
}
