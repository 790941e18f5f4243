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
