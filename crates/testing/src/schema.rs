//! The JSON Schema of scenes, and a validator that is none of ours: Python's `jsonschema`, which runs as long as the test program.

use crate::command::{brinell, output};
use crate::places::temporary;
use crate::python::{keeping_modules, python};
use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::{LazyLock, Mutex};

/// Takes the schema from the first line, and answers each further one, a text as JSON, with what is wrong with it by the schema: a list of messages, or null if it is no TOML.
const VALIDATOR: &str = "
import json, sys, tomllib
from jsonschema import Draft202012Validator
schema = json.loads(sys.stdin.readline())
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
for line in sys.stdin:
    try:
        scene = tomllib.loads(json.loads(line))
    except tomllib.TOMLDecodeError:
        answer = None
    else:
        answer = [f'{error.json_path}: {error.message}'[:300] for error in validator.iter_errors(scene)]
    print(json.dumps(answer), flush=True)
";

/// What `brinell schema` prints.
pub static SCHEMA: LazyLock<Value> = LazyLock::new(|| output(brinell(temporary()).arg("schema")).with_status(0).json());

static PIPES: LazyLock<Mutex<(Child, BufReader<ChildStdout>)>> = LazyLock::new(|| {
    let mut command = Command::new(python());
    command.args(["-X", "utf8", "-c", VALIDATOR]).stdin(Stdio::piped()).stdout(Stdio::piped());
    // it ends with its input
    let mut child = keeping_modules(&mut command).spawn().expect("Python can be started");
    writeln!(child.stdin.as_mut().expect("a pipe"), "{}", *SCHEMA).expect("the validator reads");
    let output = child.stdout.take().expect("a pipe");
    Mutex::new((child, BufReader::new(output)))
});

/// What is wrong with the `text` of a scene by the schema; `None` if it is no TOML.
pub fn mistakes(text: &str) -> Option<Vec<String>> {
    let mut pipes = PIPES.lock().expect("no test has failed while it had the pipes");
    writeln!(pipes.0.stdin.as_mut().expect("a pipe"), "{}", Value::from(text)).expect("the validator reads");
    let mut answer = String::new();
    pipes.1.read_line(&mut answer).expect("the validator answers");
    serde_json::from_str(&answer).expect("the validator writes JSON")
}
