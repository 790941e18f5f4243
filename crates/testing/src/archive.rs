//! FMUs and other archives: their files, and copies with changes.

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

/// The files of the archive at `path` with their names, in their order.
pub fn files(path: &Path) -> Vec<(String, Vec<u8>)> {
    let file = File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut archive = ZipArchive::new(file).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let count = archive.len();
    let one = |index| {
        let mut file = archive.by_index(index).expect("a file of the archive");
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).expect("a file of the archive");
        (file.name().expect("a name in Unicode").into_owned(), bytes)
    };
    (0..count).map(one).collect()
}

/// The text of the file `name` in the archive at `path`.
pub fn text(path: &Path, name: &str) -> String {
    let found = files(path).into_iter().find(|(other, _)| other == name);
    let (_, bytes) = found.unwrap_or_else(|| panic!("there is no {name} in {}", path.display()));
    String::from_utf8(bytes).expect("UTF-8")
}

/// Writes an archive of `files`.
pub fn write<N: AsRef<str>, D: AsRef<[u8]>>(path: &Path, files: impl IntoIterator<Item = (N, D)>) {
    let mut archive = ZipWriter::new(File::create(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())));
    for (name, bytes) in files {
        archive.start_file(name.as_ref(), SimpleFileOptions::default()).expect("the name is new");
        archive.write_all(bytes.as_ref()).expect("the file can be written to");
    }
    archive.finish().expect("the file can be written to");
}

/// Copies the archive at `from` to `to`; `change` gives each file its new bytes, or leaves it out.
pub fn changed(from: &Path, to: &Path, mut change: impl FnMut(&str, Vec<u8>) -> Option<Vec<u8>>) {
    write(to, files(from).into_iter().filter_map(|(name, bytes)| change(&name, bytes).map(|bytes| (name, bytes))));
}

/// `bytes` with `new` in place of `old` wherever it occurs.
pub fn replaced(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    let (mut made, mut rest) = (Vec::with_capacity(bytes.len()), bytes);
    while let Some((&first, others)) = rest.split_first() {
        match rest.strip_prefix(old) {
            Some(after) => {
                made.extend(new);
                rest = after;
            }
            None => {
                made.push(first);
                rest = others;
            }
        }
    }
    made
}
