#include "assets/import/gltf_elements.h"

#include <algorithm>
#include <cstring>

#include <nlohmann/json.hpp>

namespace foretouch::internal {
namespace {

using nlohmann::json;

enum ComponentType : std::uint64_t {
  kByte = 5120,
  kUnsignedByte,
  kShort,
  kUnsignedShort,
  kUnsignedInt = 5125,
  kFloat
};

/// Reads at any address: files do not always align what the format requires them to.
template <typename T>
double numberAt(const char* at) {
  T number;
  std::memcpy(&number, at, sizeof number);
  return static_cast<double>(number);
}

double componentAt(const char* at, std::uint64_t type) {
  switch (type) {
    case kByte: return numberAt<std::int8_t>(at);
    case kUnsignedByte: return numberAt<std::uint8_t>(at);
    case kShort: return numberAt<std::int16_t>(at);
    case kUnsignedShort: return numberAt<std::uint16_t>(at);
    case kUnsignedInt: return numberAt<std::uint32_t>(at);
    default: return numberAt<float>(at);
  }
}

}  // namespace

std::uint64_t componentBytes(const json& componentType) {
  if (!componentType.is_number_unsigned()) return 0;
  switch (componentType.get<std::uint64_t>()) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case kFloat: return 4;
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

double normalisedNumber(double integer, std::uint64_t componentType) {
  switch (componentType) {
    case kByte: return std::max(integer / 127.0, -1.0);
    case kUnsignedByte: return integer / 255.0;
    case kShort: return std::max(integer / 32767.0, -1.0);
    case kUnsignedShort: return integer / 65535.0;
    default: return integer;  // The format normalises no others.
  }
}

void appendElements(std::string_view bytes, const ElementLayout& layout, std::size_t count,
                    std::vector<double>& numbers) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t column = 0; column < layout.shape.columns; ++column) {
      const char* const first = bytes.data() + i * layout.step() + column * layout.columnBytes();
      for (std::size_t row = 0; row < layout.shape.rows; ++row) {
        const double number = componentAt(first + row * layout.component, layout.componentType);
        numbers.push_back(layout.isNormalized ? normalisedNumber(number, layout.componentType)
                                              : number);
      }
    }
  }
}

}  // namespace foretouch::internal
