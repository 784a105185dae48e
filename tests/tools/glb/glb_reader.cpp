#include "tests/tools/glb/glb_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace foretouch::test {
namespace {

using nlohmann::json;

std::uint32_t wordAt(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) {
    word = word << 8 | static_cast<unsigned char>(bytes.at(offset + static_cast<std::size_t>(i)));
  }
  return word;
}

std::size_t sizeOf(const json& root, const char* list) {
  return root.contains(list) ? root[list].size() : 0;
}

}  // namespace

std::size_t widthOf(const json& accessor) {
  static const std::map<std::string, std::size_t> kWidths = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  return kWidths.at(accessor.at("type"));
}

GlbReader::GlbReader(const std::string& bytes) {
  if (bytes.size() < 28 || bytes.compare(0, 4, "glTF") != 0) {
    ADD_FAILURE() << "no GLB, " << bytes.size() << " bytes";
    return;
  }
  EXPECT_EQ(wordAt(bytes, 4), 2u);
  EXPECT_EQ(wordAt(bytes, 8), bytes.size());
  const std::size_t text = wordAt(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(text % 4, 0u);
  root_ = json::parse(bytes.substr(20, text));
  const std::size_t chunk = 20 + text;
  EXPECT_EQ(bytes.substr(chunk + 4, 4), std::string("BIN\0", 4));
  binary_ = bytes.substr(chunk + 8);
  EXPECT_EQ(wordAt(bytes, chunk), binary_.size());
  EXPECT_EQ(binary_.size() % 4, 0u);
  EXPECT_EQ(root_["buffers"].size(), 1u);
  EXPECT_EQ(root_["buffers"][0]["byteLength"], binary_.size());
  EXPECT_EQ(root_["asset"]["version"], "2.0");
}

const char* GlbReader::startOf(std::size_t index, std::size_t rowBytes) const {
  const json& accessor = root_.at("accessors").at(index);
  const json& view = root_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const std::size_t offset = accessor.value("byteOffset", std::size_t{0});
  const std::size_t stride = view.value("byteStride", rowBytes);
  const std::size_t rows = accessor.at("count");
  EXPECT_GT(rows, 0u);
  EXPECT_LE(offset + (rows - 1) * stride + rowBytes, view.at("byteLength").get<std::size_t>());
  EXPECT_EQ(offset % 4, 0u);
  EXPECT_EQ(stride % 4, 0u);
  return binary_.data() + view.at("byteOffset").get<std::size_t>() + offset;
}

std::vector<float> GlbReader::floats(std::size_t index) const {
  const json& accessor = root_.at("accessors").at(index);
  EXPECT_EQ(accessor.at("componentType"), 5126);
  const std::size_t rowBytes = 4 * widthOf(accessor);
  const json& view = root_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const std::size_t stride = view.value("byteStride", rowBytes);
  const char* start = startOf(index, rowBytes);
  const std::size_t rows = accessor.at("count");
  std::vector<float> values(rows * widthOf(accessor));
  for (std::size_t row = 0; row < rows; ++row) {
    std::memcpy(values.data() + row * widthOf(accessor), start + row * stride, rowBytes);
  }
  return values;
}

std::vector<std::uint32_t> GlbReader::indices(std::size_t index) const {
  const json& accessor = root_.at("accessors").at(index);
  EXPECT_EQ(accessor.at("componentType"), 5125);
  EXPECT_EQ(accessor.at("type"), "SCALAR");
  std::vector<std::uint32_t> values(accessor.at("count").get<std::size_t>());
  std::memcpy(values.data(), startOf(index, 4), 4 * values.size());
  return values;
}

void GlbReader::check() const {
  checkViews();
  checkAccessors();
  checkMeshes();
  checkNodes();
  checkAnimations();
  for (const auto& [key, value] : root_.items()) {
    EXPECT_FALSE(value.is_array() && value.empty()) << key << " is an empty list";
  }
}

void GlbReader::checkViews() const {
  std::size_t end = 0;
  for (const json& view : root_.at("bufferViews")) {
    EXPECT_EQ(view.at("buffer"), 0);
    EXPECT_EQ(view.at("byteOffset"), end);  // no gaps, no bytes twice
    end += view.at("byteLength").get<std::size_t>();
  }
  EXPECT_EQ(end, binary_.size());
}

void GlbReader::checkAccessors() const {
  for (std::size_t i = 0; i < sizeOf(root_, "accessors"); ++i) {
    const json& accessor = root_["accessors"][i];
    if (accessor.at("componentType") != 5126) continue;
    const std::vector<float> values = floats(i);
    const std::size_t width = widthOf(accessor);
    for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << "accessor " << i;
    if (!accessor.contains("min")) continue;
    ASSERT_EQ(accessor["min"].size(), width);
    ASSERT_EQ(accessor["max"].size(), width);
    for (std::size_t column = 0; column < width; ++column) {
      float low = values[column], high = low;
      for (std::size_t at = column; at < values.size(); at += width) {
        low = std::min(low, values[at]);
        high = std::max(high, values[at]);
      }
      EXPECT_EQ(accessor["min"][column].get<double>(), static_cast<double>(low));
      EXPECT_EQ(accessor["max"][column].get<double>(), static_cast<double>(high));
    }
  }
}

void GlbReader::checkMeshes() const {
  for (const json& mesh : root_.at("meshes")) {
    for (const json& primitive : mesh.at("primitives")) {
      const json& attributes = primitive.at("attributes");
      const std::size_t positions = attributes.at("POSITION");
      EXPECT_TRUE(root_["accessors"][positions].contains("min"));
      const std::size_t vertices = floats(positions).size() / 3;
      const std::vector<std::uint32_t> corners = indices(primitive.at("indices"));
      constexpr int kLines = 1, kTriangles = 4;
      const bool areLines = primitive.value("mode", kTriangles) == kLines;
      EXPECT_EQ(corners.size() % (areLines ? 2 : 3), 0u);
      EXPECT_LT(*std::max_element(corners.begin(), corners.end()), vertices);
      if (primitive.contains("material")) {
        EXPECT_LT(primitive["material"].get<std::size_t>(), sizeOf(root_, "materials"));
      }
      if (!attributes.contains("NORMAL")) continue;
      const std::vector<float> normals = floats(attributes["NORMAL"]);
      EXPECT_EQ(normals.size(), 3 * vertices);
      for (std::size_t i = 0; i < normals.size(); i += 3) {
        EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1.0, 1e-6);
      }
    }
  }
}

std::vector<int> GlbReader::parents() const {
  std::vector<int> parents(root_.at("nodes").size(), -1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    for (const json& child : root_["nodes"][i].value("children", json::array())) {
      int& parent = parents.at(child.get<std::size_t>());
      EXPECT_EQ(parent, -1) << "two parents";
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

void GlbReader::checkNodes() const {
  const std::vector<int> above = parents();
  std::set<int> shown;
  for (const json& root : root_.at("scenes").at(0).at("nodes")) shown.insert(root.get<int>());
  for (std::size_t i = 0; i < above.size(); ++i) {
    const json& node = root_["nodes"][i];
    if (node.contains("mesh")) {
      EXPECT_LT(node["mesh"].get<std::size_t>(), root_["meshes"].size());
    }
    if (node.contains("rotation")) {
      double square = 0.0;
      for (const json& x : node["rotation"]) square += x.get<double>() * x.get<double>();
      EXPECT_NEAR(square, 1.0, 1e-12);
    }
    int ancestor = static_cast<int>(i);
    for (std::size_t depth = 0; above[static_cast<std::size_t>(ancestor)] >= 0; ++depth) {
      ASSERT_LE(depth, above.size()) << "a cycle";
      ancestor = above[static_cast<std::size_t>(ancestor)];
    }
    EXPECT_EQ(shown.count(ancestor), 1u) << "node " << i << " is not shown";
  }
}

void GlbReader::checkAnimations() const {
  static const std::map<std::string, std::size_t> kWidths = {
      {"rotation", 4}, {"translation", 3}, {"scale", 3}};
  for (const json& animation : root_.value("animations", json::array())) {
    std::set<std::pair<std::size_t, std::string>> seen;
    for (const json& channel : animation.at("channels")) {
      const json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
      const std::string path = channel.at("target").at("path");
      const std::size_t node = channel["target"].at("node");
      EXPECT_LT(node, root_["nodes"].size());
      EXPECT_TRUE(seen.insert({node, path}).second) << "a part moved twice";
      const std::vector<float> times = floats(sampler.at("input"));
      EXPECT_TRUE(root_["accessors"][sampler["input"].get<std::size_t>()].contains("min"));
      EXPECT_GE(times.front(), 0.0f);
      EXPECT_TRUE(std::adjacent_find(times.begin(), times.end(),
                                     [](float a, float b) { return b <= a; }) == times.end());
      const std::size_t width = kWidths.at(path);
      const std::vector<float> values = floats(sampler.at("output"));
      EXPECT_EQ(widthOf(root_["accessors"][sampler["output"].get<std::size_t>()]), width);
      EXPECT_EQ(values.size(), width * times.size());
    }
  }
}

std::size_t GlbReader::node(const std::string& name) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < root_.at("nodes").size(); ++i) {
    if (root_["nodes"][i].value("name", "") == name) found.push_back(i);
  }
  EXPECT_EQ(found.size(), 1u) << name;
  return found.empty() ? 0 : found.front();
}

}  // namespace foretouch::test
