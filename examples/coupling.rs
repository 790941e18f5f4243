//! Four ways to couple a contact with a mass, using only the functions of the FMU's library: error of the restitution for
//! some numbers of steps per contact.
//!
//! ```sh
//! brinell export scenes/coupled.toml && brinell export scenes/mass_known.toml
//! brinell predict scenes/coupled.toml --json > impact.json
//! cargo run --release --example coupling coupled.fmu mass_known.fmu impact.json
//! ```

use libloading::Library;
use std::error::Error;
use std::ffi::{CString, c_char, c_int, c_void};
use std::{env, fs, ptr};

type Outcome<T> = Result<T, Box<dyn Error>>;
type Component = *mut c_void;
type Values = unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> c_int;
type Derivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *mut f64) -> c_int;

/// The struct `fmi2CallbackFunctions`: this importer provides no callbacks.
#[repr(C)]
struct Callbacks([*mut c_void; 5]);

/// An FMU, unpacked and instantiated.
struct Unit {
    library: Library,
    component: Component,
    xml: String,
    time: f64,
    _folder: tempfile::TempDir,
}

impl Unit {
    fn load(path: &str) -> Outcome<Unit> {
        let folder = tempfile::tempdir()?;
        let mut archive = zip::ZipArchive::new(fs::File::open(path)?)?;
        archive.extract(folder.path())?;
        let xml = fs::read_to_string(folder.path().join("modelDescription.xml"))?;
        let platform = fs::read_dir(folder.path().join("binaries"))?.next().ok_or("no binaries")??;
        let library = fs::read_dir(platform.path())?.next().ok_or("no library")??;
        // SAFETY: the library of an FMU, which has no initializers that could harm.
        let library = unsafe { Library::new(library.path()) }?;
        let guid = CString::new(attribute(&xml, "guid").ok_or("no guid")?)?;
        // SAFETY: the signature of the standard; the strings outlive the call, and the callbacks are never called.
        let component = unsafe {
            type Instantiate = unsafe extern "C" fn(
                *const c_char,
                c_int,
                *const c_char,
                *const c_char,
                *const Callbacks,
                c_int,
                c_int,
            ) -> Component;
            let instantiate = library.get::<Instantiate>("fmi2Instantiate")?;
            let callbacks = Callbacks([ptr::null_mut(); 5]);
            instantiate(c"contact".as_ptr(), 1, guid.as_ptr(), c"".as_ptr(), &callbacks, 0, 0)
        };
        if component.is_null() {
            return Err("fmi2Instantiate gave no instance".into());
        }
        Ok(Unit { library, component, xml, time: 0.0, _folder: folder })
    }

    fn reference(&self, name: &str) -> Outcome<u32> {
        let variable = self.xml.split("<ScalarVariable ").find(|text| text.starts_with(&format!("name=\"{name}\"")));
        let reference = variable.and_then(|text| attribute(text, "valueReference"));
        Ok(reference.ok_or(format!("no variable {name}"))?.parse()?)
    }

    /// A function that takes only the component.
    fn call(&self, function: &str) -> Outcome<()> {
        // SAFETY: the signature of the standard.
        done(function, unsafe {
            self.library.get::<unsafe extern "C" fn(Component) -> c_int>(function)?(self.component)
        })
    }

    /// Return to the start, with the bodies this far apart [m].
    fn start(&mut self, gap: f64) -> Outcome<()> {
        type Setup = unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
        self.call("fmi2Reset")?;
        // SAFETY: the signature of the standard.
        done("fmi2SetupExperiment", unsafe {
            self.library.get::<Setup>("fmi2SetupExperiment")?(self.component, 0, 0.0, 0.0, 0, 0.0)
        })?;
        self.set("initial_gap", gap)?;
        self.time = 0.0;
        self.call("fmi2EnterInitializationMode")?;
        self.call("fmi2ExitInitializationMode")
    }

    fn values(&self, function: &str, name: &str, mut value: f64) -> Outcome<f64> {
        let reference = self.reference(name)?;
        // SAFETY: the signature of the standard, with arrays of one.
        done(function, unsafe { self.library.get::<Values>(function)?(self.component, &reference, 1, &mut value) })?;
        Ok(value)
    }

    fn set(&self, name: &str, value: f64) -> Outcome<()> {
        self.values("fmi2SetReal", name, value).map(drop)
    }

    fn get(&self, name: &str) -> Outcome<f64> {
        self.values("fmi2GetReal", name, 0.0)
    }

    /// First and second derivative: of the input for the next step, or of the force at the end of the last one.
    fn derivatives(&self, function: &str, name: &str, mut values: [f64; 2]) -> Outcome<[f64; 2]> {
        let references = [self.reference(name)?; 2];
        // SAFETY: the signature of the standard, with arrays of two.
        done(function, unsafe {
            let function = self.library.get::<Derivatives>(function)?;
            function(self.component, references.as_ptr(), 2, [1, 2].as_ptr(), values.as_mut_ptr())
        })?;
        Ok(values)
    }

    fn step(&mut self, step: f64) -> Outcome<()> {
        type DoStep = unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int;
        // SAFETY: the signature of the standard.
        done("fmi2DoStep", unsafe { self.library.get::<DoStep>("fmi2DoStep")?(self.component, self.time, step, 1) })?;
        self.time += step;
        Ok(())
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: the signature of the standard; the component is not used afterwards.
        if let Ok(free) = unsafe { self.library.get::<unsafe extern "C" fn(Component)>("fmi2FreeInstance") } {
            unsafe { free(self.component) };
        }
    }
}

fn done(function: &str, status: c_int) -> Outcome<()> {
    if status == 0 { Ok(()) } else { Err(format!("{function} returned {status}").into()) }
}

/// The first attribute of this name.
fn attribute<'a>(xml: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = xml.split_once(&format!(" {name}=\""))?;
    Some(rest.split_once('"')?.0)
}

#[derive(Clone, Copy, Debug)]
enum Way {
    ForceOneStepLate,
    PredictedForce,
    InputDerivatives,
    MassKnown,
}

/// The speed of the rebound [m/s].
fn rebound(way: Way, unit: &mut Unit, mass: f64, mut speed: f64, step: f64) -> Outcome<f64> {
    let (mut force, mut late, mut derivatives) = (0.0, 0.0, [0.0; 2]);
    while force > 0.0 || speed > 0.0 {
        unit.set("indentation_rate", speed)?;
        if let Way::InputDerivatives = way {
            // the second derivative of the force is part of the jerk
            let jerk = -(derivatives[0] + 0.25 * step * derivatives[1]) / mass;
            unit.derivatives("fmi2SetRealInputDerivatives", "indentation_rate", [-force / mass, jerk])?;
        }
        let predicted = if let Way::PredictedForce = way { unit.get("predicted_force")? } else { 0.0 };
        unit.step(step)?;
        force = unit.get("force")?;
        speed -= step / mass
            * match way {
                Way::ForceOneStepLate => late,
                Way::PredictedForce => predicted,
                Way::InputDerivatives | Way::MassKnown => unit.get("mean_force")?,
            };
        late = force;
        derivatives = unit.derivatives("fmi2GetRealOutputDerivatives", "force", derivatives)?;
    }
    Ok(-speed)
}

fn main() -> Outcome<()> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [coupled, mass_known, impact] = &arguments[..] else {
        return Err("three files are needed: coupled.fmu mass_known.fmu impact.json".into());
    };
    let impact: serde_json::Value = serde_json::from_str(&fs::read_to_string(impact)?)?;
    let number = |value: &serde_json::Value| value.as_f64().ok_or("impact.json is not of `brinell predict --json`");
    let (mass, speed, law) = (number(&impact["mass"])?, number(&impact["speed"])?, &impact["laws"][0]);
    let contact_time = number(&law["loading_time"])? + number(&law["unloading_time"])?;
    let expected = number(&law["restitution"])?;
    println!("error of the restitution at so many steps per contact\n{:18}{:>10}{:>10}{:>10}", "", 8, 32, 128);
    for way in [Way::ForceOneStepLate, Way::PredictedForce, Way::InputDerivatives, Way::MassKnown] {
        let mut unit = Unit::load(if let Way::MassKnown = way { mass_known } else { coupled })?;
        print!("{:18}", format!("{way:?}"));
        for steps in [8.0, 32.0, 128.0] {
            const PLACES: u32 = 8;
            let (step, mut squares) = (contact_time / steps, 0.0);
            for place in 0..PLACES {
                // the position within the second step where the bodies meet
                unit.start((1.0 + (f64::from(place) + 0.5) / f64::from(PLACES)) * speed * step)?;
                let error = rebound(way, &mut unit, mass, speed, step)? / speed / expected - 1.0;
                squares += error * error / f64::from(PLACES);
            }
            print!("{:>10.1e}", f64::sqrt(squares));
        }
        println!();
    }
    Ok(())
}
