#!/usr/bin/env python3
"""Makes a compiler for all platforms in a folder of its own, without root privileges.

    python3 packaging/toolchain.py FOLDER [--std] [--targets [TARGET ...]] [--mirror URL]

For who makes releases on a machine whose Rust has no other targets. Debian has a compiler that builds browsers
(rustc-web), with the sources of Rust's libraries, and LLVM's linker. Their packages are unpacked, not installed; `core`
is then compiled for each target. `BRINELL_TOOLCHAIN=FOLDER` makes `brinell` use it. Layout of the folder:

packages.json                     the packages; written last: without it the toolchain is incomplete
usr/bin/rustc                     a script that passes the place of its libraries to the compiler, rustc-web
usr/bin/cc-lld                    a script that takes the arguments of a C compiler, and links ELF files
usr/lib/rustlib/HOST/bin/rust-lld  LLVM's linker for all systems, a script; the first argument is -flavor
usr/bin/wasm2c                    makes C of modules for WebAssembly, for C source as a platform
usr/lib/rustlib/TARGET/lib        core and compiler_builtins of each target
usr/src/rustc-VERSION/library     with --std: the sources of Rust's libraries, for cargo's -Zbuild-std
usr/lib/rustlib/wasm32-wasip1/    with --std: the C library of modules for a page
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import lzma
import os
import platform
import re
import shutil
import subprocess
import tarfile
import urllib.request
from pathlib import Path

RELEASE = "bookworm-security"
MIRROR = "https://deb.debian.org/debian-security"
# The text of wasm2c differs between versions, so this one is pinned, and found beside the mirror of security updates.
WABT = "debian/pool/main/w/wabt/wabt_1.0.32-1_{processor}.deb"
WABT_SHA256 = {
    "amd64": "f258a5cd377afac3361fc1dcb6fb10e813a88ab32c1895eba63fd7422801e9f1",
    "arm64": "a2aa1c8b6e413fc34b8070df9256df6d10d82c65f600a01b676fac2851aeee95",
}
# The C library of modules with the whole standard library: those of the page in a browser.
WASI = "debian/pool/main/w/wasi-libc/wasi-libc_0.0~git20241209.574b88d-2_all.deb"
WASI_SHA256 = "b7716260051d289248b7667f81fa2792c125d888ff51da3fa09c6272cc0bd11d"
TARGETS = [
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "x86_64-pc-windows-msvc",
    "x86_64-apple-darwin",
    "aarch64-apple-darwin",
    "wasm32-unknown-unknown",
]

# Settings of crates of the standard library: their unstable features stay unstable for their users.
SETTINGS = (
    "--crate-type=rlib -Copt-level=3 -Cpanic=abort -Ccodegen-units=1 -Zforce-unstable-if-unmarked --cap-lints=allow"
).split()
# What the build script of compiler_builtins sets for 64-bit processors. The functions over bytes are the exporter's own.
BUILTINS = [f'--cfg=feature="{name}"' for name in ("compiler-builtins", "mem-unaligned", "unstable-intrinsics")]
BUILTINS += ["--cfg=intrinsics_enabled", "--cfg=arch_enabled", "--cfg=optimizations_enabled"]

RUSTC = """#!/bin/sh
here=${0%/*}
LD_LIBRARY_PATH=$here/../lib/LIBRARIES exec "$here/rustc-web" "$@"
"""
LLD = """#!/bin/sh
usr=${0%/*}/../../../..
LD_LIBRARY_PATH=$usr/lib/LIBRARIES exec "$usr"/lib/llvm-*/bin/lld "$@"
"""
# Debian's rustc has no other way to link ELF files.
DRIVER = """#!/bin/sh
# Takes the arguments of a C compiler, and gives those for the linker to LLVM's.
set -f
here=${0%/*}
count=$#
while [ $count -gt 0 ]; do
  argument=$1
  shift
  count=$((count - 1))
  case $argument in
    -Wl,*) IFS=,; set -- "$@" ${argument#-Wl,}; unset IFS ;;
    -nostartfiles|-nodefaultlibs|-nostdlib|-m64) ;;
    *) set -- "$@" "$argument" ;;
  esac
done
exec "$here/../lib/rustlib/HOST/bin/rust-lld" -flavor gnu "$@"
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--std", action="store_true", help="also what cargo needs to build whole programs")
    parser.add_argument("--targets", nargs="*", default=TARGETS, help="those that get a core; cargo with --std needs none")
    parser.add_argument("--mirror", default=MIRROR, help="a mirror of Debian's security updates")
    given = parser.parse_args()
    folder, done = given.folder.resolve(), given.folder.resolve() / "packages.json"
    known = json.loads(done.read_text()) if done.is_file() else {}
    has_all = set(known.get("targets", TARGETS)) >= set(given.targets)
    if known and known.get("std", False) >= given.std and has_all:
        print(f"{folder} is complete")
        return
    processor = {"x86_64": "amd64", "aarch64": "arm64"}.get(platform.machine())
    if platform.system() != "Linux" or processor is None:
        raise SystemExit("there are packages for Linux on x86-64 and arm64 only: use `rustup target add`")
    index = lzma.decompress(fetch(f"{given.mirror}/dists/{RELEASE}/main/binary-{processor}/Packages.xz")).decode()
    packages = chosen(index, given.std)
    shutil.rmtree(folder / "usr", ignore_errors=True)
    done.unlink(missing_ok=True)
    for package, pattern in packages:
        print(f"{package['Package']} {package['Version']}, {int(package['Size']) // 1_000_000} MB", flush=True)
        data = fetch(f"{given.mirror}/{package['Filename']}")
        if hashlib.sha256(data).hexdigest() != package["SHA256"]:
            raise SystemExit(f"{package['Filename']} has another hash than the index says")
        unpack(data, folder, pattern)
    fetch_pinned(WABT.format(processor=processor), WABT_SHA256[processor], given.mirror, folder, r"usr/bin/wasm2c$")
    if given.std:
        fetch_pinned(WASI, WASI_SHA256, given.mirror, folder, r"usr/lib/wasm32-wasi/(crt1-.*\.o|libc\.a)$")
        inside = folder / "usr/lib/rustlib/wasm32-wasip1/lib/self-contained"
        inside.parent.mkdir(parents=True, exist_ok=True)
        (folder / "usr/lib/wasm32-wasi").rename(inside)
    write_scripts(folder / "usr")
    # with --std, this machine has the core of the whole library
    host = {f"{platform.machine()}-unknown-linux-gnu"} if given.std else set()
    for target in sorted(set(given.targets) - host):
        print(f"core for {target}", flush=True)
        compile_core(folder / "usr", target)
    if not given.std:
        shutil.rmtree(folder / "usr/src")
    listed = [{key: package[key] for key in ("Package", "Version", "SHA256")} for package, _ in packages]
    made = {"std": given.std, "targets": given.targets, "mirror": given.mirror, "packages": listed}
    done.write_text(json.dumps(made, indent=1) + "\n")
    if given.targets:
        print(f"BRINELL_TOOLCHAIN={folder} brinell export SCENE --platforms all uses it")


def fetch(url: str) -> bytes:
    with urllib.request.urlopen(url, timeout=60) as answer:  # proxies come from the environment
        return answer.read()


def chosen(index: str, std: bool) -> list[tuple[dict[str, str], str]]:
    """The packages of the compiler in an index, and patterns for the files that are needed of each."""
    known = {}
    for paragraph in index.split("\n\n"):
        fields = dict(re.findall(r"^([\w-]+): (.*)$", paragraph, re.M))
        known.setdefault(fields.get("Package"), fields)

    def depends(package: str, prefix: str) -> str:
        names = [name.split(" ")[0] for name in known[package]["Depends"].split(", ")]
        return next(name for name in names if name.startswith(prefix))

    libraries = depends("libstd-rust-web-dev", "libstd-rust-web-")
    llvm = depends(libraries, "libllvm")
    crates = r"[^/]*" if std else r"(core|compiler-builtins|portable-simd|stdarch)"
    sources = rf"usr/src/[^/]*/library/{crates}/" + (r"|usr/src/[^/]*/library/|usr/lib/rustlib/src/" if std else "")
    parts = [
        ("rustc-web", r"usr/bin/rustc$"),
        (libraries, r"usr/lib/.*\.so"),
        (llvm, r"usr/lib/.*\.so"),
        (llvm.replace("libllvm", "lld-"), r"usr/lib/llvm-.*/bin/lld$"),
        ("rust-web-src", sources),
    ]
    if std:
        parts.append(("libstd-rust-web-dev", r"usr/lib/rustlib/"))
    versions = {known[name]["Version"] for name, _ in parts if "rust" in name}
    if len(versions) != 1:
        raise SystemExit(f"the mirror is being updated: it has {versions}; try again later")
    return [(known[name], pattern) for name, pattern in parts]


def fetch_pinned(name: str, digest: str, mirror: str, folder: Path, pattern: str) -> None:
    """The files that match `pattern` of a package beside the mirror of security updates, which never changes."""
    print(name.rpartition("/")[2], flush=True)
    data = fetch(f"{mirror.rpartition('/')[0]}/{name}")
    if hashlib.sha256(data).hexdigest() != digest:
        raise SystemExit(f"{name} has another hash than it had")
    unpack(data, folder, pattern)


def unpack(package: bytes, folder: Path, pattern: str) -> None:
    """Unpacks the files of a Debian package, an `ar` archive with a `tar` archive in it, whose paths begin with `pattern`."""
    at = 8
    while at < len(package):
        name, size = package[at : at + 16].strip().rstrip(b"/"), int(package[at + 48 : at + 58])
        if name == b"data.tar.xz":
            with tarfile.open(fileobj=io.BytesIO(package[at + 60 : at + 60 + size])) as data:
                for member in data:
                    member.name = member.name.removeprefix("./")
                    if not member.isdir() and re.match(pattern, member.name):
                        data.extract(member, folder, filter="tar")
            return
        at += 60 + size + size % 2
    raise SystemExit("a package without data.tar.xz")


def write_scripts(usr: Path) -> None:
    (usr / "bin/rustc").rename(usr / "bin/rustc-web")
    host = f"{platform.machine()}-unknown-linux-gnu"
    lld = usr / "lib/rustlib" / host / "bin/rust-lld"
    for path, text in ((usr / "bin/rustc", RUSTC), (usr / "bin/cc-lld", DRIVER), (lld, LLD)):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace("LIBRARIES", f"{platform.machine()}-linux-gnu").replace("HOST", host))
        path.chmod(0o755)


def compile_core(usr: Path, target: str) -> None:
    """Compiles `core` and `compiler_builtins` for `target` from the sources of the compiler."""
    library = next((usr / "src").glob("*/library"))
    folder = usr / "lib/rustlib" / target / "lib"
    folder.mkdir(parents=True, exist_ok=True)

    def build(name: str, crate: Path, *more: str) -> None:
        edition = re.search(r'^edition = "(\d+)"', (crate / "Cargo.toml").read_text(), re.M)
        command = [usr / "bin/rustc", f"--crate-name={name}", f"--edition={edition[1] if edition else 2024}"]
        command += ["--target", target, *SETTINGS, *more, crate / "src/lib.rs", "-o", folder / f"lib{name}.rlib"]
        subprocess.run(command, check=True, cwd=folder, env={**os.environ, "RUSTC_BOOTSTRAP": "1"})

    # bitcode only, because it is optimized together with the library of an FMU
    build("core", library / "core", "-Clinker-plugin-lto")
    builtins = library / "compiler-builtins/compiler-builtins"
    build("compiler_builtins", builtins, *BUILTINS, "--extern=core=libcore.rlib")


if __name__ == "__main__":
    main()
