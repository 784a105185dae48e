#include <algorithm>
#include <cmath>

#include "assets/import/model_records.h"
#include "assets/import/model_stream.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

// Low enough that no sum of counts wraps around.
constexpr std::uint64_t kSaneCount = std::uint64_t{1} << 32;

bool isFinite(const Affine& affine) {
  return affine.linear.allFinite() && affine.translation.allFinite();
}

}  // namespace

void ModelReader::parseFrame(std::uint32_t type, std::string_view payload) {
  ++frames_;
  switch (type) {
    case kNode: return parseNode(payload);
    case kMimic: return parseMimic(payload);
    case kMesh: return parseMesh(payload);
    case kVertices: return parseVertices(payload);
    case kTriangles: return parseTriangles(payload);
    case kBone: return parseBone(payload);
    case kWeights: return parseWeights(payload);
    case kAnimation: return parseAnimation(payload);
    case kTrack: return parseTrack(payload);
    case kPositions: return parsePositions(payload);
    case kScales: return parseScales(payload);
    case kRotations: return parseRotations(payload);
    case kPositionTangents: return parsePositionTangents(payload);
    case kRotationTangents: return parseRotationTangents(payload);
    case kNote: return parseNote(payload);
    default: return breakOff("a frame of unknown type " + std::to_string(type));
  }
}

bool ModelReader::isWhole(std::uint64_t count) const {
  return left_.nothing() && frames_ == count;
}

bool ModelReader::isNode(std::int32_t node) const {
  return node >= 0 && slotOf(node) < model_.nodes.size();
}

void ModelReader::checkSize() {
  if (const std::string excess = size_.excess(); !excess.empty()) breakOff(excess);
}

std::string ModelReader::nameIn(std::string_view bytes) {
  std::string name = readableText(bytes, kMaxModelNameBytes);
  size_.nameBytes += name.size();
  return name;
}

template <typename Record, typename Take>
void ModelReader::parseAll(std::string_view payload, std::uint64_t& left, Take take) {
  const std::size_t count = payload.size() / sizeof(Record);
  if (payload.size() % sizeof(Record) != 0) return breakOff("records of a wrong size");
  if (count > left) return breakOff("more records than were promised");
  for (; !payload.empty(); payload.remove_prefix(sizeof(Record))) {
    if (!take(valueIn<Record>(payload))) return breakOff("an index out of range");
  }
  left -= count;
}

void ModelReader::parseNode(std::string_view payload) {
  if (payload.size() < sizeof(NodeHead)) return breakOff("a node of a wrong size");
  if (!model_.mimics.empty() || !model_.meshes.empty() || !model_.animations.empty()) {
    return breakOff("a node too late");
  }
  const auto head = valueIn<NodeHead>(payload);
  payload.remove_prefix(sizeof head);
  const std::size_t lssBytes = std::size_t{head.lss} * sizeof(LssRecord);
  if (head.lss > kMaxLssPerNode || payload.size() < lssBytes + head.nameBytes) {
    return breakOff("a node of a wrong size");
  }
  if (head.parent != -1 && !isNode(head.parent)) return breakOff("a node before its parent");
  ModelNode node;
  node.parent = head.parent;
  node.toParent = affineIn(head.toParent);
  node.axis = Vector3d(head.axis[0], head.axis[1], head.axis[2]);
  node.lowerLimit = head.lowerLimit;
  node.upperLimit = head.upperLimit;
  node.joint = static_cast<ModelJointType>(head.joint);
  node.isOnlooker = head.isOnlooker != 0;
  node.fileNode = head.fileNode;
  if (head.joint > static_cast<std::uint32_t>(ModelJointType::Planar) || !isFinite(node.toParent) ||
      !(std::abs(node.axis.norm() - 1.0) < 1e-6) || !std::isfinite(head.lowerLimit) ||
      !std::isfinite(head.upperLimit)) {
    return breakOff("a node whose joint or frame cannot be");
  }
  for (std::uint32_t i = 0; i < head.lss; ++i, payload.remove_prefix(sizeof(LssRecord))) {
    node.lss.push_back(lssIn(valueIn<LssRecord>(payload)));
    if (!isValid(node.lss.back())) return breakOff("a sphere or capsule that cannot be");
  }
  node.name = nameIn(payload.substr(0, head.nameBytes));
  node.jointName = nameIn(payload.substr(head.nameBytes));
  model_.nodes.push_back(std::move(node));
  ++size_.nodes;
  size_.lss += head.lss;
  checkSize();
}

void ModelReader::parseMimic(std::string_view payload) {
  if (payload.size() != sizeof(MimicRecord)) return breakOff("a mimic of a wrong size");
  if (!model_.meshes.empty() || !model_.animations.empty()) return breakOff("a mimic too late");
  const auto record = valueIn<MimicRecord>(payload);
  if (!isNode(record.node) || !isNode(record.leader) || !std::isfinite(record.factor) ||
      !std::isfinite(record.offset)) {
    return breakOff("a mimic that cannot be");
  }
  model_.mimics.push_back({record.node, record.leader, record.factor, record.offset});
  ++size_.mimics;
  checkSize();
}

void ModelReader::parseMesh(std::string_view payload) {
  if (payload.size() < sizeof(MeshHead)) return breakOff("a mesh of a wrong size");
  if (!left_.nothing() || !model_.animations.empty()) return breakOff("a mesh out of place");
  const auto head = valueIn<MeshHead>(payload);
  ModelMesh mesh;
  mesh.node = static_cast<std::int32_t>(head.node);
  if (mesh.node != head.node || !isNode(mesh.node)) return breakOff("a mesh at no node");
  mesh.name = nameIn(payload.substr(sizeof head));

  if (std::max({head.vertices, head.triangles, head.bones}) > kSaneCount) {
    return breakOff("counts beyond the limits");
  }
  ++size_.meshes;
  size_.vertices += head.vertices;
  size_.triangles += head.triangles;
  size_.bones += head.bones;
  left_.vertices = head.vertices;
  left_.triangles = head.triangles;
  left_.bones = head.bones;
  model_.meshes.push_back(std::move(mesh));
  checkSize();
}

void ModelReader::parseVertices(std::string_view payload) {
  // Before the first mesh `left_` is empty, so if anything is left there is a mesh.
  parseAll<VectorRecord>(payload, left_.vertices, [this](const VectorRecord& r) {
    model_.meshes.back().vertices.emplace_back(r[0], r[1], r[2]);
    return true;
  });
}

void ModelReader::parseTriangles(std::string_view payload) {
  if (left_.vertices != 0) return breakOff("triangles before their vertices");
  parseAll<TriangleRecord>(payload, left_.triangles, [this](const TriangleRecord& triangle) {
    ModelMesh& mesh = model_.meshes.back();
    mesh.triangles.push_back(triangle);
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](std::int32_t i) { return i >= 0 && slotOf(i) < mesh.vertices.size(); });
  });
}

void ModelReader::parseBone(std::string_view payload) {
  if (payload.size() < sizeof(BoneHead)) return breakOff("a bone of a wrong size");
  if (left_.vertices + left_.triangles + left_.weights != 0 || left_.bones == 0) {
    return breakOff("a bone out of place");
  }
  const auto head = valueIn<BoneHead>(payload);
  ModelBone bone;
  bone.node = static_cast<std::int32_t>(head.node);
  bone.meshToBone = affineIn(head.meshToBone);
  if (bone.node != head.node || (bone.node != -1 && !isNode(bone.node)) ||
      !isFinite(bone.meshToBone)) {
    return breakOff("a bone whose node or frame cannot be");
  }
  bone.name = nameIn(payload.substr(sizeof head));
  size_.weights += std::min(head.weights, kSaneCount);
  left_.weights = head.weights;
  --left_.bones;
  model_.meshes.back().bones.push_back(std::move(bone));
  checkSize();
}

void ModelReader::parseWeights(std::string_view payload) {
  parseAll<WeightRecord>(payload, left_.weights, [this](const WeightRecord& r) {
    ModelMesh& mesh = model_.meshes.back();
    const bool inRange = r.vertex >= 0 && slotOf(r.vertex) < mesh.vertices.size();
    mesh.bones.back().weights.push_back(
        {inRange ? static_cast<std::int32_t>(r.vertex) : 0, r.weight});
    return inRange;
  });
}

void ModelReader::parseAnimation(std::string_view payload) {
  if (payload.size() < sizeof(AnimationHead)) return breakOff("an animation of a wrong size");
  if (!left_.nothing()) return breakOff("an animation out of place");
  const auto head = valueIn<AnimationHead>(payload);
  ModelAnimation animation;
  animation.durationS = head.durationS;
  if (!std::isfinite(head.durationS)) return breakOff("an animation without end");
  animation.name = nameIn(payload.substr(sizeof head));
  ++size_.animations;
  size_.tracks += std::min(head.tracks, kSaneCount);
  left_.tracks = head.tracks;
  model_.animations.push_back(std::move(animation));
  checkSize();
}

void ModelReader::parseTrack(std::string_view payload) {
  if (payload.size() != sizeof(TrackHead)) return breakOff("a track of a wrong size");
  if (left_.tracks == 0 || left_.keys()) return breakOff("a track out of place");
  const auto head = valueIn<TrackHead>(payload);
  ModelTrack track;
  track.node = static_cast<std::int32_t>(head.node);
  if (track.node != head.node || !isNode(track.node)) return breakOff("a track of no node");
  if (std::max({head.positions, head.scales, head.rotations}) > kSaneCount) {
    return breakOff("counts beyond the limits");
  }
  const auto fits = [](std::uint64_t tangents, std::uint64_t keys) {
    return tangents == 0 || tangents == keys;
  };
  if (!fits(head.positionTangents, head.positions) ||
      !fits(head.rotationTangents, head.rotations)) {
    return breakOff("tangents that are not as many as keys");
  }
  left_.positionTangents = head.positionTangents;
  left_.rotationTangents = head.rotationTangents;
  --left_.tracks;
  left_.positions = head.positions;
  left_.scales = head.scales;
  left_.rotations = head.rotations;
  size_.keys += head.positions + head.scales + head.rotations;
  model_.animations.back().tracks.push_back(std::move(track));
  checkSize();
}

void ModelReader::parsePositions(std::string_view payload) {
  parseAll<VectorKeyRecord>(payload, left_.positions, [this](const VectorKeyRecord& r) {
    model_.animations.back().tracks.back().positions.push_back(vectorKeyIn(r));
    return true;
  });
}

void ModelReader::parseScales(std::string_view payload) {
  parseAll<VectorKeyRecord>(payload, left_.scales, [this](const VectorKeyRecord& r) {
    model_.animations.back().tracks.back().scales.push_back(vectorKeyIn(r));
    return true;
  });
}

void ModelReader::parseRotations(std::string_view payload) {
  parseAll<RotationKeyRecord>(payload, left_.rotations, [this](const RotationKeyRecord& r) {
    model_.animations.back().tracks.back().rotations.push_back(
        {r[0], Quaternion(r[1], r[2], r[3], r[4])});
    return true;
  });
}

void ModelReader::parsePositionTangents(std::string_view payload) {
  parseAll<TangentRecord<3>>(payload, left_.positionTangents, [this](const TangentRecord<3>& r) {
    model_.animations.back().tracks.back().positionTangents.push_back(tangentsIn<3>(r));
    return true;
  });
}

void ModelReader::parseRotationTangents(std::string_view payload) {
  parseAll<TangentRecord<4>>(payload, left_.rotationTangents, [this](const TangentRecord<4>& r) {
    model_.animations.back().tracks.back().rotationTangents.push_back(tangentsIn<4>(r));
    return true;
  });
}

void ModelReader::parseNote(std::string_view payload) {
  if (!left_.nothing()) return breakOff("a note out of place");
  model_.notes.push_back(readableText(payload, kMaxModelNoteBytes));
  ++size_.notes;
  checkSize();
}

}  // namespace foretouch::internal
