//! The common parts of all HTML pages: the head, and escaped text.

use std::fmt::Write;

/// The style of a page of text.
pub const TEXT_STYLE: &str = "\
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 50rem; margin: 0 auto; padding: 1rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { text-align: left; padding: .25rem .75rem .25rem 0; border-bottom: 1px solid #8886; vertical-align: top; }
td.n { text-align: right; white-space: nowrap; }
figure { margin: 1rem 0; } svg { max-width: 100%; height: auto; background: #fff; }
code { font-size: .95em; }";

/// The style of a page of pictures and tables. In dark mode the pictures are inverted and their hues rotated back, so that
/// every line keeps its colour and contrast.
pub const PICTURE_STYLE: &str = "\
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
@media screen and (prefers-color-scheme: dark) { figure svg:not(.map), .legend i { filter: invert(1) hue-rotate(180deg); } figure svg.map { background: #fff; border-radius: .4rem; } }
@media print {
  body { max-width: none; padding: 0; font-size: 9pt; } .csv { display: none; } .table { overflow: visible; max-height: none; font-size: inherit; }
  .panels { grid-template-columns: repeat(3, 1fr); } h2 { break-after: avoid; } tr, figure { break-inside: avoid; }
  .legend i { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  th, td { padding: .1rem .35rem; } .words { white-space: normal; }
}";

/// The beginning of a page, up to its heading.
pub fn begin(page: &mut String, title: &str, style: &str) -> std::fmt::Result {
    writeln!(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(page, "<title>{title}</title>\n<meta name=\"viewport\" content=\"width=device-width\">")?;
    writeln!(page, "<style>\n{style}\n</style>\n</head>\n<body>")
}

/// `text`, escaped for HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
