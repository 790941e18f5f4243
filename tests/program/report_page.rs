//! The page of a report in a browser: nothing overflows on a desktop or a phone, no text of a picture is cut off, and
//! it prints on a few pages. The test needs Chromium; without it, it prints that it was skipped.

use crate::command::{empty_folder, run, scene};
use crate::skips;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// Measures the page, and writes the results to attributes of the body.
const PROBE: &str = r#"<script>
addEventListener("load", () => {
  const page = document.documentElement;
  document.body.setAttribute("data-overflow", page.scrollWidth - page.clientWidth);
  const cut = [...document.querySelectorAll("figure svg text")].filter((text) => {
    const [inner, outer] = [text.getBoundingClientRect(), text.ownerSVGElement.getBoundingClientRect()];
    return inner.width > 0 && (inner.left < outer.left - 1 || inner.right > outer.right + 1);
  });
  document.body.setAttribute("data-cut", cut.map((text) => text.textContent).join("|"));
});
</script>"#;

/// The command of an installed browser.
fn chromium() -> Option<OsString> {
    let named = env::var_os("BRINELL_CHROMIUM");
    let known = ["chromium", "chromium-browser", "google-chrome"].map(OsString::from);
    let answers =
        |program: &OsString| Command::new(program).arg("--version").output().is_ok_and(|said| said.status.success());
    named.into_iter().chain(known).find(answers)
}

/// The output of the browser for `arguments` and the page at `path`.
fn browse(browser: &OsString, profile: &Path, arguments: &[&str], path: &Path) -> String {
    let mut command = Command::new(browser);
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"]);
    command.arg(format!("--user-data-dir={}", profile.display())).args(arguments);
    let output = command.arg(format!("file://{}", path.display())).output().expect("a browser that answered before");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The value of an attribute of the body.
fn attribute<'a>(page: &'a str, name: &str) -> &'a str {
    let start = page.find(&format!("{name}=\"")).unwrap_or_else(|| panic!("the browser hasn't measured {name}"));
    page[start + name.len() + 2..].split('"').next().expect("there is always a first part")
}

#[test]
fn the_page_fits_a_desktop_a_phone_and_six_printed_pages() {
    let Some(browser) = chromium() else {
        return skips::skipped("the look of the report", "there is no Chromium (BRINELL_CHROMIUM names one)");
    };
    let folder = empty_folder();
    for name in ["steel_ball", "damped", "two_contacts"] {
        run(folder.path(), ["report", &scene(name).display().to_string(), "--quick", "-o", name]).with_status(0);
        let page = folder.path().join(name).join("index.html");
        let text = fs::read_to_string(&page).expect("a page").replace("</body>", &format!("{PROBE}</body>"));
        let probed = page.with_file_name("probed.html");
        fs::write(&probed, text).expect("a writable folder");
        let profile = folder.path().join("profile");
        for width in [1440, 1024, 390] {
            let size = format!("--window-size={width},900");
            let measured = browse(&browser, &profile, &[&size, "--dump-dom"], &probed);
            assert_eq!(attribute(&measured, "data-overflow"), "0", "{name} at {width} pixels");
            assert_eq!(attribute(&measured, "data-cut"), "", "{name} at {width} pixels: text is cut off");
        }
        let pdf = folder.path().join("page.pdf");
        browse(&browser, &profile, &[&format!("--print-to-pdf={}", pdf.display())], &page);
        let pdf = fs::read(&pdf).expect("a printed page");
        let pages = String::from_utf8_lossy(&pdf).matches("/Type /Page\n").count();
        assert!((1..=6).contains(&pages), "{name} prints on {pages} pages");
    }
}
