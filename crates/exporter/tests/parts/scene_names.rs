use brinell_exporter::mistake::Spanned;
use brinell_exporter::scene::names::{KEYWORDS, check_identifier, check_name};

#[test]
fn a_keyword_is_no_name_of_an_fmu_and_what_resembles_one_is() {
    assert_eq!(KEYWORDS.split_whitespace().count(), 109);
    for keyword in KEYWORDS.split_whitespace() {
        let named = |name: &str| Spanned::new(0..1, name.to_string());
        let refused = check_name(&named(keyword)).map_err(|mistake| mistake.1);
        assert!(refused.is_err_and(|said| said.contains("a keyword of C or C++")), "{keyword}");
        for near in [format!("{keyword}_1"), keyword.to_ascii_uppercase()] {
            assert!(check_name(&named(&near)).is_ok_and(|name| name == near), "{near}");
        }
        // of a contact, which is no name of a file or function
        assert!(check_identifier(&named(keyword)).is_ok());
    }
}
