//! FMUs by people who mean no good, or that others would unpack to something else; each must be refused by every reader with its reason.

use crate::archive::{self, replaced};
use std::fs;
use std::io::{Cursor, Write as _};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A hostile FMU.
pub struct Hostile {
    pub name: String,
    pub bytes: Vec<u8>,
    /// A part of the message.
    pub said: &'static str,
    /// What it takes to see it.
    pub seen: Seen,
}

/// Who sees what is wrong with an FMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// Whoever opens the archive.
    InArchive,
    /// Whoever unpacks the file in question.
    InFile,
    /// Whoever reads the model description.
    InDescription,
    /// Whoever looks for the library.
    InLibrary,
}

const DESCRIPTION: &str = "modelDescription.xml";

/// A file of no use, with a name that can be found in the archive's bytes.
const MORE: &str = "resources/aaaaaaaaaaaaaaaa";

type Files = Vec<(String, Vec<u8>)>;

fn packed(files: &Files, more: impl FnOnce(&mut ZipWriter<Cursor<Vec<u8>>>)) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        archive.start_file(name.as_str(), SimpleFileOptions::default()).expect("a new name");
        archive.write_all(bytes).expect("memory can be written to");
    }
    more(&mut archive);
    archive.finish().expect("memory can be written to").into_inner()
}

/// Changes the entry of the directory for each file whose name begins with `name`: `change` gets its bytes, of which 20 to 23 are the
/// packed size, 24 to 27 the size, and 8 and 9 the flags (APPNOTE.TXT, section 4.3.12).
fn with_entry(mut bytes: Vec<u8>, name: &str, change: impl Fn(&mut [u8])) -> Vec<u8> {
    let mut at = 0;
    let mut found = 0;
    while let Some(next) = bytes[at..].windows(4).position(|part| part == b"PK\x01\x02") {
        let entry = at + next;
        if bytes[entry + 46..].starts_with(name.as_bytes()) {
            change(&mut bytes[entry..]);
            found += 1;
        }
        at = entry + 4;
    }
    assert!(found > 0, "no entry for {name}");
    bytes
}

fn of_size(size: u32) -> impl Fn(&mut [u8]) {
    move |entry| entry[24..28].copy_from_slice(&size.to_le_bytes())
}

/// Hostile copies of the good FMU at `good`.
pub fn all(good: &Path) -> Vec<Hostile> {
    let files = archive::files(good);
    let mut all = Vec::new();
    let mut add = |name: &str, bytes: Vec<u8>, seen: Seen, said: &'static str| {
        all.push(Hostile { name: name.into(), bytes, said, seen });
    };
    let deflated =
        SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).compression_level(Some(1));
    let with = |name: &str| packed(&[files.clone(), vec![(name.into(), b"x".repeat(100))]].concat(), |_| ());
    for (index, path) in [
        "../out.txt",
        "a/../../out.txt",
        "/out.txt",
        "..\\out.txt",
        "C:\\out.txt",
        "binaries/linux64/../x.so",
        "binaries/./unit.so",
        "a//unit.so",
    ]
    .into_iter()
    .enumerate()
    {
        add(&format!("path-{index}"), with(path), Seen::InArchive, "no plain path inside the archive");
    }
    add(
        "twice",
        replaced(
            &packed(&files, |zip| {
                for name in [MORE, "resources/bbbbbbbbbbbbbbbb"] {
                    zip.start_file(name, deflated).unwrap();
                }
            }),
            b"bbbbbbbbbbbbbbbb",
            b"aaaaaaaaaaaaaaaa",
        ),
        Seen::InArchive,
        "two files in it have the same name",
    );
    add(
        "link",
        packed(&files, |zip| zip.add_symlink(MORE, "/etc/passwd", deflated).unwrap()),
        Seen::InArchive,
        "is a symbolic link, which tools unpack differently",
    );
    let zeros = |zip: &mut ZipWriter<_>| {
        zip.start_file(MORE, deflated.compression_level(Some(9))).unwrap();
        let piece = vec![0; 1_000_000];
        (0..100).for_each(|_| zip.write_all(&piece).unwrap());
    };
    add("bomb", packed(&files, zeros), Seen::InArchive, "has 100 MB when unpacked; allowed is");
    add(
        "declared",
        with_entry(with(MORE), MORE, of_size(3_000_000_000)),
        Seen::InArchive,
        "has 3000 MB when unpacked; allowed is",
    );
    let several = packed(&files, |zip| {
        (0..40).for_each(|index| zip.start_file(format!("{MORE}{index}"), deflated).unwrap());
    });
    add(
        "together",
        with_entry(several, MORE, of_size(60_000_000)),
        Seen::InArchive,
        "it has 2400 MB when unpacked; allowed is",
    );
    add("more than declared", with_entry(with(MORE), MORE, of_size(10)), Seen::InFile, "declare");
    add("encrypted", with_entry(with(MORE), MORE, |entry| entry[8] |= 1), Seen::InFile, "its zip archive is damaged");
    add("text", b"not a zip".to_vec(), Seen::InArchive, "it is no zip archive");
    add("half", packed(&files, |_| ())[..2000].to_vec(), Seen::InArchive, "it is no zip archive");
    let described = |from: &str, to: &str| {
        let change = |(name, bytes): &(String, Vec<u8>)| {
            let is_it = name == DESCRIPTION;
            (name.clone(), if is_it { replaced(bytes, from.as_bytes(), to.as_bytes()) } else { bytes.clone() })
        };
        let changed: Files = files.iter().map(change).collect();
        assert_ne!(changed, files, "nothing of {from}");
        packed(&changed, |_| ())
    };
    let text = archive::text(good, DESCRIPTION);
    let identifier =
        text.split("modelIdentifier=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("an identifier");
    let called =
        |name: &str| described(&format!("modelIdentifier=\"{identifier}\""), &format!("modelIdentifier=\"{name}\""));
    for (index, name) in ["../../../tmp/x", "/tmp/x", "..\\x", "C:x"].into_iter().enumerate() {
        add(&format!("identifier-{index}"), called(name), Seen::InLibrary, "which is no name of a library");
    }
    add("other library", called(".."), Seen::InLibrary, "which modelDescription.xml names");
    add("version", described("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\""), Seen::InLibrary, "is not of FMI 2.0");
    add("kind", described("CoSimulation", "ModelExchange"), Seen::InLibrary, "no element CoSimulation");
    let doctype = "<!DOCTYPE x [<!ENTITY e SYSTEM \"file:///etc/passwd\">]><fmiModelDescription";
    add("entity", described("<fmiModelDescription", doctype), Seen::InDescription, "it has a document type");
    add("control", described("<LogCategories>", "<LogCategories>&#1;"), Seen::InDescription, "none that XML can have");
    add("no XML", described("<fmiModelDescription", "<<"), Seen::InDescription, "modelDescription.xml can't be read");
    let without = |start: &str| {
        let kept: Files = files.iter().filter(|(name, _)| !name.starts_with(start)).cloned().collect();
        packed(&kept, |_| ())
    };
    add("no description", without(DESCRIPTION), Seen::InDescription, "modelDescription.xml is missing");
    add("no library", without("binaries/"), Seen::InLibrary, "there is no binary for this platform");
    all
}

/// Writes hostile copies of the good FMU at `good` to `folder`: the path of each, and a part of what is said of it.
pub fn write_all(good: &Path, folder: &Path) -> Vec<(PathBuf, Hostile)> {
    let write = |(index, hostile): (usize, Hostile)| {
        let path = folder.join(format!("hostile{index}.fmu"));
        fs::write(&path, &hostile.bytes).expect("the folder can be written to");
        (path, hostile)
    };
    all(good).into_iter().enumerate().map(write).collect()
}
