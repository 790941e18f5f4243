//! A sweep as a page that needs nothing else: the scene in words, the pictures, the numbers.

use super::quantities;
use super::sweep::{STEPS, Sweep};
use crate::documentation::escape;
use crate::numbers::digits;
use crate::plot::css_line;
use crate::scene::Scene;
use crate::table;
use std::fmt::Write;

/// Every how manyth speed the tables show; the others are in the CSV.
const STRIDE: usize = STEPS as usize / 20;

/// In the dark the pictures are inverted and their hues turned back, so that every line keeps its colour and its contrast.
const STYLE: &str = "\
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 0 auto; padding: 1rem; }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr)); gap: .5rem; }
.panels.wide { grid-template-columns: repeat(auto-fit, minmax(min(30rem, 100%), 1fr)); }
figure { margin: 0; max-width: 46rem; } figure svg { width: 100%; height: auto; }
.legend { display: flex; flex-wrap: wrap; gap: 0 1.5rem; list-style: none; padding: 0; }
.legend i { display: inline-block; width: 1.25rem; margin-right: .4rem; vertical-align: middle; }
.table { overflow: auto; max-height: 30rem; font-size: .9rem; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: .2rem .6rem; border-bottom: 1px solid #8886; white-space: nowrap; }
th { vertical-align: bottom; white-space: normal; }
th button { all: unset; cursor: pointer; } th button:focus-visible { outline: 2px solid; }
[aria-sort=ascending] button::after { content: \" \\2191\"; } [aria-sort=descending] button::after { content: \" \\2193\"; }
.copy { font: inherit; } .scene th, .scene td, .words { text-align: left; } .lead { font-size: 1.15rem; }
@media screen and (prefers-color-scheme: dark) { figure svg, .legend i { filter: invert(1) hue-rotate(180deg); } }
@media print {
  body { max-width: none; padding: 0; font-size: 9pt; } .csv { display: none; } .table { overflow: visible; max-height: none; font-size: inherit; }
  .panels { grid-template-columns: repeat(3, 1fr); } h2 { break-after: avoid; } tr, figure { break-inside: avoid; }
  .legend i { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  th, td { padding: .1rem .35rem; } .words { white-space: normal; }
}";

/// The page of `sweep` on the bodies of `scene`.
pub fn write(scene: &Scene, sweep: &Sweep) -> String {
    let mut page = String::new();
    body(&mut page, scene, sweep).expect("a String takes everything");
    page
}

/// What a page begins with, up to its heading.
pub fn begin(page: &mut String, title: &str) -> std::fmt::Result {
    writeln!(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(page, "<title>{title}</title>\n<meta name=\"viewport\" content=\"width=device-width\">")?;
    writeln!(page, "<style>\n{STYLE}\n</style>\n</head>\n<body>")
}

fn body(page: &mut String, scene: &Scene, sweep: &Sweep) -> std::fmt::Result {
    let name = escape(&scene.name);
    begin(page, &format!("{name}: impacts"))?;
    writeln!(page, "<h1>{name}: impacts over speed</h1>")?;
    if !scene.description.is_empty() {
        writeln!(page, "<p>{}</p>", escape(&scene.description))?;
    }
    words(page, scene, sweep)?;
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

/// What meets what.
fn words(page: &mut String, scene: &Scene, sweep: &Sweep) -> std::fmt::Result {
    let (from, to) = sweep.range;
    let rigid = scene.value("impactor.youngs_modulus").is_none();
    let impactor = if rigid { "A rigid sphere" } else { "An elastic sphere" };
    let target = match scene.value("target.radius") {
        None => "a half-space",
        Some(radius) if radius < 0.0 => "a spherical socket",
        Some(_) => "a sphere",
    };
    writeln!(
        page,
        "<p>{impactor} meets {target} with an effective mass of {} kg and closing speeds from {} to {} m/s. By energy \
         balance: what loading takes from the motion and unloading gives back.</p>\n<table class=\"scene\">",
        digits(sweep.mass),
        digits(from),
        digits(to)
    )?;
    for parameter in scene.parameters.iter().filter(|parameter| parameter.name != "initial_gap") {
        let unit = table::variable(parameter.name).unit.as_deref().unwrap_or("");
        writeln!(page, "<tr><th>{}</th><td>{} {unit}</td></tr>", parameter.name, digits(parameter.value))?;
    }
    writeln!(page, "</table>")
}

fn legend(page: &mut String, sweep: &Sweep) -> std::fmt::Result {
    writeln!(page, "<h2>Restitution, largest force and dent</h2>\n<ul class=\"legend\">")?;
    for (index, (law, _)) in sweep.laws.iter().enumerate() {
        writeln!(page, "<li><i style=\"border-top: {}\"></i>{}</li>", css_line(index), escape(law))?;
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
