//! A browser for tests, in the target folder like all their tools.

use super::pytest;
use super::python::{environment_beside, keeping_modules};
use crate::places::root;
use crate::skips::skipped;
use std::env;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

/// A browser that runs without windows.
struct Browser {
    program: PathBuf,
    /// The Python interpreter with its driver.
    python: PathBuf,
}

/// Linux on x86-64 has the pinned Chromium, always; elsewhere the variable `BRINELL_CHROMIUM` names one.
///
/// # Errors
/// The reason why this system has none.
fn browser() -> Result<&'static Browser, &'static str> {
    static BROWSER: OnceLock<Result<Browser, String>> = OnceLock::new();
    let made = || {
        let has_package = cfg!(all(target_os = "linux", target_arch = "x86_64"));
        let named = env::var_os("BRINELL_CHROMIUM").map(PathBuf::from).filter(|_| !has_package);
        if !has_package && named.is_none() {
            return Err("the tests have a Chromium for Linux on x86-64 only; BRINELL_CHROMIUM names another".into());
        }
        let (packages, script) = (root().join("tests/requirements-browser.txt"), root().join("tests/page/browser.py"));
        let python = environment_beside("browser-venv", &packages, has_package.then_some(script.as_path()))
            .unwrap_or_else(|why| panic!("{why}"));
        Ok(Browser { program: named.unwrap_or_else(|| python.with_file_name("chromium")), python })
    };
    BROWSER.get_or_init(made).as_ref().map_err(String::as_str)
}

/// Runs these files of tests/page/ with the browser and what `given` adds to the command. Where there is no browser, `what` is skipped.
pub fn pytest(what: &str, files: &[&str], given: impl FnOnce(&mut Command) -> &mut Command) {
    let browser = match browser() {
        Ok(browser) => browser,
        Err(why) => return skipped(what, why),
    };
    run(browser, files, "chromium", given);
}

/// Runs these files in the Firefox and the WebKit of the system too, as far as it has them.
pub fn pytest_in_others(what: &str, files: &[&str], given: impl Fn(&mut Command) -> &mut Command) {
    let Ok(browser) = browser() else { return };
    for (kind, programs, package) in OTHERS {
        if let Some(missing) = programs.iter().find(|program| !is_installed(program)) {
            skipped(
                &format!("{what} in {kind}"),
                &format!("there is no {missing} (Debian and Ubuntu: apt install {package})"),
            );
            continue;
        }
        run(browser, files, kind, &given);
    }
}

/// Other browsers: their names, the programs that are needed, and where they are from. A Firefox of a snap can't read a folder of a test.
const OTHERS: [(&str, &[&str], &str); 2] =
    [("firefox", &["firefox-esr"], "firefox-esr"), ("webkit", &["WebKitWebDriver", "Xvfb"], "webkit2gtk-driver xvfb")];

fn is_installed(program: &str) -> bool {
    env::var_os("PATH").is_some_and(|path| env::split_paths(&path).any(|folder| folder.join(program).is_file()))
}

/// Runs these files in this kind of browser.
fn run(browser: &Browser, files: &[&str], kind: &str, given: impl FnOnce(&mut Command) -> &mut Command) {
    let mut command = Command::new(&browser.python);
    keeping_modules(&mut command).env("BRINELL_TEST_BROWSER", kind).env("BRINELL_TEST_CHROMIUM", &browser.program);
    // scenes are UTF-8, whatever the user's language
    pytest::pytest(given(command.env("PYTHONUTF8", "1")), "page", files);
}
