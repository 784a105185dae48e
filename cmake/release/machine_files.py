#!/usr/bin/env python3
"""Writes the C library for other machines, from what CMake installed of a build by `./run cross`:

  machine_files.py windows --installed FOLDER --version V --output FOLDER [--contact NAME]
  machine_files.py arm64   --installed FOLDER --version V --output FOLDER [--contact NAME]

installed: where the components c and c_dev were installed; of arm64 with the prefix FOLDER/usr.
windows: foretouch-V-windows-x86_64.zip, which needs nothing else. arm64: Debian's packages
libforetouch0.1 and libforetouch-dev for that architecture. The same input gives the same bytes:
every date is SOURCE_DATE_EPOCH. Needs patchelf, dpkg-deb and the machine's strip."""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile

from release_files import OF_THE_SYSTEM, add, copy_of, date, output_of

COPYRIGHT = pathlib.Path(__file__).parent.parent / "packages/copyright"
CONTACT = "Foretouch maintainers <root@localhost>"
README = """\
Foretouch {version} for Windows on x86-64: the C library.

bin/foretouch.dll needs nothing but Windows. Link lib/libforetouch.dll.a with MinGW; for Microsoft's
linker make an import library first: lib /def:lib\\foretouch.def /machine:x64 /out:foretouch.lib
include/foretouch has the headers, share/foretouch/c-example programs, share/foretouch/dotnet the binding for C#.
There is no importer: scenes come as arrays, avatars and clips as avatar files and BVH.
"""
CONTROL = """\
Package: {package}
Version: {version}-1
Architecture: arm64
Maintainer: {contact}
Section: {section}
Priority: optional
Depends: {depends}
Installed-Size: {kilobytes}
Description: continuous collision detection of avatars
 Foretouch tells what an articulated body (a VR user, a mocap actor, a robot)
 meets between two poses: when each link first touches the scene, where, and
 along which normal. It never reports a contact late, rounding included.
 .
 {about}
"""


def make_windows(arguments):
    name = f"foretouch-{arguments.version}-windows-x86_64"
    target = arguments.output / f"{name}.zip"
    with tempfile.TemporaryDirectory() as scratch:
        prefix = pathlib.Path(scratch, name)
        copy_of(arguments.installed, prefix, {"lib/cmake", "lib/pkgconfig"})
        for library in prefix.glob("bin/*.dll"):
            subprocess.run(["x86_64-w64-mingw32-strip", "--strip-unneeded", str(library)], check=True)
        (prefix / "README.txt").write_text(README.format(version=arguments.version).replace("\n", "\r\n"))
        shutil.copy(COPYRIGHT, prefix / "COPYRIGHT.txt")
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
            for path in sorted(path for path in prefix.rglob("*") if path.is_file()):
                add(archive, str(path.relative_to(scratch)), path.read_bytes(), time.gmtime(date())[:6], 0o644)
    return [target]


def needs_of(library):
    """The packages that a library is linked with, by those of this machine: a release of Debian has
    the same names and versions for all architectures."""
    needs = set()
    for name in output_of("patchelf", "--print-needed", str(library)).split():
        if OF_THE_SYSTEM.match(name) or name.startswith("ld-linux"):
            name = "libc.so.6"
        owners = output_of("dpkg-query", "-S", f"*/{name}").splitlines()
        package = owners[0].split(":")[0]
        version = output_of("dpkg-query", "-W", "-f", "${Version}\n", package).splitlines()[0]
        needs.add(f"{package} (>= {version.split(':')[-1].split('-')[0].split('+')[0]})")
    return ", ".join(sorted(needs))


def write_package(root, arguments, **control):
    package = control["package"]
    documents = root / "usr/share/doc" / package
    documents.mkdir(parents=True)
    shutil.copy(COPYRIGHT, documents)
    control["kilobytes"] = (sum(p.stat().st_size for p in root.rglob("*") if p.is_file()) + 1023) // 1024
    (root / "DEBIAN").mkdir(exist_ok=True)
    (root / "DEBIAN/control").write_text(
        CONTROL.format(version=arguments.version, contact=arguments.contact, **control))
    for path in [root, *root.rglob("*")]:
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() else 0o644)
            os.utime(path, (date(), date()))
    target = arguments.output / f"{package}_{arguments.version}-1_arm64.deb"
    subprocess.run(["dpkg-deb", "--root-owner-group", "-Zxz", "--build", str(root), str(target)],
                   check=True, stdout=subprocess.DEVNULL)
    return target


def make_arm64(arguments):
    libraries = [path for path in arguments.installed.glob("usr/lib/aarch64-linux-gnu/libforetouch.so.*.*.*")]
    if len(libraries) != 1:
        sys.exit(f"machine_files: expected one library in {arguments.installed}/usr/lib/aarch64-linux-gnu")
    library = libraries[0]
    soname = output_of("patchelf", "--print-soname", str(library)).strip()
    runtime, development = f"libforetouch{soname.partition('.so.')[2]}", "libforetouch-dev"
    with tempfile.TemporaryDirectory() as scratch:
        one, other = pathlib.Path(scratch, "one"), pathlib.Path(scratch, "other")
        of_runtime = {f"usr/lib/aarch64-linux-gnu/{name}" for name in (library.name, soname)}
        copy_of(arguments.installed, other, of_runtime)
        folder = one / "usr/lib/aarch64-linux-gnu"
        folder.mkdir(parents=True)
        shutil.copy(library, folder)
        (folder / soname).symlink_to(library.name)
        subprocess.run(["aarch64-linux-gnu-strip", "--strip-unneeded", str(folder / library.name)], check=True)
        (one / "DEBIAN").mkdir()
        (one / "DEBIAN/triggers").write_text("activate-noawait ldconfig\n")
        (one / "DEBIAN/shlibs").write_text(
            f"libforetouch {soname.partition('.so.')[2]} {runtime} (>= {arguments.version})\n")
        return [write_package(one, arguments, package=runtime, section="libs", depends=needs_of(library),
                              about="This package holds the C library, without the importer."),
                write_package(other, arguments, package=development, section="libdevel",
                              depends=f"{runtime} (= {arguments.version}-1)",
                              about="This package holds the headers of C and their examples.")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("machine", choices=["windows", "arm64"])
    parser.add_argument("--installed", type=pathlib.Path, required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--contact", default=CONTACT)
    arguments = parser.parse_args()
    if "SOURCE_DATE_EPOCH" not in os.environ:
        sys.exit("machine_files: expected the date of the sources in SOURCE_DATE_EPOCH")
    arguments.installed = arguments.installed.resolve()
    arguments.output = arguments.output.resolve()
    arguments.output.mkdir(parents=True, exist_ok=True)
    make = make_windows if arguments.machine == "windows" else make_arm64
    for target in make(arguments):
        print(target)


if __name__ == "__main__":
    main()
