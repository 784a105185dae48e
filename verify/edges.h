// verify/edges.h: what is to be proven of a robot: "foretouch-edges" version 1. On an edge each
// coordinate runs evenly from one configuration to another, and moves joints with it.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/fault.h"
#include "verify/statement.h"

namespace verify {

/// Along an axis or about it, by factor * (the coordinate) + offset: metres or radians.
struct Drive {
  Point axis{};  ///< In the joint's frame at rest; its length does not matter.
  std::size_t coordinate = 0;
  double factor = 1.0, offset = 0.0;
};

/// From its frame at rest a joint is shifted, then turned.
struct DrivenJoint {
  std::vector<Drive> shifts;
  std::optional<Drive> turn;
};

/// Triangles that a link may touch: from `first` on, before `end`.
struct Ignored {
  std::size_t first = 0, end = 0;
};

struct Edge {
  long long number = 0;
  std::vector<double> from, to;
};

struct EdgeStatement {
  double clearance = 0.0;  ///< All have to keep more than this away (m).
  std::size_t coordinates = 0;
  std::vector<DrivenJoint> joints;            ///< As many as links.
  std::vector<std::vector<Ignored>> ignored;  ///< Per link, in order, none next to another.
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< Own links: a < b.
  std::vector<Edge> edges;
};

/// `ignored`: those of one link. O(log ranges).
[[nodiscard]] bool isIgnored(const std::vector<Ignored>& ignored, std::size_t triangle);
/// Whether a text is about edges, and not about steps, by its first word.
[[nodiscard]] bool isOfEdges(std::string_view text);
[[nodiscard]] Fault readEdges(std::string_view text, const std::vector<Link>& links,
                              std::size_t triangles, EdgeStatement& statement);

}  // namespace verify
