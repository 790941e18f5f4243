//! Debian packages: an `ar` archive that contains a `tar` archive compressed by xz.

use lzma_rust2::XzReader;
use object::read::archive::ArchiveFile;
use std::fs;
use std::io::{self, Read};
use std::path::Path;

/// Largest size of an index [bytes].
const LARGEST_INDEX: u64 = 1 << 30;

/// The decompressed bytes.
///
/// # Errors
/// [`io::Error`]
pub fn unxz(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    XzReader::new(bytes, true).take(LARGEST_INDEX).read_to_end(&mut text)?;
    Ok(text)
}

/// Unpacks the files of a package whose paths are `wanted` to `folder`. The compiler, `usr/bin/rustc`, becomes
/// `usr/bin/rustc-web`.
///
/// # Errors
/// A sentence.
pub fn unpack(package: &Path, folder: &Path, wanted: impl Fn(&str) -> bool) -> Result<(), String> {
    let bytes = fs::read(package).map_err(|error| error.to_string())?;
    let archive = ArchiveFile::parse(bytes.as_slice()).map_err(|error| error.to_string())?;
    for member in archive.members() {
        let member = member.map_err(|error| error.to_string())?;
        if member.name() == b"data.tar.xz" {
            let data = member.data(bytes.as_slice()).map_err(|error| error.to_string())?;
            return untar(XzReader::new(data, true), folder, wanted).map_err(|error| error.to_string());
        }
    }
    Err("it has no data.tar.xz".into())
}

fn untar(data: impl Read, folder: &Path, wanted: impl Fn(&str) -> bool) -> io::Result<()> {
    let mut archive = tar::Archive::new(data);
    archive.set_preserve_mtime(false);
    for entry in archive.entries()? {
        let mut entry = entry?;
        let path = entry.path()?.to_string_lossy().into_owned();
        let path = path.trim_start_matches("./");
        if entry.header().entry_type().is_dir() || !wanted(path) {
            continue;
        }
        match path {
            "usr/bin/rustc" => {
                let program = folder.join("usr/bin/rustc-web");
                fs::create_dir_all(program.parent().unwrap_or(folder))?;
                entry.unpack(program)?;
            }
            // rejects paths that would leave the folder
            _ => drop(entry.unpack_in(folder)?),
        }
    }
    Ok(())
}
