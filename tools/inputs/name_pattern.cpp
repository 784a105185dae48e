#include "tools/inputs/name_pattern.h"

namespace foretouch::tools {

bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  const bool anyEnding = pattern.back() == '*';
  if (anyEnding) pattern.remove_suffix(1);
  const bool anyBeginning = !pattern.empty() && pattern.front() == '*';
  if (anyBeginning) pattern.remove_prefix(1);
  if (name.size() < pattern.size()) return false;
  if (anyBeginning && anyEnding) return name.find(pattern) != std::string_view::npos;
  if (anyBeginning) return name.substr(name.size() - pattern.size()) == pattern;
  return anyEnding ? name.substr(0, pattern.size()) == pattern : name == pattern;
}

std::vector<std::int32_t> matching(std::string_view pattern,
                                   const std::vector<std::string>& names) {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (matches(pattern, names[i])) found.push_back(static_cast<std::int32_t>(i));
  }
  return found;
}

}  // namespace foretouch::tools
