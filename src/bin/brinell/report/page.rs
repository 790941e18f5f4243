//! The report as a page that needs nothing else.

use super::Report;
use crate::html::{PICTURE_STYLE, begin, escape};
use std::fmt::Write;

/// The page of `report`.
pub fn write(report: &Report) -> String {
    let mut page = String::new();
    body(&mut page, report).expect("a String takes everything");
    page
}

fn body(page: &mut String, report: &Report) -> std::fmt::Result {
    let name = escape(&report.name);
    begin(page, &format!("{name}: report"), PICTURE_STYLE)?;
    writeln!(page, "<h1>{name}: step, coupling and law</h1>")?;
    let (lead, others) = report.summary.split_first().expect("there is something to say");
    writeln!(page, "<p class=\"lead\"><strong>{}</strong></p>\n<ul>", escape(lead))?;
    for sentence in others {
        writeln!(page, "<li>{}</li>", escape(sentence))?;
    }
    writeln!(page, "</ul>\n<p>Numbers of this page for programs: <a href=\"report.json\">report.json</a></p>")?;
    for part in &report.parts {
        writeln!(page, "<h2>{}</h2>\n<p>{}</p>", part.title, part.words)?;
        if !part.pictures.is_empty() {
            writeln!(page, "<div class=\"panels wide\">")?;
            for (name, svg) in &part.pictures {
                let link = format!("<a href=\"{name}.svg\">{name}.svg</a>");
                writeln!(page, "<figure>\n{svg}<figcaption class=\"csv\">{link}</figcaption></figure>")?;
            }
            writeln!(page, "</div>")?;
        }
        for table in &part.tables {
            let file = format!("{}.csv", table.name);
            let rows = if table.on_page { table.html() } else { String::new() };
            writeln!(page, "{rows}<p class=\"csv\"><a href=\"{file}\">{file}</a>, with all digits</p>")?;
        }
    }
    writeln!(page, "<p>Brinell {}</p>", env!("CARGO_PKG_VERSION"))?;
    writeln!(page, "<script>\n{}</script>\n</body>\n</html>", include_str!("tables.js"))
}
