// assets/import/gltf_elements.h: the elements of a glTF accessor, out of bytes. Source: Khronos,
// "glTF 2.0 Specification", "Accessors". In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace foretouch::internal {

/// The size of an accessor's "componentType"; 0 if there is no such type.
[[nodiscard]] std::uint64_t componentBytes(const nlohmann::json& componentType);

struct ElementShape {
  std::uint64_t rows = 0, columns = 0;
};
/// The shape of an accessor's "type"; zeros if there is no such type.
[[nodiscard]] ElementShape elementShape(const nlohmann::json& type);

/// How elements are stored.
struct ElementLayout {
  std::uint64_t componentType = 0, component = 0;  ///< component: bytes of one.
  ElementShape shape;
  bool isNormalized = false;
  std::uint64_t stride = 0;  ///< Bytes from one to the next; 0: they touch.

  /// Columns of matrices begin at multiples of four bytes.
  [[nodiscard]] std::uint64_t columnBytes() const {
    const std::uint64_t bytes = shape.rows * component;
    return shape.columns > 1 ? (bytes + 3) / 4 * 4 : bytes;
  }
  [[nodiscard]] std::uint64_t elementBytes() const { return columnBytes() * shape.columns; }
  [[nodiscard]] std::uint64_t step() const { return stride == 0 ? elementBytes() : stride; }
  /// How many numbers one element has; they come column by column.
  [[nodiscard]] std::size_t width() const { return shape.rows * shape.columns; }
};

/// The number that an integer of `componentType` stands for if it is normalised: 0 to 1, or -1
/// to 1.
[[nodiscard]] double normalisedNumber(double integer, std::uint64_t componentType);

/// Appends width() numbers per element, normalised if the layout says so. Precondition: `bytes`
/// holds `count` elements.
void appendElements(std::string_view bytes, const ElementLayout& layout, std::size_t count,
                    std::vector<double>& numbers);

}  // namespace foretouch::internal
