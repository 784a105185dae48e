"""Small wrong changes of C++ sources, as text: a comparison turned, a bound halved, a sign lost, a
term dropped, an index off by one. Sources have the house's layout, in which binary operators stand
between spaces and template brackets do not."""
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    path: str  # from the repository's root
    line: int  # from 1
    column: int
    operator: str
    before: str
    after: str
    text: str  # the line as it was

    def applied(self, source):
        lines = source.split("\n")
        line = lines[self.line - 1]
        assert line[self.column:self.column + len(self.before)] == self.before
        lines[self.line - 1] = line[:self.column] + self.after + line[self.column + len(self.before):]
        return "\n".join(lines)

    @property
    def name(self):
        return f"{self.path}:{self.line}: {self.before.strip()} -> {self.after.strip() or 'nothing'}"

    @property
    def key(self):
        """The same while the line stays, wherever it moves."""
        return f"{self.path}: {self.text.strip()}: {self.column - len(self.text) + len(self.text.lstrip())}: " \
               f"{self.before.strip()} -> {self.after.strip() or 'nothing'}"


SWAPS = [
    ("comparison", {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > "}),
    ("comparison turned", {" < ": " >= ", " <= ": " > ", " > ": " <= ", " >= ": " < "}),
    ("equality", {" == ": " != ", " != ": " == "}),
    ("sign", {" + ": " - ", " - ": " + ", " += ": " -= ", " -= ": " += "}),
    ("product", {" * ": " / ", " / ": " * "}),
    ("logic", {" && ": " || ", " || ": " && "}),
    ("extreme", {"std::min(": "std::max(", "std::max(": "std::min("}),
    ("truth", {"return true;": "return false;", "return false;": "return true;"}),
    ("off by one", {" + 1]": "]", " - 1]": "]"}),
]
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|0x1p[+-]\d+)(?![\w.])")
INDEX = re.compile(r"\[([a-z])\]")
MINUS = re.compile(r"(?<=[(,=] )-(?=[a-zA-Z(])|(?<=\()-(?=[a-zA-Z(])|(?<=return )-(?=[a-zA-Z(])")
TERM = re.compile(r" [+-] (?:[\w.]+(?:::\w+)*(?:\[\w+\])?(?:\([\w., ]*\))?)(?= [+-]|[;,)])")
STATEMENT = re.compile(r"^(\s+)([\w.\[\]>-]+ (?:[+*|-]?=) [^;]*;|[\w.:>-]+\([^;]*\);)$")

# What no test of behaviour can see: checks of the compiler and of our own mistakes, texts.
BLIND = re.compile(r"static_assert|FORETOUCH_ASSERT|^\s*#|template|operator|^\s*using |\.reserve\(|reserve\(|"
                   r"[Ee]rror::|toString|describe|#pragma|shrink_to_fit")


def code_of(line):
    """The line with texts and comments blanked out, every column where it was."""
    line = re.sub(r'"(?:\\.|[^"\\])*"', lambda m: " " * len(m.group()), line)
    line = re.sub(r"'(?:\\.|[^'\\])'", lambda m: " " * len(m.group()), line)
    cut = line.find("//")
    return line if cut < 0 else line[:cut] + " " * (len(line) - cut)


def mutants_of(path, source):
    in_comment = False
    for number, text in enumerate(source.split("\n"), 1):
        if "/*" in text:
            in_comment = True
        if in_comment:
            in_comment = "*/" not in text
            continue
        if BLIND.search(text):
            continue
        code = code_of(text)

        def made(operator, column, before, after):
            return Mutant(path, number, column, operator, before, after, text)

        for operator, swaps in SWAPS:
            for before, after in swaps.items():
                at = code.find(before)
                while at >= 0:
                    yield made(operator, at, before, after)
                    at = code.find(before, at + 1)
        for found in NUMBER.finditer(code):
            number_text = found.group()
            if float.fromhex(number_text) if "0x" in number_text else float(number_text):
                yield made("bound halved", found.start(), number_text, f"(0.5 * {number_text})")
        for found in INDEX.finditer(code):
            yield made("off by one", found.start(), found.group(), f"[{found.group(1)} + 1]")
        for found in MINUS.finditer(code):
            yield made("sign lost", found.start(), "-", "")
        for found in TERM.finditer(code):
            yield made("term dropped", found.start(), found.group(), "")
        found = STATEMENT.match(code.rstrip())
        if found and "const " not in code and "return" not in code:
            yield made("statement dropped", found.start(2), text[found.start(2):found.end(2)], ";")
