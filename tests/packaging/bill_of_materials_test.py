"""bill_of_materials_test.py SOURCE PROGRAM IMPORTER: the bill names what the loader takes, once each, and is
the same every time; what is not installed is refused."""
import json
import os
import subprocess
import sys

source, program, importer = sys.argv[1:4]
script = os.path.join(source, "cmake/packages/bill_of_materials.py")


def run(*arguments):
    return subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True)


usual = ["--version", "1.2.3", "--linked", program, importer, "--built-with", "libeigen3-dev", "--lock",
         os.path.join(source, "viewer/package-lock.json")]
first = run(*usual)
if first.returncode != 0 and "of Debian packages" in first.stderr:
    print("skipped: libraries here are of no Debian package")
    sys.exit(0)
assert first.returncode == 0, first.stderr
assert first.stdout == run(*usual).stdout, "two bills differ"
bill = json.loads(first.stdout)
assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.5")
by_name = {c["name"]: c for c in bill["components"]}
assert len(by_name) <= len(bill["components"])
references = [c["bom-ref"] for c in bill["components"]]
assert len(set(references)) == len(references), "a component is named twice"
use = lambda name: by_name[name]["properties"][0]["value"]
assert use("libassimp5") == "linked", "the importer's library is missing"
assert use("libc6") == "linked" and use("libeigen3-dev") == "built with"
assert use("three") == "in the page" and use("typescript") == "builds the page"
assert by_name["libassimp5"]["version"] == subprocess.run(
    ["dpkg-query", "-W", "-f", "${Version}", "libassimp5"], capture_output=True, text=True).stdout
for reference in bill["dependencies"][0]["dependsOn"]:
    assert reference in references
absent = run("--version", "1", "--built-with", "no-such-package")
assert absent.returncode != 0 and "no-such-package" in absent.stderr
print(len(references), "components")
