#!/usr/bin/env python3
"""Writes what the packages stand on, as CycloneDX 1.5 (https://cyclonedx.org/docs/1.5/json/):

  bill_of_materials.py --version V [--linked FILE...] [--built-with PACKAGE...] [--lock FILE] > FILE

linked: programs and shared libraries; the Debian packages of all that the loader finds for them.
built-with: Debian packages whose headers and static libraries are compiled in, or whose tools were used.
lock: npm's package-lock.json; what is in the page, and what builds it.
The same input gives the same bytes: the date is SOURCE_DATE_EPOCH, the serial number a hash."""
import argparse
import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import uuid


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def libraries_of(programs):
    """Paths of the shared libraries that the loader takes for the programs."""
    found = set()
    for program in programs:
        found.update(re.findall(r"=> (/\S+) \(0x", output_of("ldd", program)))
    return {os.path.realpath(path) for path in found}


def package_of(path):
    """The Debian package of a file; None if none owns it. Its name may be the one before /usr was merged."""
    for name in (path, path.removeprefix("/usr")):
        done = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout.split(": ")[0].split(",")[0].split(":")[0]
    return None


def facts_of(package):
    """Version, architecture and source of an installed package."""
    form = r"${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n"
    lines = output_of("dpkg-query", "-W", "-f", form, package).splitlines()
    return lines[0].split("\t")


def debian_component(package, use):
    version, architecture, source, source_version = facts_of(package)
    release = dict(line.rstrip().split("=", 1) for line in open("/etc/os-release") if "=" in line)
    distribution = release.get("ID", "debian").strip('"') + "-" + release.get("VERSION_ID", "").strip('"')
    purl = f"pkg:deb/debian/{package}@{version}?arch={architecture}&distro={distribution}"
    return {"type": "library", "bom-ref": purl, "name": package, "version": version, "purl": purl,
            "scope": "required" if use == "linked" else "optional",
            "properties": [{"name": "foretouch:use", "value": use},
                           {"name": "debian:source", "value": f"{source} {source_version}"}]}


def npm_components(lock):
    packages = json.load(open(lock))["packages"]
    for path, entry in sorted(packages.items()):
        if not path or "version" not in entry:
            continue
        name = path.split("node_modules/")[-1]
        purl = f"pkg:npm/{name.replace('@', '%40', 1)}@{entry['version']}"
        use = "builds the page" if entry.get("dev") else "in the page"
        component = {"type": "library", "bom-ref": purl, "name": name, "version": entry["version"], "purl": purl,
                     "scope": "excluded" if entry.get("dev") else "required",
                     "properties": [{"name": "foretouch:use", "value": use}]}
        if isinstance(entry.get("license"), str):
            component["licenses"] = [{"expression": entry["license"]}]
        yield component


def components_of(asked):
    uses = {}
    for package in asked.built_with:
        uses[package] = "built with"
    unowned = []
    for path in sorted(libraries_of(asked.linked)):
        package = package_of(path)
        if package is None:
            unowned.append(path)
        else:
            uses[package] = "linked"
    if unowned:
        sys.exit("bill_of_materials: expected libraries of Debian packages, found " + ", ".join(unowned))
    components = [debian_component(package, use) for package, use in sorted(uses.items())]
    if asked.lock:
        components += npm_components(asked.lock)
    return components


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", required=True)
    parser.add_argument("--linked", nargs="*", default=[])
    parser.add_argument("--built-with", nargs="*", default=[])
    parser.add_argument("--lock")
    asked = parser.parse_args()
    components = components_of(asked)
    digest = hashlib.sha256(json.dumps([asked.version, components], sort_keys=True).encode()).hexdigest()
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    date = datetime.datetime.fromtimestamp(epoch, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    own = f"pkg:generic/foretouch@{asked.version}"
    json.dump({"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
               "serialNumber": "urn:uuid:" + str(uuid.UUID(digest[:32], version=4)),
               "metadata": {"timestamp": date,
                            "component": {"type": "application", "bom-ref": own, "name": "foretouch",
                                          "version": asked.version, "purl": own}},
               "components": components,
               "dependencies": [{"ref": own, "dependsOn": sorted(c["bom-ref"] for c in components
                                                                   if c["scope"] != "excluded")}]},
              sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
