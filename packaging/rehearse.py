#!/usr/bin/env python3
"""Does what a tag starts (.github/workflows/release.yml), from packages instead of the repository, but for publishing.
At its end it says what it could not try here.

    python3 packaging/rehearse.py                                            # for this machine
    python3 packaging/rehearse.py --toolchain FOLDER [--mingw FOLDER]        # for all platforms
    python3 packaging/rehearse.py crates source                              # some of the steps

The files are below target/rehearsal: crates/, python/ (wheels and source distribution), archives/ (with hashes), NOTES.md, site/.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import time
import venv
from collections.abc import Callable
from pathlib import Path
from typing import Any

from archives import sums
from page import TARGET as WEB
from platforms import PLATFORMS, ROOT, has_standard_library
from trial import tried

# What a package is compressed to at most, and which of its folders a user needs [bytes].
LARGEST = 400_000
FOLDERS = {"src", "data", "scenes"}

# The scenes whose FMUs the program from packages and that of the repository must write with the same bytes.
SCENES = ["steel_ball", "mass_known", "elastic"]

# With it, programs for arm64 start others in QEMU.
KERNEL = (6, 7)

# Which can't be tried without accounts, or on other systems.
NEVER = [
    "publishing to crates.io, PyPI and GitHub, and its short-lived passwords",
    "the provenance that GitHub attests",
    "macOS: no program has run on it here; Windows but for Wine, arm64 but for QEMU",
    "the Python module on Windows and on musl: there is no Python for them here",
    "the warnings of Windows and macOS about programs from the internet",
]


class Rehearsal:
    """The steps, in the order of their names in `STEPS`."""

    def __init__(self, given: argparse.Namespace) -> None:
        self.given = given
        self.folder: Path = given.output.resolve()
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir(parents=True, exist_ok=True)
        self.not_tried: list[str] = []
        settings = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
        self.version = re.findall(r'^version = "(.*)"', settings, re.M)[0]
        # as GitHub names it, OWNER/brinell
        self.repository = "".join(re.findall(r'^repository = "https://[^/]*/(.*)"', settings, re.M))

    def new(self, name: str) -> Path:
        """An empty folder for files of the release."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def tool(self, program: str) -> Path:
        """A program of requirements-checks.txt, or maturin."""
        folder = self.scratch / "venv"
        programs = folder / ("Scripts" if os.name == "nt" else "bin")
        if not (programs / program).exists():
            venv.create(folder, with_pip=True)
            for name in ("requirements.txt", "requirements-checks.txt"):
                run(programs / "python", "-m", "pip", "install", "--quiet", "-r", ROOT / "packaging" / name)
        return Path(programs / program)

    def crates(self) -> str:
        """The packages for crates.io, each with what its user needs and no more."""
        known = json.loads(run("cargo", "metadata", "--format-version=1", "--no-deps", "--locked"))["packages"]
        names = {it["name"] for it in known if it["publish"] is None}
        target = self.scratch / "packing"
        shutil.rmtree(target / "package", ignore_errors=True)
        more = [part for name in sorted(names) for part in ("--package", name)]
        more += ["--allow-dirty"] if self.given.tag is None else []
        run("cargo", "package", "--locked", "--no-verify", "--target-dir", target, *more)
        folder, told = self.new("crates"), []
        for path in sorted((target / "package").glob("*.crate")):
            shutil.copy2(path, folder)
            files = packed(path)
            others = {name.split("/")[0] for name in files if "/" in name} - FOLDERS
            if others or "LICENSE" not in files or path.stat().st_size > LARGEST:
                raise SystemExit(f"{path.name}: {path.stat().st_size} bytes, with {sorted(others)} and {sorted(files)}")
            told.append(f"{path.stem} {len(files)} files, {path.stat().st_size:,} bytes")
        found = {path.name.rsplit("-", 1)[0] for path in folder.iterdir()}
        if found != names:
            raise SystemExit(f"packages of {sorted(found)}, but {sorted(names)} are published")
        return "; ".join(told)

    def registry(self) -> dict[str, str]:
        """The variables of a cargo that knows the packages of the step `crates` and what they depend on, and nothing else."""
        folder, home = self.scratch / "registry", self.scratch / "cargo-home"
        shutil.rmtree(home, ignore_errors=True)
        variables = {**os.environ, "CARGO_HOME": str(home)}
        run(
            "cargo",
            "vendor",
            "--locked",
            "--versioned-dirs",
            "--manifest-path",
            ROOT / "Cargo.toml",
            folder,
            env=variables,
        )
        shutil.rmtree(home)
        for path in (self.folder / "crates").iterdir():
            shutil.rmtree(folder / path.stem, ignore_errors=True)
            with tarfile.open(path) as archive:
                archive.extractall(folder, filter="data")
            checksum = {"files": {}, "package": hashlib.sha256(path.read_bytes()).hexdigest()}
            (folder / path.stem / ".cargo-checksum.json").write_text(json.dumps(checksum))
        home.mkdir()
        replaced = f'[source.crates-io]\nreplace-with = "here"\n[source.here]\ndirectory = {json.dumps(str(folder))}\n'
        (home / "config.toml").write_text(replaced, encoding="utf-8")
        # neither the repository nor its target folder
        return variables | {"CARGO_TARGET_DIR": str(self.scratch / "target")}

    def install(self) -> str:
        """`cargo install brinell` from the packages alone; the FMUs are those of the repository's program, byte by byte."""
        variables, root = self.registry(), self.scratch / "installed"
        run("cargo", "install", "brinell", "--locked", "--force", "--root", root, env=variables, cwd=self.scratch)
        run("cargo", "build", "--release", "--locked")
        # what this repository's tests would use
        target = json.loads(run("cargo", "metadata", "--format-version=1", "--no-deps"))["target_directory"]
        ending = ".exe" if os.name == "nt" else ""
        programs = [root / "bin" / f"brinell{ending}", Path(target) / "release" / f"brinell{ending}"]
        folder = self.new("scratch/exported")
        for scene in SCENES:
            made = []
            for number, program in enumerate(programs):
                fmu = folder / f"{scene}{number}.fmu"
                cache = {**os.environ, "BRINELL_CACHE": str(self.scratch / f"cache{number}")}
                run(program, "export", ROOT / "scenes" / f"{scene}.toml", "--compile", "-o", fmu, env=cache, cwd=folder)
                run(program, "check", fmu, cwd=folder)
                made.append(fmu.read_bytes())
            if made[0] != made[1]:
                raise SystemExit(f"{scene}: the program from packages makes another FMU than that of the repository")
        return f"{len(SCENES)} FMUs with the same bytes"

    def source(self) -> str:
        """The source distribution, from which a wheel is made in an empty environment."""
        folder = self.new("python")
        run(self.tool("maturin"), "sdist", "-o", folder, cwd=ROOT / "python")
        (archive,) = folder.glob("*.tar.gz")
        unpacked = self.new("scratch/source")
        with tarfile.open(archive) as files:
            files.extractall(unpacked, filter="data")
        # maturin leaves out crates that nobody needs who builds the program, but not their lines of the lock file
        lock = next(unpacked.glob("*/Cargo.lock"))
        before = lock.read_text()
        run("cargo", "metadata", "--format-version=1", cwd=lock.parent)
        if not set(lock.read_text().splitlines()) <= set(before.splitlines()):
            raise SystemExit(f"{archive.name}: its lock file is not that of the repository")
        variables, empty, made = self.registry(), self.new("scratch/empty"), self.new("scratch/from-source")
        # files of a source distribution have one time: what an earlier one has left in a target folder would pass for new
        del variables["CARGO_TARGET_DIR"]
        venv.create(empty, with_pip=True)
        python = empty / ("Scripts" if os.name == "nt" else "bin") / "python"
        run(python, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", made, archive, env=variables, cwd=empty)
        (wheel,) = made.iterdir()
        return f"{archive.name} {archive.stat().st_size:,} bytes, makes {wheel.name} {wheel.stat().st_size:,} bytes"

    def libraries(self) -> str:
        """The prebuilt libraries, by the program from packages."""
        program = self.scratch / "installed" / "bin" / ("brinell.exe" if os.name == "nt" else "brinell")
        variables = {**os.environ, "BRINELL_CACHE": str(self.scratch / "cache0")}
        platforms: list[str] = []
        if self.given.toolchain is not None:
            variables["BRINELL_TOOLCHAIN"] = str(self.given.toolchain.resolve())
            platforms = ["--platforms", "all,c-code"]
        else:
            self.not_tried.append("libraries for other platforms, and C source: there is no --toolchain")
        folder = self.new("prebuilt")
        run(program, "prebuild", "-o", folder, *platforms, env=variables)
        files = list(folder.iterdir())
        return f"{len(files)} files, {sum(path.stat().st_size for path in files):,} bytes"

    def page(self) -> str:
        """The page for a browser, with the prebuilt libraries inside."""
        variables = dict(os.environ)
        if self.given.toolchain is not None:
            variables["BRINELL_STD_TOOLCHAIN"] = str(self.given.toolchain.resolve())
        elif not has_standard_library(WEB):
            self.not_tried.append("the page for a browser: Rust hasn't its target, and there is no --toolchain")
            return "-"
        made = self.folder / "brinell.html"
        page = [ROOT / "packaging" / "page.py", "--prebuilt", self.folder / "prebuilt", "-o", made]
        run(sys.executable, *page, "--scratch", self.scratch / "page", env=variables)
        return f"{made.stat().st_size:,} bytes"

    def wheels(self) -> str:
        """Wheels and archives with hashes and bill of materials, from the unpacked source distribution; looked at by two tools."""
        (source,) = (self.scratch / "source").iterdir()
        chosen, tools = [], []
        for name in ("toolchain", "mingw"):
            if (folder := getattr(self.given, name)) is not None:
                tools += [f"--{name}", folder]
        for name, it in PLATFORMS.items():
            linker = it.zig or self.given.mingw is not None or shutil.which("x86_64-w64-mingw32-gcc") is not None
            if linker and (self.given.toolchain is not None or has_standard_library(it.target)):
                chosen.append(name)
            else:
                self.not_tried.append(f"the wheel for {name}: there is no {'standard library' if linker else 'linker'}")
        chosen = [name for name in chosen if not self.given.platforms or name in self.given.platforms]
        archives = self.new("archives")
        command = [
            ROOT / "packaging" / "release.py",
            *chosen,
            "--source",
            source,
            "--prebuilt",
            self.folder / "prebuilt",
        ]
        page = self.folder / "brinell.html"
        tools += ["--page", page] if page.is_file() else []
        run(sys.executable, *command, *tools, "--scratch", self.scratch / "wheels", "-o", archives)
        if page.is_file():
            shutil.copy2(page, archives)
        # wheels go to the Python Package Index, archives and hashes to the page of the release
        for wheel in (self.folder / "python").glob("*.whl"):
            wheel.unlink()
        for wheel in archives.glob("*.whl"):
            wheel.rename(self.folder / "python" / wheel.name)
        python = sorted((self.folder / "python").iterdir())
        run(self.tool("twine"), "check", "--strict", *python)
        run(self.tool("check-wheel-contents"), *(path for path in python if path.suffix == ".whl"))
        files = [path for path in archives.iterdir() if path.name != "SHA256SUMS"]
        (archives / "SHA256SUMS").write_text(sums([*files, *python]))
        (self.folder / "NOTES.md").write_text(self.notes(), encoding="utf-8")
        return "; ".join(f"{path.name} {path.stat().st_size:,} bytes" for path in python if path.suffix == ".whl")

    def notes(self) -> str:
        """The entry of the version in CHANGELOG.md, followed by what every release says."""
        changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        entry = re.findall(rf"^## {re.escape(self.version)}[^\n]*\n(.*?)(?=^## |\Z)", changes, re.M | re.S)
        if not entry:
            raise SystemExit(f"CHANGELOG.md has no entry of {self.version}")
        text = (ROOT / "packaging" / "notes.md").read_text(encoding="utf-8")
        text = text.replace("VERSION", self.version).replace("REPOSITORY", self.repository or "OWNER/brinell")
        return text.replace("CHANGES", entry[0].strip())

    def trial(self) -> str:
        """The wheel for this machine, as its user has it; those for musl, arm64 and Windows without glibc, in QEMU and in Wine."""
        said = re.sub(r"\s+", " ", tried(self.folder / "python"))[:100]
        # at a tag, jobs on those systems do it
        if self.given.tag is not None:
            return said
        wheels = len(list((self.folder / "python").glob("*.whl")))
        kernel = tuple(map(int, platform.release().split(".")[:2])) if sys.platform == "linux" else (0, 0)
        if wheels == len(PLATFORMS) and kernel >= KERNEL:
            variables = {**os.environ, "BRINELL_WHEELS": str(self.folder / "python")}
            run("cargo", "test", "--release", "--test", "platforms", "elsewhere", "--", "--ignored", env=variables)
        else:
            self.not_tried.append(f"other wheels than that of this machine: that takes wheels for all platforms, and Linux {KERNEL[0]}.{KERNEL[1]}")
        return said

    def book(self) -> str:
        """The guide as a site, and the page beside it."""
        site = self.new("site")
        # the test compiles mdBook once, and looks at its messages
        run("cargo", "test", "--release", "--test", "guide", "--", "--ignored", "book")
        target = json.loads(run("cargo", "metadata", "--format-version=1", "--no-deps"))["target_directory"]
        (program,) = (Path(target) / "tools").glob("mdbook-*/bin/mdbook*")
        run(program, "build", ROOT / "docs", "--dest-dir", site)
        page = self.folder / "brinell.html"
        if page.is_file():
            shutil.copy2(page, site)
        return f"{sum(path.is_file() for path in site.rglob('*'))} files"


def packed(crate: Path) -> set[str]:
    """The files of a package."""
    with tarfile.open(crate) as archive:
        return {name.split("/", 1)[1] for name in archive.getnames()}


def run(*command: Any, cwd: Path = ROOT, env: dict[str, str] | None = None) -> str:
    """What a command prints; if it fails, the rehearsal ends with what it said."""
    words = [str(word) for word in command]
    ended = subprocess.run(
        words, cwd=cwd, env=env, capture_output=True, encoding="utf-8", errors="replace", check=False
    )
    if ended.returncode:
        raise SystemExit(f"{' '.join(words)}\n{ended.stdout}{ended.stderr}")
    return ended.stdout


STEPS: dict[str, Callable[[Rehearsal], str]] = {
    name: getattr(Rehearsal, name)
    for name in ("crates", "install", "source", "libraries", "page", "wheels", "trial", "book")
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    add = parser.add_argument
    add("steps", nargs="*", metavar="STEP", help=f"{', '.join(STEPS)} [default: all]")
    add("--toolchain", type=Path, help="the folder of packaging/toolchain.py FOLDER --std, for all platforms")
    add("--mingw", type=Path, help="the folder that Debian's mingw-w64 is unpacked in")
    add(
        "--platform",
        action="append",
        dest="platforms",
        metavar="PLATFORM",
        help=f"only wheels for this: {', '.join(PLATFORMS)}",
    )
    add("--tag", help="the tag of the release: the version with a v before it; nothing may be uncommitted")
    add("-o", "--output", type=Path, default=ROOT / "target" / "rehearsal", help="[default: %(default)s]")
    given = parser.parse_args()
    for name in given.steps:
        if name not in STEPS:
            parser.error(f"there is no step {name}: {', '.join(STEPS)}")
    if given.toolchain is not None:
        packages = given.toolchain / "packages.json"
        if not packages.is_file() or '"std": true' not in packages.read_text():
            parser.error(f"--toolchain {given.toolchain}: it is not the folder of packaging/toolchain.py FOLDER --std")
    rehearsal = Rehearsal(given)
    if given.tag is not None and given.tag.startswith("v") and given.tag != f"v{rehearsal.version}":
        parser.error(f"--tag {given.tag}: the version in Cargo.toml is {rehearsal.version}")
    if given.tag == f"v{rehearsal.version}":
        if not rehearsal.repository:
            parser.error(f"--tag {given.tag}: Cargo.toml has no repository; packaging/addresses.py writes it")
        if f"## {rehearsal.version} (unreleased)" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"):
            parser.error(f"--tag {given.tag}: CHANGELOG.md says unreleased; packaging/version.py writes the date")
    for name in given.steps or STEPS:
        begin = time.monotonic()
        said = STEPS[name](rehearsal)
        print(f"{name:<10} {time.monotonic() - begin:5.0f} s  {said}", flush=True)
    print("not tried:", *rehearsal.not_tried, *NEVER, sep="\n- ")


if __name__ == "__main__":
    main()
