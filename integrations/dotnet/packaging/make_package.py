#!/usr/bin/env python3
"""Writes the Unity package: its folder, and the tarball that Unity's package manager takes.

  make_package.py --output FOLDER --version V --linux-x64 LIBRARY [--linux-arm64 LIBRARY --sysroot FOLDER]
                  [--win-x64 DLL]

Brings along what a library of Linux is linked with, but for the C and C++ libraries; all lie in one folder
and are called .so, as Unity copies nothing else into players, and find each other there. Unity leaves out
what has no .meta file, so each file gets one, whose number depends on its path alone: scenes that use a
component keep it in the next version. The same input gives the same bytes: every date is SOURCE_DATE_EPOCH.
Needs patchelf and binutils."""
import argparse
import gzip
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

NAME = "com.foretouch.unity"
SOURCES = Path(__file__).resolve().parent.parent
PROJECT = SOURCES.parent.parent
CONTENT = ["package.json", "README.md", "Foretouch.csproj", "Runtime", "Samples~"]
OF_THE_SYSTEM = re.compile(r"^(ld-linux-|lib(c|m|dl|pthread|rt|stdc\+\+|gcc_s)\.so)")
HOST = ["/lib/x86_64-linux-gnu", "/usr/lib/x86_64-linux-gnu"]

META = "fileFormatVersion: 2\nguid: {guid}\n"
FOLDER = META + "folderAsset: yes\nDefaultImporter:\n  externalObjects: {{}}\n"
PLUGIN = META + """PluginImporter:
  serializedVersion: 2
  isPreloaded: 0
  isOverridable: 0
  platformData:
  - first:
      Any:
    second:
      enabled: 0
      settings: {{}}
  - first:
      Editor: Editor
    second:
      enabled: {enabled}
      settings:
        CPU: x86_64
        DefaultValueInitialized: true
        OS: {system}
  - first:
      Standalone: {player}
    second:
      enabled: {enabled}
      settings:
        CPU: x86_64
"""
# Where Unity loads them. Linux on ARM64 has no editor, and no player but for embedded devices.
PLACES = {"linux-x64": ("Linux", "Linux64", 1), "win-x64": ("Windows", "Win64", 1), "linux-arm64": ("Linux", "Linux64", 0)}


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(library):
    return [name for name in output_of("patchelf", "--print-needed", str(library)).split() if not OF_THE_SYSTEM.match(name)]


def found(name, folders):
    for folder in folders:
        path = Path(folder, name)
        if path.exists():
            return path.resolve()
    sys.exit(f"make_package: {name} is in none of {', '.join(map(str, folders))}")


def own_name(name):
    """libfmt.so.9 becomes libforetouch-fmt.so: no other package brings one of that name."""
    return "libforetouch-" + name[len("lib"):name.index(".so")] + ".so" if not name.startswith("libforetouch.so") else "libforetouch.so"


def with_all_it_needs(library, folders):
    """Name to path, of a library and, one after the other, all that these need."""
    all_of_them, waiting = {}, [("libforetouch.so", Path(library).resolve())]
    while waiting:
        name, path = waiting.pop()
        if name not in all_of_them:
            all_of_them[name] = path
            waiting += [(one, found(one, folders)) for one in needed(path)]
    return all_of_them


def bring_linux(library, folders, strip, target):
    target.mkdir(parents=True)
    brought = with_all_it_needs(library, folders)
    for name, path in sorted(brought.items()):
        copy = target / own_name(name)
        shutil.copy(path, copy)
        copy.chmod(0o755)
        subprocess.run([strip, "--strip-unneeded", str(copy)], check=True)
        changes = [["--set-soname", copy.name], ["--set-rpath", "$ORIGIN"]]
        changes += [["--replace-needed", one, own_name(one)] for one in needed(copy)]
        for change in changes:  # one by one: patchelf forgets some of several
            subprocess.run(["patchelf", *change, str(copy)], check=True)


def guid(path):
    return hashlib.md5(f"{NAME}/{path}".encode()).hexdigest()


def meta_of(path, package):
    name = path.relative_to(package).as_posix()
    if path.is_dir():
        return FOLDER.format(guid=guid(name))
    if path.suffix in (".so", ".dll"):
        system, player, enabled = PLACES[path.parent.name]
        return PLUGIN.format(guid=guid(name), system=system, player=player, enabled=enabled)
    return META.format(guid=guid(name))


def write_metas(package):
    for path in sorted(package.rglob("*")):
        if not any(part.endswith("~") for part in path.relative_to(package).parts):
            path.with_name(path.name + ".meta").write_text(meta_of(path, package))


def write_tarball(package, target):
    date = int(os.environ["SOURCE_DATE_EPOCH"])
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path in sorted(package.rglob("*")):
            if not path.is_file():
                continue
            entry = tarfile.TarInfo("package/" + path.relative_to(package).as_posix())  # as npm has it
            entry.size, entry.mtime, entry.mode = path.stat().st_size, date, 0o644
            with open(path, "rb") as file:
                archive.addfile(entry, file)
    with open(target, "wb") as file, gzip.GzipFile(fileobj=file, mode="wb", filename="", mtime=date) as packed:
        packed.write(raw.getvalue())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option in ("output", "version", "linux-x64"):
        parser.add_argument("--" + option, required=True)
    for option in ("linux-arm64", "sysroot", "win-x64"):
        parser.add_argument("--" + option)
    arguments = parser.parse_args()
    package = Path(arguments.output, NAME)
    shutil.rmtree(package, ignore_errors=True)
    package.mkdir(parents=True)
    for name in CONTENT:
        (shutil.copytree if (SOURCES / name).is_dir() else shutil.copy)(SOURCES / name, package / name)
    shutil.copy(PROJECT / "LICENSE", package / "LICENSE.md")
    if f'"version": "{arguments.version}"' not in (package / "package.json").read_text():
        sys.exit(f"make_package: package.json: expected the version {arguments.version}")
    bring_linux(arguments.linux_x64, [Path(arguments.linux_x64).resolve().parent, *HOST], "strip", package / "Plugins/linux-x64")
    if arguments.linux_arm64:
        root = Path(arguments.sysroot)
        bring_linux(arguments.linux_arm64, [root / "usr/lib/aarch64-linux-gnu", root / "lib/aarch64-linux-gnu"],
                    "aarch64-linux-gnu-strip", package / "Plugins/linux-arm64")
    if arguments.win_x64:
        (package / "Plugins/win-x64").mkdir(parents=True)
        shutil.copy(arguments.win_x64, package / "Plugins/win-x64/foretouch.dll")
    write_metas(package)
    target = Path(arguments.output, f"{NAME}-{arguments.version}.tgz")
    write_tarball(package, target)
    print(f"{target}: {target.stat().st_size / 1e6:.1f} MB, with {', '.join(sorted(p.name for p in (package / 'Plugins').iterdir() if p.is_dir()))}")


if __name__ == "__main__":
    main()
