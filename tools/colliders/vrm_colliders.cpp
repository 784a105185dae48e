// Spring bones' colliders of VRM avatars: tools/colliders/collider_writers.h. The importer's own
// process reads and checks the file first; here its JSON is changed, and none of it is trusted.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "articulated/link_places.h"
#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "assets/model/model_frames.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/colliders/capsule_forms.h"
#include "tools/colliders/collider_writers.h"
#include "tools/little_endian.h"

namespace foretouch::tools {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
// Keys stay in the file's order.
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t{4} << 30;
/// A GLB's header, and its first chunk's (Khronos, glTF 2.0, "GLB File Format Specification").
constexpr std::size_t kHeadBytes = 12, kChunkHeadBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
/// Deeper JSON is refused: writing it takes the machine's stack. VRM nests some ten deep.
constexpr int kMostDepth = 256;
/// A bone may rest so far (m), and turned so far (share of its reach), from the avatar's: what
/// files in floats lose.
constexpr double kSamePlace = 1e-4, kSameTurn = 1e-4;
/// Spheres of VRM 0.x that stand in for a capsule are thicker by this share at most. A choice: at 5
/// % a forearm takes nine.
constexpr double kThicker = 0.05;
constexpr char kGroup[] = "Foretouch";

Error refusal(const std::string& path, std::string message) {
  return Error::in(path, ErrorCode::Mismatch, std::move(message));
}

/// Where the avatar's links are in the file.
struct Place {
  std::size_t node = 0;  ///< In the file.
  Matrix3d shape;        ///< The node's frame is the link's, times this (scale).
  double scale = 1.0;    ///< The least scale along any direction.
};

/// A collider of the file.
struct FileCollider {
  std::size_t node = 0;
  Lss lss;  ///< In the node's frame.
};

std::vector<LinkState> restPlacesOf(const Skeleton& skeleton) {
  std::vector<LinkState> places;
  placesAt(skeleton, restPose(skeleton), places);
  return places;
}

/// The file's colliders, from an avatar of the same file.
class ColliderFinder {
 public:
  ColliderFinder(const Avatar& avatar, const std::string& path, std::vector<std::string>& notes)
      : avatar_(avatar), path_(path), notes_(notes) {}

  Result<std::vector<FileCollider>> find() {
    FORETOUCH_TRY(const Model model, importModel(path_));
    FORETOUCH_TRY(const ModelAvatar made, avatarFromModel(model));
    const std::vector<Affine> nodes = internal::worldFrames(model, internal::restFrames(model));
    const std::vector<LinkState> theirs = restPlacesOf(made.avatar.skeleton());
    const std::vector<LinkState> ours = restPlacesOf(avatar_.skeleton());
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (avatar_.lss(link).empty()) continue;
      const auto same = made.avatar.skeleton().find(avatar_.skeleton().name(link));
      if (!same) return stranger(link, "is no node of it");
      const LinkState& there = theirs[slotOf(*same)];
      const double off = (there.p_WL - ours[slotOf(link)].p_WL).norm();
      const double turned = (there.R_WL - ours[slotOf(link)].R_WL).cwiseAbs().maxCoeff();
      if (off > kSamePlace || turned > kSameTurn) {
        return stranger(
            link, fmt::format("rests {:.2g} m from its node, turned by {:.2g} rad", off, turned));
      }
      const ModelNode& node = model.nodes[slotOf(made.nodeOfLink[slotOf(*same)])];
      const Matrix3d shape =
          there.R_WL.transpose() * nodes[slotOf(made.nodeOfLink[slotOf(*same)])].linear;
      FORETOUCH_CHECK(add(link, node, made.avatar.lss(*same), shape));
    }
    tell();
    return std::move(found_);
  }

 private:
  [[nodiscard]] Error stranger(LinkId link, const std::string& what) const {
    return refusal(path_,
                   "expected the avatar that foretouch avatar mesh makes of this file; its link " +
                       inQuotes(avatar_.skeleton().name(link)) + " " + what);
  }

  /// `theirs`: first those that the file states itself.
  Result<Done> add(LinkId link, const ModelNode& node, const std::vector<Lss>& theirs,
                   const Matrix3d& shape) {
    const auto sizes = Eigen::JacobiSVD<Matrix3d>(shape).singularValues();
    if (node.fileNode < 0 || !(sizes[2] > 0.0)) return stranger(link, "has no node with a size");
    const bool isRigid = (shape - Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-9;
    scaled_ += isRigid ? 0 : 1;
    const std::size_t stated = std::min(node.lss.size(), theirs.size());
    for (const Lss& lss : avatar_.lss(link)) {
      const auto isSame = [&](const Lss& other) {
        const Lss collider = asCollider(other);
        return collider.a == lss.a && collider.b == lss.b && collider.radius == lss.radius;
      };
      if (std::any_of(theirs.begin(), theirs.begin() + static_cast<std::ptrdiff_t>(stated),
                      isSame)) {
        ++known_;
        continue;
      }
      // Some readers scale radii and some do not: this one is large enough for both.
      const Matrix3d back = isRigid ? Matrix3d(Matrix3d::Identity()) : Matrix3d(shape.inverse());
      const double radius =
          isRigid ? lss.radius : lss.radius * std::max(1.0, (1.0 + 1e-9) / sizes[2]);
      found_.push_back(
          {static_cast<std::size_t>(node.fileNode), {back * lss.a, back * lss.b, radius}});
    }
    return Done{};
  }

  void tell() {
    if (known_ > 0) {
      notes_.push_back(fmt::format("{} colliders that the file has already are not added", known_));
    }
    if (scaled_ > 0) {
      notes_.push_back(
          fmt::format("{} bones are scaled: radii there hold the LSS whether or not a "
                      "tool scales them",
                      scaled_));
    }
  }

  const Avatar& avatar_;
  const std::string& path_;
  std::vector<std::string>& notes_;
  std::vector<FileCollider> found_;
  std::size_t known_ = 0, scaled_ = 0;
};

Json vectorOf(const Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

/// The list, which becomes one where there is none.
Json& listIn(Json& object, const char* key) {
  Json& list = object[key];
  if (!list.is_array()) list = Json::array();
  return list;
}

/// The objects of a list that may not be there.
std::vector<Json*> objectsIn(Json& object, const char* key) {
  std::vector<Json*> found;
  if (!object.contains(key) || !object[key].is_array()) return found;
  for (Json& element : object[key]) {
    if (element.is_object()) found.push_back(&element);
  }
  return found;
}

void addTo(Json& document, const char* list, const char* name) {
  Json& names = listIn(document, list);
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// VRM 1.0: one group of colliders, minded by every spring.
void addToOne(Json& document, const std::vector<FileCollider>& added) {
  addTo(document, "extensionsUsed", "VRMC_springBone");
  Json& springBone = document["extensions"]["VRMC_springBone"];
  if (!springBone.is_object()) springBone = {{"specVersion", "1.0"}};
  Json& colliders = listIn(springBone, "colliders");
  Json group = {{"name", kGroup}, {"colliders", Json::array()}};
  for (const FileCollider& collider : added) {
    const Lss lss = byEnds(collider.lss, HeldAs::Floats);
    const bool isSphere = lss.a == lss.b;
    Json shape = {{"offset", vectorOf(lss.a)}, {"radius", lss.radius}};
    if (!isSphere) shape["tail"] = vectorOf(lss.b);
    group["colliders"].push_back(colliders.size());
    colliders.push_back({{"node", collider.node},
                         {"shape", {{isSphere ? "sphere" : "capsule", std::move(shape)}}}});
  }
  Json& groups = listIn(springBone, "colliderGroups");
  for (Json* const spring : objectsIn(springBone, "springs")) {
    listIn(*spring, "colliderGroups").push_back(groups.size());
  }
  groups.push_back(std::move(group));
}

/// Spheres along the axis, which hold the LSS: a point within r of the axis is within half a
/// spacing and r of a centre, in a right angle.
std::vector<Lss> spheresOf(const Lss& lss) {
  const double length = (lss.b - lss.a).norm();
  if (length == 0.0) return {lss};
  const double half = lss.radius * std::sqrt((1.0 + kThicker) * (1.0 + kThicker) - 1.0);
  const double count = std::min(std::ceil(length / (2.0 * half)), 1000.0);
  const double radius = std::hypot(lss.radius, 0.5 * length / count) * (1.0 + 1e-12);
  std::vector<Lss> spheres;
  for (double i = 0.0; i <= count; i += 1.0) {
    const Vector3d middle = lss.a + i / count * (lss.b - lss.a);
    spheres.push_back({middle, middle, radius});
  }
  return spheres;
}

/// VRM 0.x: a group per node, minded by every group of springs. Its offsets are in Unity's frame,
/// mirrored in z.
void addToOld(Json& document, const std::vector<FileCollider>& added,
              std::vector<std::string>& notes) {
  Json& moved = document["extensions"]["VRM"]["secondaryAnimation"];
  if (!moved.is_object()) moved = Json::object();
  Json& groups = listIn(moved, "colliderGroups");
  const std::size_t first = groups.size();
  std::size_t capsules = 0, spheres = 0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    if (i == 0 || added[i].node != added[i - 1].node) {
      groups.push_back({{"node", added[i].node}, {"colliders", Json::array()}});
    }
    const std::vector<Lss> parts = spheresOf(added[i].lss);
    capsules += parts.size() > 1 ? 1 : 0;
    spheres += parts.size() > 1 ? parts.size() : 0;
    for (const Lss& part : parts) {
      const Lss lss = byEnds(part, HeldAs::Floats);
      const Json offset = {{"x", lss.a.x()}, {"y", lss.a.y()}, {"z", -lss.a.z()}};
      groups.back()["colliders"].push_back({{"offset", offset}, {"radius", lss.radius}});
    }
  }
  for (Json* const springs : objectsIn(moved, "boneGroups")) {
    for (std::size_t g = first; g < groups.size(); ++g)
      listIn(*springs, "colliderGroups").push_back(g);
  }
  if (capsules == 0) return;
  notes.push_back(
      fmt::format("VRM 0.x has spheres alone: {} capsules became {} spheres, which hold "
                  "them and are at most {} % thicker",
                  capsules, spheres, 100.0 * kThicker));
}

Result<Json> parsed(std::string_view text, const std::string& path) {
  bool isTooDeep = false;
  const Json::parser_callback_t watch = [&](int depth, Json::parse_event_t, Json&) {
    isTooDeep = isTooDeep || depth > kMostDepth;
    return !isTooDeep;
  };
  Json document = Json::parse(text, watch, false);
  if (isTooDeep || !document.is_object()) {
    return refusal(path, isTooDeep ? "expected JSON that nests at most 256 deep, found more"
                                   : "expected JSON of a glTF file, found other text");
  }
  return document;
}

std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i > 0; --i) {
    word = word << 8 | static_cast<unsigned char>(bytes[offset + i - 1]);
  }
  return word;
}

/// The file with another text as its first chunk. All that comes behind it stays, byte for byte.
Result<std::string> withText(std::string_view bytes, std::size_t textBytes, std::string text,
                             const std::string& path) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t total = bytes.size() - textBytes + text.size();
  if (total >= kMostBytes)
    return refusal(path, "the file would be larger than a GLB may be, 4 GiB");
  std::string out(bytes.substr(0, kHeadBytes - 4));
  for (const std::size_t word : {total, text.size(), std::size_t{kJsonChunk}}) {
    appendBytes(out, static_cast<std::uint32_t>(word));
  }
  out += text;
  out += bytes.substr(kHeadBytes + kChunkHeadBytes + textBytes);
  return out;
}

}  // namespace

Result<std::string> vrmColliders(const Avatar& avatar, const std::string& path,
                                 std::vector<std::string>& notes) {
  FORETOUCH_TRY(const auto added, ColliderFinder(avatar, path, notes).find());
  FORETOUCH_TRY(const std::string bytes, readWholeFile(path, kMostBytes - 1));
  const std::size_t begin = kHeadBytes + kChunkHeadBytes;
  if (bytes.size() < begin || bytes.compare(0, 4, "glTF") != 0 ||
      wordAt(bytes, kHeadBytes) > bytes.size() - begin) {
    return refusal(path, "expected a VRM avatar in one file (GLB), found another one");
  }
  const std::size_t textBytes = wordAt(bytes, kHeadBytes);
  FORETOUCH_TRY(Json document, parsed(std::string_view(bytes).substr(begin, textBytes), path));
  Json& extensions = document["extensions"];
  if (!extensions.is_object()) extensions = Json::object();
  const bool isOne = extensions.contains("VRMC_vrm");
  if (!isOne && (!extensions.contains("VRM") || !extensions["VRM"].is_object())) {
    return refusal(path, "expected a VRM avatar: the file holds neither VRMC_vrm nor VRM");
  }
  isOne ? addToOne(document, added) : addToOld(document, added, notes);
  return withText(bytes, textBytes, document.dump(-1, ' ', false, Json::error_handler_t::replace),
                  path);
}

}  // namespace foretouch::tools
