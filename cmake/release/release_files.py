#!/usr/bin/env python3
"""Writes the files that need no compiler and no package manager, from what CMake installed:

  release_files.py archive --installed FOLDER --version V --output FOLDER
  release_files.py wheel   --installed FOLDER --version V --output FOLDER

installed: where the components runtime, c, c_dev and python were installed, of one build, by
`cmake --install ... --prefix FOLDER`. archive: foretouch-V-linux-x86_64.tar.xz, to be unpacked
anywhere. wheel: foretouch-V-cp311-cp311-manylinux_2_36_x86_64.whl, for pip.

Both bring along every shared library but those of the C library itself, in lib/foretouch beside
the rest, and find them relative to themselves. The same input gives the same bytes: every date is
SOURCE_DATE_EPOCH. Needs patchelf and xz."""
import argparse
import base64
import hashlib
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile

# What every Linux with this C library has, and must not have twice: the C library and its loader.
OF_THE_SYSTEM = re.compile(r"^(linux-vdso|ld-linux-|lib(c|m|dl|pthread|rt|resolv|util|anl)\.so)")
PRIVATE = "lib/foretouch"


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def is_linked(path):
    """A program or a shared library, which a loader reads."""
    return path.is_file() and not path.is_symlink() and is_elf(path) and path.suffix not in (".a", ".o")


def date():
    return int(os.environ["SOURCE_DATE_EPOCH"])


def libraries_of(files):
    """Name to path of the shared libraries that the loader takes for the files, all of their own
    included, but for those of the system."""
    found = {}
    for file in files:
        told = output_of("ldd", str(file))
        for name, path in re.findall(r"^\s*(\S+) => (\S+) \(0x", told, re.MULTILINE):
            if not OF_THE_SYSTEM.match(name):
                found[name] = path
        lost = re.findall(r"^\s*(\S+) => not found", told, re.MULTILINE)
        if lost:
            sys.exit(f"release_files: {file}: {', '.join(lost)} not found; expected the machine of the build")
    return found


def bring_libraries(prefix, extra=()):
    """Copies what the files below prefix (and `extra`) are linked with to lib/foretouch, strips all
    and makes each look for its libraries there."""
    linked = [path for path in sorted(prefix.rglob("*")) if is_linked(path)] + list(extra)
    private = prefix / PRIVATE
    own = {path.name for path in linked}
    brought = {name: path for name, path in libraries_of(linked).items() if name not in own}
    private.mkdir(parents=True, exist_ok=True)
    for name, path in sorted(brought.items()):
        shutil.copy(os.path.realpath(path), private / name)
        (private / name).chmod(0o755)
        linked.append(private / name)
    for path in linked:
        subprocess.run(["strip", "--strip-unneeded", str(path)], check=True)
        away = os.path.relpath(private, path.parent)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN" if away == "." else f"$ORIGIN/{away}", str(path)],
                       check=True)
    check_closed(linked, private)


def check_closed(linked, private):
    """Whatever a file asks for by name is brought along, or the system's."""
    there = {path.name for path in private.iterdir()} | {path.name for path in linked}
    for path in linked:
        for name in output_of("patchelf", "--print-needed", str(path)).split():
            if name not in there and not OF_THE_SYSTEM.match(name):
                sys.exit(f"release_files: {path.name} needs {name}, which is not brought along")


def licences(prefix):
    """The copyright files of the Debian packages whose libraries are brought along."""
    folder = prefix / "share/doc/foretouch/libraries"
    folder.mkdir(parents=True, exist_ok=True)
    for library in sorted((prefix / PRIVATE).iterdir()):
        for name in (f"/usr/lib/x86_64-linux-gnu/{library.name}", f"/lib/x86_64-linux-gnu/{library.name}"):
            owner = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True)
            if owner.returncode == 0:
                package = owner.stdout.split(":")[0]
                text = pathlib.Path("/usr/share/doc", package, "copyright")
                if text.is_file():
                    shutil.copy(text, folder / package)
                break


def copy_of(installed, place, left_out):
    shutil.copytree(installed, place, symlinks=True, ignore=lambda folder, names: [
        name for name in names if str(pathlib.Path(folder, name).relative_to(installed)) in left_out])


def make_archive(installed, version, output):
    name = f"foretouch-{version}-linux-x86_64"
    with tempfile.TemporaryDirectory() as scratch:
        prefix = pathlib.Path(scratch, name)
        copy_of(installed, prefix, {"lib/python3"})
        bring_libraries(prefix)
        licences(prefix)
        target = output / f"{name}.tar.xz"
        packing = subprocess.Popen(["xz", "-6", "--threads=1"], stdin=subprocess.PIPE, stdout=open(target, "wb"))
        with tarfile.open(fileobj=packing.stdin, mode="w|", format=tarfile.PAX_FORMAT) as archive:
            for path in [prefix, *sorted(prefix.rglob("*"))]:
                archive.add(path, str(path.relative_to(scratch)), recursive=False, filter=without_owner)
        packing.stdin.close()
        if packing.wait() != 0:
            sys.exit("release_files: xz failed")
        return target


def without_owner(entry):
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = "root"
    entry.mtime = date()
    entry.mode = 0o755 if entry.isdir() or entry.mode & stat.S_IXUSR else 0o644
    return entry


METADATA = """\
Metadata-Version: 2.1
Name: foretouch
Version: {version}
Summary: Continuous collision detection of avatars
Requires-Python: >=3.11,<3.12
Requires-Dist: numpy
"""
WHEEL = """\
Wheel-Version: 1.0
Generator: foretouch
Root-Is-Purelib: false
Tag: {tag}
"""
ENTRY = "[console_scripts]\nforetouch = foretouch._command:main\n"


def make_wheel(installed, version, output):
    """The Python package with an installation of the program inside, in foretouch/_installed."""
    tag = "cp311-cp311-manylinux_2_36_x86_64"
    module = installed / "lib/python3/dist-packages/foretouch"
    if not module.is_dir():
        sys.exit(f"release_files: no Python package in {module}; expected a build with it (FORETOUCH_PYTHON=ON)")
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        package = root / "foretouch"
        shutil.copytree(module, package)
        for file in sorted(pathlib.Path(__file__).parent.glob("wheel/*.py")):
            shutil.copy(file, package)
        inside = package / "_installed"
        for part in ("bin", "libexec", "share/foretouch/examples"):
            shutil.copytree(installed / part, inside / part, symlinks=True)
        bring_libraries(inside, sorted(package.glob("*.so")))
        licences(inside)
        about = root / f"foretouch-{version}.dist-info"
        about.mkdir()
        (about / "METADATA").write_text(METADATA.format(version=version))
        (about / "WHEEL").write_text(WHEEL.format(tag=tag))
        (about / "entry_points.txt").write_text(ENTRY)
        target = output / f"foretouch-{version}-{tag}.whl"
        write_zip(root, about / "RECORD", target)
        return target


def write_zip(root, record, target):
    when = time.gmtime(date())[:6]
    lines = []
    files = [path for path in sorted(root.rglob("*")) if path.is_file()]
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in files:
            name, content = str(path.relative_to(root)), path.read_bytes()
            add(archive, name, content, when, path.stat().st_mode)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            lines.append(f"{name},sha256={digest},{len(content)}\n")
        lines.append(f"{record.relative_to(root)},,\n")
        add(archive, str(record.relative_to(root)), "".join(lines).encode(), when, 0o644)


def add(archive, name, content, when, mode):
    entry = zipfile.ZipInfo(name, when)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = (stat.S_IFREG | (0o755 if mode & stat.S_IXUSR else 0o644)) << 16
    archive.writestr(entry, content)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("kind", choices=["archive", "wheel"])
    parser.add_argument("--installed", type=pathlib.Path, required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    if "SOURCE_DATE_EPOCH" not in os.environ:
        sys.exit("release_files: expected the date of the sources in SOURCE_DATE_EPOCH")
    arguments.output.mkdir(parents=True, exist_ok=True)
    make = make_archive if arguments.kind == "archive" else make_wheel
    print(make(arguments.installed.resolve(), arguments.version, arguments.output.resolve()))


if __name__ == "__main__":
    main()
