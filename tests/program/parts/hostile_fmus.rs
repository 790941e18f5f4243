//! Hostile archives and model descriptions: read without a panic, or refused with a message of ordinary length. Nothing is ever
//! written outside the folder, nor more than the bound.

use brinell::parts::{BoundedArchive, Description};
use brinell_testing::mutations::{assert_message, bytes, cases, text};
use std::fs;
use std::io::{Cursor, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const DESCRIPTION: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<fmiModelDescription fmiVersion=\"2.0\" modelName=\"unit\" guid=\"{1}\" description=\"a &amp; b &#x41;\">
  <CoSimulation modelIdentifier=\"unit\" canInterpolateInputs=\"true\" maxOutputDerivativeOrder=\"1\"/>
  <!-- a comment --><LogCategories><Category name=\"logAll\"/></LogCategories><![CDATA[ <x> ]]>
  <ModelVariables>
    <ScalarVariable name=\"rate\" valueReference=\"0\" causality=\"input\"><Real start=\"1e-3\"/></ScalarVariable>
    <ScalarVariable name=\"force\" valueReference=\"1\" causality=\"output\"><Real unit='N'/></ScalarVariable>
    <ScalarVariable name=\"regime\" valueReference=\"2\" causality=\"output\"><Enumeration declaredType=\"r\" start=\"1\"/>
    </ScalarVariable>
  </ModelVariables>
</fmiModelDescription>
";

/// A document type with entities that would be four gigabytes.
const BOMB: &str = "<?xml version=\"1.0\"?><!DOCTYPE b [<!ENTITY a \"aaaaaaaaaaaaaaaa\"><!ENTITY c \"&a;&a;&a;&a;\">
<!ENTITY d SYSTEM \"file:///etc/passwd\">]>
<fmiModelDescription fmiVersion=\"2.0\" guid=\"&c;&c;&d;\"><CoSimulation modelIdentifier=\"&a;\"/></fmiModelDescription>\n";

const WORDS: [&str; 12] = [
    "ScalarVariable",
    "Real",
    "Integer",
    "Boolean",
    "String",
    "Enumeration",
    "start",
    "valueReference",
    "causality",
    "4294967296",
    "&#0;",
    "xmlns:a",
];

#[test]
fn hostile_model_descriptions_are_read_or_refused_with_a_message() {
    let (mut read, all) = (0, cases(20_000));
    for number in 0..all {
        let case = text(number, &[DESCRIPTION, DESCRIPTION, BOMB], &WORDS);
        match catch_unwind(AssertUnwindSafe(|| Description::read(|| Ok(Cursor::new(case.as_bytes()))))) {
            // what comes out is no larger than what goes in: nothing was expanded
            Ok(Ok(description)) => {
                let names: usize = description.variables.iter().map(|(name, _)| name.len()).sum();
                assert!(description.guid.len() + names <= case.len(), "larger than the text: {case}");
                read += 1;
            }
            Ok(Err(error)) => assert_message(&error.to_string(), &case),
            Err(_) => panic!("case {number} panics:\n{case}"),
        }
    }
    assert!(read > all / 20 && read < all, "{read} of {all} were read");
}

/// A small archive with all that an FMU has.
fn archive(names: &[&str]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (index, name) in names.iter().enumerate() {
        let method = if index % 2 == 0 { CompressionMethod::Deflated } else { CompressionMethod::Stored };
        archive.start_file(*name, SimpleFileOptions::default().compression_method(method)).expect("another name");
        archive.write_all(DESCRIPTION.repeat(index + 1).as_bytes()).expect("memory can be written to");
    }
    archive.finish().expect("memory can be written to").into_inner()
}

/// All files below `folder`, and their total size.
fn files_below(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).expect("a readable folder").flatten();
    entries
        .map(|entry| if entry.path().is_dir() { files_below(&entry.path()) } else { entry.metadata().unwrap().len() })
        .sum()
}

#[test]
fn hostile_archives_are_unpacked_inside_their_folder_or_refused_with_a_message() {
    let good = archive(&["modelDescription.xml", "binaries/linux64/unit.so", "resources/scene.toml", "documentation/"]);
    let outer = tempfile::tempdir().expect("a folder for temporary files");
    let (mut unpacked, all) = (0, cases(1000));
    for number in 0..all {
        let case = bytes(number, &good);
        let folder = outer.path().join("inner");
        fs::create_dir(&folder).expect("an empty folder");
        let opened = || BoundedArchive::open(Cursor::new(case.as_slice()));
        match catch_unwind(AssertUnwindSafe(|| opened().and_then(|mut archive| archive.unpack(&folder)))) {
            Ok(Ok(())) => unpacked += 1,
            Ok(Err(error)) => assert_message(&error.to_string(), &format!("case {number}")),
            Err(_) => panic!("case {number} panics"),
        }
        assert!(files_below(outer.path()) < 1 << 20, "case {number} is far larger than what was packed");
        assert_eq!(fs::read_dir(outer.path()).unwrap().count(), 1, "case {number} has left its folder");
        fs::remove_dir_all(&folder).expect("what was unpacked can be removed");
    }
    assert!(unpacked > all / 50 && unpacked < all, "{unpacked} of {all} were unpacked");
}
