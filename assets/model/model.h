// assets/model/model.h: a rigged model as read from a file (glTF, FBX, Collada, URDF, MJCF ...):
// nodes, meshes, skins, joints and animations. Uninterpreted: assets/model/model_avatar.h decides
// what it means as an avatar. Metres, radians, seconds, converted from the file's unit.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "assets/file_frame.h"
#include "lss/lss.h"

namespace foretouch {

/// An affine map x -> linear*x + translation.
struct Affine {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Affine operator*(const Affine& inner) const {
    return {linear * inner.linear, linear * inner.translation + translation};
  }
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
    return linear * p + translation;
  }
};

/// How a node may move against its parent; files without joints (all but URDF and MJCF) leave it
/// Free.
enum class ModelJointType : std::uint8_t { Free, Fixed, Revolute, Continuous, Prismatic, Planar };

struct ModelNode {
  std::string name;          ///< UTF-8 without control characters; may be empty or repeated.
  std::int32_t parent = -1;  ///< Index of an earlier node; -1: a root.
  Affine toParent;           ///< At rest. May scale, shear or mirror: files do.
  std::vector<Lss>
      lss;  ///< Spheres and capsules that the file declares as such, in the node's frame.
  ModelJointType joint = ModelJointType::Free;
  std::string jointName;       ///< URDF and MJCF name joints apart from links; else empty.
  bool isOnlooker = false;     ///< A camera or a light: what it does is not a body's motion.
  std::int32_t fileNode = -1;  ///< For glTF: its number in the file; -1: it has none.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< The joint's, in the node's frame, unit.
  double lowerLimit = 0.0, upperLimit = 0.0;        ///< Radians or metres; equal: none stated.
};

/// A node's joint that goes along with another one's: its coordinate is factor * (the other's) +
/// offset.
struct ModelMimic {
  std::int32_t node = -1, leader = -1;
  double factor = 1.0, offset = 0.0;  ///< Finite; the offset in radians or metres.
};

/// The vertices of a mesh that a bone moves, with their weights.
struct ModelBone {
  std::int32_t node = -1;  ///< -1: the file does not contain the node (called `name`).
  std::string name;
  Affine meshToBone;  ///< At bind time: from mesh space into the bone's frame.
  struct Weight {
    std::int32_t vertex;
    double weight;  ///< As in the file: may be zero, negative or NaN.
  };
  std::vector<Weight> weights;
};

/// A mesh as placed by a node; a mesh that n nodes place appears n times.
struct ModelMesh {
  std::string name;
  std::int32_t node = -1;                              ///< Whose frame the vertices are in.
  std::vector<Eigen::Vector3d> vertices;               ///< May hold NaN: files do.
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< Indices are in range.
  std::vector<ModelBone> bones;                        ///< Empty: moves rigidly with its node.
};

/// The keys of one node. A list without keys leaves that part at the node's rest.
struct ModelTrack {
  std::int32_t node = -1;
  struct VectorKey {
    double timeS;
    Eigen::Vector3d value;
  };
  struct RotationKey {
    double timeS;
    Quaternion value;
  };
  std::vector<VectorKey> positions, scales;
  std::vector<RotationKey> rotations;

  /// Tangents of a cubic spline's key, per second: where the curve comes in, and where it goes out.
  template <typename Value>
  struct Tangents {
    Value in, out;
  };
  /// Empty: straight lines join the keys, and turns at constant rate. Else as many as keys: cubics
  /// join them. Those of rotations are of x, y, z, w.
  std::vector<Tangents<Eigen::Vector3d>> positionTangents = {};
  std::vector<Tangents<Eigen::Vector4d>> rotationTangents = {};
};

struct ModelAnimation {
  std::string name;
  double durationS = 0.0;
  std::vector<ModelTrack> tracks;
};

struct Model {
  std::vector<ModelNode> nodes;  ///< Parents before children.
  std::vector<ModelMimic> mimics;
  std::vector<ModelMesh> meshes;
  std::vector<ModelAnimation> animations;
  /// Faults that the reader skipped, one sentence each (a missing mesh file, faces with indices out
  /// of range, points and lines, ...). Bounded in number.
  std::vector<std::string> notes;
  FileFrame frame;
};

/// In which order four numbers are a quaternion.
enum class QuaternionOrder : std::uint8_t { Xyzw, Wxyz };

struct JointTableOptions {
  /// For a table without a header: its columns' names, in order; or only the name of a layout that
  /// is known (tableLayouts()), which also says units, rate and order. Empty: as the header
  /// says.
  std::vector<std::string> columns;
  std::optional<double> rateHz;               ///< Rows per second, for a table without times.
  std::optional<QuaternionOrder> quaternion;  ///< In arrays, whose names need not say it.
  bool isInDegrees = false;                   ///< Or as the layout has it.
  std::optional<double> metresPerUnit;        ///< Empty: metres, or as the layout has it.
};

/// The layouts of public sets of motions that are known by name: "lafan1-g1", "bones-seed-g1".
[[nodiscard]] std::vector<std::string> tableLayouts();

}  // namespace foretouch
