//! Compression of a file as a whole, which takes longer than that of a stream and gives less: zopfli, with one block for each large
//! section of a library. Finding the borders of blocks would take most of zopfli's time.

use object::read::macho::{FatArch, MachOFatFile32};
use object::{Object, ObjectSection};
use std::io::Write;
use std::num::NonZeroU64;
use std::{iter, mem};

/// Size of the largest file that is compressed in this way [bytes]. A model description may have many megabytes.
pub const LARGEST: usize = 1 << 18;

/// A compressed file.
pub struct Deflated {
    bytes: Vec<u8>,
    checksum: u32,
    /// Size of the file [bytes].
    size: usize,
}

impl Deflated {
    /// `file`, compressed; `None` if it is too large.
    pub fn new(file: &[u8]) -> Option<Deflated> {
        if file.len() > LARGEST {
            return None;
        }
        let options =
            zopfli::Options { iteration_count: ITERATIONS, maximum_block_splits: 1, ..zopfli::Options::default() };
        let mut encoder = zopfli::DeflateEncoder::new(options, zopfli::BlockType::Dynamic, Vec::new());
        let mut begin = 0;
        for end in borders(file).into_iter().chain([file.len()]) {
            // each piece becomes a block
            encoder.write_all(&file[mem::replace(&mut begin, end)..end]).expect(IN_MEMORY);
        }
        let bytes = encoder.finish().expect(IN_MEMORY);
        Some(Deflated { bytes, checksum: crc32fast::hash(file), size: file.len() })
    }
}

/// A second one saves 0.1 % more, a third nothing.
const ITERATIONS: NonZeroU64 = NonZeroU64::new(2).unwrap();

const IN_MEMORY: &str = "memory takes everything";

/// The size from which a section has a block of its own [bytes].
const LARGE: u64 = 2048;

/// The borders of the large sections of a library; none for other files.
fn borders(file: &[u8]) -> Vec<usize> {
    let universal = MachOFatFile32::parse(file).map(|universal| universal.arches().to_vec()).unwrap_or_default();
    let slices = universal.iter().map(|slice| slice.file_range()).chain(iter::once((0, file.len() as u64)));
    let mut borders = Vec::new();
    for (begin, size) in slices {
        let slice = file.get(begin as usize..(begin + size) as usize).unwrap_or_default();
        let Ok(library) = object::File::parse(slice) else { continue };
        let ranges = library.sections().filter_map(|section| section.file_range()).filter(|(_, size)| *size >= LARGE);
        borders.extend(ranges.flat_map(|(at, size)| [begin + at, begin + at + size]).map(|border| border as usize));
    }
    borders.retain(|&border| border > 0 && border < file.len());
    borders.sort_unstable();
    borders.dedup();
    borders
}

/// A zip archive with a single file.
///
/// Reference: PKWARE, APPNOTE.TXT 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16.
pub fn archive_of_one(name: &str, file: &Deflated) -> Vec<u8> {
    const VERSION: u16 = 20;
    const UNIX: u16 = 3 << 8;
    const NAME_IN_UTF8: u16 = 1 << 11;
    const DEFLATE: u16 = 8;
    const FIRST_DAY_OF_1980: u16 = 1 << 5 | 1;
    const ORDINARY_FILE: u32 = 0o100_644 << 16;
    let words = |words: &[u16]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>();
    let long = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>();
    let flags = if name.is_ascii() { 0 } else { NAME_IN_UTF8 };
    let head = [
        words(&[VERSION, flags, DEFLATE, 0, FIRST_DAY_OF_1980]),
        long(&[file.checksum, file.bytes.len() as u32, file.size as u32]),
        words(&[name.len() as u16, 0]),
    ]
    .concat();
    let local = [b"PK\x03\x04", head.as_slice(), name.as_bytes(), &file.bytes].concat();
    let made_by = words(&[UNIX | VERSION]);
    let rest = [words(&[0, 0, 0]), long(&[ORDINARY_FILE, 0])].concat();
    let central = [b"PK\x01\x02", made_by.as_slice(), &head, &rest, name.as_bytes()].concat();
    let sizes = [words(&[0, 0, 1, 1]), long(&[central.len() as u32, local.len() as u32]), words(&[0])].concat();
    [local, central, b"PK\x05\x06".to_vec(), sizes].concat()
}

#[cfg(test)]
mod tests {
    use super::{Deflated, LARGEST, archive_of_one, borders};
    use std::io::{Cursor, Read};
    use zip::ZipArchive;

    #[test]
    fn a_file_is_read_back_from_the_archive_of_one() {
        let program = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        for (name, file) in [("empty", &[][..]), ("text ü", b"text text text text"), ("code", &program[..LARGEST])] {
            let archive = archive_of_one(name, &Deflated::new(file).expect("it is small enough"));
            assert!(archive.len() < file.len() * 9 / 10 + 200, "{name}: {} of {}", archive.len(), file.len());
            let mut archive = ZipArchive::new(Cursor::new(archive)).expect("an archive");
            let mut entry = archive.by_index(0).expect("a file");
            let mut found = Vec::new();
            // checks the sum
            entry.read_to_end(&mut found).expect("a compressed file");
            assert_eq!((&*entry.name().expect("a name"), entry.unix_mode()), (name, Some(0o100_644)));
            assert!(found == file, "{name}");
        }
        assert!(Deflated::new(&program[..=LARGEST]).is_none());
    }

    #[test]
    fn a_library_has_borders_within_it_and_other_files_have_none() {
        let program = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        let found = borders(&program);
        assert!(found.len() > 2 && found.is_sorted(), "{found:?}");
        assert!(found.iter().all(|&border| border > 0 && border < program.len()), "{found:?}");
        assert!(borders(b"<html>").is_empty() && borders(&program[..100]).is_empty() && borders(&[]).is_empty());
    }
}
