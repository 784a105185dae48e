// verify/json.h: as much of JSON as an avatar file needs.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace verify {

struct Json {
  enum class Kind { Null, Truth, Number, Text, Array, Object };
  Kind kind = Kind::Null;
  double number = 0.0;
  std::string text;
  bool hasEscape = false;         ///< In the text.
  std::vector<Json> items;        ///< An array's; an object's values.
  std::vector<std::string> keys;  ///< An object's, beside its values.

  [[nodiscard]] bool isPlainText() const { return kind == Kind::Text && !hasEscape; }
  /// The only value of this key; nothing: it is not an object, or lacks the key, or has it twice.
  [[nodiscard]] const Json* find(std::string_view key) const;
};

/// False if the whole text is not one value, or a key has an escape. Escapes in texts stay as they
/// are written. At most 32 deep.
[[nodiscard]] bool parseJson(std::string_view text, Json& value);

}  // namespace verify
