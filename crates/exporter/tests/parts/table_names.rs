use brinell_exporter::table::names::lists;

const TABLE: &str = "# text\n\n[[a]]\nname = \"one\"\nk = 1\n\n[[b]]\nname = \"x\"\n\n[[a]]\nname = \"two\"\n";

#[test]
fn a_table_lists_its_names_in_their_order_and_no_others() {
    assert!(lists(TABLE, "[[a]]", [&["one", "two"]]) && lists(TABLE, "[[b]]", [&["x"]]));
    assert!(lists(TABLE, "[[a]]", [&["two"], &["one"]]), "each list has an order of its own");
    for wrong in [&["one"][..], &["two", "one"], &["one", "two", "three"], &["on", "two"], &["one ", "two"], &[]] {
        assert!(!lists(TABLE, "[[a]]", [wrong]), "{wrong:?}");
    }
}
