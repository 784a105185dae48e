// tests/assets/import_files.h: model files and fake importers, made by the test.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "assets/import/scene_import.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {

/// Options that name the importer under test.
SceneImportOptions withImporter();

/// One triangle with corners (0,0,0), (1,0,0), (0,1,0), as OBJ.
inline constexpr std::string_view kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A PLY file with float vertices and int indices, binary little-endian.
std::string binaryPly(const std::vector<Eigen::Vector3f>& vertices,
                      const std::vector<std::array<int, 3>>& faces);

/// A glTF file whose mesh 0 is the triangle above, `copies` times, and mesh 1 two points and a
/// line; `nodes` is the JSON array of nodes, of which 0 is the root.
std::string gltfWithNodes(const std::string& nodes, int copies = 1);

/// A BVH of 100,000 joints, each below the one before: assimp's reader overruns its stack on it.
std::string bvhThatCrashesTheReader();

std::string base64(std::string_view bytes);

/// The vertices of triangle `i`, one per row, for comparing and printing.
Eigen::Matrix3d cornersOf(const ImportedScene& imported, std::size_t i);
Eigen::Matrix3d rows(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// How many descriptors this process has open.
std::size_t openDescriptors();
/// Does this process have children, dead or alive?
bool hasChildren();

}  // namespace foretouch::test
