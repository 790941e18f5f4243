//! Impacts as a self-contained page: the scene in words, the pictures, the numbers.

use super::map::Map;
use super::methods;
use super::oblique::{self, Setting};
use super::sweep::Sweep;
use super::time_history::TimeHistory;
use crate::bodies;
use crate::columns::{Columns, some};
use crate::html::{PICTURE_STYLE, begin, escape};
use crate::laws::Choice;
use crate::numbers::{digits, quantity};
use crate::plot::{Picture, css_lines};
use crate::regime;
use crate::scene::Scene;
use brinell::contact::Regime;
use brinell::contact::impact::Impact;
use std::fmt::Write;

/// Rows of a table; the CSV file has the others.
const ROWS: usize = 21;

/// A page about impacts on the bodies of the first contact of a scene.
struct Page<'a> {
    scene: &'a Scene,
    /// Title of the page, such as "impacts over speed".
    subject: String,
    /// The impact in words, starting with "with".
    with: String,
    /// The method of the computation, in words.
    method: String,
    /// The heading of the pictures.
    heading: &'static str,
    /// The names of the lines, if there are any.
    lines: Vec<&'a str>,
    pictures: Vec<String>,
    columns: Columns,
    /// Parameters of the scene that the impacts have with other values; `with` says them.
    replaced: Vec<&'static str>,
    warnings: Vec<String>,
}

/// The page of a sweep over one quantity.
pub fn of_sweep(scene: &Scene, choices: &[Choice], sweep: &Sweep) -> String {
    let (from, to) = (quantity(sweep.axis.from, sweep.axis.unit), quantity(sweep.axis.to, sweep.axis.unit));
    let fixed = impact_but(sweep.impact, &[sweep.axis.name]);
    Page {
        scene,
        subject: format!("impacts over {}", sweep.axis.name.replace('_', " ")),
        with: format!("{fixed} and {} from {from} to {to}", sweep.axis.name),
        method: format!("predicted {}", methods(choices)),
        heading: "Restitution, largest force and dent",
        lines: sweep.laws.iter().map(|(law, _)| law.as_str()).collect(),
        pictures: figures(&sweep.panels()),
        columns: sweep.columns(),
        replaced: vec![sweep.axis.name],
        warnings: sweep.limits.warnings(),
    }
    .write()
}

/// The page of oblique impacts over one quantity.
pub fn of_oblique(scene: &Scene, (impact, setting): (Impact, Setting), sweep: &oblique::Sweep) -> String {
    let axis = &sweep.axis;
    let (from, to) = (quantity(axis.from, axis.unit), quantity(axis.to, axis.unit));
    let Setting { angle, spin, coefficient, .. } = setting;
    let fixed = [
        ("angle", format!("an angle of incidence of {angle} degrees")),
        ("spin", format!("a spin of {}", quantity(spin, "rad/s"))),
        (oblique::FRICTION, format!("a coefficient of friction of {coefficient}")),
    ];
    let fixed: Vec<_> = fixed.into_iter().filter(|(name, _)| *name != axis.name).map(|(_, words)| words).collect();
    let normal = impact_but(impact, &[axis.name]).replace("closing speed", "speed");
    Page {
        scene,
        subject: format!("oblique impacts over {}", axis.name.replace('_', " ")),
        with: format!("{normal}, {} and {} from {from} to {to}", fixed.join(", "), axis.name),
        method: oblique::METHOD.into(),
        heading: "Tangential restitution, rebound angle, spin and slip",
        lines: sweep.laws.iter().map(|(law, _)| law.as_str()).collect(),
        pictures: figures(&sweep.panels()),
        columns: sweep.columns(),
        replaced: vec![axis.name, oblique::FRICTION],
        warnings: sweep.limits().warnings(),
    }
    .write()
}

/// The page of a map over two quantities.
pub fn of_map(scene: &Scene, choices: &[Choice], impact: Impact, map: &Map) -> String {
    let [first, second] = &map.axes;
    let range = |axis: &super::axis::Axis| {
        format!("{} from {} to {}", axis.name, quantity(axis.from, axis.unit), quantity(axis.to, axis.unit))
    };
    Page {
        scene,
        subject: format!("impacts over {} and {}", first.name.replace('_', " "), second.name.replace('_', " ")),
        with: format!("{}, {} and {}", impact_but(impact, &[first.name, second.name]), range(first), range(second)),
        method: format!("predicted {}", methods(choices)),
        heading: "Restitution, largest force and dent",
        lines: Vec::new(),
        pictures: vec![map.svg()],
        columns: map.columns(),
        replaced: vec![first.name, second.name],
        warnings: map.limits.warnings(),
    }
    .write()
}

/// The page of an impact over time.
pub fn of_time_history(scene: &Scene, choices: &[Choice], impact: Impact, history: &TimeHistory) -> String {
    Page {
        scene,
        subject: "an impact over time".into(),
        with: impact_but(impact, &[]),
        method: format!("predicted {}", methods(choices)),
        heading: "Force, indentation and closing speed",
        lines: history.laws().collect(),
        pictures: figures(&history.panels()),
        columns: history.columns(),
        replaced: Vec::new(),
        warnings: Vec::new(),
    }
    .write()
}

/// The fixed quantities of the impact, in words.
fn impact_but(impact: Impact, varied: &[&str]) -> String {
    let is_varied = |names: &[&str]| varied.iter().any(|name| names.contains(name));
    let mass = format!("an effective mass of {}", quantity(impact.mass, "kg"));
    let speed = format!("a closing speed of {}", quantity(impact.speed, "m/s"));
    let mass = (!is_varied(&["mass", "effective_mass"])).then_some(mass);
    let speed = (!is_varied(&["speed", "energy", "drop_height"])).then_some(speed);
    let words: Vec<_> = mass.into_iter().chain(speed).collect();
    if words.is_empty() { "masses and speeds".into() } else { words.join(" and ") }
}

fn figures(panels: &[Picture]) -> Vec<String> {
    panels.iter().map(|panel| panel.svg_without_legend(400, 360)).collect()
}

impl Page<'_> {
    fn write(&self) -> String {
        let mut page = String::new();
        self.body(&mut page).expect("a String takes everything");
        page
    }

    fn body(&self, page: &mut String) -> std::fmt::Result {
        let name = escape(&self.scene.name);
        begin(page, &format!("{name}: {}", self.subject), PICTURE_STYLE)?;
        writeln!(page, "<h1>{name}: {}</h1>", self.subject)?;
        if !self.scene.description.is_empty() {
            writeln!(page, "<p>{}</p>", escape(&self.scene.description))?;
        }
        self.words(page)?;
        self.legend(page)?;
        let panels = if self.pictures.len() > 1 { " class=\"panels\"" } else { "" };
        writeln!(page, "<div{panels}>")?;
        for picture in &self.pictures {
            let wide = if self.pictures.len() > 1 { "" } else { " style=\"max-width: none\"" };
            writeln!(page, "<figure{wide}>\n{picture}</figure>")?;
        }
        writeln!(page, "</div>")?;
        let csv = self.columns.csv();
        // an address may contain commas, letters, digits and signs as they are, but no line ends
        let (address, lines) = (csv.replace('\n', "%0A"), csv.lines().count() - 1);
        writeln!(
            page,
            "<p class=\"csv\"><a download=\"{name}.csv\" href=\"data:text/csv;charset=utf-8,{address}\">All {lines} rows with \
             all digits as CSV</a></p>"
        )?;
        for law in &self.columns.laws {
            self.table(page, law)?;
        }
        writeln!(page, "<p>Brinell {}</p>\n</body>\n</html>", env!("CARGO_PKG_VERSION"))
    }

    /// The two bodies, and how the impacts were computed.
    fn words(&self, page: &mut String) -> std::fmt::Result {
        let (impactor, target) = bodies::words(self.scene, 0);
        let begin = match bodies::first_contact(self.scene) {
            Some(contact) => format!("In {contact}, {impactor}"),
            None => capitalized(impactor),
        };
        writeln!(
            page,
            "<p>{begin} meets {target} with {}. The impacts are {}.</p>\n<table class=\"scene\">",
            self.with, self.method
        )?;
        let is_elsewhere =
            |name: &str| ["initial_gap", "effective_mass"].contains(&name) || self.replaced.contains(&name);
        for (name, value, unit) in bodies::numbers(self.scene, 0).into_iter().filter(|(name, ..)| !is_elsewhere(name)) {
            writeln!(page, "<tr><th>{name}</th><td>{} {unit}</td></tr>", digits(value))?;
        }
        writeln!(page, "</table>")?;
        self.warnings.iter().try_for_each(|warning| writeln!(page, "<p>Warning: {}</p>", escape(warning)))
    }

    fn legend(&self, page: &mut String) -> std::fmt::Result {
        writeln!(page, "<h2>{}</h2>\n<ul class=\"legend\">", self.heading)?;
        for (law, line) in self.lines.iter().zip(css_lines(self.lines.iter().copied())) {
            writeln!(page, "<li><i style=\"border-top: {line}\"></i>{}</li>", escape(law))?;
        }
        writeln!(page, "</ul>")
    }

    fn table(&self, page: &mut String, (law, rows): &(String, Vec<Vec<f64>>)) -> std::fmt::Result {
        writeln!(page, "<h2>{}</h2>\n<div class=\"table\">\n<table>\n<thead><tr>", escape(law))?;
        for column in &self.columns.columns {
            let unit = if column.unit.is_empty() { String::new() } else { format!(" [{}]", column.unit) };
            write!(page, "<th>{}{unit}</th>", column.name)?;
        }
        writeln!(page, "</tr></thead>\n<tbody>")?;
        for row in some(rows.len(), ROWS) {
            write!(page, "<tr>")?;
            for (column, value) in self.columns.columns.iter().zip(&rows[row]) {
                let regime = Regime::ALL.into_iter().find(|regime| f64::from(*regime as i32) == *value);
                match regime.filter(|_| column.name == "regime") {
                    Some(regime) => write!(page, "<td>{}</td>", regime::words(regime))?,
                    None => write!(page, "<td>{}</td>", digits(*value))?,
                }
            }
            writeln!(page, "</tr>")?;
        }
        writeln!(page, "</tbody>\n</table>\n</div>")
    }
}

/// `words` with a capital letter.
fn capitalized(words: &str) -> String {
    words[..1].to_uppercase() + &words[1..]
}
