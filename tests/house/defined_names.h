// tests/house/defined_names.h: finds the names that a C++ file defines at namespace scope, in its
// text. A linker sees a name that two sources define only if the compiler left it in both: an
// inlined function or a folded constant leaves no trace. The text always shows it.
#pragma once

#include <string>
#include <vector>

namespace foretouch::house {

enum class NameKind { Function, Type, Variable };

struct DefinedName {
  NameKind kind = NameKind::Variable;
  std::string name;      ///< With its namespaces; a function with its parameter types.
  int line = 0;          ///< Counted from 1.
  int lastLine = 0;      ///< Of its body, if it has one; else as `line`.
  bool isLocal = false;  ///< In an anonymous namespace: another file may have the same.
};

/// The definitions of `source` at namespace scope, in order. Excludes members of classes.
[[nodiscard]] std::vector<DefinedName> definedNames(const std::string& source);

}  // namespace foretouch::house
