"""How a case is run: which programs there are, and what stands for them in command lines."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PATIENCE_S = 1200  # of a machine that has much else to do


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

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    # What a case may need, and how it is found or made: the first time that it is asked for.
    TOOLS = {
        "at_width": ("bin/at_width, a test's program", "_at_width"),
        "c": ("libforetouch.so, or a C compiler", "_c_programs"),
        "packages": ("the Python package", "_packages"),
        "network": ("a network namespace", "_network"),
    }

    def tool(self, name):
        """Where it is, or whether there is one; None or False where it is absent."""
        if name not in self._tools:
            known = self.TOOLS.get(name)
            self._tools[name] = getattr(self, known[1])() if known else self._has_width(name)
        return self._tools[name]

    def lacks(self, case):
        """What the case needs and is not here; "" where nothing is missing."""
        absent = [file for file in case.data if not (self.data / file).exists()]
        absent += [self.TOOLS[tool][0] if tool in self.TOOLS else f"the processor's {tool}"
                   for tool in case.tools if not self.tool(tool)]
        return "absent: " + ", ".join(absent) if absent else ""

    def _at_width(self):
        program = self.build / "bin/at_width"
        return program if program.exists() else None

    def _has_width(self, width):
        program = self.tool("at_width")
        return program and subprocess.run([program, width, "--version"], capture_output=True,
                                          check=False).returncode == 0

    def _packages(self):
        packages = self.build / "lib/python3/dist-packages"
        return packages if (packages / "foretouch").is_dir() else None

    def _network(self):
        tried = subprocess.run([self.source / "tests/network/in_namespace.sh", "true"],
                               capture_output=True, check=False)
        return tried.returncode == 0

    def _c_programs(self):
        """Both C programs, linked with the library of the build; their folder."""
        library = next(iter(sorted(self.build.rglob("libforetouch.so"))), None)
        compiler = shutil.which("cc")
        if library is None or compiler is None:
            return None
        folder = Path(self._folder.name)
        bindings = self.source / "bindings/c"
        for source in (self.source / "tests/digests/contacts.c", bindings / "example/swing.c"):
            subprocess.run([compiler, "-std=c99", "-O1", "-I", bindings / "include", source, "-o",
                            folder / source.stem, library, "-lm", f"-Wl,-rpath,{library.parent}"],
                           check=True)
        return folder

    def words(self, words):
        """A command line with what its {names} stand for."""
        names = {"foretouch": self.program, "data": self.data, "source": self.source,
                 "examples": self.build / "share/foretouch/examples", "python": "/usr/bin/python3",
                 "at_width": self._tools.get("at_width"), "c": self._tools.get("c")}
        return [word.format_map(names) for word in words]

    def environment(self):
        packages = str(self._tools.get("packages") or "")
        return {**os.environ, "FORETOUCH_IMPORTER": str(self.build / "bin/foretouch-import"),
                "LC_ALL": "C.UTF-8", "PYTHONPATH": packages, "PYTHONDONTWRITEBYTECODE": "1"}


def _run_program(step, world, folder):
    words = world.words(step.words)
    try:
        ended = subprocess.run(words, cwd=folder, env=world.environment(), capture_output=True,
                               timeout=PATIENCE_S, check=False)
    except subprocess.TimeoutExpired as late:
        raise Failed(f"{' '.join(words)}\n  did not end within {PATIENCE_S} s") from late
    if step.exit not in (None, ended.returncode):
        raise Failed(f"{' '.join(words)}\n  ended with {ended.returncode}, expected {step.exit}: "
                     + ended.stderr.decode(errors="replace")[-600:])
    if step.out:
        last = b"exit %d\n" % ended.returncode if step.exit is None else b""
        (folder / step.out).write_bytes(ended.stdout + last)


def run(case, world, folder):
    """Runs the steps of a case in a folder of its own."""
    for step in case.steps:
        if callable(step):
            step(folder)
        else:
            _run_program(step, world, folder)
    for file in case.outputs:
        if not (folder / file).exists():
            raise Failed(f"made no {file}")
