#include "assets/mesh/link_mesh.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "articulated/try.h"
#include "assets/import/model_stream.h"
#include "assets/import/text.h"
#include "assets/mesh/link_mesh_skinned.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "lss/single.h"

namespace foretouch {
namespace {

using Surfaces = std::vector<std::vector<Triangle>>;

// A frame whose axes are unit and at right angles up to this counts as rigid: files hold floats.
constexpr double kRigidSlack = 1e-5;

Error meshError(ErrorCode code, const std::string& file, LinkId link, std::string message) {
  return Error{code, file, -1, link, std::move(message)};
}

/// The only node of that name, as the import makes names readable.
Result<std::int32_t> nodeNamed(const Model& model, const std::string& name, const std::string& file,
                               LinkId link) {
  const std::string readable = internal::readableText(name, internal::kMaxModelNameBytes);
  std::optional<std::int32_t> found;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].name != readable) continue;
    if (found.has_value()) {
      return meshError(ErrorCode::DuplicateName, file, link,
                       "several nodes are named " + inQuotes(name));
    }
    found = static_cast<std::int32_t>(i);
  }
  if (!found.has_value()) {
    return meshError(ErrorCode::UnknownName, file, link, "no node is named " + inQuotes(name));
  }
  return *found;
}

bool isRigid(const Eigen::Matrix3d& m) {
  return (m.transpose() * m - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRigidSlack &&
         m.determinant() > 0.0;
}

bool hasBones(const Model& model) {
  return std::any_of(model.meshes.begin(), model.meshes.end(),
                     [](const ModelMesh& mesh) { return !mesh.bones.empty(); });
}

/// Do the frames of all these nodes, and of those above them, neither scale nor mirror?
bool areRigid(const Model& model, const std::vector<std::int32_t>& nodes) {
  std::vector<bool> rigid;
  rigid.reserve(model.nodes.size());
  for (const ModelNode& node : model.nodes) {
    rigid.push_back((node.parent < 0 || rigid[slotOf(node.parent)]) &&
                    isRigid(node.toParent.linear));
  }
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](std::int32_t node) { return rigid[slotOf(node)]; });
}

/// Are all vertices at these nodes floats? Skips those that are not finite.
bool areFloats(const Model& model, const std::vector<std::int32_t>& nodes) {
  const std::set<std::int32_t> wanted(nodes.begin(), nodes.end());
  return std::all_of(model.meshes.begin(), model.meshes.end(), [&](const ModelMesh& mesh) {
    return wanted.count(mesh.node) == 0 ||
           std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Eigen::Vector3d& v) {
             return !v.allFinite() || nearestFloat(v) == v;
           });
  });
}

/// The triangles of the nodes' own meshes, per node.
Surfaces ownTriangles(const Model& model, const std::vector<std::int32_t>& nodes) {
  std::map<std::int32_t, std::vector<Triangle>> ofNode;
  for (const std::int32_t node : nodes) ofNode[node];
  for (const ModelMesh& mesh : model.meshes) {
    const auto wanted = ofNode.find(mesh.node);
    if (wanted == ofNode.end()) continue;
    for (const auto& t : mesh.triangles) {
      const auto corner = [&](std::size_t k) { return mesh.vertices[slotOf(t[k])]; };
      wanted->second.push_back({{corner(0), corner(1), corner(2)}});
    }
  }
  Surfaces surfaces;
  for (const std::int32_t node : nodes) surfaces.push_back(ofNode[node]);
  return surfaces;
}

/// A promised surface that is missing or not finite would mean missed contacts.
std::optional<Error> badSurface(const std::vector<Triangle>& surface, const std::string& node,
                                const std::string& file, LinkId link) {
  if (surface.empty()) {
    return meshError(ErrorCode::Empty, file, link,
                     "the node " + inQuotes(node) + " has no triangles");
  }
  if (!std::all_of(surface.begin(), surface.end(), isFinite)) {
    return meshError(ErrorCode::NonFinite, file, link,
                     "a triangle of node " + inQuotes(node) + " is not finite");
  }
  return std::nullopt;
}

/// Bones, frames that scale or mirror, and vertices that need rounding require avatarFromModel()'s
/// rule: an avatar's LSS contain its result, to the last bit.
Result<Surfaces> surfacesIn(const Model& model, const Avatar& avatar, const std::string& path,
                            const std::vector<LinkId>& links) {
  std::vector<std::string> names;
  for (const LinkId link : links) names.push_back(avatar.mesh(link).node);
  if (hasBones(model)) return internal::surfacesOfLinks(model, names, path);
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < links.size(); ++i) {
    FORETOUCH_TRY(const auto node, nodeNamed(model, names[i], path, links[i]));
    nodes.push_back(node);
  }
  if (!areRigid(model, nodes) || !areFloats(model, nodes)) {
    return internal::surfacesOfLinks(model, names, path);
  }
  return ownTriangles(model, nodes);
}

/// Fills in the surfaces of `links`, all of which refer to `path`.
Result<Done> loadFile(const Avatar& avatar, const std::string& path,
                      const std::vector<LinkId>& links, const ModelImportOptions& options,
                      Surfaces& surfaces) {
  FORETOUCH_TRY(const auto model, importModel(path, options));
  FORETOUCH_TRY(auto found, surfacesIn(model, avatar, path, links));
  for (std::size_t i = 0; i < links.size(); ++i) {
    std::vector<Triangle>& surface = found[i];
    if (auto error = badSurface(surface, avatar.mesh(links[i]).node, path, links[i])) {
      return *error;
    }
    surfaces[slotOf(links[i])] = std::move(surface);
  }
  return Done{};
}

Result<Surfaces> loadChecked(const Avatar& avatar, const std::string& avatarPath,
                             const std::vector<LinkId>& wanted, const ModelImportOptions& options) {
  const std::filesystem::path folder = std::filesystem::path(avatarPath).parent_path();
  std::map<std::string, std::vector<LinkId>> linksOfFile;
  for (const LinkId link : wanted) {
    const std::string& file = avatar.mesh(link).file;
    if (!file.empty()) linksOfFile[(folder / file).string()].push_back(link);
  }
  Surfaces surfaces(countOf(avatar.numLinks()));
  for (const auto& [path, links] : linksOfFile) {
    FORETOUCH_CHECK(loadFile(avatar, path, links, options, surfaces));
  }
  return Result<Surfaces>(std::move(surfaces));
}

}  // namespace

Result<Surfaces> loadLinkMeshes(const Avatar& avatar, const std::string& avatarPath,
                                const ModelImportOptions& options) {
  std::vector<LinkId> all(countOf(avatar.numLinks()));
  std::iota(all.begin(), all.end(), 0);
  return loadLinkMeshes(avatar, avatarPath, all, options);
}

Result<Surfaces> loadLinkMeshes(const Avatar& avatar, const std::string& avatarPath,
                                const std::vector<LinkId>& links,
                                const ModelImportOptions& options) {
  try {
    return loadChecked(avatar, avatarPath, links, options);
  } catch (const std::bad_alloc&) {
    return meshError(ErrorCode::LimitExceeded, avatarPath, -1,
                     "not enough memory for the links' triangles");
  } catch (const std::system_error& error) {
    return meshError(ErrorCode::FileUnreadable, avatarPath, -1, error.what());
  }
}

}  // namespace foretouch
