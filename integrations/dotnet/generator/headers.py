"""Reads the headers of the C library, which have one regular shape: opaque handles, structs, anonymous
enums, functions that FT_API introduces, and constants. What it does not know is an error that names
file and line, so nothing is left out unseen."""
import re
from dataclasses import dataclass, field
from pathlib import Path

ORDER = ["foretouch", "mechanics", "person", "robots", "solid", "world", "events", "triggers", "ask", "solid_world"]


class Unknown(Exception):
    """What the headers have and this reader does not know."""


@dataclass
class Variable:
    """A field of a struct, or a parameter."""
    name: str
    base: str  # "double", "ft_lss"
    stars: int  # 2: const char* const*
    is_const: bool  # what the first star points to
    length: int = 0  # of an array; 0: none
    doc: str = ""


@dataclass
class Struct:
    name: str
    fields: list
    doc: str = ""


@dataclass
class Enum:
    values: list  # of (name, number, doc)
    doc: str = ""


@dataclass
class Function:
    name: str
    returns: Variable
    parameters: list
    doc: str = ""


@dataclass
class Handle:
    name: str
    doc: str = ""


@dataclass
class Constant:
    name: str
    value: int
    doc: str = ""


@dataclass
class Header:
    name: str
    items: list = field(default_factory=list)

    def of(self, kind):
        return [item for item in self.items if isinstance(item, kind)]


COMMENT = re.compile(r"/\*(.*?)\*/", re.S)


def words(comment):
    lines = (re.sub(r"^\s*\*+ ?", "", line).strip() for line in comment.split("\n"))
    return " ".join(line for line in lines if line)


def without_comments(text):
    return re.sub(r"\s+", " ", COMMENT.sub(" ", text)).strip()


def pieces(text, where):
    """(code, doc) of each declaration in `text`: doc is the comment before it, without an empty line
    between, or else behind it on its line."""
    at, doc = 0, ""
    while at < len(text):
        blank = re.compile(r"\s*").match(text, at)
        if blank.group().count("\n") > 1:
            doc = ""
        at = blank.end()
        if at == len(text):
            return
        comment = COMMENT.match(text, at)
        if comment:
            doc, at = words(comment.group(1)), comment.end()
            continue
        begin, at = at, end_of_declaration(text, at, where)
        code = text[begin:at]
        behind = re.compile(r"[ \t]*/\*(.*?)\*/", re.S).match(text, at)
        if behind:
            doc, at = (doc + " " + words(behind.group(1))).strip(), behind.end()
        yield code, doc
        doc = ""


def end_of_declaration(text, at, where):
    if text[at] == "#":
        return text.index("\n", at)
    if text.startswith('extern "C" {', at):
        return at + len('extern "C" {')
    if text[at] == "}":  # of extern "C"
        return at + 1
    depth, begin = 0, at
    while at < len(text):
        comment = COMMENT.match(text, at)
        if comment:
            at = comment.end()
            continue
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
        if text[at - 1] == ";" and depth == 0:
            return at
    raise Unknown(f"{where}: expected ';' after '{text[begin:begin + 60]}'")


def variables(code, doc, constants, where):
    """The variables of "double a[3], b[3], radius"."""
    found = re.fullmatch(r"(const )?(\w+)(.*)", code)
    if not found:
        raise Unknown(f"{where}: expected a type and names, found '{code}'")
    for declarator in found[3].split(","):
        one = re.fullmatch(r"\s*((?:\*\s*(?:const)?\s*)*)(\w+)(?:\[(\w+)\])?", declarator)
        if not one:
            raise Unknown(f"{where}: expected a name, found '{declarator}' in '{code}'")
        length = constants.get(one[3]) or int(one[3]) if one[3] else 0
        yield Variable(one[2], found[2], one[1].count("*"), bool(found[1]), length, doc)


class Reader:
    def __init__(self):
        self.constants = {}

    def header(self, path):
        text = re.sub(r'^#if defined\(_WIN32\).*?^#endif\n', "", path.read_text(), count=1, flags=re.S | re.M)
        header = Header(path.stem)
        for code, doc in pieces(text, path.name):
            line = text[:text.index(code)].count("\n") + 1
            item = self.item(code, doc, f"{path.name}:{line}")
            if item:
                header.items.append(item)
        return header

    def item(self, code, doc, where):
        plain = without_comments(code)
        if code.startswith("#"):
            return self.define(code, doc)
        if plain in ('extern "C" {', "}", "typedef int32_t ft_status;"):
            return None
        found = re.fullmatch(r"typedef struct (\w+) (\w+);", plain)
        if found and found[1] == found[2]:
            return Handle(found[1], doc)
        found = re.match(r"typedef struct (\w+) \{", plain)
        if found:
            return self.struct(found[1], code, doc, where)
        if plain.startswith("enum {"):
            return self.enum(code, doc, where)
        if plain.startswith("FT_API "):
            return self.function(plain, doc, where)
        raise Unknown(f"{where}: expected a handle, struct, enum or function, found '{plain[:80]}'")

    def define(self, code, doc):
        found = re.fullmatch(r"#define (FT_\w+) \(?(-?\d+)\)?", code.strip())
        if not found:
            return None  # guards, and FT_CHECK_ABI()
        self.constants[found[1]] = int(found[2])
        return Constant(found[1], int(found[2]), doc)

    def struct(self, name, code, doc, where):
        body = code[code.index("{") + 1:code.rindex("}")]
        if not re.fullmatch(r"\s*" + name + r"\s*;", code[code.rindex("}") + 1:]):
            raise Unknown(f"{where}: expected '{name};' behind its struct")
        fields = []
        for one, comment in pieces(body, where):
            fields += variables(without_comments(one).rstrip("; "), comment, self.constants, where)
        return Struct(name, fields, doc)

    def enum(self, code, doc, where):
        body = code[code.index("{") + 1:code.rindex("}")]
        values = []
        for entry in without_comments(body).split(","):
            found = re.fullmatch(r"\s*(FT_\w+) = (-?\d+)\s*", entry)
            if not found:
                raise Unknown(f"{where}: expected FT_NAME = number, found '{entry}'")
            behind = re.search(found[1] + r"\s*=\s*-?\d+,?\s*/\*(.*?)\*/", body, re.S)
            values.append((found[1], int(found[2]), words(behind[1]) if behind else ""))
        return Enum(values, doc)

    def function(self, plain, doc, where):
        found = re.fullmatch(r"FT_API (.+?)(ft_\w+)\((.*)\);", plain)
        if not found:
            raise Unknown(f"{where}: expected FT_API and a function, found '{plain[:80]}'")
        returns = next(variables(found[1].strip() + " returned", "", self.constants, where))
        parameters = []
        if found[3] != "void":
            for one in found[3].split(","):
                parameters += variables(one.strip(), "", self.constants, where)
        return Function(found[2], returns, parameters, doc)


def read_headers(folder):
    found = {path.stem for path in Path(folder).glob("*.h")}
    if found != set(ORDER):
        raise Unknown(f"{folder}: expected the headers {sorted(ORDER)}, found {sorted(found)}")
    reader = Reader()
    return [reader.header(Path(folder) / (name + ".h")) for name in ORDER]
