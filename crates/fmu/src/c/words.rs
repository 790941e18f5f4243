//! Words of memory as numbers and as bytes.

/// Words as the numbers whose bits they are.
pub fn numbers_of(words: &[u64]) -> &[f64] {
    // SAFETY: both have the same size and alignment, and any bits are a number.
    unsafe { core::slice::from_raw_parts(words.as_ptr().cast(), words.len()) }
}

/// Words as the bytes in memory.
pub fn bytes_of(words: &[u64]) -> &[u8] {
    // SAFETY: a word consists of eight bytes, which have no alignment.
    unsafe { core::slice::from_raw_parts(words.as_ptr().cast(), size_of_val(words)) }
}

/// The text in words, up to the first zero.
pub fn text_of(words: &[u64]) -> &[u8] {
    let bytes = bytes_of(words);
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    bytes.get(..end).unwrap_or_default()
}
