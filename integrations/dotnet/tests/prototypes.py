"""The functions of the C library's headers, as pycparser reads them: a reader that shares nothing with
generator/headers.py. Prints each as tests/Layouts.cs prints those of C#.
  prototypes.py FOLDER_OF_HEADERS"""
import subprocess
import sys
from pathlib import Path

from pycparser import c_ast, c_parser

WORDS = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "uint8_t": "byte", "double": "double",
         "float": "float", "ft_status": "int", "size_t": "ulong", "void": "void"}
# In place of the system's headers, which use what pycparser does not know.
TYPES = "typedef signed char int8_t; typedef unsigned char uint8_t; typedef int int32_t; typedef unsigned uint32_t; " \
        "typedef long int64_t; typedef unsigned long uint64_t; typedef unsigned long size_t;\n"


def preprocessed(folder):
    text = "".join(f"#include <foretouch/{path.name}>\n" for path in sorted(Path(folder).glob("*.h")))
    command = ["cc", "-E", "-P", "-std=c99", "-nostdinc", "-isystem", str(Path(__file__).parent / "no_headers"),
               "-D__attribute__(x)=", "-I", str(Path(folder).parent), "-x", "c", "-"]
    return TYPES + subprocess.run(command, input=text, text=True, check=True, capture_output=True).stdout


def opaque(tree):
    """Handles: structs that are named and never defined."""
    return {node.name for node in tree.ext if isinstance(node, c_ast.Typedef) and isinstance(node.type, c_ast.TypeDecl)
            and isinstance(node.type.type, c_ast.Struct) and node.type.type.decls is None}


def word(kind, handles):
    if isinstance(kind, (c_ast.PtrDecl, c_ast.ArrayDecl)):
        target = kind.type
        if isinstance(target, c_ast.TypeDecl) and isinstance(target.type, c_ast.IdentifierType) and \
                target.type.names[0] in handles:
            return "handle"
        return "pointer"
    return WORDS[" ".join(kind.type.names)]


def main(folder):
    tree = c_parser.CParser().parse(preprocessed(folder))
    handles = opaque(tree)
    for node in tree.ext:
        if not (isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl)):
            continue
        parameters = [word(p.type, handles) for p in node.type.args.params]
        print(f"{word(node.type.type, handles)} {node.name}({', '.join(p for p in parameters if p != 'void')})")


if __name__ == "__main__":
    main(sys.argv[1])
