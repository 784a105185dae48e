#include "tools/glb/glb_content.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/assert.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

/// Smallest and largest of each column.
void setBounds(Accessor& accessor, const float* values, std::size_t rows, std::size_t width) {
  for (std::size_t column = 0; column < width; ++column) {
    float low = values[column], high = low;
    for (std::size_t row = 1; row < rows; ++row) {
      low = std::min(low, values[row * width + column]);
      high = std::max(high, values[row * width + column]);
    }
    accessor.low.push_back(low);
    accessor.high.push_back(high);
  }
}

}  // namespace

std::size_t GlbContent::addMaterial(const GlbMaterial& material) {
  constexpr double kRoughness = 0.8, kMetal = 0.0;
  json entry = {{"name", material.name},
                {"doubleSided", true},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", material.color},
                  {"metallicFactor", kMetal},
                  {"roughnessFactor", kRoughness}}}};
  if (material.color[3] < 1.0) entry["alphaMode"] = "BLEND";
  return document_.add("materials", std::move(entry));
}

std::size_t GlbContent::addVertices(const std::vector<Eigen::Vector3f>& vertices, bool areBounded) {
  Accessor accessor;
  accessor.view = document_.addView(vertices.size() * 3 * sizeof(float), ViewTarget::Vertices);
  accessor.count = vertices.size();
  accessor.type = "VEC3";
  if (areBounded) setBounds(accessor, vertices.front().data(), vertices.size(), 3);
  for (const Eigen::Vector3f& v : vertices) {
    for (const float x : v) appendFloat(bytes_, x);
  }
  return document_.addAccessor(accessor);
}

json GlbContent::addPart(const MeshPart& part) {
  const GlbMesh& mesh = part.mesh;
  FORETOUCH_ASSERT(mesh.indices.size() >= (part.areLines ? 2u : 3u));
  json attributes = {{"POSITION", addVertices(mesh.positions, true)}};
  if (!mesh.normals.empty()) attributes["NORMAL"] = addVertices(mesh.normals, false);
  Accessor corners;
  corners.view =
      document_.addView(mesh.indices.size() * sizeof(std::uint32_t), ViewTarget::Indices);
  corners.count = mesh.indices.size();
  corners.componentType = ComponentType::UnsignedInt;
  for (const std::uint32_t index : mesh.indices) appendIndex(bytes_, index);
  constexpr int kLines = 1;  // glTF's number; triangles are what it takes without one
  json primitive = {{"attributes", attributes},
                    {"indices", document_.addAccessor(corners)},
                    {"material", part.material}};
  if (part.areLines) primitive["mode"] = kLines;
  return primitive;
}

std::size_t GlbContent::addMesh(const std::string& name, const std::vector<MeshPart>& parts) {
  json primitives = json::array();
  for (const MeshPart& part : parts) primitives.push_back(addPart(part));
  return document_.add("meshes", {{"name", name}, {"primitives", primitives}});
}

std::size_t GlbContent::addRows(const std::vector<float>& values, int width) {
  const auto columns = static_cast<std::size_t>(width);
  FORETOUCH_ASSERT(!values.empty() && values.size() % columns == 0);
  Accessor accessor;
  accessor.view = document_.addView(values.size() * sizeof(float), ViewTarget::None);
  accessor.count = values.size() / columns;
  accessor.type = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
  setBounds(accessor, values.data(), accessor.count, columns);
  for (const float value : values) appendFloat(bytes_, value);
  return document_.addAccessor(accessor);
}

std::size_t GlbContent::addLists(const std::vector<std::vector<float>>& lists) {
  std::size_t numbers = 0;
  for (const auto& list : lists) numbers += list.size();
  Accessor accessor;
  accessor.view = document_.addView(numbers * sizeof(float), ViewTarget::None);
  std::size_t first = 0;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    accessor.count = lists[i].size();
    accessor.low = accessor.high = nullptr;
    setBounds(accessor, lists[i].data(), accessor.count, 1);
    const std::size_t index = document_.addAccessor(accessor);
    if (i == 0) first = index;
    accessor.byteOffset += accessor.count * sizeof(float);
    for (const float value : lists[i]) appendFloat(bytes_, value);
  }
  return first;
}

Result<Done> GlbContent::writeFile(const std::string& path) const {
  FORETOUCH_TRY(const auto head, inFile(document_.glbHead(), path));
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(head);
  file.write(bytes_);
  return file.commit();
}

}  // namespace foretouch::tools
