// tests/assets/gltf_writer.h: glTF files written by the test, with numbers stored in every way that
// the format knows. Shares no code with the reader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace foretouch::test {

/// "componentType".
enum class Stored : int { Byte = 5120, UByte, Short, UShort, UInt = 5125, Float };

/// What a number becomes when it is stored and read again: computed from the specification's table
/// of normalised integers.
double storedAs(double number, Stored type, bool isNormalised);

struct AccessorWay {
  Stored type = Stored::Float;
  bool isNormalised = false;
  std::size_t stride = 0;  ///< Bytes from element to element; 0: they touch.
  std::size_t offset = 0;  ///< Of the first in its view: room for others, interleaved.
};

class GltfWriter {
 public:
  GltfWriter();

  /// Elements of `width` numbers each; "type" is SCALAR, VEC2, VEC3, VEC4 or, of 16, MAT4.
  std::size_t accessor(const std::vector<double>& numbers, std::size_t width,
                       const AccessorWay& way = {});
  /// Overwrites elements of accessor `base`, or of zeros where it is -1.
  std::size_t sparse(int base, std::size_t count, std::size_t width,
                     const std::vector<double>& indices, const std::vector<double>& values,
                     Stored indexType = Stored::UShort, const AccessorWay& way = {});
  /// Bytes as a view of their own.
  std::size_t view(const std::string& bytes, std::size_t stride = 0);

  /// A node at the root that places a mesh of one primitive.
  nlohmann::json& meshNode(const nlohmann::json& primitive, const std::string& name = "node");
  nlohmann::json& node(const nlohmann::json& node, bool isRoot = true);

  nlohmann::json root;                                   ///< To add to and to change.
  nlohmann::json moreBuffers = nlohmann::json::array();  ///< Behind the one with the bytes.
  [[nodiscard]] std::string gltf() const;
  [[nodiscard]] std::string glb() const;

 private:
  std::string bytes_;
};

}  // namespace foretouch::test
