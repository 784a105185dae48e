// foretouch-import FILE: reads a model with assimp and writes its triangles to standard output
// (middleware/import_protocol.h). A helper of the library, run as a child under limits that its
// parent sets; the only program that links assimp.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <Eigen/Core>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include "middleware/import_polygon.h"
#include "middleware/import_protocol.h"
#include "middleware/import_text.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// What ends the import with a message to the parent.
struct Failure {
  ImportFailure kind;
  std::string text;
};

/// An affine map in double; assimp's matrices are float, and a chain of them would lose digits.
struct Transform {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vector3d translation = Vector3d::Zero();

  [[nodiscard]] Transform operator*(const Transform& inner) const {
    return {linear * inner.linear, linear * inner.translation + translation};
  }
  [[nodiscard]] Vector3d operator*(const Vector3d& p) const { return linear * p + translation; }
};

Transform transformOf(const aiMatrix4x4& m) {
  Transform transform;
  transform.linear << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  transform.translation = Vector3d(m.a4, m.b4, m.c4);
  return transform;
}

Vector3d vertexOf(const aiMesh& mesh, std::uint32_t index) {
  const aiVector3D& v = mesh.mVertices[index];
  return {v.x, v.y, v.z};
}

/// A mesh of the file, cut into triangles once for all its placements.
struct MeshTriangles {
  std::vector<CornerTriple> triangles;
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
};

bool indicesAreInRange(const aiMesh& mesh, const aiFace& face) {
  return mesh.mVertices != nullptr &&
         std::all_of(face.mIndices, face.mIndices + face.mNumIndices,
                     [&](unsigned index) { return index < mesh.mNumVertices; });
}

void addFace(const aiMesh& mesh, const aiFace& face, MeshTriangles& out) {
  if (face.mNumIndices == 3) {
    out.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    return;
  }
  std::vector<Vector3d> corners;
  corners.reserve(face.mNumIndices);
  for (unsigned k = 0; k < face.mNumIndices; ++k) {
    corners.push_back(vertexOf(mesh, face.mIndices[k]));
  }
  const std::size_t first = out.triangles.size();
  cutPolygon(corners, out.triangles);
  for (std::size_t i = first; i < out.triangles.size(); ++i) {
    for (std::uint32_t& corner : out.triangles[i]) corner = face.mIndices[corner];
  }
}

MeshTriangles trianglesOf(const aiMesh& mesh) {
  MeshTriangles out;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices < 3) {
      ++out.skippedPrimitives;
    } else if (!indicesAreInRange(mesh, face)) {
      ++out.skippedFaces;
    } else {
      addFace(mesh, face, out);
    }
    if (out.triangles.size() > kMaxTriangles) {
      throw Failure{ImportFailure::TooLarge,
                    "a mesh of more than " + std::to_string(kMaxTriangles) + " triangles"};
    }
  }
  return out;
}

/// A mesh where a node puts it.
struct Placement {
  unsigned mesh;
  const aiString* name;
  Transform toWorld;
};

struct Model {
  const aiScene* scene = nullptr;
  std::vector<MeshTriangles> meshes;
  std::vector<Placement> placements;  // with triangles only
  ImportTotals totals;
  std::size_t nameBytes = 0;  // as the parent will count them
};

void addPlacement(Model& model, const aiNode& node, unsigned mesh, const Transform& toWorld) {
  if (mesh >= model.scene->mNumMeshes) {
    throw Failure{ImportFailure::Refused, "a node places a mesh that the file does not hold"};
  }
  const MeshTriangles& triangles = model.meshes[mesh];
  ImportTotals& totals = model.totals;
  ++totals.meshInstances;
  totals.skippedPrimitives += triangles.skippedPrimitives;
  totals.skippedFaces += triangles.skippedFaces;
  if (triangles.triangles.empty()) return;
  const aiString& meshName = model.scene->mMeshes[mesh]->mName;
  const aiString& name = node.mName.length > 0 ? node.mName : meshName;
  totals.triangles += triangles.triangles.size();
  ++totals.objects;
  model.nameBytes += readableText({name.data, name.length}, kMaxObjectNameBytes).size();
  if (totals.triangles > kMaxTriangles || totals.objects > kMaxImportObjects ||
      model.nameBytes > kMaxImportNameBytes) {
    throw Failure{ImportFailure::TooLarge,
                  "instances counted, it has more than " + std::to_string(kMaxTriangles) +
                      " triangles, " + std::to_string(kMaxImportObjects) + " objects or " +
                      std::to_string(kMaxImportNameBytes) + " bytes of names"};
  }
  model.placements.push_back({mesh, &name, toWorld});
}

/// Depth first, parents before children, children in order: on a stack of our own, as the depth of
/// the tree is the file's choice.
void walk(Model& model, const Transform& rootToWorld) {
  struct Pending {
    const aiNode* node;
    Transform parentToWorld;
  };
  std::vector<Pending> pending{{model.scene->mRootNode, rootToWorld}};
  while (!pending.empty()) {
    const Pending current = pending.back();
    pending.pop_back();
    const aiNode& node = *current.node;
    ++model.totals.nodes;
    const Transform toWorld = current.parentToWorld * transformOf(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      addPlacement(model, node, node.mMeshes[i], toWorld);
    }
    for (unsigned i = node.mNumChildren; i > 0; --i) {
      pending.push_back({node.mChildren[i - 1], toWorld});
    }
  }
}

/// Metres per unit. FBX alone states its unit without applying it (in centimetres); Collada's is
/// applied by its reader, the other formats are metres or say nothing.
double metresPerUnit(const Assimp::Importer& importer, const aiScene& scene) {
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* reader =
      index < 0 ? nullptr : importer.GetImporterInfo(static_cast<std::size_t>(index));
  const bool isFbx = reader != nullptr && reader->mFileExtensions != nullptr &&
                     std::string_view(reader->mFileExtensions) == "fbx";
  float centimetres = 0.0F;
  if (!isFbx || scene.mMetaData == nullptr ||
      !scene.mMetaData->Get("UnitScaleFactor", centimetres) || !(centimetres > 0.0F)) {
    return 1.0;
  }
  return static_cast<double>(centimetres) / 100.0;
}

void setUp(Assimp::Importer& importer) {
  // Files with bones and no mesh get a mesh of bones otherwise, a surface that nobody drew.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // What is not read cannot break.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
}

/// No post-processing at all: its steps merge, drop or reorder triangles, or refuse sloppy files
/// that are usable; what is needed of them is done here.
const aiScene& readScene(Assimp::Importer& importer, const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (!importer.IsExtensionSupported(extension)) {
    throw Failure{ImportFailure::UnknownFormat, extension};
  }
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    // assimp catches its own failed allocations and leaves their name.
    const bool outOfMemory = reason.find("bad_alloc") != std::string::npos;
    throw Failure{outOfMemory ? ImportFailure::OutOfMemory : ImportFailure::Refused, reason};
  }
  if (scene->mRootNode == nullptr) throw Failure{ImportFailure::Refused, "no root node"};
  return *scene;
}

void writeModel(const Model& model, ImportWriter& writer) {
  writer.totals(model.totals);
  for (const Placement& placement : model.placements) {
    const aiMesh& mesh = *model.scene->mMeshes[placement.mesh];
    const std::vector<CornerTriple>& triangles = model.meshes[placement.mesh].triangles;
    writer.object({placement.name->data, placement.name->length}, triangles.size());
    for (const CornerTriple& corners : triangles) {
      writer.triangle({placement.toWorld * vertexOf(mesh, corners[0]),
                       placement.toWorld * vertexOf(mesh, corners[1]),
                       placement.toWorld * vertexOf(mesh, corners[2])});
    }
  }
}

bool importFile(const std::string& path, ImportWriter& writer) {
  // Never destroyed: assimp frees its tree by recursion, and a deep one that was read well must not
  // crash afterwards.
  Assimp::Importer& importer = *new Assimp::Importer;
  setUp(importer);
  Model model;
  model.scene = &readScene(importer, path);
  model.totals.uniqueMeshes = model.scene->mNumMeshes;
  for (unsigned i = 0; i < model.scene->mNumMeshes; ++i) {
    model.meshes.push_back(trianglesOf(*model.scene->mMeshes[i]));
  }
  Transform toMetres;
  toMetres.linear *= metresPerUnit(importer, *model.scene);
  walk(model, toMetres);
  writeModel(model, writer);
  return writer.finish();
}

bool writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

int run(const std::string& path) {
  // Standard output is kept for the stream; what assimp or its libraries print goes to stderr.
  const int output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (output < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    std::perror("foretouch-import: standard output");
    return 2;
  }
  ImportWriter writer([output](std::string_view bytes) { return writeAll(output, bytes); });
  try {
    return importFile(path, writer) ? 0 : 1;
  } catch (const Failure& failure) {
    writer.fail(failure.kind, failure.text);
  } catch (const std::bad_alloc&) {
    writer.fail(ImportFailure::OutOfMemory, "");
  } catch (const std::exception& error) {
    writer.fail(ImportFailure::Refused, error.what());
  }
  return 1;
}

}  // namespace
}  // namespace foretouch::internal

int main(int argc, char** argv) {
  if (argc != 2 || std::string_view(argv[1]) == "--help" || isatty(STDOUT_FILENO) != 0) {
    std::fputs(
        "usage: foretouch-import FILE\n"
        "Writes the triangles of a model file to standard output, in a binary form that the\n"
        "foretouch library reads. Not meant to be run by hand.\n",
        stderr);
    return 2;
  }
  _exit(foretouch::internal::run(argv[1]));
}
