use brinell_exporter::schema::{schema, without_links};
use serde_json::Value;

/// Calls `see` for each key of a scene, with its path.
fn each_key(schema: &Value, path: &str, see: &mut impl FnMut(&str, &Value)) {
    for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}.{key}");
        see(&path, schema);
        each_key(schema, &path, see);
    }
    if schema["items"].is_object() {
        each_key(&schema["items"], path, see);
    }
}

#[test]
fn every_key_has_words_without_links_and_every_number_a_unit_or_none_at_all() {
    let mut count = 0;
    each_key(&schema(), "", &mut |path, key| {
        let words = key["description"].as_str().unwrap_or_default();
        assert!(!words.is_empty() && !words.contains("](") && !words.contains("Option"), "{path}: {key}");
        let is_quantity = key["type"][1] == "string" && key["type"][0] == "number";
        assert!(!is_quantity || key["pattern"].is_string(), "{path}: {key}");
        count += 1;
    });
    assert!(count > 130, "{count}");
}

#[test]
fn links_leave_their_words() {
    let text = "a [built-in `x`](#a) or [one of your own](b.md#c), `[x, y]` and [Pa]";
    assert_eq!(without_links(text), "a built-in `x` or one of your own, `[x, y]` and [Pa]");
}
