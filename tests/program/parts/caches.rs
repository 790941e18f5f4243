#![cfg(unix)]

use brinell::parts::cache_folder;
use std::path::PathBuf;

/// The folder with these variables set.
fn chosen(os: &str, variables: &[(&str, &str)]) -> Option<PathBuf> {
    let value = |name: &str| variables.iter().find(|(known, _)| *known == name).map(|(_, value)| value.into());
    cache_folder(value, os).ok()
}

#[test]
fn an_empty_or_relative_xdg_cache_home_counts_as_unset() {
    let folder = |variables: &[(&str, &str)]| chosen("linux", variables);
    assert_eq!(folder(&[("HOME", "/home/a"), ("XDG_CACHE_HOME", "/c")]), Some("/c/brinell".into()));
    for none in ["", ".", "cache", "../cache"] {
        let set = [("HOME", "/home/a"), ("XDG_CACHE_HOME", none)];
        assert_eq!(folder(&set), Some("/home/a/.cache/brinell".into()), "{none:?}");
    }
    assert_eq!(folder(&[("HOME", "/home/a")]), Some("/home/a/.cache/brinell".into()));
    assert_eq!(folder(&[("HOME", "")]), None, "never the folder of temporary files");
    assert_eq!(folder(&[]), None);
    assert_eq!(folder(&[("BRINELL_CACHE", "/own"), ("XDG_CACHE_HOME", "/c")]), Some("/own".into()));
}

#[test]
fn each_system_has_its_own_cache() {
    assert_eq!(chosen("macos", &[("HOME", "/Users/a")]), Some("/Users/a/Library/Caches/brinell".into()));
    assert_eq!(chosen("windows", &[("LOCALAPPDATA", "/local"), ("HOME", "/h")]), Some("/local/brinell".into()));
    assert_eq!(chosen("windows", &[("HOME", "/h")]), None);
}
