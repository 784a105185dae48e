#include "tools/sweep/surface_writer.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/glb/gltf_document.h"
#include "tools/little_endian.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Counts the bytes written.
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

Error tooLarge(const char* format) {
  return Error::in("--output", ErrorCode::LimitExceeded,
                   std::string("too many triangles for a ") + format + " file");
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
        for (const double x : part.vertices[i]) appendBytes(bytes, x);
        appendBytes(bytes, part.timesS[i]);
        appendBytes(bytes, static_cast<std::int32_t>(link.link));
        out.write(bytes);
      }
    }
  }
  std::uint32_t first = 0;
  for (const LinkSurface& link : sweep.links) {
    for (const SweptSurface& part : link.parts) {
      for (const auto& t : part.triangles) {
        bytes.clear();
        appendBytes(bytes, static_cast<std::uint8_t>(3));
        for (const std::uint32_t corner : t) appendBytes(bytes, first + corner);
        out.write(bytes);
      }
      first += static_cast<std::uint32_t>(part.vertices.size());
    }
  }
  return Done{};
}

// Application-specific attributes begin with an underscore and may not be unsigned int (glTF 2.0,
// "Meshes").
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

/// One link's node, mesh, views and accessors: for vertices, interleaved as position, time and
/// link, and for triangles.
void addLink(GltfDocument& document, const LinkSurface& link) {
  const Counts counts = countsOf(link);
  Vector3d low = link.parts[0].vertices[0], high = low;
  for (const SweptSurface& part : link.parts) {
    for (const Vector3d& v : part.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  Accessor column;
  column.view =
      document.addView(counts.vertices * kVertexBytes, ViewTarget::Vertices, kVertexBytes);
  column.count = counts.vertices;
  Accessor positions = column, corners;
  positions.type = "VEC3";
  positions.low = gltfVector(low);
  positions.high = gltfVector(high);
  json attributes = {{"POSITION", document.addAccessor(positions)}};
  column.byteOffset = 3 * sizeof(float);
  attributes["_TIME"] = document.addAccessor(column);
  column.byteOffset += sizeof(float);
  attributes["_LINK"] = document.addAccessor(column);
  corners.view = document.addView(counts.triangles * kTriangleBytes, ViewTarget::Indices);
  corners.count = 3 * counts.triangles;
  corners.componentType = ComponentType::UnsignedInt;
  const json primitive = {{"attributes", attributes}, {"indices", document.addAccessor(corners)}};
  const std::size_t mesh =
      document.add("meshes", {{"name", link.name}, {"primitives", json::array({primitive})}});
  document.show(document.add("nodes", {{"name", link.name}, {"mesh", mesh}}));
}

void writeBinary(const LinkSurface& link, Output& out) {
  std::string bytes;
  for (const SweptSurface& part : link.parts) {
    for (std::size_t i = 0; i < part.vertices.size(); ++i) {
      bytes.clear();
      for (const double x : part.vertices[i]) appendBytes(bytes, static_cast<float>(x));
      appendBytes(bytes, static_cast<float>(part.timesS[i]));
      appendBytes(bytes, static_cast<float>(link.link));
      out.write(bytes);
    }
  }
  std::uint32_t first = 0;
  for (const SweptSurface& part : link.parts) {
    for (const auto& t : part.triangles) {
      bytes.clear();
      for (const std::uint32_t corner : t) appendBytes(bytes, first + corner);
      out.write(bytes);
    }
    first += static_cast<std::uint32_t>(part.vertices.size());
  }
}

Result<Done> writeGlb(const Sweep& sweep, SurfaceSide side, Output& out) {
  GltfDocument document(titleOf(sweep, side));
  for (const LinkSurface& link : sweep.links) addLink(document, link);
  const auto head = document.glbHead();
  if (!head.ok()) return tooLarge("GLB");
  out.write(head.value());
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
  return Error::in("--output", ErrorCode::OutOfRange,
                   "expected a name that ends in .obj, .ply or .glb, found " + inQuotes(path));
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
