//! Questions of the page and their answers, without a browser.

use brinell_web::answer;
use serde_json::{Value, json};

fn ask(question: &Value) -> Value {
    serde_json::from_str(&answer(question.to_string().as_bytes()).0).expect("answers are JSON")
}

#[test]
fn lists_are_there() {
    let said = ask(&json!({ "method": "about" }));
    assert!(said["ok"]["materials"].as_array().is_some_and(|all| all.len() > 30), "{said}");
}
