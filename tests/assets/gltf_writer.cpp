#include "tests/assets/gltf_writer.h"

#include <cmath>
#include <cstring>

#include "tests/assets/import_files.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

struct Integer {
  double least, most, one;  ///< Range, and what 1.0 is if it is normalised.
  std::size_t bytes;
};

Integer integerOf(Stored type) {
  switch (type) {
    case Stored::Byte: return {-128, 127, 127, 1};
    case Stored::UByte: return {0, 255, 255, 1};
    case Stored::Short: return {-32768, 32767, 32767, 2};
    case Stored::UShort: return {0, 65535, 65535, 2};
    default: return {0, 4294967295.0, 4294967295.0, 4};
  }
}

double integerFor(double number, Stored type, bool isNormalised) {
  const Integer integer = integerOf(type);
  return std::round(isNormalised ? number * integer.one : number);
}

void append(std::string& bytes, double number, const AccessorWay& way) {
  if (way.type == Stored::Float) {
    const auto single = static_cast<float>(number);
    bytes.append(reinterpret_cast<const char*>(&single), 4);
    return;
  }
  const auto stored = static_cast<std::int64_t>(integerFor(number, way.type, way.isNormalised));
  for (std::size_t i = 0; i < integerOf(way.type).bytes; ++i) {
    bytes += static_cast<char>(stored >> (8 * i) & 0xFF);
  }
}

const char* typeOf(std::size_t width) {
  switch (width) {
    case 1: return "SCALAR";
    case 2: return "VEC2";
    case 3: return "VEC3";
    case 4: return "VEC4";
    default: return "MAT4";
  }
}

json described(const AccessorWay& way, std::size_t count, std::size_t width) {
  json accessor{
      {"componentType", static_cast<int>(way.type)}, {"count", count}, {"type", typeOf(width)}};
  if (way.isNormalised) accessor["normalized"] = true;
  return accessor;
}

std::string elements(const std::vector<double>& numbers, std::size_t width,
                     const AccessorWay& way) {
  // What lies between elements must never be read.
  std::string bytes(way.offset, '\x7E');
  for (std::size_t i = 0; i < numbers.size(); i += width) {
    const std::size_t begin = bytes.size();
    for (std::size_t k = 0; k < width; ++k) append(bytes, numbers[i + k], way);
    const bool isLast = i + width >= numbers.size();
    if (way.stride != 0 && !isLast) bytes.append(begin + way.stride - bytes.size(), '\x7E');
  }
  return bytes;
}

std::string word(std::size_t value) {
  std::string text;
  for (int k = 0; k < 4; ++k) text += static_cast<char>(value >> (8 * k) & 0xFF);
  return text;
}

}  // namespace

double storedAs(double number, Stored type, bool isNormalised) {
  if (type == Stored::Float) return static_cast<double>(static_cast<float>(number));
  const double integer = integerFor(number, type, isNormalised);
  return isNormalised ? std::max(integer / integerOf(type).one, -1.0) : integer;
}

GltfWriter::GltfWriter() {
  root = {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", json::array()}}}},
          {"nodes", json::array()},
          {"meshes", json::array()},
          {"accessors", json::array()},
          {"bufferViews", json::array()}};
}

std::size_t GltfWriter::view(const std::string& bytes, std::size_t stride) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  bytes_ += bytes;
  root["bufferViews"].push_back(view);
  return root["bufferViews"].size() - 1;
}

std::size_t GltfWriter::accessor(const std::vector<double>& numbers, std::size_t width,
                                 const AccessorWay& way) {
  json accessor = described(way, numbers.size() / width, width);
  accessor["bufferView"] = view(elements(numbers, width, way), way.stride);
  if (way.offset != 0) accessor["byteOffset"] = way.offset;
  root["accessors"].push_back(accessor);
  return root["accessors"].size() - 1;
}

std::size_t GltfWriter::sparse(int base, std::size_t count, std::size_t width,
                               const std::vector<double>& indices,
                               const std::vector<double>& values, Stored indexType,
                               const AccessorWay& way) {
  json accessor = described(way, count, width);
  if (base >= 0) {
    const json& other = root["accessors"][static_cast<std::size_t>(base)];
    accessor["bufferView"] = other["bufferView"];
    if (other.contains("byteOffset")) accessor["byteOffset"] = other["byteOffset"];
  }
  AccessorWay asIndices;
  asIndices.type = indexType;
  AccessorWay tight = way;
  tight.stride = 0;
  // Not at the begin of their views.
  const std::size_t indexView = view(std::string(4, '\x7E') + elements(indices, 1, asIndices));
  const std::size_t valueView = view(std::string(8, '\x7E') + elements(values, width, tight));
  accessor["sparse"] = {{"count", indices.size()},
                        {"indices",
                         {{"bufferView", indexView},
                          {"byteOffset", 4},
                          {"componentType", static_cast<int>(indexType)}}},
                        {"values", {{"bufferView", valueView}, {"byteOffset", 8}}}};
  root["accessors"].push_back(accessor);
  return root["accessors"].size() - 1;
}

json& GltfWriter::node(const json& node, bool isRoot) {
  if (isRoot) root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back(node);
  return root["nodes"].back();
}

json& GltfWriter::meshNode(const json& primitive, const std::string& name) {
  root["meshes"].push_back({{"primitives", {primitive}}});
  return node({{"name", name}, {"mesh", root["meshes"].size() - 1}});
}

std::string GltfWriter::gltf() const {
  json whole = root;
  whole["buffers"] = {{{"byteLength", bytes_.size()},
                       {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
  for (const json& buffer : moreBuffers) whole["buffers"].push_back(buffer);
  return whole.dump();
}

std::string GltfWriter::glb() const {
  json whole = root;
  whole["buffers"] = {{{"byteLength", bytes_.size()}}};
  for (const json& buffer : moreBuffers) whole["buffers"].push_back(buffer);
  std::string text = whole.dump(), bytes = bytes_;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  return "glTF" + word(2) + word(28 + text.size() + bytes.size()) + word(text.size()) + "JSON" +
         text + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

}  // namespace foretouch::test
