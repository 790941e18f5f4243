use brinell_exporter::scene::rules::{BODIES, Key, RULES};
use brinell_exporter::schema::schema;
use serde_json::Value;

/// The schema of the key at this `path` below that of a table.
fn below<'a>(schema: &'a Value, path: &[String]) -> Option<&'a Value> {
    let Some((first, rest)) = path.split_first() else { return Some(schema) };
    let table = if schema["items"].is_object() { &schema["items"] } else { schema };
    below(table["properties"].get(first.trim_end_matches('s')).or(table["properties"].get(first))?, rest)
}

#[test]
fn a_rule_names_keys_that_scenes_have() {
    let schema = schema();
    // of the keys that a contact may not have for itself the schema knows nothing
    let is_refused =
        |key: &Key| key.path[0] == "contact" && key.path.len() == 3 && BODIES.contains(&key.path[1].as_str());
    let of_scene = |key: &Key| is_refused(key) || below(&schema, &key.path).is_some();
    for rule in RULES.iter() {
        let of_body = |key: &Key| below(&schema["properties"][rule.body.as_deref()?], &key.path);
        let keys: Vec<_> = rule.when.iter().flatten().chain(&rule.what).collect();
        let known = keys.iter().filter(|key| of_scene(key) || of_body(key).is_some()).count();
        assert_eq!(known, keys.len(), "{keys:?}");
    }
    assert!(RULES.len() > 100);
}
