// tests/house/object_names.h: names that two objects define for the linker, of which it takes one
// without a word or, where both are strong, whichever library comes first.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace foretouch::house {

struct Clash {
  std::string name;               ///< As the linker has it, mangled.
  std::set<std::string> objects;  ///< Of different sources, at least two.
};

/// Reads what `nm -A -g --defined-only` prints of object files. A name that several objects define
/// weakly is one of a header's; one that is strong in any of them has a source of its own, and may
/// be in no other. One source in two targets is one source.
[[nodiscard]] std::vector<Clash> clashesIn(const std::string& namesOfObjects);

}  // namespace foretouch::house
