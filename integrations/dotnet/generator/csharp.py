"""Writes the headers as C#: ft_world_contact becomes FtWorldContact, its field time_us timeUs, and
FT_VERDICT_CLEAR FtVerdict.Clear; functions keep their names, in FtNative."""
from os.path import commonprefix

from headers import Constant, Enum, Function, Handle, Struct, Unknown
from methods import Methods
from names import INTEGERS, SCALARS, field_name, summary, type_name, upper

HEAD = "// Written by generator/generate.py of foretouch/{header}.h. Change that, not this.\n"


def array_type(variable):
    """An array becomes a struct of as many: with x, y, z for three numbers, so that nobody needs
    `unsafe` to read a normal."""
    if variable.base == "double":
        return {3: "FtVector", 4: "FtRotation", 9: "FtMatrix"}.get(variable.length)
    if type_name(variable.base):
        return f"{type_name(variable.base)}Of{variable.length}"
    return None


class Writer:
    def __init__(self, headers):
        self.handles = {item.name for header in headers for item in header.of(Handle)}
        self.structs = {item.name for header in headers for item in header.of(Struct)}
        self.methods = Methods(headers)

    def file(self, header):
        types = "".join(self.item(item) for item in header.items if not isinstance(item, (Function, Constant)))
        constants = "".join(f"{summary(c.doc, '    ')}    public const int {upper(c.name[3:])} = {c.value};\n"
                            for c in header.of(Constant))
        if constants:
            types += f"  public static partial class Ft {{\n{constants}  }}\n"
        functions = "".join(self.function(item) for item in header.of(Function))
        return (HEAD.format(header=header.name) + "using System;\nusing System.Runtime.InteropServices;\n\n" +
                "namespace Foretouch {\n" + types + self.methods.of_header(header, self.handles) +
                f"  public static unsafe partial class FtNative {{\n{functions}  }}\n}}\n")

    def item(self, item):
        return {Handle: self.handle, Struct: self.struct, Enum: self.enum}[type(item)](item)

    def handle(self, item):
        name = type_name(item.name)
        return (summary(item.doc, "  ") +
                f"  public sealed unsafe partial class {name} : FtHandle {{\n"
                f"    /// <summary>In place of one that is not there: NULL in C.</summary>\n"
                f"    public static readonly {name} None = new {name}();\n"
                f"    protected override bool ReleaseHandle() {{ FtNative.{item.name}_destroy(handle); return true; }}\n"
                "  }\n")

    def struct(self, item):
        # One with pointers is for unsafe code alone.
        unsafe = "unsafe " if any(v.stars for v in item.fields) else ""
        fields = "".join(summary(v.doc, "    ") + f"    public {self.field_type(v, item.name)} {field_name(v.name)};\n"
                         for v in item.fields)
        text = (summary(item.doc, "  ") + "  [StructLayout(LayoutKind.Sequential)]\n"
                f"  public {unsafe}partial struct {type_name(item.name)} {{\n{fields}  }}\n")
        return text + "".join(self.array(v) for v in item.fields if v.length and v.base != "double")

    def field_type(self, v, where):
        if v.length:
            name = array_type(v)
            if not name or v.stars:
                raise Unknown(f"{where}.{v.name}: expected an array of 3, 4 or 9 numbers, or of structs")
            return name
        if v.stars and v.base in self.handles:
            return "IntPtr" + "*" * (v.stars - 1)
        return self.plain(v, where)

    def plain(self, v, where):
        name = SCALARS.get(v.base) or (type_name(v.base) if v.base in self.structs else None)
        if not name:
            raise Unknown(f"{where}.{v.name}: expected a known type, found '{v.base}'")
        return name + "*" * v.stars

    def array(self, v):
        name, element = array_type(v), type_name(v.base)
        names = [f"item{i}" for i in range(v.length)]
        cases = "".join(f"          case {i}: return item{i};\n" for i in range(v.length))
        return (f"  [StructLayout(LayoutKind.Sequential)]\n  public struct {name} {{\n"
                f"    public {element} {', '.join(names)};\n    public {element} this[int index] {{\n"
                f"      get {{\n        switch (index) {{\n{cases}"
                "          default: throw new IndexOutOfRangeException();\n        }\n      }\n    }\n  }\n")

    def enum(self, item):
        """Constants in a class of their own, or in the struct or handle that has its name."""
        names = [name for name, _, _ in item.values]
        prefix = commonprefix(names) if len(names) > 1 else names[0][:names[0].rindex("_") + 1]
        prefix = prefix[:prefix.rindex("_") + 1]
        name = "FtStatus" if prefix == "FT_" else "Ft" + upper(prefix[3:-1])
        kind = "static partial class"
        if name in {type_name(one) for one in self.handles}:
            kind = "sealed partial class"
        elif name in {type_name(one) for one in self.structs}:
            kind = "partial struct"
        values = "".join(f"{summary(doc, '    ')}    public const int {upper(one[len(prefix):])} = {number};\n"
                         for one, number, doc in item.values)
        doc = summary(item.doc, "  ") if kind.startswith("static") else ""
        return f"{doc}  public {kind} {name} {{\n{values}  }}\n"

    def function(self, item):
        where = item.name
        returned = self.plain(item.returns, where)
        parameters = ", ".join(self.parameter(v, item) for v in item.parameters)
        return (summary(item.doc, "    ") +
                f"    [DllImport(Library)] public static extern {returned} {item.name}({parameters});\n")

    def parameter(self, v, function):
        name = field_name(v.name)
        if v.base in self.handles:
            if v.stars == 2:
                return f"out {type_name(v.base)} {name}"
            # A SafeHandle cannot be used after it was disposed, nor be collected during the call.
            return f"IntPtr {name}" if function.name.endswith("_destroy") else f"{type_name(v.base)} {name}"
        if v.length:
            return f"{SCALARS[v.base]}* {name}"
        if v.stars == 1 and v.base in INTEGERS and not v.is_const:
            return f"out {SCALARS[v.base]} {name}"  # one number, which the function stores
        return f"{self.plain(v, function.name)} {name}"
