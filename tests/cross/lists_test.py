#!/usr/bin/env python3
"""lists_test.py SOURCE_FOLDER: do the lists agree that `./run cross` goes by?

A machine that `run` builds for has a preset, a toolchain file and a line in docs/machines.md; the
other machine's packages are those that CMakeLists.txt looks for everywhere; the tests that run there
exist. Nothing is built.
"""
import json
import pathlib
import re
import sys

# What the packages are called that CMake finds; nothing: of the compiler.
PACKAGES = {"Eigen3": "libeigen3-dev", "Threads": None, "hwy": "libhwy-dev", "fmt": "libfmt-dev",
            "nlohmann_json": "nlohmann-json3-dev"}
# What is not looked for there: found where it is, or needed by tests and by every program.
OTHERS = {"libembree-dev", "libgtest-dev", "libgmp-dev", "libboost-dev"}
OF_THE_COMPILER = re.compile(r"libc6-dev|libstdc\+\+-\d+-dev")


def words_of(name, run):
    found = re.search(rf"^{name}=\(([^)]*)\)", run, re.MULTILINE)
    return found.group(1).split() if found else []


def disagreements(source):
    run = (source / "run").read_text()
    cmake = (source / "CMakeLists.txt").read_text()
    guide = (source / "docs/machines.md").read_text()
    presets = {preset["name"] for preset in
               json.loads((source / "CMakePresets.json").read_text())["configurePresets"]
               if preset.get("inherits") == "cross"}
    body = re.search(r"^prepare_cross\(\) \{.*?^\}", run, re.MULTILINE | re.DOTALL).group(0)
    machines = re.findall(r"^    (\w+)\)$", body, re.MULTILINE)
    if not machines:
        yield "run: prepare_cross() knows no machine"
    for machine in machines:
        if machine not in presets:
            yield f"{machine}: no preset of that name inherits 'cross'"
        if f"./run cross {machine}" not in guide:
            yield f"{machine}: docs/machines.md does not say `./run cross {machine}`"
        if not words_of(f"{machine}_packages", run):
            yield f"{machine}: run has no {machine}_packages"
    for preset in presets:
        if not (source / f"cmake/cross/{preset}.cmake").is_file():
            yield f"{preset}: there is no cmake/cross/{preset}.cmake"

    here, there = set(words_of("packages", run)), set(words_of("arm64_sysroot", run))
    needed = set()
    for library in re.findall(r"^find_package\((\w+)", cmake, re.MULTILINE):
        if library not in PACKAGES:
            yield f"{library}: CMakeLists.txt looks for it everywhere; say here which package has it"
        elif PACKAGES[library]:
            needed.add(PACKAGES[library])
    for package in (needed | OTHERS) - there:
        yield f"{package}: missing in arm64_sysroot"
    for package in there - needed - OTHERS:
        if not OF_THE_COMPILER.fullmatch(package):
            yield f"{package}: nobody needs it in arm64_sysroot"
    for package in there - here:
        if not OF_THE_COMPILER.fullmatch(package):
            yield f"{package}: in arm64_sysroot, and not installed here"

    tests = set()
    for lists in (source / "tests").rglob("CMakeLists.txt"):
        tests.update(re.findall(r"^foretouch_test\((\w+)", lists.read_text(), re.MULTILINE))
    for test in set(words_of("cross_tests", run)) - tests:
        yield f"{test}: in cross_tests, and no test program"
    if len(words_of("cross_tests", run)) < 5:
        yield "run: cross_tests names fewer than five test programs"


def main(source):
    found = list(disagreements(pathlib.Path(source)))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
