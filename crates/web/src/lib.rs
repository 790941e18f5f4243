//! What the page asks for: a call with JSON, and an answer with JSON and bytes.
//!
//! The page writes its question to the memory that [`reserve`] gives, and calls [`call`] with its length. The answer begins with two
//! lengths of four bytes, little-endian: of its JSON, and of the bytes behind it. A question is an object with a `method`; behind a
//! zero byte it may have bytes, too.
//!
//! | module | what it has |
//! |---|---|
//! | `lists` | laws, materials, tools, platforms, regimes |
//! | `examples` | scenes to start from |
//! | `text` | the scene as text and as values, with its mistakes |
//! | `answers` | predictions, curves, numbers for other tools |
//! | `archive` | the FMU |
//! | `unit` | the FMU, running |
//! | `bounce` | bodies in the hands of a master |
#![deny(unsafe_code)]

mod answers;
mod archive;
mod bounce;
mod examples;
mod lists;
mod text;
pub mod unit;

use serde_json::{Value, json};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The question, and the answer to the last one.
static QUESTION: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());

fn held(bytes: &Mutex<Vec<u8>>) -> MutexGuard<'_, Vec<u8>> {
    bytes.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Memory for a question of this `length` \[bytes\].
#[allow(unsafe_code, reason = "its name must be that of the export; no other function has it")]
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    let mut question = held(&QUESTION);
    question.clear();
    question.resize(length, 0);
    question.as_mut_ptr()
}

/// Answers the question. The answer stays until the next call.
#[allow(unsafe_code, reason = "its name must be that of the export; no other function has it")]
#[unsafe(no_mangle)]
pub extern "C" fn call() -> *const u8 {
    let question = std::mem::take(&mut *held(&QUESTION));
    let (json, bytes) = answer(&question);
    let mut answer = held(&ANSWER);
    answer.clear();
    for part in [json.as_bytes(), &bytes] {
        answer.extend((part.len() as u32).to_le_bytes());
    }
    answer.extend(json.as_bytes());
    answer.extend(&bytes);
    answer.as_ptr()
}

/// Why there is no answer.
#[derive(Debug, Default)]
pub struct Refused {
    message: String,
    /// Mistakes in the scene, with their places.
    mistakes: Vec<Value>,
}

impl<E: std::fmt::Display> From<E> for Refused {
    fn from(error: E) -> Refused {
        Refused { message: error.to_string(), mistakes: Vec::new() }
    }
}

/// The answer to a question: JSON, and bytes.
pub fn answer(question: &[u8]) -> (String, Vec<u8>) {
    match dispatch(question) {
        Ok((value, bytes)) => (json!({ "ok": value }).to_string(), bytes),
        Err(Refused { message, mistakes }) => {
            (json!({ "error": { "message": message, "mistakes": mistakes } }).to_string(), Vec::new())
        }
    }
}

fn dispatch(question: &[u8]) -> Result<(Value, Vec<u8>), Refused> {
    let end = question.iter().position(|byte| *byte == 0).unwrap_or(question.len());
    let (asked, bytes) = (&question[..end], question.get(end + 1..).unwrap_or_default());
    let asked: Value = serde_json::from_slice(asked)?;
    let method = asked["method"].as_str().unwrap_or_default();
    let value = match method {
        "about" => lists::about(),
        "schema" => brinell_exporter::schema::schema(),
        "check" => text::check(&read(&asked)?),
        "edit" => text::edit(&read(&asked)?)?,
        "new" => text::new(&read(&asked)?)?,
        "predict" => answers::predict(&read(&asked)?)?,
        "curve" => answers::curve(&read(&asked)?)?,
        "history" => answers::history(&read(&asked)?)?,
        "sweep" => answers::sweep(&read(&asked)?)?,
        "bands" => answers::bands(&read(&asked)?)?,
        "picture" => answers::picture(&read(&asked)?)?,
        "csv" => answers::csv(&read(&asked)?)?,
        "translate" => answers::translation(&read(&asked)?)?,
        "libraries" => archive::libraries(&read(&asked)?, bytes)?,
        "export" => return archive::export(&read(&asked)?),
        "scene_of" => archive::scene_of(bytes)?,
        "table" => text::table(&read(&asked)?, bytes)?,
        "ways" => bounce::ways(),
        "bounce" => bounce::bounce(&read(&asked)?)?,
        other => return Err(format!("there is no method `{other}`").into()),
    };
    Ok((value, Vec::new()))
}

/// The arguments of a method.
fn read<T: serde::de::DeserializeOwned>(asked: &Value) -> Result<T, Refused> {
    Ok(T::deserialize(asked)?)
}
