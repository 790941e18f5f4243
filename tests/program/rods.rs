//! What `predict` and `export` say about rods, against waves in rods that are integrated point by point.

use crate::archive;
use brinell_contact::{Body, History, Model, Pair, Surface};
use brinell_testing::folder::{Folder, number};
use brinell_testing::physics;
use serde_json::Value;

/// A rod of steel or aluminium, or the heavy and rigid body that is none.
#[derive(Clone, Copy)]
struct Rod {
    youngs_modulus: f64,
    density: f64,
    length: f64,
    area: f64,
}

const STEEL: Rod = Rod { youngs_modulus: 206e9, density: 7850.0, length: 0.5, area: 7.854e-3 };
const ALUMINIUM: Rod = Rod { youngs_modulus: 69e9, density: 2700.0, length: 0.2, area: 2e-3 };
const POISSONS_RATIO: f64 = 0.3;

/// Two bodies that meet. Without `target` the impactor hits a steel half-space.
#[derive(Clone, Copy)]
struct Case {
    impactor: Rod,
    target: Option<Rod>,
    /// Radius of the rounded end of the impactor \[m\].
    radius: f64,
    /// `None` for an elastic contact.
    yield_strength: Option<f64>,
    speed: f64,
}

impl Rod {
    fn mass(&self) -> f64 {
        self.density * self.length * self.area
    }

    fn wave_speed(&self) -> f64 {
        (self.youngs_modulus / self.density).sqrt()
    }

    fn keys(&self) -> String {
        let Rod { youngs_modulus, density, length, area } = self;
        format!(
            "youngs_modulus = {youngs_modulus:?}\npoissons_ratio = {POISSONS_RATIO}\ndensity = {density:?}\n\
             length = {length:?}\narea = {area:?}\n"
        )
    }
}

impl Case {
    /// The effective mass \[kg\].
    fn mass(&self) -> f64 {
        1.0 / (1.0 / self.impactor.mass() + self.target.map_or(0.0, |rod| 1.0 / rod.mass()))
    }

    fn text(&self) -> String {
        let half_space = format!("youngs_modulus = 206e9\npoissons_ratio = {POISSONS_RATIO}\n");
        let strength = self.yield_strength.map_or(String::new(), |strength| format!("yield_strength = {strength:?}\n"));
        format!(
            "name = \"unit\"\n[impactor]\nradius = {:?}\n{}[target]\n{}{strength}[impact]\nmass = {:?}\nspeed = {:?}\n",
            self.radius,
            self.impactor.keys(),
            self.target.map_or(half_space, |rod| rod.keys()),
            self.mass(),
            self.speed
        )
    }

    fn predicted(&self) -> Value {
        Folder::of(&self.text()).json("predict scene.toml")
    }

    /// The contact by the laws of the scene.
    fn model(&self) -> physics::AnyModel {
        let body = |radius, youngs_modulus| Body { radius, youngs_modulus, poissons_ratio: POISSONS_RATIO };
        let impactor = body(self.radius, self.impactor.youngs_modulus);
        let target = body(f64::INFINITY, self.target.map_or(206e9, |rod| rod.youngs_modulus));
        let strength = self.yield_strength.unwrap_or(f64::INFINITY);
        let (loading, unloading) =
            if self.yield_strength.is_some() { ("brinell", "brinell") } else { ("hertz", "contact-radius") };
        let (loading, unloading) = (physics::loading(loading), physics::unloading(unloading));
        Model { pair: Pair::new(&impactor, &target, strength).unwrap(), loading, unloading, surface: Surface::Dented }
    }

    /// The largest forces \[N\] until `border` \[s\] and in the whole impact, with free far ends, or to three times `border` with
    /// heavy bodies behind them.
    fn largest_forces(&self, border: f64, held: bool) -> (f64, f64) {
        let model = self.model();
        let mut rods: Vec<Chain> = [Some(self.impactor), self.target].into_iter().flatten().map(Chain::new).collect();
        let step = rods.iter().map(|rod| rod.step).fold(f64::INFINITY, f64::min);
        rods.iter_mut().for_each(|rod| rod.divide(step));
        let mut contact = History::start(&model, 0.0).unwrap();
        let (mut before, mut whole, mut time, mut has_touched) = (0.0_f64, 0.0_f64, 0.0, false);
        loop {
            let force = contact.force();
            has_touched |= force > 0.0;
            if (has_touched && force <= 0.0) || (held && time > 3.0 * border) {
                return (before, whole);
            }
            whole = whole.max(force);
            if time < border {
                before = before.max(force);
            }
            let given_way: f64 = rods.iter_mut().map(|rod| rod.advance(force, held)).sum();
            contact.advance(&model, self.speed * step - given_way).unwrap();
            time += step;
        }
    }
}

/// A rod as points with springs between them. With steps of the time that a wave takes from point to point, the difference
/// equation has the solutions of the wave equation itself.
struct Chain {
    rod: Rod,
    step: f64,
    now: Vec<f64>,
    before: Vec<f64>,
    /// Force of the last step \[N\].
    force: f64,
}

impl Chain {
    /// Number of points of the coarser rod.
    const POINTS: usize = 400;

    fn new(rod: Rod) -> Chain {
        let step = rod.length / rod.wave_speed() / Chain::POINTS as f64;
        Chain { rod, step, now: Vec::new(), before: Vec::new(), force: 0.0 }
    }

    /// Chooses the points for this step \[s\].
    fn divide(&mut self, step: f64) {
        let count = (self.rod.length / (self.rod.wave_speed() * step)).round() as usize + 1;
        (self.step, self.now, self.before) = (step, vec![0.0; count], vec![0.0; count]);
    }

    /// Moves the rod under a `force` on its near end; returns how far that has given way in the step \[m\].
    fn advance(&mut self, force: f64, held: bool) -> f64 {
        let Chain { rod, step, now, before, force: last_force } = self;
        let last = now.len() - 1;
        // a force is held over a step, and the difference equation is one over two steps
        let mean = 0.5 * (force + *last_force);
        *last_force = force;
        // the end point has half of the mass of the others
        let mass = 0.5 * rod.density * rod.area * rod.wave_speed() * *step;
        let push = mean * *step * *step / mass;
        let next = |at: usize| match at {
            0 => 2.0 * now[1] - before[0] + push,
            at if at == last => {
                if held {
                    0.0
                } else {
                    2.0 * now[last - 1] - before[last]
                }
            }
            at => now[at - 1] + now[at + 1] - before[at],
        };
        let next: Vec<f64> = (0..=last).map(next).collect();
        let moved = next[0] - now[0];
        *before = std::mem::replace(now, next);
        moved
    }
}

fn close(got: f64, expected: f64, tolerance: f64) -> bool {
    (got / expected - 1.0).abs() <= tolerance
}

/// One or two rods, equal ones and others, from a sharp end to one that is nearly flat.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (impactor, target) in [(STEEL, None), (STEEL, Some(STEEL)), (STEEL, Some(ALUMINIUM)), (ALUMINIUM, Some(STEEL))]
    {
        for (radius, yield_strength) in [(0.05, None), (1.0, None), (1e3, None), (0.05, Some(300e6)), (1.0, Some(2e9))]
        {
            for speed in [0.01, 1.0, 8.0] {
                cases.push(Case { impactor, target, radius, yield_strength, speed });
            }
        }
    }
    cases
}

#[test]
fn no_contact_of_rods_pushes_harder_than_their_waves_until_they_return() {
    let mut nearest = 0.0_f64;
    for case in cases() {
        let answer = case.predicted();
        let rods = &answer["rods"];
        let [bound, first, last] = ["largest_force", "first_return", "last_return"].map(|key| number(rods, key));
        let returns =
            [Some(case.impactor), case.target].into_iter().flatten().map(|rod| 2.0 * rod.length / rod.wave_speed());
        assert!(close(returns.clone().fold(f64::INFINITY, f64::min), first, 1e-12), "{}{rods}", case.text());
        assert!(close(returns.fold(0.0, f64::max), last, 1e-12), "{}{rods}", case.text());
        // the bound of free ends holds for the whole impact
        let (before, whole) = case.largest_forces(first, false);
        assert!(before <= bound * 1.002 && whole <= bound * 1.002, "{}{bound}: {before} {whole}", case.text());
        let (held, _) = case.largest_forces(first, true);
        assert!(close(held, before, 1e-9), "{}: a far end is felt before its wave returns", case.text());
        nearest = nearest.max(before / bound);
    }
    assert!(nearest > 0.999, "the bound is reached: {nearest}");
}

/// So the bound ends with the return of the wave.
#[test]
fn a_rod_with_a_heavy_body_behind_it_pushes_harder_once_the_wave_has_returned() {
    let case = Case { impactor: STEEL, target: None, radius: 1e3, yield_strength: None, speed: 1.0 };
    let rods = &case.predicted()["rods"];
    let bound = number(rods, "largest_force");
    let (before, whole) = case.largest_forces(number(rods, "first_return"), true);
    assert!(before <= bound && whole > 2.5 * bound, "{before} {whole} {bound}");
}

/// In an elastic impact the force of a compact body is 3 % too high if the contact lasts 5 times as long as the wave takes,
/// and 15 % if twice.
#[test]
fn the_error_of_a_compact_body_is_what_the_warning_says() {
    let ratio = |case: &Case| {
        let answer = case.predicted();
        let law = &answer["laws"][0];
        let time = number(law, "loading_time") + number(law, "unloading_time");
        let (_, force) = case.largest_forces(0.0, false);
        (time / number(&answer, "rods/last_return"), number(law, "largest_force") / force - 1.0)
    };
    for target in [None, Some(STEEL)] {
        for (travels, error, width) in [(5.0, 0.027, 0.003), (2.0, 0.147, 0.005)] {
            let mut case = Case { impactor: STEEL, target, radius: 1.0, yield_strength: None, speed: 1.0 };
            // the time of Hertz's impact falls with the fifth root of the radius
            case.radius *= (ratio(&case).0 / travels).powi(5);
            let (now, too_high) = ratio(&case);
            assert!(close(now, travels, 1e-6) && (too_high - error).abs() < width, "{now}: {too_high}");
        }
    }
    for case in cases() {
        let (travels, too_high) = ratio(&case);
        assert!(travels < 5.0 || too_high < 0.03, "{}{travels}: {too_high}", case.text());
    }
}

#[test]
fn a_prediction_says_whether_the_waves_allow_its_force() {
    let mut seen = [0; 3];
    for case in cases() {
        let answer = case.predicted();
        let (law, rods) = (&answer["laws"][0], &answer["rods"]);
        let time = number(law, "loading_time") + number(law, "unloading_time");
        let exceeds = number(law, "largest_force") > number(rods, "largest_force");
        let is_short = !exceeds && time < 5.0 * number(rods, "last_return");
        let (warnings, notes) = (law["warnings"].to_string(), answer["notes"].to_string());
        let takes = "the wave in a rod limits the force to";
        assert_eq!(warnings.contains(takes) && warnings.contains("takes the body as compact"), exceeds, "{answer}");
        assert_eq!(warnings.contains("not all of the rod's mass takes part at once"), is_short, "{answer}");
        assert_eq!(
            notes.contains("The wave in a rod limits") && notes.contains("stays below that"),
            !exceeds,
            "{answer}"
        );
        seen[usize::from(exceeds) + 2 * usize::from(is_short)] += 1;
    }
    assert!(seen.iter().all(|count| *count > 3), "{seen:?}");
    let no_rods = "name = \"unit\"\n[impactor]\nradius = 0.05\n[target]\nmaterial = \"mild steel\"\n";
    let answer = Folder::of(no_rods).json("predict scene.toml");
    assert!(answer["rods"].is_null() && !answer["notes"].to_string().contains("rod"), "{answer}");
}

#[test]
fn a_sweep_counts_the_impacts_that_the_waves_do_not_allow() {
    let takes = "the wave in a rod limits the force to";
    let case = |modulus: f64| {
        let impactor = Rod { youngs_modulus: modulus, ..STEEL };
        Case { impactor, target: Some(ALUMINIUM), radius: 20.0, yield_strength: None, speed: 0.5 }
    };
    let exceeds = |modulus: &f64| case(*modulus).predicted()["laws"][0]["warnings"].to_string().contains(takes);
    let moduli = [2e8, 2e9, 2e10, 2e11];
    let count = moduli.iter().filter(|modulus| exceeds(modulus)).count();
    assert!((1..4).contains(&count), "{count}");
    let said = Folder::of(&case(2e11).text()).words("predict scene.toml --sweep impactor.youngs_modulus=2e8:2e11:4");
    let told = [format!("{count} of 4 impacts"), format!("at the worst, {takes}")];
    assert!(told.iter().all(|part| said.contains(part)), "{said}");
}

#[test]
fn export_and_its_page_say_what_predict_says_of_rods() {
    for (radius, expected) in [(1e3, "the wave in a rod limits"), (0.05, "The wave in a rod limits")] {
        let case = Case { impactor: STEEL, target: None, radius, yield_strength: None, speed: 8.0 };
        let folder = Folder::of(&case.text());
        assert_eq!(folder.json("export scene.toml")["rods"], case.predicted()["rods"]);
        let said = folder.words("export scene.toml");
        assert!(said.contains(expected), "{said}");
        let page = archive::text(&folder.at("unit.fmu"), "documentation/index.html");
        assert!(page.contains(expected), "{page}");
    }
}

/// The FMU knows nothing of rods.
#[test]
fn length_and_area_change_nothing_in_the_fmu() {
    let case = Case { impactor: STEEL, target: Some(ALUMINIUM), radius: 0.05, yield_strength: Some(300e6), speed: 1.0 };
    let written = |text: &str| Folder::of(text).words("constants scene.toml");
    let text = case.text();
    let plain: Vec<_> = text.lines().filter(|line| !line.starts_with("length") && !line.starts_with("area")).collect();
    assert_eq!(plain.len() + 4, text.lines().count());
    assert_eq!(written(&text), written(&plain.join("\n")));
}
