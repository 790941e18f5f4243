//! A sweep as a page that needs nothing else: the scene in words, the pictures, the numbers.

use super::sweep::{STEPS, Sweep};
use super::{methods, quantities};
use crate::bodies;
use crate::html::{PICTURE_STYLE, begin, escape};
use crate::laws::Choice;
use crate::numbers::digits;
use crate::plot::css_lines;
use crate::scene::Scene;
use std::fmt::Write;

/// Every how manyth speed the tables show; the others are in the CSV.
const STRIDE: usize = STEPS as usize / 20;

/// The page of `sweep`, by the laws of `choices` on the bodies of the first contact of `scene`.
pub fn write(scene: &Scene, choices: &[Choice], sweep: &Sweep) -> String {
    let mut page = String::new();
    body(&mut page, scene, choices, sweep).expect("a String takes everything");
    page
}

fn body(page: &mut String, scene: &Scene, choices: &[Choice], sweep: &Sweep) -> std::fmt::Result {
    let name = escape(&scene.name);
    begin(page, &format!("{name}: impacts"), PICTURE_STYLE)?;
    writeln!(page, "<h1>{name}: impacts over speed</h1>")?;
    if !scene.description.is_empty() {
        writeln!(page, "<p>{}</p>", escape(&scene.description))?;
    }
    words(page, scene, choices, sweep)?;
    legend(page, sweep)?;
    writeln!(page, "<div class=\"panels\">")?;
    for panel in sweep.panels() {
        writeln!(page, "<figure>\n{}</figure>", panel.svg_without_legend(400, 360))?;
    }
    writeln!(page, "</div>")?;
    let csv = sweep.csv();
    // commas, letters, digits and signs stand for themselves in an address; line ends don't
    let (address, lines) = (csv.replace('\n', "%0A"), csv.lines().count() - 1);
    writeln!(
        page,
        "<p class=\"csv\"><a download=\"{name}_sweep.csv\" href=\"data:text/csv;charset=utf-8,{address}\">All {lines} \
         impacts with all digits as CSV</a></p>"
    )?;
    for law in &sweep.laws {
        table(page, law)?;
    }
    writeln!(page, "<p>Brinell {}</p>\n</body>\n</html>", env!("CARGO_PKG_VERSION"))
}

/// What meets what, and how the impacts were found.
fn words(page: &mut String, scene: &Scene, choices: &[Choice], sweep: &Sweep) -> std::fmt::Result {
    let (from, to) = sweep.range;
    let (impactor, target) = bodies::words(scene, 0);
    let begin = match bodies::first_contact(scene) {
        Some(contact) => format!("In {contact}, {impactor}"),
        None => capitalized(impactor),
    };
    writeln!(
        page,
        "<p>{begin} meets {target} with an effective mass of {} kg and closing speeds from {} to {} m/s. The impacts are \
         predicted {}.</p>\n<table class=\"scene\">",
        digits(sweep.mass),
        digits(from),
        digits(to),
        methods(choices)
    )?;
    for (name, value, unit) in bodies::numbers(scene, 0).into_iter().filter(|(name, ..)| *name != "initial_gap") {
        writeln!(page, "<tr><th>{name}</th><td>{} {unit}</td></tr>", digits(value))?;
    }
    writeln!(page, "</table>")
}

/// `words` as the beginning of a sentence.
fn capitalized(words: &str) -> String {
    words[..1].to_uppercase() + &words[1..]
}

fn legend(page: &mut String, sweep: &Sweep) -> std::fmt::Result {
    writeln!(page, "<h2>Restitution, largest force and dent</h2>\n<ul class=\"legend\">")?;
    let names = || sweep.laws.iter().map(|(law, _)| law.as_str());
    for (law, line) in names().zip(css_lines(names())) {
        writeln!(page, "<li><i style=\"border-top: {line}\"></i>{}</li>", escape(law))?;
    }
    writeln!(page, "</ul>")
}

fn table(page: &mut String, (law, points): &(String, Vec<super::sweep::Point>)) -> std::fmt::Result {
    writeln!(page, "<h2>{}</h2>\n<div class=\"table\">\n<table>\n<thead><tr><th>speed [m/s]</th>", escape(law))?;
    for (name, _, unit) in points.first().map(|(_, prediction)| quantities(prediction)).into_iter().flatten() {
        let unit = if unit.is_empty() { "[1]".into() } else { format!("[{unit}]") };
        write!(page, "<th>{name} {unit}</th>")?;
    }
    writeln!(page, "<th>regime</th></tr></thead>\n<tbody>")?;
    for (speed, prediction) in points.iter().step_by(STRIDE) {
        write!(page, "<tr><td>{}</td>", digits(*speed))?;
        for (_, value, _) in quantities(prediction) {
            write!(page, "<td>{}</td>", digits(value))?;
        }
        writeln!(page, "<td>{}</td></tr>", prediction.regime as i32)?;
    }
    writeln!(page, "</tbody>\n</table>\n</div>")
}
