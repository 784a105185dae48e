#include "tools/json_text.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lss/assert.h"

namespace foretouch::tools {

std::string numberText(double value) {
  FORETOUCH_ASSERT(std::isfinite(value));
  return fmt::format("{}", value);
}

std::string jsonString(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonList(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? "," : "") + jsonString(text);
  return out + "]";
}

std::string jsonFileName(const std::string& path) {
  return jsonString(std::filesystem::path(path).filename().string());
}

}  // namespace foretouch::tools
