"""Methods of handles for functions of a regular shape, so that no loop over a buffer is written by hand:
lists of structs, one struct, poses, and the usual options."""
from headers import Function, Struct
from names import SCALARS, field_name, summary, type_name, upper


class Methods:
    def __init__(self, headers):
        self.structs = {item.name: item for header in headers for item in header.of(Struct)}

    def of_header(self, header, handles):
        """The methods of all functions of a header, in their classes."""
        by_type = {}
        for function in header.of(Function):
            for owner, text in self.method(function, handles):
                by_type.setdefault(owner, []).append(text)
        return "".join(f"  public {kind} {name} {{\n{''.join(texts)}  }}\n" for (kind, name), texts in by_type.items())

    def method(self, f, handles):
        usual = self.usual(f)
        if usual:
            yield usual
        if not f.parameters or f.parameters[0].base not in handles or f.parameters[0].stars != 1:
            return
        owner = f.parameters[0].base
        # ft_query_links is Links(), and ft_solid_world_shown, of a world, SolidShown().
        name = upper(f.name[len("ft_"):].replace(owner[len("ft_"):] + "_", "", 1))
        for shape in (self.list, self.pose, self.single):
            text = shape(f, name)
            if text:
                yield ("sealed unsafe partial class", type_name(owner)), text

    def usual(self, f):
        if not f.name.endswith("_init") or f.parameters[0].base not in self.structs:
            return None
        name = type_name(f.parameters[0].base)
        size = f", (ulong)sizeof({name})" if len(f.parameters) == 2 else ""
        return ("unsafe partial struct", name), (
            "    /// <summary>As the library has it by default.</summary>\n"
            f"    public static {name} Usual {{\n      get {{\n        {name} usual;\n"
            f"        Ft.Must(FtNative.{f.name}(&usual{size}));\n        return usual;\n      }}\n    }}\n")

    def is_answer(self, v):
        return v.base in self.structs and v.stars == 1 and not v.is_const

    def has_size(self, v):
        first = self.structs[v.base].fields[0]
        return first.name == "size" and first.base == "uint32_t"

    @staticmethod
    def fills(f):
        """Does it end as all that fill an array, with their capacity?"""
        return [v.name for v in f.parameters[-2:]] == ["capacity", "required"]

    @staticmethod
    def numbers(parameters):
        """How numbers before the answer are declared and passed on; None: they are none."""
        if any(v.stars or v.length or v.base not in SCALARS for v in parameters):
            return None
        return [f"{'int' if v.base == 'size_t' else SCALARS[v.base]} {field_name(v.name)}" for v in parameters], \
               ["this"] + [("(ulong)" if v.base == "size_t" else "") + field_name(v.name) for v in parameters]

    def list(self, f, name):
        numbers = self.numbers(f.parameters[1:-3])
        if len(f.parameters) < 4 or not self.fills(f) or not self.is_answer(f.parameters[-3]) or not numbers:
            return None
        if f.parameters[-3].base in ("ft_other_link",):
            return None
        answer = type_name(f.parameters[-3].base)
        buffer = name[0].lower() + name[1:] + "Buffer"
        size = f"first->size = (uint)sizeof({answer});\n          " if self.has_size(f.parameters[-3]) else ""
        return (f"    readonly FtBuffer<{answer}> {buffer} = new FtBuffer<{answer}>();\n" + summary(f.doc, "    ") +
                f"    public ReadOnlySpan<{answer}> {name}({', '.join(numbers[0])}) {{\n"
                "      ulong count;\n      int status;\n      do {\n"
                f"        fixed ({answer}* first = {buffer}.Items) {{\n          {size}"
                f"status = FtNative.{f.name}({', '.join(numbers[1] + ['first', f'{buffer}.Capacity', 'out count'])});\n"
                f"        }}\n      }} while ({buffer}.HasGrown(status, count));\n"
                f"      return {buffer}.First(count);\n    }}\n")

    def pose(self, f, name):
        numbers = self.numbers(f.parameters[1:-4])
        if not self.fills(f) or [v.name for v in f.parameters[-4:-2]] != ["rotations", "translations"] or not numbers:
            return None
        passed = numbers[1] + ["into.Native->rotations", "into.Native->translations", "(ulong)into.JointCount", "out count"]
        return (summary(f.doc, "    ") + f"    public void {name}({', '.join(numbers[0] + ['FtPoseBuffer into'])}) {{\n"
                f"      ulong count;\n      Ft.Must(FtNative.{f.name}({', '.join(passed)}));\n"
                "      GC.KeepAlive(into);\n    }\n")

    def single(self, f, name):
        numbers = self.numbers(f.parameters[1:-1])
        last = f.parameters[-1]
        if len(f.parameters) < 2 or not self.is_answer(last) or not self.has_size(last) or not numbers:
            return None
        answer = type_name(last.base)
        return (summary(f.doc, "    ") + f"    public {answer} {name}({', '.join(numbers[0])}) {{\n"
                f"      var answer = new {answer} {{ size = (uint)sizeof({answer}) }};\n"
                f"      Ft.Must(FtNative.{f.name}({', '.join(numbers[1] + ['&answer'])}));\n      return answer;\n    }}\n")
