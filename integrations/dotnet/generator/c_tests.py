"""Writes C for the tests: how structs lie in memory, by the compiler, and every field of a struct as
text, as tests/Dump.cs has them in C#."""
from headers import Struct

KIND = ('#define KIND(x) _Generic((x), int32_t: "int", uint32_t: "uint", int64_t: "long", \\\n'
        '    uint64_t: "ulong", double: "double", float: "float", uint8_t: "byte", default: "other")\n')


def includes(headers):
    return ("#include <inttypes.h>\n#include <stddef.h>\n#include <stdio.h>\n#include <string.h>\n" +
            "".join(f"#include <foretouch/{header.name}.h>\n" for header in headers))


def structs(headers):
    return [item for header in headers for item in header.of(Struct)]


def kind(v):
    if v.stars:
        return '"pointer"'
    if v.base.startswith("ft_") and v.base != "ft_status":
        return f'"{v.base}"'
    return None


def layout_program(headers):
    lines = []
    for s in structs(headers):
        lines.append(f'  printf("{s.name} size %zu\\n", sizeof({s.name}));')
        for v in s.fields:
            of = f"(({s.name}*)0)->{v.name}"
            element = f"{of}[0]" if v.length else of
            lines.append(f'  printf("{s.name}.{v.name} %zu %zu x%zu %s\\n", offsetof({s.name}, {v.name}), '
                         f'sizeof({of}), sizeof({of}) / sizeof({element}), {kind(v) or f"KIND({element})"});')
    return includes(headers) + KIND + "int main(void) {\n" + "\n".join(lines) + "\n  return 0;\n}\n"


def dump_header(headers):
    """dump_ft_x(const ft_x*) prints a struct's fields, doubles as their bits; not what points."""
    text = includes(headers) + DUMP_NUMBERS
    for s in structs(headers):
        if any(v.stars for v in s.fields):
            continue
        lines = "".join("  " + dump_field(v) + "\n" for v in s.fields)
        text += f"static void dump_{s.name}(const {s.name}* of) {{\n{lines}}}\n"
    return text


def dump_field(v):
    call = f"dump_{v.base}" if v.base.startswith("ft_") else "dump_bits" if v.base == "double" else "dump_number"
    value = "of->" + v.name
    by_pointer = v.base.startswith("ft_")
    if v.length:
        argument = f"&{value}[i]" if by_pointer else f"{value}[i]"
        return f"{{ int i; for (i = 0; i < {v.length}; ++i) {call}({argument}); }}"
    return f"{call}({'&' if by_pointer else ''}{value});"


DUMP_NUMBERS = """#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
static void dump_bits(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  printf(" %016" PRIx64, bits);
}
static void dump_number(int64_t value) { printf(" %" PRId64, value); }
"""
