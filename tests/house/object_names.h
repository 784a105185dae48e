// tests/house/object_names.h: names that two objects define for the linker, which silently takes
// one or, if both are strong, that of the first library.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace foretouch::house {

struct Clash {
  std::string name;               ///< Mangled, as in the linker.
  std::set<std::string> objects;  ///< Of different sources, at least two.
};

/// Reads the output of `nm -A -g --defined-only` for object files. A name that several objects
/// define weakly comes from a header; one that is strong in any of them belongs to one source, and
/// may be in no other. One source in two targets is one source.
[[nodiscard]] std::vector<Clash> clashesIn(const std::string& namesOfObjects);

}  // namespace foretouch::house
