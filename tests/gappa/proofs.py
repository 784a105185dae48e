#!/usr/bin/env python3
"""proofs.py tie|prove|shrunk: the rounding constants of docs/rounding.md, and their scripts in verify/gappa.

tie: code, page, notes and scripts have one number each; no constant is left out. Needs nothing else.
prove: runs every script, and Coq on one certificate; what is not installed is skipped by name.
shrunk: constants that are shrunk by a tenth are not proven any more. 77 without gappa.
"""
import ast
import re
import shutil
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "verify/gappa"
PAGE = ROOT / "docs/rounding.md"
FOLDERS = ("lss", "articulated", "tessellation", "middleware", "planning", "verify", "assets")
UNITS = {"u": Fraction(1, 2**53), "v": Fraction(1, 2**24)}
# Too tight for a tenth less, each for a reason of its own: a dot product, a root, a slope.
TIGHT = ("kPairPlaneRounding", "kPairUnitShrink", "kChordRate")
SAMPLE = "unit_shrink.g"  # whose certificate Coq checks

NUMBER = re.compile(r"0x[0-9a-fA-F.]+p[+-]?\d+|\d+b-?\d+|\d+\.?\d*(?:e[+-]?\d+)?")


def number(text):
    if text.startswith("0x"):
        return Fraction(float.fromhex(text))
    if "b" in text:
        mantissa, exponent = text.split("b")
        return int(mantissa) * Fraction(2) ** int(exponent)
    return Fraction(text)


def evaluated(text, names):
    """The exact value of a sum of products of numbers, names and powers."""
    text = re.sub(r"static_cast<\w+>|double(?=\{)|\b\w+::|\b(?:rnd|fl)(?=\()", "", text)
    text = text.replace("{", "(").replace("}", ")").replace("^", "**")
    text = re.sub(r"(0x[0-9a-f.]+p[+-]?\d+|\d+\.\d*)[fF]\b", r"\1", text)
    text = re.sub(r"(\d)\s*([uv])\b", r"\1 * \2", text)
    values = []

    def stored(match):
        values.append(number(match[0]))
        return f"n_{len(values) - 1}"

    tree = ast.parse(re.sub(r"(?<![\w.])(?:%s)" % NUMBER.pattern, stored, text.strip()), mode="eval")

    def value(node):
        if isinstance(node, ast.Name):
            return values[int(node.id[2:])] if node.id.startswith("n_") else names[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -value(node.operand)
        left, right = value(node.left), value(node.right)
        return {ast.Add: lambda: left + right, ast.Sub: lambda: left - right, ast.Mult: lambda: left * right,
                ast.Div: lambda: left / right, ast.Pow: lambda: left ** int(right)}[type(node.op)]()

    return value(tree.body)


def rows():
    """constant, file, value, shown by, used, too large by."""
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        if line.startswith("| `k") and len(cells) == 6:
            yield [cells[0].strip("`"), cells[1].strip("`")] + cells[2:]


def scripts_of(shown):
    return re.findall(r"`(\w+\.(?:g|sollya))`", shown)


DECLARED = re.compile(r"constexpr\s+(?:double|float)\s+(k[^;(\[]*?=[^;]*);")


def constants(path):
    """name -> initialiser."""
    text = re.sub(r"//[^\n]*", "", path.read_text())
    found = {}
    for declared in DECLARED.findall(text):
        for one in re.split(r",\s*(?=k[A-Z]\w*\s*=)", declared):
            name, _, initialiser = one.partition("=")
            found.setdefault(name.strip(), " ".join(initialiser.split()))
    return found


def is_of_rounding(name, initialiser):
    small = r"Roundoff|0x1(\.\w+)?p-[2-9]\d|0x1p-1\d\d\d?|\b1\.0[fF]?\s*[+-]\s*(1e-|0x)"
    ending = r"(Inflation|Padding|Roundings?|Roundoff|Shrink|Underflow)$"
    return bool(re.search(ending, name) or re.search(small, initialiser))


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path


def known_names():
    names = dict(UNITS)
    for path in sources():
        for name, initialiser in constants(path).items():
            try:
                names.setdefault(name, evaluated(initialiser, names))
            except (KeyError, SyntaxError, AttributeError, ValueError):
                pass  # of what no rounding is counted with
    return names


def value_in_code(path, name, names):
    local = dict(names)
    own = constants(path)
    for other, initialiser in own.items():
        try:
            local[other] = evaluated(initialiser, local)
        except (KeyError, SyntaxError, AttributeError, ValueError):
            pass
    return local[name] if name in own else None


def defined_in(script):
    text = script.read_text()
    return {name: value for name, value in re.findall(r"^(k\w+) = (.*);", text, re.M)}


def tie():
    wrong, names, listed = [], known_names(), {}
    for name, where, value, shown, used, large in rows():
        place = f"{name} of {where}"
        listed.setdefault(where, set()).add(name)
        told = evaluated(value, UNITS)
        in_code = value_in_code(ROOT / where, name, names) if (ROOT / where).exists() else None
        if in_code != told:
            wrong.append(f"{place}: the page says {value}, the code {in_code and float(in_code)}")
        for script in scripts_of(shown):
            path = SCRIPTS / script
            own = defined_in(path) if path.exists() else {}
            if name not in own or evaluated(own[name], UNITS) != told:
                wrong.append(f"{place}: {script} has {own.get(name, 'none')}, expected {value}")
        if not scripts_of(shown) and not re.match(r"(argument|no bound): \w", shown):
            wrong.append(f"{place}: expected a script, or 'argument: ..' or 'no bound: ..', found '{shown}'")
        if used != "-" and 3 * float(used) < 1 and not large:
            wrong.append(f"{place}: three times too large: expected what a tighter one is worth")
    for path in sources():
        where = str(path.relative_to(ROOT))
        for name, initialiser in constants(path).items():
            if is_of_rounding(name, initialiser) and name not in listed.get(where, ()):
                wrong.append(f"{name} of {where}: expected a row in {PAGE.name}")
    everyone = {script for row in rows() for script in scripts_of(row[3])}
    for path in SCRIPTS.iterdir():
        if path.suffix in (".g", ".sollya") and path.name not in everyone:
            wrong.append(f"{path.name}: no constant names it")
    return wrong + wrong_inlines() + wrong_notes(listed)


UNNAMED = r"[\d.]+ \* (?:double\{)?kUnitRoundoff\w*|= kUnitRoundoff(?:OfFloat)? \*"


def wrong_inlines():
    """Roundings without a name: the page lists how many each file has."""
    listed = dict(re.findall(r"^\| `([\w/.-]+\.(?:h|cpp))` \| (\d+) \|", PAGE.read_text(), re.M))
    wrong = []
    for path in sources():
        where = str(path.relative_to(ROOT))
        text = DECLARED.sub("", re.sub(r"//[^\n]*", "", path.read_text()))
        found = len(re.findall(UNNAMED, text))
        told = int(listed.get(where, 0))
        if found != told:
            wrong.append(f"{where}: {found} roundings without a name, {PAGE.name} lists {told}")
    return wrong


NOTED = re.compile(r"`(?:\w+::)*(k\w+)`\s+=\s+((?:[\d.]+(?:e-?\d+)?(?:\^-?\d+)?|[uv*/+-]| )+)")


def wrong_notes(listed):
    values = {}
    for name, where, value, *_ in rows():
        values.setdefault(name, []).append((where, evaluated(value, UNITS)))
    wrong, read = [], 0
    notes = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.md")]
    for note in notes + [ROOT / "docs/guarantees.md"]:
        text = " ".join(note.read_text().split())
        single = re.search(r"\bu = 2\^-24", text)
        units = {"u": UNITS["v"] if single else UNITS["u"], "v": UNITS["v"]}
        for name, told in NOTED.findall(text):
            if name not in values:
                continue
            told = told.strip(" .*+-")
            number_told = evaluated(told, units)
            near = [one for one in values[name] if (ROOT / one[0]).parent == note.parent] or values[name]
            read += 1
            if not any(number_told in (one, one * UNITS["u"], one * UNITS["v"]) for _, one in near):
                wrong.append(f"{note.relative_to(ROOT)}: `{name}` = {told}, the page has another number")
    if read < 30:
        wrong.append(f"the notes: expected 30 numbers or more, found {read}")
    return wrong


def gappa(text):
    ran = subprocess.run(["gappa"], input=text, capture_output=True, text=True, timeout=120)
    return ran.returncode, ran.stdout + ran.stderr


def goals(text):
    """The constants below each bound, in order."""
    own = dict(re.findall(r"(?:^|;)\s*(\w+) = ([^;]*)(?=;)", text, re.M))
    conclusion = text.rsplit("->", 1)[1]
    found = []
    for goal in re.findall(r"(.*?)\s<= 1(?=\s)", conclusion.replace("\n", " ") + " "):
        names = set(re.findall(r"\b[A-Za-z_]\w*", goal.split("/\\")[-1].rsplit(" / ", 1)[-1]))
        for _ in range(6):
            names |= {other for name in names if not name.startswith("k") and name in own
                      for other in re.findall(r"\b[A-Za-z_]\w*", own[name])}
        found.append({name for name in names if re.match(r"k[A-Z]", name)})
    return found


def shares(path):
    """What each constant's script needs of it."""
    text = path.read_text()
    _, output = gappa(re.sub(r" <= 1(?=\s)", " in ?", text))
    bound = r"\bin \[[^,\]]*(?:\{[^}]*\})?, [^{\]]*?\{?([-\d.e+]+)(?:, [^}]*\})?\]"
    most = [float(upper) for upper in re.findall(bound, output)]
    needed = {}
    for names, share in zip(goals(text), most):
        for name in names:
            needed[name] = max(needed.get(name, share), share)
    return needed, len(most) == len(goals(text))


def shrink(text, name):
    def less(match):
        value = evaluated(match[2], UNITS)
        of_one = value if abs(value - 1) > Fraction(1, 100) else None
        return f"{match[1]}0.9 * ({match[2]});" if of_one else f"{match[1]}1 + 0.9 * (({match[2]}) - 1);"
    return re.sub(r"(?m)^(%s = )(.*);" % name, less, text)


def certificate_is_checked():
    with tempfile.TemporaryDirectory() as folder:
        proof = Path(folder) / "sample.v"
        ran = subprocess.run(["gappa", "-Bcoq", SCRIPTS / SAMPLE], capture_output=True, text=True)
        proof.write_text(ran.stdout)
        return subprocess.run(["coqc", proof], capture_output=True, cwd=folder).returncode == 0


def prove_by_gappa(listed, wrong):
    for script in sorted(SCRIPTS.glob("*.g")):
        failed, output = gappa(script.read_text())
        if failed or "arning" in output:
            wrong.append(f"{script.name}: {output.strip()}")
            continue
        needed, is_whole = shares(script)
        if not is_whole:
            wrong.append(f"{script.name}: not every bound was told")
        for name, _, _, shown, used, _ in listed:
            if script.name in scripts_of(shown) and name in needed and f"{needed[name]:.2g}" != used:
                wrong.append(f"{name}: {script.name} needs {needed[name]:.2g} of it, {PAGE.name} says {used}")


def prove_by_sollya(wrong):
    for script in sorted(SCRIPTS.glob("*.sollya")):
        ran = subprocess.run(["sollya", script], capture_output=True, text=True, timeout=120)
        if ran.stdout.split()[-1:] != ["true"] or "arning" in ran.stderr:
            wrong.append(f"{script.name}: {ran.stdout} {ran.stderr}")


def prove():
    wrong, listed = tie(), list(rows())
    has = {program: shutil.which(program) is not None for program in ("gappa", "sollya", "coqc")}
    if has["gappa"]:
        prove_by_gappa(listed, wrong)
    if has["sollya"]:
        prove_by_sollya(wrong)
    if has["gappa"] and has["coqc"] and not certificate_is_checked():
        wrong.append(f"{SAMPLE}: Coq refuses its certificate")
    for program in has:
        print(f"{program}: {'run' if has[program] else 'SKIPPED, not installed'}")
    shown = [row[3] for row in listed]
    for kind, program in (("g", "Gappa"), ("sollya", "Sollya")):
        count = sum(f".{kind}`" in one for one in shown)
        print(f"{count} constants by {len(list(SCRIPTS.glob('*.' + kind)))} scripts of {program}")
    arguments = sum(one.startswith("argument: ") for one in shown)
    nothing = sum(one.startswith("no bound: ") for one in shown)
    print(f"{arguments} constants by argument, {nothing} that bound nothing")
    print(f"{len(listed)} constants, {len(wrong)} unproven without a named reason")
    return wrong


def shrunk():
    if not shutil.which("gappa"):
        print("proofs: no gappa: skipped")
        sys.exit(77)
    wrong, tried = [], 0
    for name, _, _, shown, *_ in rows():
        for script in scripts_of(shown) if name in TIGHT else []:
            text = (SCRIPTS / script).read_text()
            if not script.endswith(".g"):
                continue
            tried += 1
            if gappa(text)[0] != 0:
                wrong.append(f"{script}: not proven as it is")
            if shrink(text, name) == text or gappa(shrink(text, name))[0] == 0:
                wrong.append(f"{name}: proven although it is a tenth smaller")
    return wrong + ([] if tried == len(TIGHT) else [f"expected {len(TIGHT)} scripts, found {tried}"])


if __name__ == "__main__":
    commands = {"tie": tie, "prove": prove, "shrunk": shrunk}
    if len(sys.argv) != 2 or sys.argv[1] not in commands:
        sys.exit("expected one of: " + ", ".join(commands))
    problems = commands[sys.argv[1]]()
    for problem in problems:
        print(problem, file=sys.stderr)
    sys.exit(1 if problems else 0)
