#include "assets/import/text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::size_t kLongestSequence = 4;

/// The well-formed UTF-8 sequence at the start of `text`; empty if there is none.
std::string_view firstCharacter(std::string_view text) {
  for (std::size_t length = 1; length <= kLongestSequence && length <= text.size(); ++length) {
    if (isUtf8(text.substr(0, length))) return text.substr(0, length);
  }
  return {};
}

bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

}  // namespace

std::string readableText(std::string_view text, std::size_t limitBytes) {
  std::string readable;
  while (!text.empty()) {
    const std::string_view character = firstCharacter(text);
    std::string_view shown = character;
    if (character.empty()) {
      shown = kReplacement;
    } else if (isControl(character)) {
      shown = " ";
    }
    text.remove_prefix(character.empty() ? 1 : character.size());
    if (readable.empty() && shown == " ") continue;
    if (readable.size() + shown.size() > limitBytes) break;
    readable += shown;
  }
  while (!readable.empty() && readable.back() == ' ') readable.pop_back();
  return readable;
}

std::string quotedName(std::string_view name) {
  return "'" + readableText(name, 120) + "'";
}

std::vector<std::string> skippedNotes(std::uint64_t primitives, std::uint64_t faces) {
  std::vector<std::string> notes;
  if (primitives > 0) {
    notes.push_back(std::to_string(primitives) +
                    " points and lines are left out: they have no surface");
  }
  if (faces > 0) {
    notes.push_back(std::to_string(faces) + " faces with vertex indices out of range are left out");
  }
  return notes;
}

std::string lowerExtensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace foretouch::internal
