// tools/json_text.h: the pieces that lines of JSON are made of.
#pragma once

#include <string>
#include <vector>

namespace foretouch::tools {

/// The shortest text that reads back as the same double. `value` is finite (asserted).
[[nodiscard]] std::string numberText(double value);

/// `text` as a JSON string with its quotes; what is not UTF-8 becomes U+FFFD.
[[nodiscard]] std::string jsonString(const std::string& text);

/// A list of such strings.
[[nodiscard]] std::string jsonList(const std::vector<std::string>& texts);

/// The name of a file without its folders, as such a string.
[[nodiscard]] std::string jsonFileName(const std::string& path);

}  // namespace foretouch::tools
