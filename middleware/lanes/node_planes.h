// middleware/lanes/node_planes.h: pairs of moving LSS proven apart by planes at the nodes of a
// span: a plane that keeps the two apart at two neighbouring nodes keeps them apart between, but
// for the bend of their paths. Proof with rounding: middleware/lanes/node_planes.md. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/chain_nodes.h"
#include "tessellation/node_ends.h"

namespace foretouch::internal {

/// Pieces between neighbouring nodes.
inline constexpr int kNodePieces = kNodes - 1;
inline constexpr std::uint8_t kEveryPiece = (1U << kNodePieces) - 1U;

/// Rotations to W of a frame in which planes rest, at the nodes, row after row; rounded to nearest.
struct alignas(64) NodeFrame {
  float R[9][kNodes];
};

/// Two LSS of the table.
struct PlanePair {
  std::int32_t i, j;
  std::int32_t frame;  ///< Place of the frame that bounds their motion.
  float reach;  ///< No plane less wide keeps them apart: radii, all uncertainty and a floor (m).
  float bend;   ///< Sum of both sides' accelerations in that frame, m per unit of t squared.
  std::uint8_t open = kEveryPiece;  ///< Bit k: between nodes k and k + 1 nothing is proven yet.
};

/// Roundings of a plane's heights in float, per metre of both sides' extents (node_planes.md 2).
inline constexpr double kNodePlaneRounding = 16.0 * 0x1p-24;

/// A range of nodes; both are in it.
struct NodeRange {
  int first = 0, last = kNodes - 1;
};

/// What planes are made of and tested against; all of one span.
struct NodePlanes {
  const NodeEnds::Axis* axes;  ///< Per LSS of the table.
  const NodeFrame* frames;
  float sagittas[kNodes];  ///< h^2/8 of piece k, rounded up; the last is not used.
  /// The second of each pair, if it is of another table; null: of the same.
  const NodeEnds::Axis* others = nullptr;
  /// From the origin of `axes` to that of `others`, rounded to nearest (m). The reach then also
  /// includes kNodePlaneRounding of its coordinates' sum.
  float shift[3] = {0.0F, 0.0F, 0.0F};
  /// For planes at rest: between which nodes each is looked at.
  NodeRange nodes = {}, otherNodes = {};
};

/// Closes those pieces of the first `count` pairs that a plane through node `node`'s closest points
/// keeps apart by their reach. O(count).
void closeByPlanes(const NodePlanes& planes, int node, PlanePair* pairs, std::size_t count);

/// Closes those of the first `count` pairs that one plane at rest in W keeps apart, wherever
/// between its nodes of the range either is: the two may be of spans of different instants. Through
/// the closest points of the first's place at `node` and the second's at `otherNode`. Each pair's
/// reach includes how far both bend between their nodes; frames and bends are not looked at.
/// O(count).
void closeByRestingPlanes(const NodePlanes& planes, int node, int otherNode, PlanePair* pairs,
                          std::size_t count);

}  // namespace foretouch::internal
