#!/usr/bin/env python3
"""What takes the room in the module for JavaScript: wasm_rooms.py [BUILD], after ./run npm. Links build/cross/npm once
more, with names, and counts each function for the folder whose archive defines it: bytes, and what gzip makes of these
bytes alone. Needs what ./run npm needs, and llvm-14 (which emscripten brings)."""
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

BUILD = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/cross/npm")
LIBRARIES = ["middleware/libforetouch_middleware.a", "tessellation/libforetouch_tessellation.a",
             "articulated/libforetouch_articulated.a", "lss/libforetouch_lss.a", "bindings/c/libforetouch.a",
             "assets/libforetouch_assets.a"]


def linked_with_names(path):
    commands = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", "foretouch_wasm"], check=True, text=True,
                              capture_output=True).stdout.strip().splitlines()
    command = commands[-1].removeprefix(": && ").removesuffix(" && :")
    command = command.replace("-o bin/foretouch.wasm", f"-o {path} --profiling-funcs")
    subprocess.run(command, shell=True, check=True, cwd=BUILD, env={**os.environ, "NODE_PATH": "/usr/share/nodejs"})


def owners():
    """The folder of each function's name; of an inline one, the first that has it, as the linker takes it."""
    found = {}
    for library in LIBRARIES:
        said = subprocess.run(["/usr/lib/llvm-14/bin/llvm-nm", "-C", "-A", "--defined-only", BUILD / library], text=True,
                              capture_output=True, check=False).stdout
        folder = {"bindings": "bindings/c"}.get(library.split("/")[0], library.split("/")[0])
        for line in said.splitlines():
            place, _, rest = line.partition(": ")
            name = rest.split(" ", 2)[-1]
            room = re.search(r":(?:unity_)?([a-z_]+?)\d*(?:_cxx)?\.c", place)
            inside = f"{folder}/{room[1]}" if folder == "middleware" and "unity_" in place and room else folder
            found.setdefault(name, inside)
    return found


class Module:
    def __init__(self, data):
        self.data, self.imports, self.bodies, self.names = data, 0, [], {}
        at = 8
        while at < len(data):
            kind, (size, begin) = data[at], self.number(at + 1)
            {2: self.read_imports, 10: self.read_code, 0: self.read_names}.get(kind, lambda *_: None)(begin, begin + size)
            at = begin + size

    def number(self, at):
        value = shift = 0
        while True:
            byte = self.data[at]
            value, shift, at = value | (byte & 127) << shift, shift + 7, at + 1
            if byte < 128:
                return value, at

    def text(self, at):
        size, at = self.number(at)
        return self.data[at:at + size].decode(), at + size

    def read_imports(self, at, _end):
        count, at = self.number(at)
        for _ in range(count):  # functions alone: the module brings its own memory and tables
            _, at = self.text(at)
            _, at = self.text(at)
            assert self.data[at] == 0, "an import that is no function"
            _, at = self.number(at + 1)
            self.imports += 1

    def read_code(self, at, _end):
        count, at = self.number(at)
        for _ in range(count):
            size, at = self.number(at)
            self.bodies.append(self.data[at:at + size])
            at += size

    def read_names(self, at, end):
        name, at = self.text(at)
        while name == "name" and at < end:
            kind, (size, begin) = self.data[at], self.number(at + 1)
            at = begin
            if kind == 1:
                count, at = self.number(at)
                for _ in range(count):
                    index, at = self.number(at)
                    self.names[index], at = self.text(at)
            at = begin + size


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "named.wasm")
        linked_with_names(path)
        module = Module(path.read_bytes())
    owner, code = owners(), collections.defaultdict(list)
    for index, body in enumerate(module.bodies):
        name = module.names.get(module.imports + index, "")
        code[owner.get(name, "bindings/wasm" if name.startswith("ftw_") else "libraries")].append(body)
    rows = sorted(((sum(map(len, bodies)), len(zlib.compress(b"".join(bodies), 9)), room) for room, bodies in code.items()),
                  reverse=True)
    print("   bytes  compressed  functions  folder")
    for size, packed, room in rows:
        print(f"{size:8} {packed:11} {len(code[room]):10}  {room}")
    print(f"{sum(row[0] for row in rows):8} {sum(row[1] for row in rows):11} {sum(map(len, code.values())):10}  all")


main()
