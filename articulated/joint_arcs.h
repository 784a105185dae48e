// articulated/joint_arcs.h: the motion of every joint of a step in its parent's frame, many joints
// at a time in the processor's lanes. Formulas and rounding: articulated/motion_bounds.md 2. Not
// installed.
#pragma once

namespace foretouch::internal {

/// The numbers of two poses, joint after joint: rotations x, y, z, w as Eigen stores them, and
/// translations (m).
struct StepPoses {
  const double* rotations[2];
  const double* translations[2];
};

/// Arcs of all joints as structure of arrays: joint j's number of column c is
/// numbers[c * stride + j].
struct JointColumns {
  double* numbers;
  int stride;

  /// Columns by content (JointArc); quaternions w, x, y, z take four, vectors three.
  enum Column : int {
    kFrom = 0,
    kTo = 4,
    kTranslation = 8,
    kDrift = 11,
    kVersine = 14,
    kLength,
    kDriftLength,
    kTurn,  ///< Bound on the joint's turn over t in [0,1] (rad).
    kCount
  };
};

/// Fills the columns of `joints` joints, at least one. The same bits at every vector width.
/// O(joints).
void computeArcs(const StepPoses& poses, int joints, JointColumns arcs);

}  // namespace foretouch::internal
