#!/usr/bin/env python3
"""Runs the README's test command in the surroundings that its users have: each a row with its result.

    python3 packaging/surroundings.py                                       # all rows, each as long as the tests
    python3 packaging/surroundings.py path+user+umask-077                   # several surroundings at once
    python3 packaging/surroundings.py umask-002 cron -- --test program      # some rows, some tests

For Linux. Without names, each of the surroundings stands in one of five rows; if a row fails, its parts can be tried alone. Most
rows share the target folder of this repository; `path`, `user`, `target-folder` and `flags` compile everything anew in a folder
below `--scratch`. The output of each row is in `NAME.log` there.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from platforms import ROOT

COMMAND = ["cargo", "test", "--release", "--no-fail-fast"]

# An ordinary user without an account, a home or a group of others.
USER = 54321


@dataclass
class Run:
    """The test command in its surroundings."""

    scratch: Path
    """A folder of its own, for what the surroundings need."""
    folder: Path = ROOT
    """The repository."""
    variables: dict[str, str] = field(default_factory=lambda: dict(os.environ))
    before: list[list[str]] = field(default_factory=list)
    """Programs that start the command, the outermost first."""
    terminal: bool = False
    """Whether the command has a terminal."""
    at_once: int = 1

    def shell(self, script: str) -> None:
        """Starts the command after a `script`."""
        self.before.append(["sh", "-c", f'{script}; exec "$@"', "sh"])

    def copied(self, name: str) -> None:
        """Uses a copy of the repository instead, with what isn't committed."""
        listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        files = subprocess.run(listed, cwd=ROOT, check=True, capture_output=True, encoding="utf-8").stdout
        copy = self.scratch / name
        for file in files.split("\0"):
            if file and (ROOT / file).is_file():
                (copy / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / file, copy / file)
        self.folder = copy

    def mounts(self, script: str, then: str = 'exec "$@"') -> None:
        """Starts the command after a `script` that mounts something, where nobody else sees it."""
        rights = ["-m"] if os.geteuid() == 0 else ["-rm"]
        self.before.append(["unshare", *rights, "sh", "-c", f"{script}; {then}", "sh"])

    def home(self, name: str) -> str:
        """Uses a new home, with the toolchain where it is; the quoted name of its folder."""
        mine, folder = Path(self.variables["HOME"]), self.scratch / name
        for variable, known in {"CARGO_HOME": ".cargo", "RUSTUP_HOME": ".rustup"}.items():
            self.variables.setdefault(variable, str(mine / known))
        folder.mkdir(exist_ok=True)
        self.variables["HOME"] = str(folder)
        return shlex.quote(str(folder))


def ignored_signals(run: Run) -> None:
    """As `nohup` does, and a shell with jobs of a script in the background."""
    run.shell("trap '' HUP INT QUIT TERM USR1")


def cron(run: Run) -> None:
    """No terminal, no input, few variables."""
    kept = ["HOME", "PATH", "CARGO_HOME", "RUSTUP_HOME", "RUSTUP_AUTO_INSTALL"]
    kept += [name for name in run.variables if "proxy" in name.lower() or name.startswith("PIP_")]
    run.variables = {name: run.variables[name] for name in kept if name in run.variables}
    run.variables |= {"SHELL": "/bin/sh", "LOGNAME": "nobody"}
    run.before.append(["setsid", "--wait"])
    run.shell("exec <&-")


def terminal(run: Run) -> None:
    """A small terminal with colours."""
    run.variables |= {"TERM": "xterm-256color", "COLUMNS": "40", "LINES": "10", "CLICOLOR_FORCE": "1"}
    run.variables |= {"FORCE_COLOR": "1", "CARGO_TERM_COLOR": "always"}
    run.terminal = True


def umask(mode: str) -> Callable[[Run], None]:
    """What others may do with new files."""
    return lambda run: run.shell(f"umask {mode}")


def language(name: str) -> Callable[[Run], None]:
    """Another language, which glibc knows by a folder of its own; in Turkish `i` isn't the small letter of `I`."""

    def set_it(run: Run) -> None:
        run.variables = {key: value for key, value in run.variables.items() if not key.startswith("LC_")}
        if name != "C":
            source, _, charset = name.partition(".")
            made = ["localedef", "-i", source, "-f", charset, str(run.scratch / name)]
            subprocess.run(made, check=True)
            run.variables["LOCPATH"] = str(run.scratch)
        run.variables |= {"LANG": name, "LC_ALL": name, "LANGUAGE": name.split("_")[0]}

    return set_it


def path(run: Run) -> None:
    """A folder with spaces, quotes, and letters beyond ASCII. The linker of Rust replaces each % in a path by a random digit."""
    run.copied('Größe\'s "a b" $x')


def target_folder(run: Run) -> None:
    """A target folder of one's own."""
    run.variables["CARGO_TARGET_DIR"] = str(run.scratch / "target of one's own")


def flags(run: Run) -> None:
    """The user's own flags for the compiler, in a target folder of their own."""
    run.variables["RUSTFLAGS"] = "-Ctarget-cpu=native -Cdebuginfo=1 -Cforce-frame-pointers=yes"
    run.variables.setdefault("CARGO_TARGET_DIR", str(run.scratch / "target"))


def named_target(run: Run) -> None:
    """The platform is named, though it is that of this machine."""
    said = subprocess.run(["rustc", "-vV"], check=True, capture_output=True, text=True).stdout
    run.variables["CARGO_BUILD_TARGET"] = re.findall(r"^host: (.*)$", said, re.M)[0]


def one_job(run: Run) -> None:
    """One compiler, and one test at a time."""
    run.variables |= {"CARGO_BUILD_JOBS": "1", "RUST_TEST_THREADS": "1"}


def temporary(run: Run) -> None:
    """Temporary files in a folder with a difficult name."""
    folder = run.scratch / 'it\'s "tmp" ö'
    folder.mkdir(exist_ok=True)
    # as /tmp
    folder.chmod(0o1777)
    run.variables["TMPDIR"] = str(folder)


def full_home(run: Run) -> None:
    """A home without room for a byte."""
    home = run.home("full home")
    run.mounts(f"mount -t tmpfs -o size=64k tmpfs {home}; cat /dev/zero >{home}/all 2>/dev/null")


def no_home(run: Run) -> None:
    """A home that doesn't exist, as services have."""
    run.home("no home")
    run.variables["HOME"] = "/nonexistent"


def slow_home(run: Run) -> None:
    """A home that takes and gives two megabytes in a second, by bindfs."""
    home = run.home("slow home")
    files = run.scratch / "files of the slow home"
    files.mkdir(exist_ok=True)
    run.mounts(
        f"bindfs --read-rate=2M --write-rate=2M {shlex.quote(str(files))} {home} || exit",
        f'"$@"; code=$?; umount {home}; exit $code',
    )


def own_settings(run: Run) -> None:
    """Settings that a user of the program has: materials, a cache, libraries."""
    settings = run.scratch / "settings"
    (settings / "brinell").mkdir(parents=True, exist_ok=True)
    # it isn't complete: a test that reads it fails
    own = '[[material]]\nname = "mild steel"\nyoungs_modulus = 1e9\npoissons_ratio = 0.1\nyield_strength = 1e6\n'
    (settings / "brinell" / "materials.toml").write_text(own)
    cache, libraries = run.scratch / "cache", run.scratch / "libraries"
    libraries.mkdir(exist_ok=True)
    run.variables |= {"XDG_CONFIG_HOME": str(settings), "XDG_CACHE_HOME": str(cache)}
    run.variables |= {"BRINELL_CACHE": str(cache / "own"), "BRINELL_PREBUILT": str(libraries)}
    run.variables |= {"RUST_BACKTRACE": "full", "RUST_LOG": "trace", "TZ": "Asia/Kathmandu", "PYTHONUTF8": "0"}


def twice(run: Run) -> None:
    """A second run beside it."""
    run.at_once = 2


def user(run: Run) -> None:
    """An ordinary user, if the superuser starts this: with a home, a copy of the repository, and a bound toolchain."""
    if os.geteuid() != 0:
        return
    if run.folder == ROOT:
        run.copied("repository")
    tools, home = run.scratch / "tools", run.scratch / "home"
    mine = Path(run.variables["HOME"])
    rustup = Path(run.variables.get("RUSTUP_HOME", mine / ".rustup"))
    bound = {rustup: tools / "rustup", Path(sys.base_prefix): tools / "python"}
    programs = [tools / "cargo" / "bin", tools / "python" / "bin"]
    bound[Path(run.variables.get("CARGO_HOME", mine / ".cargo")) / "bin"] = programs[0]
    for place in [*bound.values(), home]:
        place.mkdir(parents=True, exist_ok=True)
    # what is below the superuser's home isn't for others
    others = [it for it in run.variables["PATH"].split(":") if not Path(it).is_relative_to(mine)]
    run.variables |= {"PATH": ":".join([*map(str, programs), *others]), "HOME": str(home)}
    run.variables |= {"RUSTUP_HOME": str(tools / "rustup"), "CARGO_HOME": str(home / ".cargo")}
    # a Python that was built at another place finds its library by this
    run.variables |= {"USER": "nobody", "LOGNAME": "nobody", "LD_LIBRARY_PATH": str(tools / "python" / "lib")}
    binds = [f"mount --bind {shlex.quote(str(it))} {shlex.quote(str(place))}" for it, place in bound.items()]
    run.mounts(" && ".join([*binds, f"chown -R {USER}:{USER} {shlex.quote(str(home))} {shlex.quote(str(run.folder))}"]))
    run.before.append(["chown", f"{USER}:{USER}", str(run.scratch)])
    run.before[-1] = ["setpriv", f"--reuid={USER}", f"--regid={USER}", "--clear-groups", "--"]
    os.chown(run.scratch, USER, USER)


SURROUNDINGS: dict[str, Callable[[Run], None]] = {
    "as-here": lambda run: None,
    "ignored-signals": ignored_signals,
    "cron": cron,
    "terminal": terminal,
    "umask-077": umask("077"),
    "umask-002": umask("002"),
    "umask-000": umask("000"),
    "language-C": language("C"),
    "language-tr": language("tr_TR.UTF-8"),
    "language-latin1": language("de_DE.ISO-8859-1"),
    "one-job": one_job,
    "named-target": named_target,
    "temporary": temporary,
    "full-home": full_home,
    "no-home": no_home,
    "slow-home": slow_home,
    "own-settings": own_settings,
    "twice": twice,
    "path": path,
    "user": user,
    "target-folder": target_folder,
    "flags": flags,
}

# Each stands in one row: as many together as don't contradict each other, since a row takes as long as the tests.
ROWS = [
    "terminal+umask-000+language-latin1+full-home",
    "ignored-signals+cron+umask-002+language-tr+one-job+no-home+own-settings",
    "umask-077+language-C+temporary+path+user",
    "named-target+target-folder+flags+slow-home",
    "twice",
]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n")[0], epilog=f"Surroundings: {', '.join(SURROUNDINGS)}."
    )
    parser.add_argument("rows", nargs="*", metavar="ROW", help="one, or several with + between them [default: five rows with all]")
    parser.add_argument("--scratch", type=Path, default=ROOT / "target" / "surroundings", help="[default: %(default)s]")
    rows, _, more = _split(sys.argv[1:])
    given = parser.parse_args(rows)
    wanted = given.rows or ROWS
    for name in (part for row in wanted for part in row.split("+")):
        if name not in SURROUNDINGS:
            parser.error(f"there are no surroundings {name}: {', '.join(SURROUNDINGS)}")
    scratch = given.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    failed = 0
    for row in wanted:
        failed += not _tried(row, more, scratch)
    sys.exit(1 if failed else 0)


def _split(arguments: list[str]) -> tuple[list[str], str, list[str]]:
    place = arguments.index("--") if "--" in arguments else len(arguments)
    return arguments[:place], "--", arguments[place + 1 :]


def _tried(row: str, more: list[str], scratch: Path) -> bool:
    """Runs the tests in the surroundings `row`, prints the result, and says whether it is good."""
    run = Run(scratch / row)
    run.scratch.mkdir(exist_ok=True)
    for name in sorted(row.split("+"), key=list(SURROUNDINGS).index):
        SURROUNDINGS[name](run)
    command = [*COMMAND, *more]
    if run.terminal:
        command = ["script", "-qec", f"stty cols 40 rows 10; {shlex.join(command)}", "/dev/null"]
    whole = [part for program in run.before for part in program] + command
    logs = [scratch / f"{row}{number or ''}.log" for number in range(run.at_once)]
    begin = time.monotonic()
    children = []
    for log in logs:
        with log.open("wb") as output:
            started = subprocess.Popen(
                whole,
                cwd=run.folder,
                env=run.variables,
                stdin=None if run.terminal else subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        children.append(started)
    statuses = [child.wait() for child in children]
    texts = [re.sub(r"\x1b(\[[0-9;]*[A-Za-z]|\(B)", "", log.read_text(encoding="utf-8", errors="replace")) for log in logs]
    good = not any(statuses)
    for text in texts:
        counts = [tuple(map(int, it)) for it in re.findall(r"test result: \w+\. (\d+) passed; (\d+) failed", text)]
        passed, broken = sum(it[0] for it in counts), sum(it[1] for it in counts)
        seconds = time.monotonic() - begin
        good = good and passed > 0
        print(
            f"{row:<32} {'passes' if good else 'FAILS ':6} {passed:5} passed {broken:4} failed {seconds:6.0f} s",
            flush=True,
        )
        names = re.findall(r"^test (\S+) \.\.\. FAILED", text, re.M)
        if not good:
            print("".join(f"    {name}\n" for name in names) or f"    see {logs[0]}\n", end="", flush=True)
    return good


if __name__ == "__main__":
    main()
