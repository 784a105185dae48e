#include "assets/near_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

#include "assets/text_file.h"

namespace foretouch {
namespace {

constexpr std::size_t kMaxCompared = 64;
constexpr std::size_t kMaxSuggestions = 3;

int lower(char c) {
  return std::tolower(static_cast<unsigned char>(c));
}

/// Levenshtein distance, ignoring case. Precondition: `b` is at most kMaxCompared long.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::array<std::size_t, kMaxCompared + 1> row{};
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t swapped = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min(swapped, std::min(row[j], row[j + 1]) + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string didYouMean(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > kMaxCompared) return "";
  const std::size_t reach = 1 + word.size() / 4;
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& name : names) {
    const std::size_t longer = std::max(name.size(), word.size());
    if (name.size() > kMaxCompared || longer - std::min(name.size(), word.size()) > reach) continue;
    const std::size_t distance = editDistance(word, name);
    if (distance <= reach) near.emplace_back(distance, name);
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(near.size(), kMaxSuggestions); ++i) {
    text += (i == 0 ? "; did you mean " : ", ") + inQuotes(near[i].second);
  }
  return text.empty() ? text : text + "?";
}

}  // namespace foretouch
