#include "tests/house/object_names.h"

#include <cctype>
#include <map>
#include <sstream>

namespace foretouch::house {
namespace {

/// `a/CMakeFiles/target.dir/b/c.cpp.o` without its target.
std::string sourceOf(const std::string& object) {
  const std::string folder = "CMakeFiles/";
  const std::size_t begin = object.find(folder);
  const std::size_t end = object.find(".dir/", begin);
  if (begin == std::string::npos || end == std::string::npos) return object;
  return object.substr(0, begin) + object.substr(end + 5);
}

struct Definers {
  std::set<std::string> strong, weak;  // sources
};

}  // namespace

std::vector<Clash> clashesIn(const std::string& namesOfObjects) {
  std::map<std::string, Definers> definers;
  std::istringstream lines(namesOfObjects);
  for (std::string line; std::getline(lines, line);) {
    // path:address type name
    const std::size_t colon = line.rfind(':');
    std::string address, type, name;
    if (colon == std::string::npos) continue;
    std::istringstream(line.substr(colon + 1)) >> address >> type >> name;
    if (name.empty() || name == "main") continue;
    const bool isWeak = type == "W" || type == "V" || type == "w" || type == "v" || type == "u";
    Definers& found = definers[name];
    (isWeak ? found.weak : found.strong).insert(sourceOf(line.substr(0, colon)));
  }
  std::vector<Clash> clashes;
  for (const auto& [name, found] : definers) {
    Clash clash{name, found.strong};
    clash.objects.insert(found.weak.begin(), found.weak.end());
    if (!found.strong.empty() && clash.objects.size() > 1) clashes.push_back(clash);
  }
  return clashes;
}

}  // namespace foretouch::house
