// tests/assets/fbx_writer.h: FBX files as text, made by the test, and where their nodes stand by
// the formula of FBX itself. Shares no code with a reader.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace foretouch::test {

/// One component of a property over time: seconds and values, in ascending order. Empty: the node's
/// own value.
using FbxCurve = std::vector<std::pair<double, double>>;
using FbxCurves = std::array<FbxCurve, 3>;

/// Lengths in units of the file, angles in degrees, as FBX stores them.
struct FbxNode {
  std::string name;
  int parent = -1;  ///< Index of an earlier node; -1: the scene.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  Eigen::Vector3d rotationOffset = Eigen::Vector3d::Zero(), rotationPivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d preRotation = Eigen::Vector3d::Zero(), postRotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scalingOffset = Eigen::Vector3d::Zero(), scalingPivot = Eigen::Vector3d::Zero();
  int rotationOrder = 0;  ///< XYZ, XZY, YZX, YXZ, ZXY, ZYX: the first turns first.
  FbxCurves translations, rotations, scalings;
  bool hasMesh = false;  ///< One triangle, around the node.
  std::string onlooker;  ///< "Camera" or "Light"; empty: it is none.
};

struct FbxFile {
  std::vector<FbxNode> nodes;
  double unitScaleFactor = 1.0;      ///< Centimetres per unit.
  int upAxis = 1;                    ///< 0: X, 1: Y, 2: Z.
  double startS = 0.0, stopS = 0.0;  ///< Of the animation; both 0: not stated.

  /// ASCII, version 7.4.
  [[nodiscard]] std::string text() const;
  /// The frame of each node in the scene, in the file's units and axes, at rest or at a time of the
  /// file, in the values that the curves have there (linear between keys).
  [[nodiscard]] std::vector<Eigen::Affine3d> frames() const;
  [[nodiscard]] std::vector<Eigen::Affine3d> framesAt(double timeS) const;
};

}  // namespace foretouch::test
