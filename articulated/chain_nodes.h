// articulated/chain_nodes.h: the frames of all links of a moving chain at eight instants at once,
// in the processor's lanes and without trigonometry. The instants are the Chebyshev-Lobatto points
// of a span of t, so that polynomials through them are close to the best of their degree
// (tessellation/lss_polynomials.h). Rounding: articulated/chain_nodes.md. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "lss/index.h"

namespace foretouch {

/// Instants per span: both ends and six between.
inline constexpr int kNodes = 8;

/// One link's frame at the nodes: rotations to W and origins in W relative to the origin given to
/// ChainNodes::evaluate() (m). Unit quaternions w, x, y, z and matrices, row after row, of the same
/// rotations, both to rounding.
struct alignas(64) LinkNodes {
  double q[4][kNodes];
  double R[9][kNodes];
  double p[3][kNodes];
};

/// Bounds on the frames at the instants: on |computed - true| of `p` (m) and of `R` (spectral
/// norm), and on |p| (m). "True" is the motion that motion.h defines for the given poses.
struct NodeBounds {
  double positionRounding = 0.0, rotationRounding = 0.0, reach = 0.0;
};

/// Frames of every link of a motion at the nodes of a span. Keeps its memory between calls; for one
/// thread.
class ChainNodes {
 public:
  /// Frames at the nodes of [begin, end], 0 <= begin < end <= 1; subtracts `origin` (in W) from
  /// positions, in double. `beside`: another chain's motion, whose places are compared with these:
  /// its turns count for the frames' error, and its bounds for both; or null. O(links).
  void evaluate(const ChainMotion& motion, double begin, double end, const Eigen::Vector3d& origin,
                const ChainMotion* beside = nullptr);

  [[nodiscard]] std::int32_t numLinks() const { return numLinks_; }
  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// The instants of the frames, as doubles: within 2^-52 of begin + (end-begin)*time(k); the first
  /// and the last are begin and end.
  [[nodiscard]] double instant(int k) const { return instants_[k]; }
  [[nodiscard]] const LinkNodes& link(LinkId link) const { return nodes_[slotOf(link)]; }

  /// The bounds that hold for every link. Closer ones for each link would cost more than they
  /// gain.
  [[nodiscard]] const NodeBounds& bounds() const { return bounds_; }

  /// The parent-relative poses at two instants of [0,1], as ChainMotion::poseAt() gives them, but
  /// without trigonometry and off by more (articulated/track.md 2). The poses are resized.
  /// O(joints).
  static void posesAt(const ChainMotion& motion, double begin, double end, Pose& from, Pose& to);

  /// (1 - cos(k pi/7))/2, the k-th Chebyshev-Lobatto point of [0,1], rounded.
  [[nodiscard]] static double time(int k);

 private:
  /// Coefficients of one power of a joint's versine, for all nodes.
  struct alignas(64) Row {
    double at[kNodes];
  };
  /// The series of slerp's weights of both ends; ascending powers.
  struct Weights {
    std::vector<Row> from, to;
  };
  void setInstants(double begin, double end);
  void extendWeights(std::size_t terms);
  [[nodiscard]] double rootReach(const ChainMotion& motion) const;
  void boundRoundings(const ChainMotion& motion, const ChainMotion& beside);

  std::int32_t numLinks_ = 0;
  double begin_ = 0.0, end_ = 0.0;  // an empty span: no instants yet
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  alignas(64) double instants_[kNodes] = {};
  Weights weights_;
  std::vector<LinkNodes> nodes_;
  NodeBounds bounds_;
};

}  // namespace foretouch
