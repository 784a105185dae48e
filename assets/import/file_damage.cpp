#include "assets/import/file_damage.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>

#include "assets/import/text.h"
#include "assets/import/xml_damage.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

/// Is it one of the XML formats among those that assimp reads?
bool isXml(const std::string& extension) {
  constexpr std::array<std::string_view, 6> kExtensions{".dae", ".x3d",     ".amf",
                                                        ".irr", ".irrmesh", ".xml"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::string damageOfXmlFile(const std::string& path) {
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  const auto text = readWholeFile(path, kMaxBytes);
  return text.ok() ? damageOfXml(text.value()) : "";
}

}  // namespace

std::optional<std::string> damageOf(const std::string& path) {
  try {
    const std::string extension = lowerExtensionOf(path);
    std::string damage;
    if (isXml(extension)) damage = damageOfXmlFile(path);
    if (!damage.empty()) return damage;
  } catch (const std::exception&) {
    // Out of memory, for example: the reader's own reason must do.
  }
  return std::nullopt;
}

}  // namespace foretouch::internal
