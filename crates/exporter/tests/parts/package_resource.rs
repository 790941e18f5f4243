use brinell_exporter::package::resource::version;

fn number(bytes: &[u8], at: usize) -> usize {
    usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]))
}

/// All texts of a block and its children, read as Windows does.
fn texts(block: &[u8]) -> Vec<(String, String)> {
    let length = |text: &[u8]| text.chunks(2).position(|pair| pair == [0, 0]).expect("an end");
    let text = |bytes: &[u8]| {
        let units = bytes.chunks(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
        String::from_utf16(&units.collect::<Vec<_>>()).unwrap()
    };
    let key = text(&block[6..6 + 2 * length(&block[6..])]);
    let value = (6 + 2 * key.len() + 2).next_multiple_of(4);
    let is_text = number(block, 4) == 1;
    let size = number(block, 2) * if is_text { 2 } else { 1 };
    let mut found = Vec::new();
    if is_text && size > 0 {
        found.push((key, text(&block[value..value + size - 2])));
    }
    let mut at = (value + size).next_multiple_of(4);
    while at < block.len() {
        let length = number(block, at);
        found.extend(texts(&block[at..at + length]));
        at = (at + length).next_multiple_of(4);
    }
    found
}

#[test]
fn the_blocks_are_read_back() {
    let file = version("steel_ball");
    assert_eq!(file.len() % 4, 0);
    let resource = &file[32..];
    assert_eq!((number(resource, 0), number(resource, 4)), (resource.len() - 32, 32));
    let block = &resource[32..];
    assert_eq!(number(block, 0), block.len());
    let texts = texts(block);
    let text = |key: &str| texts.iter().find(|(name, _)| name == key).unwrap_or_else(|| panic!("no {key}")).1.as_str();
    assert_eq!(text("ProductName"), "Brinell");
    assert_eq!(text("InternalName"), "steel_ball");
    assert_eq!(text("OriginalFilename"), "steel_ball.dll");
    assert_eq!(text("ProductVersion"), env!("CARGO_PKG_VERSION"));
}
