// assets/import/model_records.h: the layout of a model's numbers in its stream's frames
// (assets/import/model_stream.h). No record has padding. Not installed.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "assets/import/model_stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

enum ModelFrame : std::uint32_t {
  kNode = 16,
  kMesh,
  kVertices,
  kTriangles,
  kBone,
  kWeights,
  kAnimation,
  kTrack,
  kPositions,
  kScales,
  kRotations,
  kNote,
  kMimic,
  kPositionTangents,
  kRotationTangents
};

using AffineRecord =
    std::array<double, 12>;  // the columns of the linear part, then the translation
struct NodeHead {
  AffineRecord toParent;
  std::array<double, 3> axis;
  double lowerLimit, upperLimit;
  std::int32_t parent;
  std::uint32_t joint, lss, nameBytes, isOnlooker;  // LSS, the name and the joint's name follow
  std::int32_t fileNode;
};
using LssRecord = std::array<double, 7>;
struct MimicRecord {
  double factor, offset;
  std::int32_t node, leader;
};
struct MeshHead {
  std::uint64_t vertices, triangles, bones;
  std::int64_t node;
};
using VectorRecord = std::array<double, 3>;
using TriangleRecord = std::array<std::int32_t, 3>;
struct BoneHead {
  AffineRecord meshToBone;
  std::uint64_t weights;
  std::int64_t node;
};
struct WeightRecord {
  double weight;
  std::int64_t vertex;
};
struct AnimationHead {
  double durationS;
  std::uint64_t tracks;
};
struct TrackHead {
  std::uint64_t positions, scales, rotations;
  std::uint64_t positionTangents, rotationTangents;  // none, or as many as keys
  std::int64_t node;
};
using VectorKeyRecord = std::array<double, 4>;    // time, x, y, z
using RotationKeyRecord = std::array<double, 5>;  // time, w, x, y, z

template <int Size>
using TangentRecord = std::array<double, 2 * Size>;  // in, out

// Room for the LSS of a node beside its names; the limit of an avatar's link.
inline constexpr std::uint32_t kMaxLssPerNode = kMaxLssPerLink;
static_assert(sizeof(NodeHead) + kMaxLssPerNode * sizeof(LssRecord) + 2 * kMaxModelNameBytes <=
              kMaxImportFrameBytes);

inline AffineRecord recordOf(const Affine& affine) {
  AffineRecord record;
  Eigen::Map<Eigen::Matrix3d>(record.data()) = affine.linear;
  Eigen::Map<Eigen::Vector3d>(record.data() + 9) = affine.translation;
  return record;
}

inline Affine affineIn(const AffineRecord& record) {
  return {Eigen::Map<const Eigen::Matrix3d>(record.data()),
          Eigen::Map<const Eigen::Vector3d>(record.data() + 9)};
}

inline VectorRecord recordOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

inline VectorKeyRecord recordOf(const ModelTrack::VectorKey& key) {
  return {key.timeS, key.value.x(), key.value.y(), key.value.z()};
}

inline ModelTrack::VectorKey vectorKeyIn(const VectorKeyRecord& r) {
  return {r[0], Eigen::Vector3d(r[1], r[2], r[3])};
}

template <int Size>
TangentRecord<Size> recordOf(const ModelTrack::Tangents<Eigen::Matrix<double, Size, 1>>& tangents) {
  TangentRecord<Size> record;
  Eigen::Map<Eigen::Matrix<double, Size, 2>>(record.data()) << tangents.in, tangents.out;
  return record;
}

template <int Size>
ModelTrack::Tangents<Eigen::Matrix<double, Size, 1>> tangentsIn(const TangentRecord<Size>& record) {
  const Eigen::Map<const Eigen::Matrix<double, Size, 2>> columns(record.data());
  return {columns.col(0), columns.col(1)};
}

inline LssRecord recordOf(const Lss& lss) {
  return {lss.a.x(), lss.a.y(), lss.a.z(), lss.b.x(), lss.b.y(), lss.b.z(), lss.radius};
}

inline Lss lssIn(const LssRecord& r) {
  return {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, r[6]};
}

}  // namespace foretouch::internal
