#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "assets/import/text.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "lss/single.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using Surfaces = std::vector<std::vector<Triangle>>;

// glTF 2.0, "GLB File Format Specification" and "Accessors".
constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kTriangleList = 4, kArrayBuffer = 34962;
constexpr std::size_t kTriangleBytes = 9 * sizeof(float);
// Sizes in a GLB are 32 bits; this leaves room for the JSON.
constexpr std::size_t kMaxGlbTriangles = (std::size_t{3} << 30) / kTriangleBytes;
// The model reader cuts names above this.
constexpr std::size_t kMaxNodeNameBytes = 1023;

Error glbError(ErrorCode code, const std::string& path, LinkId link, std::string message) {
  return Error{code, path, -1, link, std::move(message)};
}

bool holdsFloats(const Triangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Vector3d& v) { return nearestFloat(v) == v; });
}

/// The reader finds nodes by name, so the names must survive it and stay distinct.
std::optional<Error> badName(const Skeleton& skeleton, const std::string& path) {
  std::set<std::string> seen;
  for (JointId link = 0; link < skeleton.numJoints(); ++link) {
    const std::string& name = skeleton.name(link);
    if (name.size() > kMaxNodeNameBytes) {
      return glbError(
          ErrorCode::LimitExceeded, path, link,
          "a link's name is longer than " + std::to_string(kMaxNodeNameBytes) + " bytes");
    }
    const std::string readable = internal::readableText(name, kMaxNodeNameBytes);
    if (readable.empty() || !seen.insert(readable).second) {
      return glbError(
          ErrorCode::DuplicateName, path, link,
          "the name " + inQuotes(name) + " without blanks at its ends is empty or another link's");
    }
  }
  return std::nullopt;
}

std::optional<Error> badInput(const Skeleton& skeleton, const Surfaces& triangles,
                              const std::string& path) {
  if (triangles.size() != countOf(skeleton.numJoints())) {
    return glbError(ErrorCode::Mismatch, path, -1,
                    "expected triangles for " + std::to_string(skeleton.numJoints()) +
                        " links, found " + std::to_string(triangles.size()));
  }
  if (auto error = badName(skeleton, path)) return error;
  std::size_t total = 0;
  for (std::size_t link = 0; link < triangles.size(); ++link) {
    total += triangles[link].size();
    for (const Triangle& triangle : triangles[link]) {
      if (!isFinite(triangle)) {
        return glbError(ErrorCode::NonFinite, path, static_cast<LinkId>(link),
                        "a triangle is not finite");
      }
      if (!holdsFloats(triangle)) {
        return glbError(ErrorCode::OutOfRange, path, static_cast<LinkId>(link),
                        "expected coordinates that are floats, as glTF holds no doubles");
      }
    }
  }
  if (total == 0) return glbError(ErrorCode::Empty, path, -1, "expected triangles, found none");
  if (total > kMaxGlbTriangles) {
    return glbError(ErrorCode::LimitExceeded, path, -1,
                    "more than " + std::to_string(kMaxGlbTriangles) + " triangles");
  }
  return std::nullopt;
}

json arrayOf(const Vector3d& v) {
  return json::array({v.x(), v.y(), v.z()});
}

json nodeOf(const Skeleton& skeleton, JointId link) {
  const Quaternion& q = skeleton.restRotation(link);
  return json{{"name", skeleton.name(link)},
              {"translation", arrayOf(skeleton.restOffset(link))},
              {"rotation", json::array({q.x(), q.y(), q.z(), q.w()})}};
}

/// Adds the link's mesh and its accessor, whose data start at byte `offset`.
void addMesh(json& root, const std::string& name, const std::vector<Triangle>& triangles,
             std::size_t offset) {
  Vector3d low = triangles[0].vertices[0], high = low;
  for (const Triangle& triangle : triangles) {
    for (const Vector3d& v : triangle.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  root["meshes"].push_back(
      {{"name", name},
       {"primitives", json::array({{{"attributes", {{"POSITION", root["accessors"].size()}}},
                                    {"mode", kTriangleList}}})}});
  root["accessors"].push_back({{"bufferView", 0},
                               {"byteOffset", offset},
                               {"componentType", kFloat},
                               {"count", 3 * triangles.size()},
                               {"type", "VEC3"},
                               {"min", arrayOf(low)},
                               {"max", arrayOf(high)}});
}

/// The reader adds a root above several roots, with a name that a link may have; so we add one
/// ourselves.
void addRoot(json& root, const Skeleton& skeleton, const std::vector<JointId>& roots) {
  if (roots.size() == 1) {
    root["scenes"] = json::array({{{"nodes", roots}}});
    return;
  }
  std::string name = "foretouch_root";
  while (skeleton.find(name).has_value()) name += '_';
  root["scenes"] = json::array({{{"nodes", json::array({root["nodes"].size()})}}});
  root["nodes"].push_back({{"name", name}, {"children", roots}});
}

json describeFile(const Skeleton& skeleton, const Surfaces& triangles) {
  json root = {{"asset", {{"version", "2.0"}, {"generator", "foretouch"}}},
               {"scene", 0},
               {"nodes", json::array()},
               {"meshes", json::array()},
               {"accessors", json::array()}};
  std::vector<JointId> roots;
  std::size_t bytes = 0;
  for (JointId link = 0; link < skeleton.numJoints(); ++link) {
    const auto& surface = triangles[slotOf(link)];
    json node = nodeOf(skeleton, link);
    if (!surface.empty()) {
      node["mesh"] = root["meshes"].size();
      addMesh(root, skeleton.name(link), surface, bytes);
      bytes += surface.size() * kTriangleBytes;
    }
    root["nodes"].push_back(std::move(node));
    const JointId parent = skeleton.parent(link);
    if (parent == kNoParent) {
      roots.push_back(link);
    } else {
      root["nodes"][slotOf(parent)]["children"].push_back(link);
    }
  }
  addRoot(root, skeleton, roots);
  root["bufferViews"] =
      json::array({{{"buffer", 0}, {"byteLength", bytes}, {"target", kArrayBuffer}}});
  root["buffers"] = json::array({{{"byteLength", bytes}}});
  return root;
}

// The format is little-endian; so is every supported machine (x86-64, ARM64).
std::string words(std::initializer_list<std::uint32_t> numbers) {
  std::string bytes;
  for (const std::uint32_t number : numbers) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xFF);
  }
  return bytes;
}

void appendFloat(std::string& bytes, double number) {
  const auto value = static_cast<float>(number);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xFF);
}

void writeBinary(const Surfaces& triangles, PendingFile& file) {
  std::string bytes;
  for (const auto& surface : triangles) {
    for (const Triangle& triangle : surface) {
      bytes.clear();
      for (const Vector3d& v : triangle.vertices) {
        for (const double number : v) appendFloat(bytes, number);
      }
      file.write(bytes);
    }
  }
}

Result<Done> writeChecked(const Skeleton& skeleton, const Surfaces& triangles,
                          const std::string& path) {
  if (const auto error = badInput(skeleton, triangles, path)) return *error;
  const json root = describeFile(skeleton, triangles);
  std::string text = root.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto binaryBytes = root["buffers"][0]["byteLength"].get<std::uint32_t>();
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  const auto textBytes = static_cast<std::uint32_t>(text.size());
  constexpr std::uint32_t kHeadBytes = 12, kChunkHeadBytes = 8;
  file.write(
      words({kGlbMagic, kGlbVersion, kHeadBytes + 2 * kChunkHeadBytes + textBytes + binaryBytes}));
  file.write(words({textBytes, kJsonChunk}) + text);
  file.write(words({binaryBytes, kBinaryChunk}));
  writeBinary(triangles, file);
  return file.commit();
}

}  // namespace

Result<Done> writeLinkMeshes(const Skeleton& skeleton,
                             const std::vector<std::vector<Triangle>>& triangles,
                             const std::string& path) {
  try {
    return writeChecked(skeleton, triangles, path);
  } catch (const std::bad_alloc&) {
    return glbError(ErrorCode::LimitExceeded, path, -1, "not enough memory for the file's text");
  } catch (const json::exception& error) {
    return glbError(ErrorCode::Syntax, path, -1, error.what());
  }
}

}  // namespace foretouch
