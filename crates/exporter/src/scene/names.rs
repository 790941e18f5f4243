//! The names of FMUs and contacts: C identifiers.

use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::any_case;

/// The name of an FMU: a C identifier that every operating system accepts as a file name.
///
/// Reference: "Naming Files, Paths, and Namespaces" in the documentation of Windows.
pub fn check_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = check_identifier(name)?;
    let lower = text.to_ascii_lowercase();
    let port = PORTS.iter().find_map(|port| lower.strip_prefix(port));
    let is_port = port.is_some_and(|number| number.len() == 1 && number.bytes().all(|digit| digit.is_ascii_digit()));
    let reason = if is_port || DEVICES.contains(&lower.as_str()) {
        "is that of a device on Windows, where no library can have it"
    } else if KEYWORDS.split_whitespace().any(|keyword| keyword == text) {
        "is a keyword of C or C++, and FMI asks for an identifier"
    } else {
        return Ok(text);
    };
    Err(Mistake(name.span(), format!("name = {text:?} {reason}: call it otherwise")))
}

/// The devices of Windows, and those that a digit follows.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];
const PORTS: [&str; 2] = ["com", "lpt"];

/// The identifiers that are no name of an FMU, as a schema.
pub fn is_no_name() -> serde_json::Value {
    let [devices, ports] = [any_case(&DEVICES), any_case(&PORTS)];
    let keywords = KEYWORDS.split_whitespace().collect::<Vec<_>>();
    serde_json::json!({ "anyOf": [{ "pattern": format!("^(?:{devices}|(?:{ports})[0-9])$") }, { "enum": keywords }] })
}

/// The keywords of C and C++, which are no identifiers. FMI asks for one of C, since importers may compile the name of an FMU into
/// their own code; many of them are written in C++.
///
/// Reference: ISO C23, section 6.4.1, with those of C99; ISO C++20, sections 5.11 and 5.5 (operators that are words).
pub const KEYWORDS: &str = "
    auto break case char const continue default do double else enum extern float for goto if inline int long register restrict
    return short signed sizeof static struct switch typedef union unsigned void volatile while
    _Alignas _Alignof _Atomic _BitInt _Bool _Complex _Decimal128 _Decimal32 _Decimal64 _Generic _Imaginary _Noreturn
    _Static_assert _Thread_local
    alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
    asm catch char16_t char32_t char8_t class co_await co_return co_yield concept const_cast consteval constinit decltype delete
    dynamic_cast explicit export friend mutable namespace new noexcept operator private protected public reinterpret_cast requires
    static_cast template this throw try typeid typename using virtual wchar_t
    and and_eq bitand bitor compl not not_eq or or_eq xor xor_eq";

/// What `check_identifier` allows, as a pattern of JSON Schema.
pub const IDENTIFIER: &str = "^[A-Za-z_][A-Za-z0-9_]{0,99}$";

/// Text that is a C identifier, or a keyword.
pub fn check_identifier(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = name.get_ref();
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    // the name is also used for a file
    let short = text.len() <= 100;
    if short && begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(text.clone());
    }
    let message = format!(
        "name = {:?} is not a C identifier: at most 100 letters, digits and `_`, and no digit at the beginning",
        shortened(text)
    );
    Err(Mistake(name.span(), message))
}
