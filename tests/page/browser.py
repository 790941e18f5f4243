"""Unpacks Chromium in an environment of tests: `bin/chromium` of the folder in the argument starts it.

The package of npm has a Chromium without windows for servers on Linux, x86-64, with the libraries and the font that a bare
machine lacks. It is fetched from the registry that npm is set up for.
"""

import base64
import hashlib
import io
import os
import shlex
import shutil
import subprocess
import sys
import tarfile
import urllib.request
from pathlib import Path

import brotli

PACKAGE = "@sparticuz/chromium/-/chromium-153.0.0.tgz"
SHA512 = "jiGWqSvPMdu4+P9TilYqAR7yEGPEHINx+lCvE/NqNO/EHYzF/x1hUiI5T6ioVIt7dEy7n88byyT0vk+dnsgQwA=="

# The package's own names fixed folders, and without any, fontconfig looks for the fonts of the system, which differ.
FONTS = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir>{fonts}</dir><cachedir>{cache}</cachedir></fontconfig>
"""

# Every system has C.UTF-8. In a language that it doesn't have, Chromium loses downloads in a folder with letters beyond ASCII.
START = """#!/bin/sh
LC_ALL=C.UTF-8 LD_LIBRARY_PATH={libraries} FONTCONFIG_PATH={fonts} exec {program} --accept-lang=en-US "$@"
"""


def main(environment: Path) -> None:
    folder = environment / "chromium"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    with tarfile.open(fileobj=io.BytesIO(fetched())) as package:

        def unpacked(name: str) -> bytes:
            file = package.extractfile(f"package/bin/{name}.br")
            assert file is not None, f"{PACKAGE} has no {name}"
            content: bytes = brotli.decompress(file.read())
            return content

        program = folder / "chromium"
        program.write_bytes(unpacked("chromium"))
        program.chmod(0o755)
        for name in ("al2023.tar", "fonts.tar"):
            with tarfile.open(fileobj=io.BytesIO(unpacked(name))) as archive:
                archive.extractall(folder, filter="data")
    (folder / "fonts.conf").write_text(FONTS.format(fonts=folder / "fonts", cache=folder / "cache"))
    start = environment / "bin/chromium"
    paths = {"libraries": folder / "lib", "fonts": folder, "program": program}
    start.write_text(START.format(**{name: shlex.quote(str(path)) for name, path in paths.items()}), encoding="utf-8")
    start.chmod(0o755)


def fetched() -> bytes:
    """The package, from the registry of npm's settings."""
    url = f"{registry().rstrip('/')}/{PACKAGE}"
    with urllib.request.urlopen(url, timeout=180) as answer:  # proxies come from the environment
        data: bytes = answer.read()
    found = base64.b64encode(hashlib.sha512(data).digest()).decode()
    if found != SHA512:
        raise SystemExit(f"{url} has the hash {found}, not the expected {SHA512}")
    return data


def registry() -> str:
    if npm := shutil.which("npm"):
        asked = subprocess.run([npm, "config", "get", "registry"], capture_output=True, text=True, check=False)
        if asked.returncode == 0 and asked.stdout.startswith("http"):
            return asked.stdout.strip()
    return os.environ.get("npm_config_registry", "https://registry.npmjs.org")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
