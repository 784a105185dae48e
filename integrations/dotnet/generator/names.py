"""How the names and types of C are called in C#, and the header's comments as documentation."""
import textwrap
from xml.sax.saxutils import escape

SCALARS = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "double": "double",
           "float": "float", "uint8_t": "byte", "char": "byte", "ft_status": "int", "void": "void",
           "size_t": "ulong"}  # on machines of 64 bits, which Ft.CheckLibrary() insists on
INTEGERS = {"int32_t", "int64_t", "uint64_t", "size_t", "uint8_t"}
KEYWORDS = {"object", "from", "in", "out", "ref", "event", "params", "is", "as", "base", "long", "fixed"}


def upper(snake):
    return "".join(part[:1].upper() + part[1:].lower() for part in snake.split("_"))


def field_name(snake):
    camel = upper(snake)
    camel = camel[:1].lower() + camel[1:]
    return "@" + camel if camel in KEYWORDS else camel


def type_name(c_name):
    return "Ft" + upper(c_name[len("ft_"):]) if c_name.startswith("ft_") and c_name != "ft_status" else None


def summary(doc, indent):
    """A comment of the header, for whoever writes C# in an editor that shows it."""
    lines = textwrap.wrap(f"<summary>{escape(doc)}</summary>", 100, break_long_words=False, break_on_hyphens=False)
    return "".join(f"{indent}/// {line}\n" for line in lines) if doc else ""
