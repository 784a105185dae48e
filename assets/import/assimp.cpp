#include "assets/import/assimp.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <assimp/config.h>
#include <assimp/importerdesc.h>

#include "assets/import/file_damage.h"
#include "assets/import/memory_budget.h"
#include "assets/import/model_files.h"
#include "assets/import/passed_over.h"
#include "assets/import/text.h"
#include "lss/index.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

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

/// The formats that docs/formats.md names, but glTF, whose reader is our own. assimp has some fifty
/// readers, and each is a way in for a file that was made to do harm.
constexpr std::array<std::string_view, 10> kAssimpFormats{".obj", ".stl", ".ply", ".dae", ".fbx",
                                                          ".3ds", ".off", ".x",   ".iqm", ".bvh"};

bool isOurs(const aiImporterDesc* reader) {
  if (reader == nullptr || reader->mFileExtensions == nullptr) return false;
  const std::string_view extensions = reader->mFileExtensions;
  const std::string first = "." + std::string(extensions.substr(0, extensions.find(' ')));
  return std::find(kAssimpFormats.begin(), kAssimpFormats.end(), first) != kAssimpFormats.end();
}

void keepOurFormatsAlone(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i > 0; --i) {
    if (!isOurs(importer.GetImporterInfo(i - 1))) {
      importer.UnregisterLoader(importer.GetImporter(i - 1));
    }
  }
}

void setUp(Assimp::Importer& importer, const std::string& path, Animations animations) {
  keepOurFormatsAlone(importer);
  importer.SetIOHandler(new ModelFiles(path));  // the importer's own from here on
  // Otherwise files with bones and no mesh get a mesh of bones, a surface that nobody drew.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // Parts that we do not read cannot fail.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, animations == Animations::Read);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
}

}  // namespace

AssimpFile readWithAssimp(const std::string& path, Animations animations) {
  // Never destroyed: assimp frees its tree recursively, and a deep tree read without error must not
  // crash afterwards.
  Assimp::Importer& importer = *new Assimp::Importer;
  setUp(importer, path, animations);
  const std::string extension = lowerExtensionOf(path);
  if (std::find(kAssimpFormats.begin(), kAssimpFormats.end(), extension) == kAssimpFormats.end()) {
    throw Failure{ImportFailure::UnknownFormat, extension};
  }
  AssimpFile file;
  file.notes = passedOver(path, animations == Animations::Read);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    // assimp catches its own failed allocations and reports their name.
    const bool outOfMemory = reason.find("bad_alloc") != std::string::npos;
    const auto damage = damageOf(path);  // a false count may have taken the memory
    if (outOfMemory && !damage) {
      throw Failure{ImportFailure::OutOfMemory, std::to_string(grantedMemory())};
    }
    throw Failure{ImportFailure::Refused, damage.value_or(reason)};
  }
  if (scene->mRootNode == nullptr) throw Failure{ImportFailure::Refused, "no root node"};
  file.scene = scene;
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* reader = index < 0 ? nullptr : importer.GetImporterInfo(slotOf(index));
  if (reader != nullptr && reader->mFileExtensions != nullptr) {
    file.frame = frameOf(*scene, reader->mFileExtensions);
  }
  return file;
}

Affine transformOf(const aiMatrix4x4& m) {
  Affine transform;
  transform.linear << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  transform.translation = Vector3d(m.a4, m.b4, m.c4);
  return transform;
}

std::string textOf(const aiString& text) {
  return std::string(text.data, text.length);
}

std::vector<Vector3d> verticesOf(const aiMesh& mesh) {
  std::vector<Vector3d> vertices;
  if (mesh.mVertices == nullptr) return vertices;
  vertices.reserve(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) vertices.push_back(vertexOf(mesh, v));
  return vertices;
}

Vector3d vertexOf(const aiMesh& mesh, std::uint32_t index) {
  const aiVector3D& v = mesh.mVertices[index];
  return {v.x, v.y, v.z};
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

void checkMeshIndex(const aiScene& scene, unsigned mesh) {
  if (mesh >= scene.mNumMeshes) {
    throw Failure{ImportFailure::Refused, "a node places a mesh that the file does not hold"};
  }
}

std::vector<VisitedNode> nodesOf(const aiScene& scene, std::size_t limit) {
  std::vector<VisitedNode> visited, pending{{scene.mRootNode, -1}};
  while (!pending.empty()) {
    const VisitedNode current = pending.back();
    pending.pop_back();
    if (visited.size() == limit) {
      throw Failure{ImportFailure::TooLarge, "more than " + std::to_string(limit) + " nodes"};
    }
    const auto index = static_cast<std::int32_t>(visited.size());
    visited.push_back(current);
    for (unsigned i = current.node->mNumChildren; i > 0; --i) {
      pending.push_back({current.node->mChildren[i - 1], index});
    }
  }
  return visited;
}

}  // namespace foretouch::internal
