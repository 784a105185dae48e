#include "assets/model/model_links.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/LU>

#include "articulated/try.h"
#include "assets/model/model_frames.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr char kPivotMark[] = "_$AssimpFbx$_";
constexpr char kNameless[] = "unnamed";
/// Distance from the identity: above the single-precision rounding of a frame without scale.
constexpr double kNoticeableScale = 1e-4;
/// No unit is that far from metres; products of smaller values stay finite.
constexpr double kLargestScale = 1e9;

Error nodeError(ErrorCode code, const Model& model, std::size_t node, const std::string& what) {
  return {code, "", -1, static_cast<std::int64_t>(node),
          "node " + std::to_string(node) + " " + inQuotes(model.nodes[node].name) + " " + what};
}

class LinkFinder {
 public:
  LinkFinder(const Model& model, const ModelOwnership& ownership)
      : model_(model), size_(model.nodes.size()), ownership_(ownership) {}

  /// Per node: is it a link?
  std::vector<bool> links();
  /// Per node: the node below it that it is a pivot of, else itself.
  [[nodiscard]] std::int32_t served(std::size_t node) const { return served_[node]; }

 private:
  void findLoads();
  void findMoved();
  void findServed();
  void leaveOutOnlookers();
  [[nodiscard]] bool isIdlePivot(std::size_t node) const {
    return !loaded_[node] && model_.nodes[node].name.find(kPivotMark) != std::string::npos;
  }

  const Model& model_;
  std::size_t size_;
  const ModelOwnership& ownership_;
  std::vector<bool> loaded_, moved_, hasChildren_;
  std::vector<std::int32_t> served_;
};

void LinkFinder::findLoads() {
  loaded_ = ownership_.carries;
  for (const ModelMesh& mesh : model_.meshes) {
    for (const ModelBone& bone : mesh.bones) {
      if (bone.node >= 0) loaded_[slotOf(bone.node)] = true;
    }
  }
  for (std::size_t i = 0; i < size_; ++i) {
    const ModelNode& node = model_.nodes[i];
    if (!node.lss.empty() || node.joint != ModelJointType::Free) loaded_[i] = true;
  }
}

void LinkFinder::findMoved() {
  moved_.assign(size_, false);
  for (const ModelAnimation& animation : model_.animations) {
    for (const ModelTrack& track : animation.tracks) {
      if (track.node >= 0) moved_[slotOf(track.node)] = true;
    }
  }
}

/// Bottom up: a pivot of X serves the same node as the child that leads to X.
void LinkFinder::findServed() {
  served_.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) served_[i] = static_cast<std::int32_t>(i);
  for (std::size_t i = size_; i-- > 0;) {
    const std::int32_t parent = model_.nodes[i].parent;
    if (parent < 0 || !isIdlePivot(slotOf(parent))) continue;
    const std::string& pivot = model_.nodes[slotOf(parent)].name;
    const std::string& name = model_.nodes[slotOf(served_[i])].name;
    const std::size_t length = pivot.find(kPivotMark);
    if (name.size() == length && pivot.compare(0, length, name) == 0) {
      served_[slotOf(parent)] = served_[i];
    }
  }
}

/// A camera or a light is not a link, however it moves, unless something else makes it one; nor is
/// what moves only such (a camera's crane). A joint of the body that carries a camera stays a link.
void LinkFinder::leaveOutOnlookers() {
  const auto isAlone = [&](std::size_t node) {
    return !loaded_[node] && (model_.nodes[node].isOnlooker || hasChildren_[node]);
  };
  std::vector<bool> onlyCarries(size_, true), isBelowBody(size_, false);
  hasChildren_.assign(size_, false);
  for (std::size_t i = size_; i-- > 0;) {
    onlyCarries[i] = onlyCarries[i] && isAlone(i);
    const std::int32_t parent = model_.nodes[i].parent;
    if (parent < 0) continue;
    hasChildren_[slotOf(parent)] = true;
    if (!onlyCarries[i]) onlyCarries[slotOf(parent)] = false;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    const std::int32_t parent = model_.nodes[i].parent;
    isBelowBody[i] =
        parent >= 0 &&
        (isBelowBody[slotOf(parent)] ||
         ((moved_[slotOf(parent)] || loaded_[slotOf(parent)]) && !onlyCarries[slotOf(parent)]));
    const std::size_t served = slotOf(served_[i]);
    const bool isOnlooker = model_.nodes[served].isOnlooker && !loaded_[served];
    if (isOnlooker || (onlyCarries[i] && !isBelowBody[i])) moved_[i] = false;
  }
}

std::vector<bool> LinkFinder::links() {
  findLoads();
  findMoved();
  findServed();
  leaveOutOnlookers();
  std::vector<bool> isLink = loaded_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (moved_[i]) isLink[slotOf(served_[i])] = true;
  }
  const std::vector<bool> isNeeded = isLink;
  for (std::size_t i = size_; i-- > 0;) {
    const std::int32_t parent = model_.nodes[i].parent;
    // Through pivots too, links or not: the nodes above them count.
    if (parent < 0 || !isLink[i]) continue;
    isLink[slotOf(parent)] = true;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    if (isIdlePivot(i) && !isNeeded[i]) isLink[i] = false;
  }
  return isLink;
}

/// The first link of a name keeps it, later ones become name#2, name#3, ..., skipping names that
/// the model already has.
class LinkNames {
 public:
  explicit LinkNames(const Model& model) {
    for (const ModelNode& node : model.nodes) own_.insert(node.name);
  }
  std::string nameOf(const ModelNode& node) {
    constexpr std::size_t kSuffixBytes = 16;
    const bool isUsable =
        !nameProblem(node.name) && node.name.size() + kSuffixBytes <= kMaxNameBytes;
    const std::string base = isUsable ? node.name : kNameless;
    if (!isUsable) ++nameless_;
    if (taken_.insert(base).second) return base;
    std::int32_t& number = numbers_.emplace(base, 1).first->second;
    for (;;) {
      std::string name = base + "#" + std::to_string(++number);
      if (own_.count(name) != 0 || !taken_.insert(name).second) continue;
      if (isUsable) renamed_.push_back(name);
      return name;
    }
  }
  void addNotes(std::vector<std::string>& notes) const {
    if (nameless_ > 0) {
      notes.push_back(std::to_string(nameless_) +
                      " links have no usable name of their own and are " + "called '" + kNameless +
                      "'");
    }
    if (!renamed_.empty()) {
      notes.push_back("names that occur more than once get a number: " + listed(renamed_));
    }
  }

 private:
  std::unordered_set<std::string> own_, taken_;
  std::unordered_map<std::string, std::int32_t> numbers_;
  std::vector<std::string> renamed_;
  std::size_t nameless_ = 0;
};

/// The nearest link above a node; kNoParent if there is none.
std::vector<LinkId> linksAbove(const Model& model, const std::vector<LinkId>& linkOfNode) {
  std::vector<LinkId> above(model.nodes.size(), kNoParent);
  for (std::size_t i = 0; i < above.size(); ++i) {
    const std::int32_t parent = model.nodes[i].parent;
    if (parent < 0) continue;
    above[i] = linkOfNode[slotOf(parent)] != kNoParent ? linkOfNode[slotOf(parent)]
                                                       : above[slotOf(parent)];
  }
  return above;
}

void noteShapes(ModelLinks& links, const std::vector<std::string>& names) {
  std::vector<std::string> scaled, mirrored;
  for (std::size_t link = 0; link < links.shape.size(); ++link) {
    const Eigen::Matrix3d& shape = links.shape[link];
    const double off = (shape - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (shape.determinant() < 0.0) {
      mirrored.push_back(names[link]);
    } else if (off > kNoticeableScale) {
      scaled.push_back(names[link]);
    }
  }
  if (!scaled.empty()) {
    links.notes.push_back("links are rigid: the scale of " + std::to_string(scaled.size()) +
                          " nodes went into vertices and offsets: " + listed(scaled));
  }
  if (!mirrored.empty()) {
    links.notes.push_back(
        std::to_string(mirrored.size()) +
        " nodes mirror what they carry; so do its vertices now: " + listed(mirrored));
  }
}

std::optional<Error> countError(std::size_t links) {
  if (links == 0) {
    return Error::of(
        ErrorCode::Empty,
        "the model has no node that carries or moves anything; expected bones, meshes, "
        "joints or an animation of them (cameras and lights are no bones)");
  }
  if (links > slotOf(kMaxJoints)) {
    return Error::of(ErrorCode::LimitExceeded, "expected at most " + std::to_string(kMaxJoints) +
                                                   " links, found " + std::to_string(links));
  }
  return std::nullopt;
}

struct RigidFrame {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position;
};

/// The frame in its parent's (in the world if there is none).
RawJoint relative(const RigidFrame& frame, const RigidFrame* parent) {
  RawJoint joint;
  joint.offset = frame.position;
  Eigen::Matrix3d rotation = frame.rotation;
  if (parent != nullptr) {
    joint.offset = parent->rotation.transpose() * (frame.position - parent->position);
    rotation = parent->rotation.transpose() * frame.rotation;
  }
  joint.rotation = Quaternion(rotation).normalized();
  return joint;
}

}  // namespace

Result<Done> checkModel(const Model& model) {
  const auto count = static_cast<std::int64_t>(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    if (node.parent < -1 || node.parent >= static_cast<std::int64_t>(i)) {
      return nodeError(ErrorCode::BadHierarchy, model, i, "does not come after its parent");
    }
    if (!node.toParent.linear.allFinite() || !node.toParent.translation.allFinite()) {
      return nodeError(ErrorCode::NonFinite, model, i, "has a transform that is not finite");
    }
  }
  const auto isNode = [&](std::int32_t node) { return node >= 0 && node < count; };
  for (const ModelMimic& mimic : model.mimics) {
    if (isNode(mimic.node) && isNode(mimic.leader)) continue;
    return Error::of(ErrorCode::OutOfRange, "a joint follows one of a node that is not there");
  }
  for (const ModelMesh& mesh : model.meshes) {
    bool isSound = isNode(mesh.node);
    for (const auto& triangle : mesh.triangles) {
      for (const std::int32_t v : triangle) {
        isSound = isSound && v >= 0 && slotOf(v) < mesh.vertices.size();
      }
    }
    for (const ModelBone& bone : mesh.bones)
      isSound = isSound && bone.node >= -1 && bone.node < count;
    if (isSound) continue;
    return Error::of(ErrorCode::OutOfRange, "mesh " + inQuotes(mesh.name) +
                                                " refers to a node or vertex that is not there");
  }
  for (const ModelAnimation& animation : model.animations) {
    for (const ModelTrack& track : animation.tracks) {
      if (track.node < count) continue;
      return Error::of(ErrorCode::OutOfRange,
                       "animation " + inQuotes(animation.name) + " moves a node that is not there");
    }
  }
  return Done{};
}

Result<ModelLinks> modelLinks(const Model& model, const ModelOwnership& ownership) {
  LinkFinder finder(model, ownership);
  const std::vector<bool> isLink = finder.links();
  ModelLinks links;
  links.linkOfNode.assign(model.nodes.size(), kNoParent);
  for (std::size_t i = 0; i < isLink.size(); ++i) {
    if (!isLink[i]) continue;
    links.linkOfNode[i] = static_cast<LinkId>(links.nodeOfLink.size());
    links.nodeOfLink.push_back(static_cast<std::int32_t>(i));
  }
  if (auto error = countError(links.nodeOfLink.size())) return *std::move(error);
  for (std::size_t i = 0; i < isLink.size(); ++i) {
    links.servedLink.push_back(links.linkOfNode[slotOf(finder.served(i))]);
  }

  const std::vector<Affine> world = worldFrames(model, restFrames(model));
  const std::vector<LinkId> above = linksAbove(model, links.linkOfNode);
  LinkNames naming(model);
  RawSkeleton raw;
  std::vector<RigidFrame> frames;
  std::vector<std::string> names;
  for (const std::int32_t node : links.nodeOfLink) {
    const Affine& frame = world[slotOf(node)];
    if (!frame.translation.allFinite() || !(frame.linear.cwiseAbs().maxCoeff() <= kLargestScale)) {
      return nodeError(ErrorCode::OutOfRange, model, slotOf(node),
                       "is scaled by more than 1e9 or has no finite place in the world");
    }
    frames.push_back({nearestRotation(frame.linear), frame.translation});
    links.shape.push_back(frames.back().rotation.transpose() * frame.linear);
    const LinkId parent = above[slotOf(node)];
    RawJoint joint =
        relative(frames.back(), parent == kNoParent ? nullptr : &frames[slotOf(parent)]);
    joint.parent = parent;
    joint.name = naming.nameOf(model.nodes[slotOf(node)]);
    names.push_back(joint.name);
    raw.joints.push_back(std::move(joint));
  }
  naming.addNotes(links.notes);
  noteShapes(links, names);
  FORETOUCH_TRY(links.skeleton, Skeleton::build(raw));
  return links;
}

Pose poseOfFrames(const Model& model, const ModelLinks& links, const std::vector<Affine>& toParent,
                  std::vector<double>& worstShear) {
  const std::vector<Affine> world = worldFrames(model, toParent);
  std::vector<RigidFrame> frames;
  Pose pose;
  for (std::size_t link = 0; link < links.nodeOfLink.size(); ++link) {
    const Affine& frame = world[slotOf(links.nodeOfLink[link])];
    const Eigen::Matrix3d& shape = links.shape[link];
    // The R for which |frame - R shape| is least; at rest, the R that defined the shape.
    frames.push_back({nearestRotation(frame.linear * shape.transpose()), frame.translation});
    const double off = (frame.linear - frames.back().rotation * shape).norm();
    worstShear[link] = std::max(worstShear[link], off / std::max(shape.norm(), 1e-300));
    const LinkId parent = links.skeleton.parent(static_cast<LinkId>(link));
    const RawJoint joint =
        relative(frames.back(), parent == kNoParent ? nullptr : &frames[slotOf(parent)]);
    pose.rotations.push_back(joint.rotation);
    pose.translations.push_back(joint.offset);
  }
  return pose;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) {
    text += (i == 0 ? "" : ", ") + inQuotes(names[i]);
  }
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

}  // namespace foretouch::internal
