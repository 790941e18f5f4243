//! Selection of the packages of the toolchain: the current ones of Debian.
//!
//! Reference: *Debian Repository Format*, for the index of packages. The index comes over HTTPS and contains the hash of every
//! package.

use super::ToolchainError;
use super::download::Source;
use super::package::{Package, Part};
use std::env;

/// The release of Debian that contains the packages.
const RELEASE: &str = "bookworm-security";

/// The packages of the toolchain according to the index on the mirror.
///
/// # Errors
/// [`ToolchainError`]
pub fn packages(source: &Source, std: bool) -> Result<Vec<Package>, ToolchainError> {
    let architecture = match (env::consts::OS, env::consts::ARCH) {
        ("linux", "x86_64") => "amd64",
        ("linux", "aarch64") => "arm64",
        (os, arch) => return Err(ToolchainError::System(format!("{os} on {arch}"))),
    };
    let index = source.index(&format!("dists/{RELEASE}/main/binary-{architecture}/Packages.xz"))?;
    choose(&index, std)
}

/// The packages of the toolchain: the compiler, and its dependencies.
fn choose(index: &str, std: bool) -> Result<Vec<Package>, ToolchainError> {
    let rustc = find(index, "rustc-web")?;
    let version = field(rustc, "Version")?;
    let dev = find(index, "libstd-rust-web-dev")?;
    let libraries = find(index, dependency(dev, "libstd-rust-web-")?)?;
    let llvm = dependency(libraries, "libllvm")?;
    let lld = format!("lld-{}", llvm.trim_start_matches("libllvm"));
    let mut parts = vec![
        (rustc, Part::Compiler),
        (libraries, Part::Libraries),
        (find(index, llvm)?, Part::Libraries),
        (find(index, &lld)?, Part::Linker),
        (find(index, "rust-web-src")?, Part::Source),
    ];
    if std {
        parts.push((dev, Part::Std));
    }
    for (paragraph, part) in &parts {
        let is_rust = !matches!(field(paragraph, "Package")?, name if name == llvm || name == lld);
        if is_rust && field(paragraph, "Version")? != version {
            return Err(ToolchainError::NoPackage(format!("{} {version}", field(paragraph, "Package")?)));
        }
        debug_assert!(*part != Part::Std || std);
    }
    parts.into_iter().map(|(paragraph, part)| package(paragraph, part)).collect()
}

fn package(paragraph: &str, part: Part) -> Result<Package, ToolchainError> {
    let text = |key| field(paragraph, key).map(str::to_string);
    let size = text("Size")?;
    let size = size.parse().map_err(|_| ToolchainError::NoPackage(format!("size that is a number: {size}")))?;
    Ok(Package {
        name: text("Package")?,
        version: text("Version")?,
        path: text("Filename")?,
        size,
        sha256: text("SHA256")?,
        part,
    })
}

/// The paragraph of the package with this name.
fn find<'a>(index: &'a str, name: &str) -> Result<&'a str, ToolchainError> {
    let is_named = |paragraph: &&str| field(paragraph, "Package").is_ok_and(|found| found == name);
    index.split("\n\n").find(is_named).ok_or_else(|| ToolchainError::NoPackage(name.into()))
}

fn field<'a>(paragraph: &'a str, key: &str) -> Result<&'a str, ToolchainError> {
    let value = |line: &'a str| line.strip_prefix(key)?.strip_prefix(": ");
    paragraph.lines().find_map(value).ok_or_else(|| ToolchainError::NoPackage(format!("field {key}")))
}

/// The first dependency of the paragraph whose name begins with `prefix`.
fn dependency<'a>(paragraph: &'a str, prefix: &str) -> Result<&'a str, ToolchainError> {
    let mut names = field(paragraph, "Depends")?.split(", ").filter_map(|needed| needed.split(' ').next());
    names.find(|name| name.starts_with(prefix)).ok_or_else(|| ToolchainError::NoPackage(format!("{prefix}...")))
}

#[cfg(test)]
mod tests {
    use super::{Part, choose};

    fn paragraph(name: &str, version: &str, depends: &str) -> String {
        format!(
            "Package: {name}\nVersion: {version}\nDepends: libc6 (>= 2.34), {depends}\nFilename: pool/{name}.deb\nSize: 12\n\
             SHA256: {name}-hash\nDescription: words\n more words\n\n"
        )
    }

    fn index(source: &str) -> String {
        [
            paragraph("rustc-web-other", "1", "x"),
            paragraph("rustc-web", "2", "libstd-rust-web-dev (= 2)"),
            paragraph("libstd-rust-web-dev", "2", "libstd-rust-web-1.99 (= 2)"),
            paragraph("libstd-rust-web-1.99", "2", "libllvm77, libstdc++6"),
            paragraph("libllvm77", "1:77", "libz3-4"),
            paragraph("lld-77", "1:77", "libllvm77 (= 1:77)"),
            paragraph("rust-web-src", source, "x"),
        ]
        .concat()
    }

    #[test]
    fn the_packages_are_those_that_the_compiler_depends_on() {
        let names =
            |std| -> Vec<_> { choose(&index("2"), std).unwrap().into_iter().map(|package| package.name).collect() };
        let usual = ["rustc-web", "libstd-rust-web-1.99", "libllvm77", "lld-77", "rust-web-src"];
        assert_eq!(names(false), usual);
        assert_eq!(names(true), [usual.as_slice(), &["libstd-rust-web-dev"]].concat());
    }

    #[test]
    fn a_package_that_is_missing_or_of_another_version_is_named() {
        let refusal = |index: &str| choose(index, false).err().expect("an error").to_string();
        assert!(refusal(&index("3")).contains("no rust-web-src 2"), "{}", refusal(&index("3")));
        let without = index("2").replace("Package: lld-77", "Package: lld-76");
        assert!(refusal(&without).contains("no lld-77"), "{}", refusal(&without));
        assert!(refusal("").contains("no rustc-web"));
    }

    #[test]
    fn only_what_is_needed_is_unpacked() {
        assert!(Part::Compiler.has("usr/bin/rustc", false) && !Part::Compiler.has("usr/share/doc/rustc", false));
        assert!(Part::Source.has("usr/src/rustc-1/library/core/src/lib.rs", false));
        let std = "usr/src/rustc-1/library/std/src/lib.rs";
        assert!(!Part::Source.has(std, false) && Part::Source.has(std, true));
        assert!(!Part::Source.has("usr/src/rustc-1/compiler/x.rs", true));
    }
}
