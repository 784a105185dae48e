#include "tools/settings/numbered_avatars.h"

#include <charconv>
#include <limits>
#include <set>

#include "articulated/try.h"
#include "assets/text_file.h"

namespace foretouch::tools {
namespace {

template <typename Whole>
Result<Whole> parseWhole(const std::string& option, const std::string& text, Whole most) {
  Whole number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, problem] = std::from_chars(text.data(), end, number);
  if (problem == std::errc() && rest == end && number >= 0 && number <= most) return number;
  return Error::in(
      option, ErrorCode::OutOfRange,
      "expected a whole number from 0 to " + std::to_string(most) + ", found " + inQuotes(text));
}

}  // namespace

Result<std::int32_t> parseAvatarId(const std::string& option, const std::string& text) {
  return parseWhole(option, text, std::numeric_limits<std::int32_t>::max());
}

Result<std::int64_t> parseUtime(const std::string& option, const std::string& text) {
  return parseWhole(option, text, std::int64_t{1} << 53);
}

Result<std::vector<NumberedAvatar>> parseNumberedAvatars(const std::string& option,
                                                         const std::vector<std::string>& texts) {
  std::vector<NumberedAvatar> avatars;
  std::set<std::int32_t> ids;
  for (const std::string& text : texts) {
    const std::size_t digits = text.find_first_not_of("0123456789");
    const bool isNumbered = digits != 0 && digits != std::string::npos && text[digits] == '=';
    NumberedAvatar avatar{1, isNumbered ? text.substr(digits + 1) : text};
    if (isNumbered) {
      FORETOUCH_TRY(avatar.id, parseAvatarId(option, text.substr(0, digits)));
    }
    if (!ids.insert(avatar.id).second) {
      return Error::in(option, ErrorCode::DuplicateName,
                       "avatar " + std::to_string(avatar.id) +
                           " is used twice (an avatar without an ID has 1); expected ID=FILE with "
                           "a different ID for each");
    }
    avatars.push_back(std::move(avatar));
  }
  return avatars;
}

}  // namespace foretouch::tools
