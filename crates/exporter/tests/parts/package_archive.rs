use brinell_exporter::package::archive::archive;

#[test]
fn an_archive_does_not_say_on_which_system_it_was_made() {
    let bytes = archive(&[("a.txt".into(), b"a")]).expect("an archive");
    let entry = bytes.windows(4).position(|it| it == b"PK\x01\x02").expect("a central directory");
    let unix = 3;
    assert_eq!(bytes[entry + 5], unix);
}
