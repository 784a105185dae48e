#include "tools/sweep/surface_writer.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Counts what goes through it.
class Output {
 public:
  explicit Output(PendingFile& file) : file_(&file) {}
  void write(const std::string& text) {
    file_->write(text);
    bytes_ += text.size();
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  PendingFile* file_;
  std::size_t bytes_ = 0;
};

// Both binary formats are little-endian; so is every machine that this is built for.
template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

Error tooLarge(const char* format) {
  return Error{ErrorCode::LimitExceeded, "--output", -1, -1,
               std::string("too many triangles for a ") + format + " file"};
}

std::string titleOf(const Sweep& sweep, SurfaceSide side) {
  return fmt::format("foretouch swept volume, {} surface, certified error {} m",
                     side == SurfaceSide::Outer ? "outer" : "inner", sweep.certifiedError);
}

void writeObj(const Sweep& sweep, SurfaceSide side, Output& out) {
  out.write("# " + titleOf(sweep, side) + "\n# vt: seconds in the clip, 0\n");
  std::size_t first = 1;
  for (const LinkSurface& link : sweep.links) {
    out.write("o " + link.name + "\n");
    for (const SweptSurface& part : link.parts) {
      for (const Vector3d& v : part.vertices) {
        out.write(fmt::format("v {} {} {}\n", v.x(), v.y(), v.z()));
      }
      for (const double timeS : part.timesS) out.write(fmt::format("vt {} 0\n", timeS));
      for (const auto& t : part.triangles) {
        out.write(
            fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", first + t[0], first + t[1], first + t[2]));
      }
      first += part.vertices.size();
    }
  }
}

Result<Done> writePly(const Sweep& sweep, SurfaceSide side, Output& out) {
  if (sweep.vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return tooLarge("PLY");
  }
  std::string head = "ply\nformat binary_little_endian 1.0\ncomment " + titleOf(sweep, side) + "\n";
  for (const LinkSurface& link : sweep.links) {
    head += fmt::format("comment link {} {}\n", link.link, link.name);
  }
  head += fmt::format(
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property double time\nproperty int link\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      sweep.vertices, sweep.triangles);
  out.write(head);
  std::string bytes;
  for (const LinkSurface& link : sweep.links) {
    for (const SweptSurface& part : link.parts) {
      for (std::size_t i = 0; i < part.vertices.size(); ++i) {
        bytes.clear();
        for (const double x : part.vertices[i]) append(bytes, x);
        append(bytes, part.timesS[i]);
        append(bytes, static_cast<std::int32_t>(link.link));
        out.write(bytes);
      }
    }
  }
  std::uint32_t first = 0;
  for (const LinkSurface& link : sweep.links) {
    for (const SweptSurface& part : link.parts) {
      for (const auto& t : part.triangles) {
        bytes.clear();
        append(bytes, static_cast<std::uint8_t>(3));
        for (const std::uint32_t corner : t) append(bytes, first + corner);
        out.write(bytes);
      }
      first += static_cast<std::uint32_t>(part.vertices.size());
    }
  }
  return Done{};
}

// glTF 2.0, "GLB File Format Specification", "Accessors" and "Meshes". Attributes of one's own
// begin with an underscore and may not be unsigned int.
constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kTriangleList = 4;
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr std::size_t kVertexBytes = 5 * sizeof(float), kTriangleBytes = 3 * sizeof(std::uint32_t);

struct Counts {
  std::size_t vertices = 0, triangles = 0;
};

Counts countsOf(const LinkSurface& link) {
  Counts counts;
  for (const SweptSurface& part : link.parts) {
    counts.vertices += part.vertices.size();
    counts.triangles += part.triangles.size();
  }
  return counts;
}

/// One link's node, mesh, views and accessors; its bytes start at `offset`: vertices, one after the
/// other as position, time and link, then triangles.
void addLink(json& root, const LinkSurface& link, std::size_t offset) {
  const Counts counts = countsOf(link);
  Vector3d low = link.parts[0].vertices[0], high = low;
  for (const SweptSurface& part : link.parts) {
    for (const Vector3d& v : part.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  const std::size_t view = root["bufferViews"].size(), accessor = root["accessors"].size();
  const std::size_t vertexBytes = counts.vertices * kVertexBytes;
  root["bufferViews"].push_back({{"buffer", 0},
                                 {"byteOffset", offset},
                                 {"byteLength", vertexBytes},
                                 {"byteStride", kVertexBytes},
                                 {"target", kArrayBuffer}});
  root["bufferViews"].push_back({{"buffer", 0},
                                 {"byteOffset", offset + vertexBytes},
                                 {"byteLength", counts.triangles * kTriangleBytes},
                                 {"target", kElementBuffer}});
  root["accessors"].push_back({{"bufferView", view},
                               {"componentType", kFloat},
                               {"count", counts.vertices},
                               {"type", "VEC3"},
                               {"min", json::array({low.x(), low.y(), low.z()})},
                               {"max", json::array({high.x(), high.y(), high.z()})}});
  for (const std::size_t byteOffset : {3 * sizeof(float), 4 * sizeof(float)}) {
    root["accessors"].push_back({{"bufferView", view},
                                 {"byteOffset", byteOffset},
                                 {"componentType", kFloat},
                                 {"count", counts.vertices},
                                 {"type", "SCALAR"}});
  }
  root["accessors"].push_back({{"bufferView", view + 1},
                               {"componentType", kUnsignedInt},
                               {"count", 3 * counts.triangles},
                               {"type", "SCALAR"}});
  root["meshes"].push_back(
      {{"name", link.name},
       {"primitives",
        json::array({{{"attributes",
                       {{"POSITION", accessor}, {"_TIME", accessor + 1}, {"_LINK", accessor + 2}}},
                      {"indices", accessor + 3},
                      {"mode", kTriangleList}}})}});
  root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back({{"name", link.name}, {"mesh", root["meshes"].size() - 1}});
}

void writeBinary(const LinkSurface& link, Output& out) {
  std::string bytes;
  for (const SweptSurface& part : link.parts) {
    for (std::size_t i = 0; i < part.vertices.size(); ++i) {
      bytes.clear();
      for (const double x : part.vertices[i]) append(bytes, static_cast<float>(x));
      append(bytes, static_cast<float>(part.timesS[i]));
      append(bytes, static_cast<float>(link.link));
      out.write(bytes);
    }
  }
  std::uint32_t first = 0;
  for (const SweptSurface& part : link.parts) {
    for (const auto& t : part.triangles) {
      bytes.clear();
      for (const std::uint32_t corner : t) append(bytes, first + corner);
      out.write(bytes);
    }
    first += static_cast<std::uint32_t>(part.vertices.size());
  }
}

Result<Done> writeGlb(const Sweep& sweep, SurfaceSide side, Output& out) {
  const std::size_t binaryBytes = sweep.vertices * kVertexBytes + sweep.triangles * kTriangleBytes;
  constexpr std::size_t kMostBytes = std::size_t{15} << 28;  // sizes are 32 bits; room for the JSON
  if (binaryBytes > kMostBytes) return tooLarge("GLB");
  json root = {{"asset", {{"version", "2.0"}, {"generator", titleOf(sweep, side)}}},
               {"scene", 0},
               {"scenes", json::array({{{"nodes", json::array()}}})},
               {"nodes", json::array()},
               {"meshes", json::array()},
               {"accessors", json::array()},
               {"bufferViews", json::array()},
               {"buffers", json::array({{{"byteLength", binaryBytes}}})}};
  std::size_t offset = 0;
  for (const LinkSurface& link : sweep.links) {
    addLink(root, link, offset);
    const Counts counts = countsOf(link);
    offset += counts.vertices * kVertexBytes + counts.triangles * kTriangleBytes;
  }
  std::string text = root.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr std::uint32_t kHeadBytes = 12, kChunkHeadBytes = 8;
  std::string head;
  const auto textBytes = static_cast<std::uint32_t>(text.size());
  const auto dataBytes = static_cast<std::uint32_t>(binaryBytes);
  for (const std::uint32_t word :
       {kGlbMagic, kGlbVersion, kHeadBytes + 2 * kChunkHeadBytes + textBytes + dataBytes, textBytes,
        kJsonChunk}) {
    append(head, word);
  }
  out.write(head + text);
  head.clear();
  append(head, dataBytes);
  append(head, kBinaryChunk);
  out.write(head);
  for (const LinkSurface& link : sweep.links) writeBinary(link, out);
  return Done{};
}

}  // namespace

Result<MeshFormat> meshFormatOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return MeshFormat::Obj;
  if (extension == ".ply") return MeshFormat::Ply;
  if (extension == ".glb") return MeshFormat::Glb;
  return Error{ErrorCode::OutOfRange, "--output", -1, -1,
               "expected a name that ends in .obj, .ply or .glb, found " + inQuotes(path)};
}

Result<std::size_t> writeSurfaces(const Sweep& sweep, SurfaceSide side, MeshFormat format,
                                  PendingFile& file) {
  Output out(file);
  Result<Done> done = Done{};
  switch (format) {
    case MeshFormat::Obj: writeObj(sweep, side, out); break;
    case MeshFormat::Ply: done = writePly(sweep, side, out); break;
    case MeshFormat::Glb: done = writeGlb(sweep, side, out); break;
  }
  if (!done.ok()) return done.error();
  return out.bytes();
}

}  // namespace foretouch::tools
