#!/usr/bin/env python3
"""lists_test.py SOURCE_FOLDER: do the lists agree that `./run` and its scripts go by?

A machine that `./run cross` builds for has a preset, a toolchain file and a line in docs/machines.md;
the other machine's packages are those that CMakeLists.txt looks for everywhere; the tests that run
there exist. Every package that is installed stands in docs/dependencies.md, and every task has its
script. Nothing is built.
"""
import json
import pathlib
import re
import sys

# What the packages are called that CMake finds; nothing: of the compiler.
PACKAGES = {"Eigen3": "libeigen3-dev", "Threads": None, "hwy": "libhwy-dev", "fmt": "libfmt-dev",
            "nlohmann_json": "nlohmann-json3-dev"}
# What is not looked for there: found where it is, or needed by tests and by every program.
OTHERS = {"libembree-dev", "libgtest-dev", "libgmp-dev", "libboost-dev", "libxxhash-dev"}
OF_THE_COMPILER = re.compile(r"libc6-dev|libstdc\+\+-\d+-dev")


# Of every Debian, or brought along by what is named.
NEEDS_NO_WORD = {"g++", "cmake", "ninja-build", "iproute2", "nodejs", "npm"}


def packages_of(source):
    groups = {}
    for line in (source / "dev/packages.txt").read_text().splitlines():
        group, *names = line.split() if line and not line.startswith("#") else [None]
        if group:
            groups.setdefault(group, []).extend(names)
    return groups


def tasks_without_scripts(source):
    tasks = [line.split() for line in (source / "dev/tasks.txt").read_text().splitlines()
             if line[:1].isalpha()]
    if len(tasks) < 20:
        yield "dev/tasks.txt names fewer than twenty tasks"
    for task, script, *_ in tasks:
        file = source / "dev" / script
        if not file.is_file():
            yield f"{task}: there is no dev/{script}"
        elif task + ")" not in file.read_text() and "[" + task + "]=" not in file.read_text() and \
                script != task + ".sh":
            yield f"{task}: dev/{script} does not know it"


def packages_without_reason(source, groups):
    table = (source / "docs/dependencies.md").read_text()
    named = {name for names in groups.values() for name in names} - NEEDS_NO_WORD
    for group in ("arm64-sysroot", "cross-sources"):  # the same for another machine
        named -= set(groups[group])
    for package in sorted(named):
        if not re.search(rf"(?<![\w-]){re.escape(package)}(?![\w-])", table):
            yield f"{package}: docs/dependencies.md does not say why it is there"


def words_of(name, script):
    found = re.search(rf"^{name}=\(([^)]*)\)", script, re.MULTILINE)
    return found.group(1).split() if found else []


def disagreements(source):
    groups = packages_of(source)
    yield from tasks_without_scripts(source)
    yield from packages_without_reason(source, groups)
    machines_script = (source / "dev/machines.sh").read_text()
    cmake = (source / "CMakeLists.txt").read_text()
    guide = (source / "docs/machines.md").read_text()
    presets = {preset["name"] for preset in
               json.loads((source / "CMakePresets.json").read_text())["configurePresets"]
               if preset.get("inherits") == "cross"}
    body = re.search(r"^prepare_cross\(\) \{.*?^\}", machines_script, re.MULTILINE | re.DOTALL).group(0)
    machines = re.findall(r"^    (\w+)\)$", body, re.MULTILINE)
    if not machines:
        yield "dev/machines.sh: prepare_cross() knows no machine"
    for machine in machines:
        if machine not in presets:
            yield f"{machine}: no preset of that name inherits 'cross'"
        if f"./run cross {machine}" not in guide:
            yield f"{machine}: docs/machines.md does not say `./run cross {machine}`"
        if not groups.get(machine):
            yield f"{machine}: dev/packages.txt has no such group"
    for preset in presets:
        if not (source / f"cmake/cross/{preset}.cmake").is_file():
            yield f"{preset}: there is no cmake/cross/{preset}.cmake"

    here, there = set(groups["build"]), set(groups["arm64-sysroot"])
    needed = set()
    for library in re.findall(r"^find_package\((\w+)", cmake, re.MULTILINE):
        if library not in PACKAGES:
            yield f"{library}: CMakeLists.txt looks for it everywhere; say here which package has it"
        elif PACKAGES[library]:
            needed.add(PACKAGES[library])
    for package in (needed | OTHERS) - there:
        yield f"{package}: missing in arm64-sysroot"
    for package in there - needed - OTHERS:
        if not OF_THE_COMPILER.fullmatch(package):
            yield f"{package}: nobody needs it in arm64-sysroot"
    for package in there - here:
        if not OF_THE_COMPILER.fullmatch(package):
            yield f"{package}: in arm64-sysroot, and not installed here"

    tests = set()
    for lists in (source / "tests").rglob("CMakeLists.txt"):
        tests.update(re.findall(r"^foretouch_test\((\w+)", lists.read_text(), re.MULTILINE))
    there = words_of("cross_tests", (source / "dev/cross.sh").read_text())
    for test in set(there) - tests:
        yield f"{test}: in cross_tests, and no test program"
    if len(there) < 5:
        yield "dev/cross.sh: cross_tests names fewer than five test programs"


def main(source):
    found = list(disagreements(pathlib.Path(source)))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
