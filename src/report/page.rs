//! The report as a self-contained page.

use super::{Figure, Part, Report};
use crate::html::{PICTURE_STYLE, begin, escape};
use std::fmt::Write;

/// Additions to the common style of all pages with pictures.
const STYLE: &str = include_str!("report.css");

/// The page of `report`.
pub fn write(report: &Report) -> String {
    let mut page = String::new();
    body(&mut page, report).expect("a String takes everything");
    page
}

fn body(page: &mut String, report: &Report) -> std::fmt::Result {
    let name = escape(&report.name);
    begin(page, &format!("{name}: report"), &format!("{PICTURE_STYLE}\n{STYLE}"))?;
    writeln!(page, "<h1>{name}</h1>\n{}<h2>Which coupling</h2>\n<ul class=\"advice\">", report.card.html())?;
    for sentence in &report.advice {
        writeln!(page, "<li>{}</li>", escape(sentence))?;
    }
    writeln!(page, "</ul>\n{}", report.choice)?;
    for part in &report.parts {
        write_part(page, part)?;
    }
    let version = env!("CARGO_PKG_VERSION");
    writeln!(page, "<p>Brinell {version}. All numbers for programs: <a href=\"report.json\">report.json</a></p>")?;
    writeln!(page, "<script>\n{}{}</script>\n</body>\n</html>", include_str!("tables.js"), include_str!("series.js"))
}

fn write_part(page: &mut String, part: &Part) -> std::fmt::Result {
    writeln!(page, "<section>\n<h2>{}</h2>\n<p>{}</p>", part.title, part.words)?;
    if !part.switches.is_empty() {
        writeln!(page, "<details class=\"switches\"><summary>Show other laws</summary>\n<ul class=\"legend\">")?;
        for (series, line) in &part.switches {
            let series = escape(series);
            writeln!(
                page,
                "<li><label><input type=\"checkbox\" data-switch=\"{series}\" data-line=\"{line}\"><i style=\"border-top: {line}\"></i>\
                 {series}</label></li>"
            )?;
        }
        writeln!(page, "</ul></details>")?;
    }
    let panels = |figures: Vec<&Figure>| {
        format!("<div class=\"panels wide\">\n{}</div>\n", figures.into_iter().map(Figure::html).collect::<String>())
    };
    let (folded, shown): (Vec<_>, Vec<_>) = part.figures.iter().partition(|figure| figure.folded);
    if !shown.is_empty() {
        write!(page, "{}", panels(shown))?;
    }
    writeln!(page, "<details><summary>How it was measured, and all numbers</summary>\n<p>{}</p>", part.method)?;
    if !folded.is_empty() {
        write!(page, "{}", panels(folded))?;
    }
    for table in &part.tables {
        let file = format!("{}.csv", table.name);
        let rows = if table.on_page { table.html() } else { String::new() };
        writeln!(page, "{rows}<p class=\"csv\"><a href=\"{file}\">{file}</a>, with all digits</p>")?;
    }
    writeln!(page, "</details>\n</section>")
}
