#include "assets/import/gltf_data.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_compression.h"
#include "assets/import/gltf_json.h"
#include "assets/import/memory_budget.h"
#include "assets/import/side_files.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

std::uint64_t numberAt(const json& object, const char* key) {
  return object.value(key, std::uint64_t{0});
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

int sixBits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

/// Nothing if the data URI is not in base64.
std::optional<std::string> dataOf(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  const std::string_view head = uri.substr(0, comma);
  constexpr std::string_view kBase64 = ";base64";
  if (comma == std::string_view::npos || head.size() < kBase64.size() ||
      head.substr(head.size() - kBase64.size()) != kBase64) {
    return std::nullopt;
  }
  std::string_view digits = uri.substr(comma + 1);
  while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
  std::string bytes;
  bytes.reserve(digits.size() * 3 / 4);
  std::uint32_t group = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const int bits = sixBits(digits[i]);
    if (bits < 0) return std::nullopt;
    group = group << 6 | static_cast<std::uint32_t>(bits);
    // Every digit but the first of four completes a byte.
    if (i % 4 != 0) bytes += static_cast<char>(group >> (4 - 2 * (i % 4 - 1)));
  }
  return bytes;
}

}  // namespace

std::string placeIn(const char* list, std::size_t i, const char* key) {
  const std::string place = std::string(list) + "[" + std::to_string(i) + "]";
  return key == nullptr ? place : place + "." + key;
}

std::string GltfData::read(const std::string& uri, std::size_t buffer) const {
  const std::string place = placeIn("buffers", buffer, "uri");
  if (uri.rfind("data:", 0) == 0) {
    auto data = dataOf(uri);
    if (!data) refuseAt(place, "expected a data URI in base64, found another one");
    return std::move(*data);
  }
  const std::string name = decodedUri(uri);
  const auto path = std::filesystem::path(file_.path).parent_path() / name;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  const bool isThere = std::filesystem::exists(path, unknown);
  if (isThere && !isSideFile(file_.path, path.string())) {
    refuseAt(place, std::string("expected ") + kSideFileRule + ", found " + inQuotes(name));
  }
  if (!isThere) {
    if (!unknown) unknown = std::make_error_code(std::errc::no_such_file_or_directory);
    refuseAt(place,
             "expected a file beside this one, found " + inQuotes(name) + ": " + unknown.message());
  }
  grantMemoryFor(size);
  auto bytes = readWholeFile(path.string(), std::size_t{1} << 40);
  if (!bytes.ok()) refuseAt(place, bytes.error().message);
  return std::move(bytes).value();
}

std::string_view GltfData::bytesOfBuffer(std::size_t buffer) {
  const json& described = at("buffers", buffer);
  const std::uint64_t length = numberAt(described, "byteLength");
  std::string_view held;
  std::string what = "the file's binary chunk";
  if (const auto uri = described.find("uri"); uri != described.end()) {
    auto found = buffers_.find(buffer);
    if (found == buffers_.end()) found = buffers_.emplace(buffer, read(*uri, buffer)).first;
    held = found->second;
    const auto& text = uri->get_ref<const std::string&>();
    what = text.rfind("data:", 0) == 0 ? "its data URI" : "the file " + inQuotes(decodedUri(text));
  } else if (buffer == 0 && file_.chunkBytes) {
    held = file_.chunk();
  } else {
    refuseAt(placeIn("buffers", buffer), file_.isBinary && buffer == 0
                                             ? "expected a binary chunk in the file, as the buffer "
                                               "has no uri, found none"
                                             : "expected a uri, found none");
  }
  if (length > held.size()) {
    refuseAt(placeIn("buffers", buffer, "byteLength"), "expected at most the " +
                                                           bytesText(held.size()) + " of " + what +
                                                           ", found " + std::to_string(length));
  }
  return held.substr(0, length);
}

/// The bytes of a view, or of its compressed data: both name a buffer, an offset and a length.
std::string_view GltfData::checkedBytes(const json& of, const std::string& place) {
  const auto buffer = of["buffer"].get<std::size_t>();
  const std::string_view held = bytesOfBuffer(buffer);
  const std::uint64_t offset = numberAt(of, "byteOffset"), length = numberAt(of, "byteLength");
  if (offset > held.size() || length > held.size() - offset) {
    refuseAt(place, "expected bytes within the " + bytesText(held.size()) + " of " +
                        placeIn("buffers", buffer) + ", found " + bytesText(length) +
                        " from byte " + std::to_string(offset) + " on");
  }
  return held.substr(offset, length);
}

std::string GltfData::decompressed(const json& compression, const std::string& place) {
  MeshoptView view;
  view.bytes = checkedBytes(compression, place);
  view.count = numberAt(compression, "count");
  view.stride = numberAt(compression, "byteStride");
  view.mode = compression["mode"].get<std::string>();
  view.filter = compression.value("filter", std::string("NONE"));
  return decompress(view, place);
}

std::string_view GltfData::bytesOfView(std::size_t view) {
  const json& described = at("bufferViews", view);
  const json* const compression = extensionOf(described, kMeshoptCompression);
  if (compression == nullptr) return checkedBytes(described, placeIn("bufferViews", view));
  auto found = views_.find(view);
  if (found == views_.end()) {
    const std::string place =
        placeIn("bufferViews", view, "extensions.") + std::string(kMeshoptCompression);
    found = views_.emplace(view, decompressed(*compression, place)).first;
  }
  return found->second;
}

ElementLayout GltfData::layoutOf(std::size_t accessor, std::string_view type,
                                 const std::string& user) const {
  const json& described = at("accessors", accessor);
  if (described["type"] != type) {
    refuseAt(user, "expected an accessor of type " + std::string(type) + ", found " +
                       placeIn("accessors", accessor) + " of type " +
                       described["type"].get<std::string>());
  }
  ElementLayout layout;
  layout.componentType = described["componentType"].get<std::uint64_t>();
  layout.component = componentBytes(described["componentType"]);
  layout.shape = elementShape(described["type"]);
  layout.isNormalized = described.value("normalized", false);
  if (described.contains("bufferView")) {
    layout.stride =
        numberAt(at("bufferViews", described["bufferView"].get<std::size_t>()), "byteStride");
  }
  return layout;
}

void GltfData::appendDense(std::size_t accessor, const ElementLayout& layout, std::uint64_t count,
                           std::vector<double>& numbers) {
  const json& described = at("accessors", accessor);
  const auto view = described["bufferView"].get<std::size_t>();
  const std::string_view held = bytesOfView(view);
  const std::uint64_t offset = numberAt(described, "byteOffset");
  const std::uint64_t element = layout.elementBytes();
  if (offset > held.size() || element > held.size() - offset ||
      count - 1 > (held.size() - offset - element) / layout.step()) {
    refuseAt(placeIn("accessors", accessor),
             "expected elements within the " + bytesText(held.size()) + " of " +
                 placeIn("bufferViews", view) + ", found " + std::to_string(count) + " of them, " +
                 bytesText(layout.step()) + " apart, from byte " + std::to_string(offset) + " on");
  }
  numbers.reserve(count * layout.width());
  appendElements(held.substr(offset), layout, count, numbers);
}

void GltfData::overwriteSparse(std::size_t accessor, const ElementLayout& layout,
                               GltfNumbers& numbers) {
  const json& sparse = at("accessors", accessor)["sparse"];
  const std::string place = placeIn("accessors", accessor, "sparse");
  const std::uint64_t count = numberAt(sparse, "count");
  ElementLayout index;
  index.componentType = sparse["indices"]["componentType"].get<std::uint64_t>();
  index.component = componentBytes(sparse["indices"]["componentType"]);
  index.shape = {1, 1};
  ElementLayout value = layout;
  value.stride = 0;
  const auto read = [&](const char* key, const ElementLayout& as) {
    const std::string_view held = bytesOfView(sparse[key]["bufferView"].get<std::size_t>());
    const std::uint64_t offset = numberAt(sparse[key], "byteOffset");
    if (offset > held.size() || count > (held.size() - offset) / as.elementBytes()) {
      refuseAt(place + "." + key, "expected elements within the " + bytesText(held.size()) +
                                      " of their view, found " + std::to_string(count) +
                                      " of them from byte " + std::to_string(offset) + " on");
    }
    std::vector<double> elements;
    appendElements(held.substr(offset), as, count, elements);
    return elements;
  };
  const std::vector<double> indices = read("indices", index), values = read("values", value);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(indices[i] >= 0.0 && indices[i] < static_cast<double>(numbers.count()))) {
      refuseAt(place + ".indices", "expected the numbers of the " +
                                       std::to_string(numbers.count()) + " elements, found " +
                                       inDigits(indices[i], 10));
    }
    const auto at = static_cast<std::size_t>(indices[i]);
    std::memcpy(numbers.values.data() + at * numbers.width, values.data() + i * numbers.width,
                numbers.width * sizeof(double));
  }
}

GltfNumbers GltfData::numbers(std::size_t accessor, std::string_view type,
                              const std::string& user) {
  const ElementLayout layout = layoutOf(accessor, type, user);
  const json& described = at("accessors", accessor);
  const std::uint64_t count = numberAt(described, "count");
  if (count == 0) refuseAt(placeIn("accessors", accessor, "count"), "expected 1 or above, found 0");
  GltfNumbers numbers;
  numbers.width = layout.width();
  if (described.contains("bufferView")) {
    appendDense(accessor, layout, count, numbers.values);
  } else {
    // Zeros take no bytes of the file: nothing else bounds them.
    constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 27;
    if (count > kMostZeros / numbers.width) {
      refuseAt(placeIn("accessors", accessor, "count"),
               "expected at most " + std::to_string(kMostZeros / numbers.width) +
                   " elements without a bufferView, found " + std::to_string(count));
    }
    numbers.values.assign(count * numbers.width, 0.0);
  }
  if (described.contains("sparse")) overwriteSparse(accessor, layout, numbers);
  return numbers;
}

}  // namespace foretouch::internal
