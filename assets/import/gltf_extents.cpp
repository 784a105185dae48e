#include "assets/import/gltf_extents.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "assets/import/side_files.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

std::uint64_t numberAt(const json& object, const char* key, std::uint64_t otherwise) {
  return object.value(key, otherwise);
}

std::string placed(const char* list, std::size_t i, const char* key = nullptr) {
  const std::string place = std::string(list) + "[" + std::to_string(i) + "]";
  return key == nullptr ? place : place + "." + key;
}

std::string bytesText(std::uint64_t count) {
  return std::to_string(count) + (count == 1 ? " byte" : " bytes");
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// A relative reference as a file's name: "%20" is a blank.
std::string decodedUri(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexadecimal(uri[i + 2]) : -1;
    if (low >= 0) i += 2;
    name += low >= 0 ? static_cast<char>(16 * high + low) : uri[i];
  }
  return name;
}

/// The number of bytes in a data URI; nothing if it is not in base64.
std::optional<std::uint64_t> dataBytes(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  const std::string_view head = uri.substr(0, comma);
  constexpr std::string_view kBase64 = ";base64";
  if (comma == std::string_view::npos || head.size() < kBase64.size() ||
      head.substr(head.size() - kBase64.size()) != kBase64) {
    return std::nullopt;
  }
  std::string_view digits = uri.substr(comma + 1);
  while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
  return digits.size() * 3 / 4;
}

class Extents {
 public:
  Extents(const json& document, const GltfSources& sources, Faults& faults)
      : document_(document), sources_(sources), faults_(faults) {}

  void check() {
    forEach("buffers", [&](const json& buffer, std::size_t i) { checkBuffer(buffer, i); });
    forEach("bufferViews", [&](const json& view, std::size_t i) { checkView(view, i); });
    forEach("accessors", [&](const json& accessor, std::size_t i) { checkAccessor(accessor, i); });
  }

 private:
  template <typename Take>
  void forEach(const char* list, const Take& take) {
    const auto found = document_.find(list);
    if (found == document_.end() || !found->is_array()) return;
    for (std::size_t i = 0; i < found->size() && !faults_.isFull(); ++i) take((*found)[i], i);
  }

  void checkBuffer(const json& buffer, std::size_t i) {
    if (!buffer.contains("uri")) return checkChunk(buffer, i);
    const auto& uri = buffer["uri"].get_ref<const std::string&>();
    if (uri.rfind("data:", 0) == 0) {
      const auto bytes = dataBytes(uri);
      if (bytes) checkHeld(buffer, i, *bytes, "its data URI");
      return;
    }
    const std::string name = decodedUri(uri);
    const std::string path = (std::filesystem::path(sources_.folder) / name).string();
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(path, unknown);
    if (!unknown &&
        !isSideFile((std::filesystem::path(sources_.folder) / "model").string(), path)) {
      faults_.add(placed("buffers", i, "uri"),
                  std::string("expected ") + kSideFileRule + ", found " + inQuotes(name));
    } else if (unknown) {
      faults_.add(placed("buffers", i, "uri"), "expected a file beside this one, found " +
                                                   inQuotes(name) + ": " + unknown.message());
    } else {
      checkHeld(buffer, i, bytes, "the file " + inQuotes(name));
    }
  }

  void checkChunk(const json& buffer, std::size_t i) {
    if (i == 0 && sources_.binaryBytes) {
      checkHeld(buffer, i, *sources_.binaryBytes, "the file's binary chunk");
    } else {
      faults_.add(placed("buffers", i), sources_.isBinary && i == 0
                                            ? "expected a binary chunk in the file, as the buffer "
                                              "has no uri, found none"
                                            : "expected a uri, found none");
    }
  }

  void checkHeld(const json& buffer, std::size_t i, std::uint64_t bytes, const std::string& what) {
    const std::uint64_t length = numberAt(buffer, "byteLength", 0);
    if (length <= bytes) return;
    faults_.add(placed("buffers", i, "byteLength"), "expected at most the " + bytesText(bytes) +
                                                        " of " + what + ", found " +
                                                        std::to_string(length));
  }

  void checkView(const json& view, std::size_t i) {
    const auto buffer = view["buffer"].get<std::size_t>();
    const std::uint64_t held = numberAt(document_["buffers"][buffer], "byteLength", 0);
    const std::uint64_t offset = numberAt(view, "byteOffset", 0);
    const std::uint64_t length = numberAt(view, "byteLength", 0);
    if (offset <= held && length <= held - offset) return;
    faults_.add(placed("bufferViews", i), "expected bytes within the " + bytesText(held) + " of " +
                                              placed("buffers", buffer) + ", found " +
                                              bytesText(length) + " from byte " +
                                              std::to_string(offset) + " on");
  }

  void checkAccessor(const json& accessor, std::size_t i) {
    if (!accessor.contains("bufferView")) return;
    const auto index = accessor["bufferView"].get<std::size_t>();
    const json& view = document_["bufferViews"][index];
    const ElementShape shape = elementShape(accessor["type"]);
    const std::uint64_t component = componentBytes(accessor["componentType"]);
    // Columns of matrices begin at multiples of four bytes.
    const std::uint64_t column =
        shape.columns > 1 ? (shape.rows * component + 3) / 4 * 4 : shape.rows * component;
    const std::uint64_t element = column * shape.columns;
    const std::uint64_t given = numberAt(view, "byteStride", 0);
    const std::uint64_t stride = given == 0 ? element : given;
    const std::uint64_t held = numberAt(view, "byteLength", 0);
    const std::uint64_t offset = numberAt(accessor, "byteOffset", 0);
    const std::uint64_t count = numberAt(accessor, "count", 0);
    const std::uint64_t place = numberAt(view, "byteOffset", 0) + offset;
    if (count == 0) {
      faults_.add(placed("accessors", i, "count"), "expected 1 or above, found 0");
    } else if (offset > held || element > held - offset ||
               count - 1 > (held - offset - element) / stride) {
      faults_.add(placed("accessors", i), "expected elements within the " + bytesText(held) +
                                              " of " + placed("bufferViews", index) + ", found " +
                                              std::to_string(count) + " of them, " +
                                              bytesText(stride) + " apart, from byte " +
                                              std::to_string(offset) + " on");
    } else if (place % component != 0) {
      faults_.add(placed("accessors", i), "expected to begin at a multiple of " +
                                              bytesText(component) + " of the buffer, found byte " +
                                              std::to_string(place));
    }
  }

  const json& document_;
  const GltfSources& sources_;
  Faults& faults_;
};

}  // namespace

std::uint64_t componentBytes(const json& componentType) {
  if (!componentType.is_number_unsigned()) return 0;
  switch (componentType.get<std::uint64_t>()) {
    case 5120:
    case 5121: return 1;
    case 5122:
    case 5123: return 2;
    case 5125:
    case 5126: return 4;
    default: return 0;
  }
}

ElementShape elementShape(const json& type) {
  if (type == "SCALAR") return {1, 1};
  if (type == "VEC2") return {2, 1};
  if (type == "VEC3") return {3, 1};
  if (type == "VEC4") return {4, 1};
  if (type == "MAT2") return {2, 2};
  if (type == "MAT3") return {3, 3};
  return type == "MAT4" ? ElementShape{4, 4} : ElementShape{};
}

void checkExtents(const json& document, const GltfSources& sources, Faults& faults) {
  Extents(document, sources, faults).check();
}

}  // namespace foretouch::internal
