"""How a case is run: which programs there are, and what stands for them in command lines."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import mathematics

PATIENCE_S = 1200  # of a machine that has much else to do

# Vectors as foretouch names them, from the narrowest to the widest.
WIDTHS = ("scalar", "ssse3", "sse4", "avx2", "avx512")


class Failed(Exception):
    """A step did not end as it should."""


class World:
    """A build folder, the data, and what is built of them for the cases."""

    def __init__(self, source, build):
        self.source, self.build = source, build.resolve()
        self.program = self.build / "bin/foretouch"
        if not self.program.exists():
            sys.exit(f"{self.program}: no such program; build it, or name its folder by --program")
        named = os.environ.get("FORETOUCH_DATA")
        self.data = Path(named or source.parent / "shared/data").resolve()
        self._tools = {}
        self._folder = tempfile.TemporaryDirectory(prefix="foretouch-digests-")
        self.at_width = self.build / "bin/at_width"
        self.widths = [width for width in WIDTHS if self._has_width(width)]

    def __enter__(self):
        for width in self.widths[:-1]:
            script = self.program_at(width)
            script.write_text(f"#!/bin/sh\nexec '{self.at_width}' {width} \"$@\"\n",
                              encoding="utf-8")
            script.chmod(0o755)
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    # What a case may need, and how it is found or made: the first time that it is asked for.
    TOOLS = {
        "c": ("libforetouch.so, or a C compiler", "_c_programs"),
        "packages": ("the Python package", "_packages"),
        "network": ("a network namespace", "_network"),
    }

    def tool(self, name):
        """Where it is, or whether there is one; None or False where it is absent."""
        if name not in self._tools:
            self._tools[name] = getattr(self, self.TOOLS[name][1])()
        return self._tools[name]

    def lacks(self, case):
        """What the case needs and is not here; "" where nothing is missing."""
        absent = [file for file in case.data if not (self.data / file).exists()]
        absent += [self.TOOLS[tool][0] for tool in case.tools if not self.tool(tool)]
        return "absent: " + ", ".join(absent) if absent else ""

    def _has_width(self, width):
        if not self.at_width.exists():
            sys.exit(f"{self.at_width}: no such program; build the tests")
        return subprocess.run([self.at_width, width, "--version"], capture_output=True,
                              check=False).returncode == 0

    def program_at(self, width):
        """The program; where it would take wider vectors by itself, one that takes these."""
        if width == self.widths[-1]:
            return self.program
        return Path(self._folder.name) / f"foretouch-{width}"

    def _packages(self):
        packages = self.build / "lib/python3/dist-packages"
        return packages if (packages / "foretouch").is_dir() else None

    def _network(self):
        tried = subprocess.run([self.source / "tests/network/in_namespace.sh", "true"],
                               capture_output=True, check=False)
        return tried.returncode == 0

    def _c_programs(self):
        """The C programs, linked with the library of the build; their folder."""
        library = next(iter(sorted(self.build.rglob("libforetouch.so"))), None)
        compiler = shutil.which("cc")
        if library is None or compiler is None:
            return None
        folder = Path(self._folder.name)
        bindings = self.source / "bindings/c"
        digests = self.source / "tests/digests"
        examples = [bindings / f"example/{name}.c"
                    for name in ("swing", "table", "solid_hand", "swinging_door")]
        for source in (digests / "contacts.c", digests / "moving_world.c", *examples):
            subprocess.run([compiler, "-std=c99", "-O1", "-I", bindings / "include", source, "-o",
                            folder / source.stem, library, "-lm", f"-Wl,-rpath,{library.parent}"],
                           check=True)
        return folder

    def words(self, words, width):
        """A command line with what its {names} stand for."""
        names = {"foretouch": self.program_at(width), "data": self.data, "source": self.source,
                 "examples": self.build / "share/foretouch/examples", "python": "/usr/bin/python3",
                 "verify": self.build / "bin/foretouch-verify", "c": self._tools.get("c")}
        return [word.format_map(names) for word in words]

    def environment(self, words, width):
        packages = str(self._tools.get("packages") or "")
        narrowed = {}
        if width != self.widths[-1] and words[0].startswith(("{c}", "{python}")):
            narrowed = {"FORETOUCH_AT_WIDTH": width,
                        "LD_PRELOAD": str(self.build / "tests/digests/libat_width_preload.so")}
        return {**os.environ, **mathematics.PLAIN, **narrowed,
                "FORETOUCH_IMPORTER": str(self.build / "bin/foretouch-import"), "LC_ALL": "C.UTF-8",
                "PYTHONPATH": packages, "PYTHONDONTWRITEBYTECODE": "1"}


def _run_program(step, world, width, folder):
    words = world.words(step.words, width)
    try:
        ended = subprocess.run(words, cwd=folder, env=world.environment(step.words, width),
                               capture_output=True, timeout=PATIENCE_S, check=False)
    except subprocess.TimeoutExpired as late:
        raise Failed(f"{' '.join(words)}\n  did not end within {PATIENCE_S} s") from late
    if step.exit not in (None, ended.returncode):
        raise Failed(f"{' '.join(words)}\n  ended with {ended.returncode}, expected {step.exit}: "
                     + ended.stderr.decode(errors="replace")[-600:])
    if step.out:
        last = b"exit %d\n" % ended.returncode if step.exit is None else b""
        (folder / step.out).write_bytes(ended.stdout + last)


def run(case, world, width, folder):
    """Runs the steps of a case in a folder of its own, by vectors of this width."""
    for step in case.steps:
        if callable(step):
            step(folder)
        else:
            _run_program(step, world, width, folder)
    for file in case.outputs:
        if not (folder / file).exists():
            raise Failed(f"made no {file}")
