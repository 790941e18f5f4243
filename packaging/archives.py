"""Reads, writes and checks wheels and archives. Equal files give archives with equal bytes."""

from __future__ import annotations

import base64
import csv
import gzip
import hashlib
import io
import struct
import tarfile
import zipfile
from pathlib import Path

from platforms import Platform

Files = dict[str, bytes]
"""The contents of each file by its path, with slashes."""

# Programs are in one of these folders.
_PROGRAMS = ("bin", "scripts")

# A time without meaning: the earliest that a zip archive can have.
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)


def _mode(name: str) -> int:
    folder = name.split("/")[-2:-1]
    return 0o755 if folder and folder[0] in _PROGRAMS else 0o644


def read_folder(folder: Path, prefix: str) -> Files:
    """The files in `folder` and its subfolders, with `prefix` before their paths."""
    paths = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    return {f"{prefix}/{path.relative_to(folder).as_posix()}": path.read_bytes() for path in paths}


def read_zip(path: Path) -> Files:
    """The files of a zip archive, such as a wheel."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def zipped(files: Files) -> bytes:
    """A zip archive of `files`."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, _ZIP_TIME)
            entry.create_system = 3
            entry.external_attr = (0o100000 | _mode(name)) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED, 9)
    return buffer.getvalue()


def tarred(files: Files) -> bytes:
    """A tar archive of `files`, compressed by gzip."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, data in files.items():
            entry = tarfile.TarInfo(name)
            entry.size, entry.mode = len(data), _mode(name)
            archive.addfile(entry, io.BytesIO(data))
    return gzip.compress(buffer.getvalue(), 9, mtime=0)


def sums(paths: list[Path]) -> str:
    """The hashes of files by their names, as `sha256sum --check` reads them."""
    return "".join(
        f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"
        for path in sorted(paths, key=lambda path: path.name)
    )


def _digest(data: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest())
    return f"sha256={digest.rstrip(b'=').decode()}"


def with_record(files: Files, record: str) -> Files:
    """The files of a wheel in order, followed by their list with the name `record`."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    ordered = {name: files[name] for name in sorted(files) if name != record}
    rows.writerows((name, _digest(data), len(data)) for name, data in ordered.items())
    rows.writerow((record, "", ""))
    return ordered | {record: text.getvalue().encode()}


def check_wheel(path: Path, platform: Platform, version: str) -> None:
    """Rejects a wheel for another platform or version, or an incomplete one."""
    files = read_zip(path)
    info = f"brinell-{version}.dist-info"
    listed = {name: digest for name, digest, _ in csv.reader(files[f"{info}/RECORD"].decode().splitlines())}
    _same(f"{path.name}: files of RECORD", set(listed), set(files))
    for name, data in files.items():
        if name != f"{info}/RECORD":
            _same(f"{path.name}: hash of {name}", listed[name], _digest(data))
    tags = [
        line.removeprefix("Tag: ")
        for line in files[f"{info}/WHEEL"].decode().splitlines()
        if line.startswith("Tag: ")
    ]
    expanded = [f"py3-none-{tag}" for tag in path.stem.split("-")[-1].split(".")]
    _same(f"{path.name}: tags", sorted(tags), sorted(expanded))
    metadata = files[f"{info}/METADATA"].decode()
    if f"\nName: brinell\nVersion: {version}\n" not in metadata:
        raise SystemExit(f"{path.name}: METADATA isn't that of brinell {version}")
    scripts = [name for name in files if name.startswith(f"brinell-{version}.data/scripts/")]
    _same(f"{path.name}: programs", len(scripts), 1)
    check_program(scripts[0], files[scripts[0]], platform)


def check_program(name: str, program: bytes, platform: Platform) -> None:
    """Rejects a program for another operating system or processor, or one that can load no library."""
    offset, machine = platform.machine
    if platform.magic == b"MZ":
        (start,) = struct.unpack_from("<I", program, 0x3C)
        _same(f"{name}: header", program[start : start + 4], b"PE\0\0")
        offset += start
    _same(f"{name}: format", program[: len(platform.magic)], platform.magic)
    _same(f"{name}: processor", program[offset : offset + len(machine)], machine)
    if platform.target.endswith("-musl"):
        _same(f"{name}: has a loader, which FMUs need", b"/lib/ld-musl-x86_64.so.1\0" in program, True)


def _same(what: str, found: object, expected: object) -> None:
    if found != expected:
        raise SystemExit(f"{what}: {found!r} instead of {expected!r}")
