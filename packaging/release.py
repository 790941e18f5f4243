#!/usr/bin/env python3
"""Makes the wheel and the archive of the exporter for each platform, and checks them.

    python3 packaging/release.py                                    # for this machine
    python3 packaging/release.py --program target/release/brinell   # without compiling anything
    python3 packaging/release.py all --prebuilt FOLDER --page FILE --toolchain FOLDER --mingw FOLDER
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

import archives
from archives import Files
from bill import bill_of_materials
from licenses import third_party
from platforms import PLATFORMS, ROOT, Tools, environment, has_standard_library, here

VERSION = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
INFO = f"brinell-{VERSION}.dist-info"
DATA = f"brinell-{VERSION}.data"

# Folders below `share` in which shells look for completions. PowerShell has none: its users call the file in a profile.
COMPLETIONS = {
    "bash": "bash-completion/completions/brinell",
    "zsh": "zsh/site-functions/_brinell",
    "fish": "fish/vendor_completions.d/brinell.fish",
    "powershell": "brinell/brinell.ps1",
}


# A crate for the Objective-C runtime asks for two libraries of macOS that zig has no list of, but the program calls none
# of their functions. Stubs satisfy the linker, which then leaves both out.
STUBS = [f"-L{ROOT}/packaging/macos", f"-F{ROOT}/packaging/macos", "-Wl,-dead_strip_dylibs"]


def main() -> None:
    given = _arguments()
    given.output.mkdir(parents=True, exist_ok=True)
    tools = Tools(given.toolchain, given.mingw)
    program = given.program or _built_program()
    share = _manual_and_completions(program)
    if given.prebuilt is not None:
        share |= archives.read_folder(given.prebuilt, "share/brinell/prebuilt")
    else:
        print("NO PREBUILT LIBRARIES: the program will need rustc to export", file=sys.stderr)
    if given.page is not None:
        share["share/brinell/brinell.html"] = given.page.read_bytes()
    else:
        print("NO PAGE: `brinell app` will have nothing to open", file=sys.stderr)
    written = []
    for name in given.platforms:
        if given.program is not None:
            tag, base = _plain_wheel(program, given.scratch, given.source)
        else:
            tag, base = _maturins_wheel(name, tools, given.scratch, given.source)
        written += _pack(name, tag, base, share, given.output)
    (given.output / "SHA256SUMS").write_text(archives.sums(written))
    for path in written:
        print(f"{path.stat().st_size:>10} {path}")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    add = parser.add_argument
    add("platforms", nargs="*", metavar="PLATFORM", help=f"{', '.join(PLATFORMS)}, or all")
    add("--program", type=Path, help="a program that is built already, for this machine")
    add(
        "--source",
        type=Path,
        default=ROOT / "python",
        help="the Python project, or an unpacked source distribution [default: python]",
    )
    add("--prebuilt", type=Path, help="the folder that `brinell prebuild` has written")
    add("--page", type=Path, help="the page that page.py has written")
    add("--toolchain", type=Path, help="the folder that rustc-web is unpacked in")
    add("--mingw", type=Path, help="the folder that Debian's mingw-w64 is unpacked in")
    folder = ROOT / "target" / "packaging"
    add("--scratch", type=Path, default=folder, help=f"where to build [default: {folder}]")
    add("-o", "--output", type=Path, default=folder / "dist", help="[default: dist in there]")
    given = parser.parse_args()
    given.platforms = list(PLATFORMS) if given.platforms == ["all"] else given.platforms or [here()]
    for name in given.platforms:
        if name not in PLATFORMS:
            parser.error(f"there is no platform {name}: {', '.join(PLATFORMS)}, or all")
    if given.program is not None and given.platforms != [here()]:
        parser.error(f"--program is a program for {here()}")
    for folder in (given.prebuilt, given.toolchain, given.mingw, given.source):
        if folder is not None and not folder.is_dir():
            parser.error(f"there is no folder {folder}")
    given.scratch, given.source = given.scratch.resolve(), given.source.resolve()
    return given


def _built_program() -> Path:
    """The program for this machine, which generates the manual and the completions."""
    subprocess.run(["cargo", "build", "--release", "--locked"], cwd=ROOT, check=True)
    return ROOT / "target" / "release" / ("brinell.exe" if os.name == "nt" else "brinell")


def _manual_and_completions(program: Path) -> Files:
    """The files below `share` of every installation."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program.resolve(), "man", "-o", folder], check=True)
        files = archives.read_folder(Path(folder), "share/man/man1")
    for shell, path in COMPLETIONS.items():
        command = [program.resolve(), "completions", shell]
        files[f"share/{path}"] = subprocess.run(command, capture_output=True, check=True).stdout
    return files


def _maturin(scratch: Path, *requirements: str) -> Path:
    """The pinned maturin, in its own environment, which is created on first use."""
    folder = scratch / "venv"
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    for name in requirements:
        wanted, installed = ROOT / "packaging" / name, folder / name
        if not installed.is_file() or installed.read_bytes() != wanted.read_bytes():
            if not folder.is_dir():
                venv.create(folder, with_pip=True)
            pip = [programs / "python", "-m", "pip", "--disable-pip-version-check"]
            subprocess.run([*pip, "install", "--quiet", "-r", wanted], check=True)
            installed.write_bytes(wanted.read_bytes())
    return programs / "maturin"


def _maturins_wheel(name: str, tools: Tools, scratch: Path, source: Path) -> tuple[str, Files]:
    """Tag and files of maturin's wheel for the platform `name`. Linked with zig, a program for
    Linux runs with glibc 2.17 and newer, which maturin checks."""
    it = PLATFORMS[name]
    more = ["requirements-zig.txt"] if it.zig else []
    command = [_maturin(scratch, "requirements.txt", *more), "build", "--release", "--locked"]
    # the linker signs a program for macOS: it must not be stripped afterwards
    command += ["--strip", "false" if it.oldest_macos else "true", "--target", it.target]
    if it.zig:
        command.append("--zig")
    if not has_standard_library(it.target):
        command += ["-Z", "build-std=std,panic_unwind"]
    with tempfile.TemporaryDirectory() as folder:
        variables = environment(it, tools, scratch, ROOT if source == ROOT / "python" else source)
        # what zig links for musl is static otherwise, whatever rustc says
        linked = ["-s", *STUBS] if it.oldest_macos else ["-dynamic"] if it.target.endswith("-musl") else []
        command += ["--out", folder, "--", *(f"-Clink-arg={argument}" for argument in linked)]
        subprocess.run(command, cwd=source, env=variables, check=True)
        (wheel,) = Path(folder).glob("*.whl")
        return wheel.stem.split("-")[-1], archives.read_zip(wheel)


def _plain_wheel(program: Path, scratch: Path, source: Path) -> tuple[str, Files]:
    """The same for an existing program, which runs on systems as new as this one."""
    maturin = _maturin(scratch, "requirements.txt")
    with tempfile.TemporaryDirectory() as folder:
        command = [maturin, "pep517", "write-dist-info", "--compatibility", "linux"]
        command += ["--metadata-directory", folder]
        subprocess.run(command, cwd=source, check=True, capture_output=True)
        files = archives.read_folder(Path(folder) / INFO, INFO)
    tag = files[f"{INFO}/WHEEL"].decode().strip().split("Tag: ")[-1].split("-")[-1]
    module = archives.read_folder(source / "brinell", "brinell")
    files |= {name: data for name, data in module.items() if "__pycache__" not in name}
    return tag, files | {f"{DATA}/scripts/{program.name}": program.read_bytes()}


def _pack(name: str, tag: str, base: Files, share: Files, output: Path) -> list[Path]:
    """Writes the wheel and the archive for the platform `name`, and checks them."""
    it = PLATFORMS[name]
    licenses = {
        "LICENSE": (ROOT / "LICENSE").read_bytes(),
        "THIRD-PARTY-LICENSES": third_party(it.target),
    }
    wheel_files = base | {f"{DATA}/data/{path}": data for path, data in share.items()}
    wheel_files |= {f"{INFO}/licenses/{path}": data for path, data in licenses.items()}
    bill = bill_of_materials(VERSION, it.target)
    wheel_files[f"{INFO}/sboms/brinell.cdx.json"] = bill
    metadata = base[f"{INFO}/METADATA"].decode()
    expression = "License-Expression: MIT\n"
    files_named = "".join(f"License-File: {path}\n" for path in licenses)
    metadata = metadata.replace(expression, f"{expression}{files_named}", 1)
    wheel_files[f"{INFO}/METADATA"] = metadata.encode()
    wheel = output / f"brinell-{VERSION}-py3-none-{tag}.whl"
    wheel.write_bytes(archives.zipped(archives.with_record(wheel_files, f"{INFO}/RECORD")))
    archives.check_wheel(wheel, it, VERSION)

    ((path, program),) = ((path, data) for path, data in base.items() if "/scripts/" in path)
    top = f"brinell-{VERSION}-{name}"
    files = {f"{top}/{path}": data for path, data in share.items()}
    files |= {f"{top}/{path}": data for path, data in licenses.items()}
    files[f"{top}/brinell.cdx.json"] = bill
    files[f"{top}/bin/{path.split('/')[-1]}"] = program
    files = {path: files[path] for path in sorted(files)}
    archive = output / (f"{top}.zip" if "windows" in name else f"{top}.tar.gz")
    archive.write_bytes((archives.zipped if "windows" in name else archives.tarred)(files))
    return [wheel, archive]


if __name__ == "__main__":
    main()
