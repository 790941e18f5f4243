//! `brinell toolchain` with a mirror in a folder, with minimal packages.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::command::{Run, brinell, contents, empty_folder, output};
use crate::skips;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex};
use std::thread;
use tempfile::TempDir;

/// A mirror, and the folder for the toolchain.
struct Mirror {
    folder: TempDir,
}

/// Writes packages and their index. The compiler is a script that creates an empty file for everything.
const SCRIPT: &str = r##"
import hashlib, io, lzma, os, sys, tarfile
root = sys.argv[1]
rustc = """#!/bin/sh
case $1 in
  --print) cd "${0%/*}/.." && pwd ;;
  -vV) echo "release: 1.99.0"; echo "host: x86_64-unknown-linux-gnu" ;;
  *) while [ $# -gt 0 ]; do if [ "$1" = -o ]; then echo made > "$2"; fi; shift; done ;;
esac
"""
packages = {
    "rustc-web": ("libc6, libstd-rust-web-dev (= 1.99)", {"usr/bin/rustc": rustc, "usr/share/doc/rustc": "text"}),
    "libstd-rust-web-dev": ("libstd-rust-web-1.99 (= 1.99)", {"usr/lib/rustlib/x86_64-unknown-linux-gnu/lib/libstd-1.rlib": "std"}),
    "libstd-rust-web-1.99": ("libllvm77", {"usr/lib/x86_64-linux-gnu/librustc_driver.so": "x" * 200000}),
    "libllvm77": ("libc6", {"usr/lib/x86_64-linux-gnu/libLLVM.so.77": "llvm"}),
    "lld-77": ("libllvm77", {"usr/lib/llvm-77/bin/lld": "#!/bin/sh\necho linked \"$@\"\n"}),
    "rust-web-src": ("libc6", {
        "usr/src/rustc-1.99.0/library/core/Cargo.toml": 'edition = "2024"\n',
        "usr/src/rustc-1.99.0/library/core/src/lib.rs": "",
        "usr/src/rustc-1.99.0/library/compiler-builtins/compiler-builtins/Cargo.toml": 'edition = "2021"\n',
        "usr/src/rustc-1.99.0/library/std/src/lib.rs": "",
    }),
}
index = ""
for name, (depends, files) in packages.items():
    tar = io.BytesIO()
    with tarfile.open(fileobj=tar, mode="w") as archive:
        for path, text in files.items():
            info = tarfile.TarInfo("./" + path)
            info.size, info.mode = len(text), 0o755
            archive.addfile(info, io.BytesIO(text.encode()))
    # not compressed away, so that a part of it is a part
    data = lzma.compress(tar.getvalue(), preset=0)
    member = lambda name, data: (f"{name:<16}{0:<12}{0:<6}{0:<6}{100644:<8}{len(data):<10}`\n").encode() + data + b"\n" * (len(data) % 2)
    deb = b"!<arch>\n" + member("debian-binary", b"2.0\n") + member("data.tar.xz", data)
    path = f"pool/{name}.deb"
    os.makedirs(os.path.join(root, "pool"), exist_ok=True)
    open(os.path.join(root, path), "wb").write(deb)
    version = "1:77" if "77" in name else "1.99"
    index += f"Package: {name}\nVersion: {version}\nDepends: {depends}\nFilename: {path}\nSize: {len(deb)}\n"
    index += f"SHA256: {hashlib.sha256(deb).hexdigest()}\n\n"
folder = os.path.join(root, "dists/bookworm-security/main/binary-amd64")
os.makedirs(folder, exist_ok=True)
open(os.path.join(folder, "Packages.xz"), "wb").write(lzma.compress(index.encode()))
"##;

impl Mirror {
    /// `None`, with a message, if curl is not installed.
    fn new() -> Option<Mirror> {
        if Command::new("curl").arg("--version").output().is_err() {
            skips::skipped("downloads of the toolchain", "there is no curl");
            return None;
        }
        let folder = empty_folder();
        output(Command::new("python3").args(["-c", SCRIPT]).arg(folder.path().join("mirror"))).with_status(0);
        Some(Mirror { folder })
    }

    fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    fn package(&self, name: &str) -> PathBuf {
        self.path(&format!("mirror/pool/{name}.deb"))
    }

    fn toolchain(&self, more: &[&str]) -> Run {
        self.toolchain_from(&format!("file://{}", self.path("mirror").display()), more)
    }

    fn toolchain_from(&self, mirror: &str, more: &[&str]) -> Run {
        let mut command = brinell(self.folder.path());
        // a server on this machine is not behind a proxy
        command.env("no_proxy", "*").args(["toolchain", "--folder", "tc", "--mirror", mirror]);
        output(command.args(more))
    }
}

/// The files below `folder`, without folders.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for name in contents(folder) {
        match folder.join(&name) {
            path if path.is_dir() => found.extend(files(&path).into_iter().map(|inside| format!("{name}/{inside}"))),
            _ => found.push(name),
        }
    }
    found.sort();
    found
}

const TARGETS: [&str; 5] = [
    "aarch64-apple-darwin",
    "aarch64-unknown-linux-gnu",
    "x86_64-apple-darwin",
    "x86_64-pc-windows-msvc",
    "x86_64-unknown-linux-gnu",
];

/// The contents of the folder of a toolchain.
fn layout() -> Vec<String> {
    let mut files = vec!["lock".to_string(), "packages.json".into()];
    files.extend(["usr/bin/cc-lld", "usr/bin/rustc", "usr/bin/rustc-web", "usr/lib/llvm-77/bin/lld"].map(String::from));
    for target in TARGETS {
        for name in ["libcompiler_builtins.rlib", "libcore.rlib"] {
            files.push(format!("usr/lib/rustlib/{target}/lib/{name}"));
        }
    }
    files.push("usr/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld".into());
    files.extend(["libLLVM.so.77", "librustc_driver.so"].map(|name| format!("usr/lib/x86_64-linux-gnu/{name}")));
    files.sort();
    files
}

#[test]
fn the_packages_are_unpacked_and_core_is_compiled_for_every_target() {
    let Some(mirror) = Mirror::new() else { return };
    let said = mirror.toolchain(&[]).with_status(0);
    assert_eq!(files(&mirror.path("tc")), layout(), "{said:#?}");
    for part in ["downloading 5 packages", "unpacking rustc-web", "compiling core for x86_64-pc-windows-msvc"] {
        assert!(said.err.contains(part), "{part}: {said:#?}");
    }
    assert!(
        said.out.contains("rustc-web") && said.out.contains("1.99") && said.out.contains("BRINELL_TOOLCHAIN="),
        "{said:#?}"
    );
    let lld = mirror.path("tc/usr/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
    assert_eq!(output(Command::new(lld).args(["-flavor", "link"])).out, "linked -flavor link\n");
    let driver = mirror.path("tc/usr/bin/cc-lld");
    let arguments = ["-nostartfiles", "-Wl,-z,now,-T,a b", "x y.o", "-m64", "-o", "*"];
    assert_eq!(output(Command::new(driver).args(arguments)).out, "linked -flavor gnu -z now -T a b x y.o -o *\n");
}

#[test]
fn a_second_call_downloads_nothing() {
    let Some(mirror) = Mirror::new() else { return };
    mirror.toolchain(&[]).with_status(0);
    fs::remove_dir_all(mirror.path("mirror")).unwrap();
    let said = mirror.toolchain(&["--json"]).with_status(0);
    assert_eq!(said.err, "");
    assert_eq!(said.json()["packages"].as_array().unwrap().len(), 5);
    // more is requested than available
    let said = mirror.toolchain(&["--std"]).with_status(1);
    assert!(said.err.contains("can't be downloaded"), "{said:#?}");
}

#[test]
fn a_download_goes_on_where_it_stopped() {
    let Some(mirror) = Mirror::new() else { return };
    let package = mirror.package("libstd-rust-web-1.99");
    let whole = fs::read(&package).unwrap();
    // the connection breaks: the mirror has half of the file
    fs::write(&package, &whole[..whole.len() / 2]).unwrap();
    mirror.toolchain(&[]).with_status(1);
    let said = mirror.toolchain(&[]).with_status(1);
    assert!(said.err.contains("libstd-rust-web-1.99") && !mirror.path("tc/packages.json").exists(), "{said:#?}");
    // a wrong part would be noticed: only the missing part comes from the mirror, which now has another beginning
    fs::create_dir_all(mirror.path("tc/packages")).unwrap();
    fs::write(mirror.path("whole"), &whole).unwrap();
    let sum = output(Command::new("sha256sum").arg(mirror.path("whole"))).with_status(0).out;
    let sum = sum.split(' ').next().unwrap();
    let part = mirror.path(&format!("tc/packages/libstd-rust-web-1.99_{sum}.part"));
    fs::write(&part, &whole[..whole.len() / 2]).unwrap();
    let mut other = whole.clone();
    other[..whole.len() / 2].fill(0);
    fs::write(&package, &other).unwrap();
    mirror.toolchain(&[]).with_status(0);
    assert_eq!(files(&mirror.path("tc")), layout());
}

/// The files that were asked for, and the first byte of each.
type Requests = Arc<Mutex<Vec<(String, usize)>>>;

/// Serves the files of `folder` over HTTP, each byte range as it is asked for. The first answer about the file `breaks` ends in the
/// middle. Returns the address and the requests.
fn serve(folder: PathBuf, breaks: &'static str) -> (String, Requests) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = format!("http://{}", listener.local_addr().unwrap());
    let asked = Arc::new(Mutex::new(Vec::new()));
    let list = Arc::clone(&asked);
    thread::spawn(move || {
        for stream in listener.incoming() {
            let mut stream = stream.expect("a connection");
            let lines: Vec<String> =
                BufReader::new(&stream).lines().map_while(Result::ok).take_while(|line| !line.is_empty()).collect();
            let path = lines[0].split(' ').nth(1).expect("a request").trim_start_matches('/').to_string();
            let range =
                lines.iter().find_map(|line| line.strip_prefix("Range: bytes=")?.strip_suffix('-')?.parse().ok());
            let bytes = fs::read(folder.join(&path)).expect("a file of the mirror");
            let from: usize = range.unwrap_or(0);
            let is_first = !list.lock().unwrap().iter().any(|(known, _)| *known == path);
            list.lock().unwrap().push((path.clone(), from));
            let (status, rest) = (if range.is_some() { "206 Partial Content" } else { "200 OK" }, &bytes[from..]);
            let head = format!(
                "HTTP/1.1 {status}\r\nContent-Length: {}\r\nContent-Range: bytes {from}-{}/{}\r\nConnection: close\r\n\r\n",
                rest.len(),
                bytes.len() - 1,
                bytes.len()
            );
            let sent = if is_first && path.ends_with(breaks) { rest.len() / 2 } else { rest.len() };
            let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&rest[..sent]));
        }
    });
    (address, asked)
}

#[test]
fn after_a_broken_connection_the_message_says_how_much_is_there_and_the_next_call_asks_for_the_rest() {
    let Some(mirror) = Mirror::new() else { return };
    let broken = "pool/libstd-rust-web-1.99.deb";
    let size = fs::metadata(mirror.package("libstd-rust-web-1.99")).unwrap().len() as usize;
    let (address, asked) = serve(mirror.path("mirror"), broken);
    let said = mirror.toolchain_from(&address, &[]).with_status(1);
    let progress = format!("{} of {size} bytes are there, and the same command goes on", size / 2);
    assert!(said.err.contains(broken) && said.err.contains(&progress), "{progress}: {said:#?}");
    mirror.toolchain_from(&address, &[]).with_status(0);
    assert_eq!(files(&mirror.path("tc")), layout());
    let asked = asked.lock().unwrap();
    let of = |path: &str| asked.iter().filter(|(known, _)| known == path).map(|(_, from)| *from).collect::<Vec<_>>();
    assert_eq!(of(broken), [0, size / 2], "the second call asks for the second half");
    assert_eq!(of("pool/rustc-web.deb"), [0], "what is complete is not asked for again");
}

#[test]
fn a_damaged_package_is_reported_and_removed() {
    let Some(mirror) = Mirror::new() else { return };
    let package = mirror.package("lld-77");
    let whole = fs::read(&package).unwrap();
    let mut damaged = whole.clone();
    damaged[100] ^= 1;
    fs::write(&package, &damaged).unwrap();
    let said = mirror.toolchain(&[]).with_status(1);
    for part in ["pool/lld-77.deb is damaged", "with the hash", "the index of the packages has", "it was removed"] {
        assert!(said.err.contains(part), "{part}: {said:#?}");
    }
    assert!(!mirror.path("tc/usr").exists(), "nothing is unpacked before all is there");
    fs::write(&package, &whole).unwrap();
    mirror.toolchain(&[]).with_status(0);
    assert_eq!(files(&mirror.path("tc")), layout());
}

#[test]
fn packages_missing_from_the_index_are_named() {
    let Some(mirror) = Mirror::new() else { return };
    let index = mirror.path("mirror/dists/bookworm-security/main/binary-amd64/Packages.xz");
    let script = "import lzma, sys; path = sys.argv[1]; text = lzma.open(path).read().replace(b'Package: lld-77', b'Package: lld-7'); \
                  lzma.open(path, 'w').write(text)";
    output(Command::new("python3").args(["-c", script]).arg(index)).with_status(0);
    let said = mirror.toolchain(&[]).with_status(1);
    assert!(said.err.contains("the index of the packages has no lld-77"), "{said:#?}");
}

#[test]
fn without_curl_the_message_says_so() {
    let folder = empty_folder();
    let said = output(brinell(folder.path()).args(["toolchain", "--folder", "tc"]).env("PATH", folder.path()));
    assert!(said.with_status(1).err.contains("curl can't be started"));
}

#[test]
fn with_std_the_sources_and_the_library_of_the_machine_stay() {
    let Some(mirror) = Mirror::new() else { return };
    mirror.toolchain(&["--std"]).with_status(0);
    let files = files(&mirror.path("tc"));
    for path in
        ["usr/src/rustc-1.99.0/library/std/src/lib.rs", "usr/lib/rustlib/x86_64-unknown-linux-gnu/lib/libstd-1.rlib"]
    {
        assert!(files.iter().any(|file| file == path), "no {path} in {files:?}");
    }
}
