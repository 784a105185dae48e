// tests/house/defined_names.h: what a C++ file defines at the scope of a namespace, found in its
// text. A linker sees a name that two sources define only where the compiler left it in both: an
// inlined function or a folded constant leaves no trace. The text always shows it.
#pragma once

#include <string>
#include <vector>

namespace foretouch::house {

enum class NameKind { Function, Type, Variable };

struct DefinedName {
  NameKind kind = NameKind::Variable;
  std::string name;      ///< With its namespaces; a function with the types of its parameters.
  int line = 0;          ///< Counted from 1.
  bool isLocal = false;  ///< In an anonymous namespace: another file may have one of its own.
};

/// What `source` defines at namespace scope, in order. Members of classes are their class's.
[[nodiscard]] std::vector<DefinedName> definedNames(const std::string& source);

}  // namespace foretouch::house
