//! The version resource of a Windows library, shown in the properties of the file.
//!
//! Reference: *Resource File Formats*, *VS_VERSIONINFO* and *VS_FIXEDFILEINFO* of the Windows documentation. The
//! linker turns it into the section `.rsrc`.

/// Type and name of a version resource: type 16, name 1.
const RT_VERSION: u16 = 16;
const NAME: u16 = 1;

/// English of the United States, in UTF-16.
const LANGUAGE: u16 = 0x0409;
const CODE_PAGE: u16 = 1200;

const FIXED_SIGNATURE: u32 = 0xFEEF_04BD;
const FIXED_VERSION: u32 = 0x0001_0000;
const MASK_OF_FLAGS: u32 = 0x3F;
const VOS_NT_WINDOWS32: u32 = 0x0004_0004;
const VFT_DLL: u32 = 2;

/// Contents of a block.
enum ResourceValue<'a> {
    Nothing,
    Text(&'a str),
    Bytes(&'a [u8]),
}

/// A resource file (`.res`) with the version of the library of the scene `name`.
pub fn version(name: &str) -> Vec<u8> {
    let version = env!("CARGO_PKG_VERSION");
    let strings = [
        ("FileDescription", "FMI 2.0 co-simulation FMU"),
        ("FileVersion", version),
        ("InternalName", name),
        ("OriginalFilename", &format!("{name}.dll")),
        ("ProductName", "Brinell"),
        ("ProductVersion", version),
    ];
    let strings: Vec<_> = strings.iter().map(|(key, text)| block(key, &ResourceValue::Text(text), &[])).collect();
    let table = block(&format!("{LANGUAGE:04X}{CODE_PAGE:04X}"), &ResourceValue::Nothing, &strings);
    let translation: Vec<u8> = [LANGUAGE, CODE_PAGE].into_iter().flat_map(u16::to_le_bytes).collect();
    let translation = block("Translation", &ResourceValue::Bytes(&translation), &[]);
    let children = [
        block("StringFileInfo", &ResourceValue::Nothing, &[table]),
        block("VarFileInfo", &ResourceValue::Nothing, &[translation]),
    ];
    let data = block("VS_VERSION_INFO", &ResourceValue::Bytes(&fixed(version)), &children);
    // every resource file begins with an empty resource
    [resource(0, 0, 0, &[]), resource(RT_VERSION, NAME, LANGUAGE, &data)].concat()
}

/// A resource with its header.
fn resource(kind: u16, name: u16, language: u16, data: &[u8]) -> Vec<u8> {
    const HEADER_SIZE: u32 = 32;
    let mut bytes: Vec<u8> = [data.len() as u32, HEADER_SIZE].into_iter().flat_map(u32::to_le_bytes).collect();
    // type and name are numbers; version of the data; flags; language; version and characteristics
    let words = [0xFFFF, kind, 0xFFFF, name, 0, 0, 0, language, 0, 0, 0, 0];
    bytes.extend(words.into_iter().flat_map(u16::to_le_bytes));
    bytes.extend(data);
    align(&mut bytes);
    bytes
}

/// The numbers of a version; file and product have the same.
fn fixed(version: &str) -> Vec<u8> {
    let mut parts = version.split(['.', '-', '+']).map(|part| part.parse::<u32>().unwrap_or(0));
    let mut next = || parts.next().unwrap_or(0);
    let (high, low) = (next() << 16 | next(), next() << 16);
    let flags = 0;
    let values = [
        FIXED_SIGNATURE,
        FIXED_VERSION,
        high,
        low,
        high,
        low,
        MASK_OF_FLAGS,
        flags,
        VOS_NT_WINDOWS32,
        VFT_DLL,
        0,
        0,
        0,
    ];
    values.into_iter().flat_map(u32::to_le_bytes).collect()
}

/// A block: its length, that of its value, whether this is text, its key, the value, and the blocks in it.
fn block(key: &str, value: &ResourceValue, children: &[Vec<u8>]) -> Vec<u8> {
    let utf16 = |text: &str| -> Vec<u8> { text.encode_utf16().chain([0]).flat_map(u16::to_le_bytes).collect() };
    let (value, length, is_text) = match value {
        ResourceValue::Nothing => (Vec::new(), 0, 1u16),
        // the length of text counts characters
        ResourceValue::Text(text) => (utf16(text), utf16(text).len() / 2, 1),
        ResourceValue::Bytes(bytes) => (bytes.to_vec(), bytes.len(), 0),
    };
    let mut bytes: Vec<u8> = [0, length as u16, is_text].into_iter().flat_map(u16::to_le_bytes).collect();
    bytes.extend(utf16(key));
    align(&mut bytes);
    bytes.extend(value);
    for child in children {
        align(&mut bytes);
        bytes.extend(child);
    }
    let length = bytes.len() as u16;
    bytes[..2].copy_from_slice(&length.to_le_bytes());
    bytes
}

/// Everything is aligned to four bytes.
fn align(bytes: &mut Vec<u8>) {
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}
