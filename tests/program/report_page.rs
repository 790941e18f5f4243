//! The pages of reports in a browser: tests/page/test_report.py.

use crate::command::{empty_folder, run, scene};
use brinell_testing::browser::pytest;
use brinell_testing::long;

#[test]
fn the_page_fits_a_desktop_a_phone_and_six_printed_pages() {
    if long::leaves_out("reports in a browser") {
        return;
    }
    let folder = empty_folder();
    for name in ["steel_ball", "damped", "two_contacts"] {
        run(folder.path(), ["report", &scene(name).display().to_string(), "--quick", "-o", name]).with_status(0);
    }
    pytest("the look of the report", &["test_report.py"], |python| python.env("BRINELL_TEST_REPORTS", folder.path()));
}
