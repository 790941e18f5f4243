"""The platforms of wheels and archives, and the build settings of the program for each."""

from __future__ import annotations

import os
import platform
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True)
class Platform:
    """A platform for the exporter."""

    machine_names: tuple[str, str]
    """Python's names of the operating system and the processor."""
    target: str
    """The target name of rustc."""
    magic: bytes
    """The first bytes of a program."""
    machine: tuple[int, bytes]
    """Offset and bytes of the processor type in the header; on Windows, after `PE`."""
    zig: bool = True
    """Whether zig links, with its own headers and libraries."""
    oldest_macos: str | None = None


_ELF = b"\x7fELF\x02\x01"
_MACH_O = b"\xcf\xfa\xed\xfe"

PLATFORMS = {
    "linux-x86_64": Platform(
        ("Linux", "x86_64"), "x86_64-unknown-linux-gnu", _ELF, (18, b"\x3e\0")
    ),
    "linux-aarch64": Platform(
        ("Linux", "aarch64"), "aarch64-unknown-linux-gnu", _ELF, (18, b"\xb7\0")
    ),
    "linux-musl-x86_64": Platform(
        ("Linux", "x86_64"), "x86_64-unknown-linux-musl", _ELF, (18, b"\x3e\0")
    ),
    "windows-x86_64": Platform(
        ("Windows", "AMD64"), "x86_64-pc-windows-gnu", b"MZ", (4, b"\x64\x86"), zig=False
    ),
    "macos-x86_64": Platform(
        ("Darwin", "x86_64"),
        "x86_64-apple-darwin",
        _MACH_O,
        (4, b"\x07\0\0\x01"),
        oldest_macos="10.12",
    ),
    "macos-arm64": Platform(
        ("Darwin", "arm64"),
        "aarch64-apple-darwin",
        _MACH_O,
        (4, b"\x0c\0\0\x01"),
        oldest_macos="11.0",
    ),
}


def here() -> str:
    """The platform of this machine."""
    names = (platform.system(), platform.machine())
    for name, it in PLATFORMS.items():
        if it.machine_names == names:
            return name
    raise SystemExit(f"there are no wheels for {' '.join(names)}: {', '.join(PLATFORMS)}")


@dataclass(frozen=True)
class Tools:
    """Folders of unpacked Debian packages; None to use the installed programs."""

    toolchain: Path | None
    """rustc-web with the source of the standard library."""
    mingw: Path | None
    """gcc-mingw-w64-x86-64-win32 and its dependencies."""


# The programs of mingw-w64 that rustc calls, with their names in Debian's packages.
_MINGW = "x86_64-w64-mingw32-"
_MINGW_PROGRAMS = {"gcc": "gcc-win32", "dlltool": "dlltool"}


def environment(it: Platform, tools: Tools, scratch: Path, source: Path) -> dict[str, str]:
    """The environment variables of maturin and cargo for a platform, to build what is in the folder `source`."""
    programs = scratch / "bin"
    programs.mkdir(parents=True, exist_ok=True)
    path = [str(programs), str(scratch / "venv" / "bin"), os.environ["PATH"]]
    cargo = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    # the program contains the paths of sources in its messages; without this option they would be those of this machine
    remapped = {cargo / "registry" / "src": "registry", source: "brinell"}
    if tools.toolchain is not None:
        remapped[tools.toolchain.resolve()] = "toolchain"
    variables = {
        **os.environ,
        "PATH": os.pathsep.join(path),
        "CARGO_TARGET_DIR": str(scratch / "target"),
    }
    flags = [f"--remap-path-prefix={old}={new}" for old, new in remapped.items()]
    if not has_standard_library(it.target):
        if tools.toolchain is not None:
            compiler = _wrapper(programs / "rustc-web", tools.toolchain, "rustc")
            variables["RUSTC"] = str(compiler)
        variables["RUSTC_BOOTSTRAP"] = "1"
    if it.target.endswith("-windows-gnu"):
        variables["CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER"] = _MINGW + "gcc"
        if tools.mingw is not None:
            for name, debian_name in _MINGW_PROGRAMS.items():
                _wrapper(programs / (_MINGW + name), tools.mingw, _MINGW + debian_name)
    if it.target.endswith("-musl"):
        # a static program can't load the library of an FMU
        flags.append("-Ctarget-feature=-crt-static")
    if it.oldest_macos is not None:
        variables["MACOSX_DEPLOYMENT_TARGET"] = it.oldest_macos
        variables["CARGO_PROFILE_RELEASE_STRIP"] = "none"
    # a path may have spaces
    variables["CARGO_ENCODED_RUSTFLAGS"] = "\x1f".join(flags)
    return variables


def has_standard_library(target: str) -> bool:
    """Whether the installed Rust has the standard library of a target (`rustup target add`)."""
    command = ["rustc", "--print", "target-libdir", "--target", target]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return result.returncode == 0 and any(Path(result.stdout.strip()).glob("libstd-*.rlib"))


def _wrapper(script: Path, folder: Path, program: str) -> Path:
    """A script that calls `program` of the packages in `folder` with their libraries."""
    root = folder.resolve() / "usr"
    programs, libraries = (shlex.quote(str(root / it)) for it in ("bin", "lib/x86_64-linux-gnu"))
    script.write_text(
        f'#!/bin/sh\nexport PATH={programs}:"$PATH"\nLD_LIBRARY_PATH={libraries} exec {programs}/{program} "$@"\n',
        encoding="utf-8",
    )
    script.chmod(0o755)
    return script


if __name__ == "__main__":
    # for `xargs rustup target add`
    print(*(it.target for it in PLATFORMS.values()))
