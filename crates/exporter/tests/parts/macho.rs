//! Filling in libraries for macOS: minimal files built by hand.

use brinell_exporter::prebuilt::fill::{FillError, fill};
use brinell_exporter::signature::{SignatureError, check};
use brinell_fmu::scene::library::block::{Block, Data, KINDS};
use sha2::{Digest, Sha256};

const LIBRARY: u64 = 42;
const PAGE: usize = 4096;

/// Start of the block, which crosses a page border.
const BLOCK_AT: usize = 2 * PAGE - 100;

/// Pages that are signed.
const PAGES: usize = (BLOCK_AT + size_of::<Block>()).div_ceil(PAGE) + 1;

/// End of the signed part: within the last page.
const END: usize = (PAGES - 1) * PAGE + 16;

/// Length of the hashes with their head.
const HASHES: usize = 88 + PAGES * 32;

fn scene(library: u64) -> Block {
    // the identity is on the first of the two pages, the codes on the second
    Block::filled(library, Data { identity: 7, codes: [7; KINDS], ..Data::EMPTY }, &[]).expect("room for no list")
}

fn bytes_of(block: Block) -> Vec<u8> {
    block.words().flat_map(u64::to_le_bytes).collect()
}

/// A library with an empty block; with a signature if it is `signed`.
fn library(signed: bool) -> Vec<u8> {
    let mut file = Vec::new();
    let name = |text: &str| {
        let mut name = [0; 16];
        name[..text.len()].copy_from_slice(text.as_bytes());
        name
    };
    // magic, arm64, all, a dynamic library, commands, their size, flags, reserved
    let commands = if signed { (2, 168) } else { (1, 152) };
    for word in [0xfeed_facf_u32, 0x0100_000c, 0, 6, commands.0, commands.1, 0, 0] {
        file.extend(word.to_le_bytes());
    }
    // a segment with one section
    file.extend([0x19_u32, 152].into_iter().flat_map(u32::to_le_bytes));
    file.extend(name("__TEXT"));
    file.extend([0, END as u64, 0, END as u64].into_iter().flat_map(u64::to_le_bytes));
    file.extend([5_u32, 5, 1, 0].into_iter().flat_map(u32::to_le_bytes));
    file.extend(name("__brinell"));
    file.extend(name("__TEXT"));
    file.extend([BLOCK_AT as u64, size_of::<Block>() as u64].into_iter().flat_map(u64::to_le_bytes));
    file.extend([BLOCK_AT as u32, 3, 0, 0, 0, 0, 0, 0].into_iter().flat_map(u32::to_le_bytes));
    if signed {
        file.extend([0x1d_u32, 16, END as u32, 20 + HASHES as u32].into_iter().flat_map(u32::to_le_bytes));
    }
    file.resize(END, 0x5a);
    file[BLOCK_AT..BLOCK_AT + size_of::<Block>()].copy_from_slice(&bytes_of(Block::unfilled(LIBRARY)));
    if signed {
        let pages: Vec<_> = file.chunks(PAGE).map(Sha256::digest).collect();
        assert_eq!(pages.len(), PAGES);
        // one blob: the hashes
        for word in [0xfade_0cc0_u32, 20 + HASHES as u32, 1, 0, 20] {
            file.extend(word.to_be_bytes());
        }
        for word in [0xfade_0c02_u32, HASHES as u32, 0x20400, 0x20002, 88, 88, 0, PAGES as u32, END as u32] {
            file.extend(word.to_be_bytes());
        }
        file.extend([32, 2, 0, 12]);
        file.resize(END + 20 + 88, 0);
        pages.iter().for_each(|hash| file.extend_from_slice(hash));
    }
    file
}

#[test]
fn a_filled_library_has_the_data_and_the_hashes_of_its_pages() {
    let empty = library(true);
    check(&empty).expect("the file built by hand is right");
    let mut filled = empty.clone();
    fill(&mut filled, &scene(LIBRARY)).expect("a good library");
    check(&filled).expect("every page has its hash");
    let block = bytes_of(scene(LIBRARY));
    assert!(filled[BLOCK_AT..].starts_with(&block));
    // nothing else changes except the hashes of the pages that do
    let others = |place: &usize| !(BLOCK_AT..BLOCK_AT + block.len()).contains(place) && *place < END + 20 + 88;
    assert_eq!(filled.len(), empty.len());
    assert!((0..empty.len()).filter(others).all(|place| filled[place] == empty[place]));
    let page = |file: &[u8], page: usize| file[page * PAGE..END.min((page + 1) * PAGE)].to_vec();
    let hash = |file: &[u8], page: usize| file[END + 20 + 88 + page * 32..][..32].to_vec();
    let changed = |page: &usize, part: &dyn Fn(&[u8], usize) -> Vec<u8>| part(&filled, *page) != part(&empty, *page);
    let pages: Vec<_> = (0..PAGES).filter(|number| changed(number, &page)).collect();
    assert!(pages.len() > 1 && pages.len() < PAGES - 2, "{pages:?}");
    assert_eq!((0..PAGES).filter(|number| changed(number, &hash)).collect::<Vec<_>>(), pages);
}

#[test]
fn a_library_that_macos_would_not_load_is_refused() {
    let refused = |mut library: Vec<u8>| fill(&mut library, &scene(LIBRARY)).unwrap_err();
    assert!(matches!(refused(library(false)), FillError::Signature(SignatureError::None)));
    // one wrong byte in each page
    for page in 0..PAGES {
        let mut damaged = library(true);
        let at = if page == 0 { 300 } else { page * PAGE + 8 };
        damaged[at] ^= 1;
        let error = refused(damaged);
        assert!(
            matches!(error, FillError::Signature(SignatureError::Wrong(found)) if found == page),
            "{page}: {error}"
        );
    }
    let mut cut = library(true);
    cut.truncate(cut.len() - 1);
    assert!(matches!(refused(cut), FillError::Signature(SignatureError::Unreadable(_))));
    let mut other = library(true);
    other[END] ^= 1;
    assert!(matches!(refused(other), FillError::Signature(SignatureError::Unreadable(_))));
    let mut signed_by_somebody = library(true);
    signed_by_somebody[END + 20 + 15] = 0;
    assert!(matches!(refused(signed_by_somebody), FillError::Signature(SignatureError::Unknown(_))));
}

#[test]
fn a_library_of_another_kind_or_one_that_is_filled_already_is_refused() {
    let mut library = library(true);
    assert!(matches!(fill(&mut library.clone(), &scene(LIBRARY + 1)), Err(FillError::NotEmpty)));
    fill(&mut library, &scene(LIBRARY)).expect("a good library");
    assert!(matches!(fill(&mut library, &scene(LIBRARY)), Err(FillError::NotEmpty)));
    assert!(matches!(fill(&mut [0; 100], &scene(LIBRARY)), Err(FillError::Unreadable(_))));
}
