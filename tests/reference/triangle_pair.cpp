// Two moving triangles: every pair of features is a linear query of its own.
#include <algorithm>

#include "lss/lss.h"
#include "tests/reference/linear_query.h"

namespace foretouch {
namespace {

/// Whether at both ends of the motion, hence throughout, all of one is beyond all of the other.
bool separatedOnAnAxis(const std::array<LinearPoint, 3>& one,
                       const std::array<LinearPoint, 3>& other) {
  const auto beyond = [](const auto& a, const auto& b, int axis) {
    const auto least = [&](auto end) {
      return std::min({(a[0].*end)[axis], (a[1].*end)[axis], (a[2].*end)[axis]});
    };
    const auto most = [&](auto end) {
      return std::max({(b[0].*end)[axis], (b[1].*end)[axis], (b[2].*end)[axis]});
    };
    return least(&LinearPoint::from) > most(&LinearPoint::from) &&
           least(&LinearPoint::to) > most(&LinearPoint::to);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (beyond(one, other, axis) || beyond(other, one, axis)) return true;
  }
  return false;
}

Feature vertexOf(int i) {
  return {FeatureKind::Vertex, static_cast<std::uint8_t>(i)};
}
Feature edgeOf(int i) {
  return {FeatureKind::Edge, static_cast<std::uint8_t>(i)};
}
constexpr Feature kFace{FeatureKind::Face, 0};

std::array<LinearPoint, 2> edge(const std::array<LinearPoint, 3>& triangle, int i) {
  return {triangle[i], triangle[(i + 1) % 3]};
}

std::array<LinearPoint, 3> atRest(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  return {LinearPoint{v[0], v[0]}, LinearPoint{v[1], v[1]}, LinearPoint{v[2], v[2]}};
}

/// Does edge i of one meet the other? A point that runs along the edge meets a face at rest.
LeafAnswer edgeThroughFace(const Triangle& one, int i, const Triangle& other) {
  return vertexFace({one.vertices[i], one.vertices[(i + 1) % 3]}, atRest(other));
}

/// The earliest of the answers so far. Brackets may overlap: the least ends of all are kept.
class Earliest {
 public:
  void consider(const LeafAnswer& leaf, Feature one, Feature other) {
    answer_.leaf.stage = std::max(answer_.leaf.stage, leaf.stage);
    if (!leaf.hits) return;
    if (!answer_.leaf.hits || leaf.toiLow < answer_.leaf.toiLow) {
      answer_.one = one;
      answer_.other = other;
      answer_.leaf.toiLow = leaf.toiLow;
    }
    answer_.leaf.toiHigh = std::min(answer_.leaf.toiHigh, leaf.toiHigh);
    answer_.leaf.hits = true;
  }

  void considerStart(const LeafAnswer& leaf, Feature one, Feature other) {
    LeafAnswer atStart = leaf;
    atStart.toiLow = atStart.toiHigh = 0.0;
    consider(atStart, one, other);
    answer_.startsInContact = answer_.leaf.hits;
  }

  [[nodiscard]] const TrianglePairAnswer& answer() const { return answer_; }

 private:
  TrianglePairAnswer answer_;
};

}  // namespace

TrianglePairAnswer trianglePair(const std::array<LinearPoint, 3>& one,
                                const std::array<LinearPoint, 3>& other) {
  Earliest earliest;
  if (separatedOnAnAxis(one, other)) return earliest.answer();
  const Triangle oneAtStart{{one[0].from, one[1].from, one[2].from}};
  const Triangle otherAtStart{{other[0].from, other[1].from, other[2].from}};
  for (int i = 0; i < 3; ++i) {
    earliest.considerStart(edgeThroughFace(oneAtStart, i, otherAtStart), edgeOf(i), kFace);
    earliest.considerStart(edgeThroughFace(otherAtStart, i, oneAtStart), kFace, edgeOf(i));
    if (earliest.answer().startsInContact) return earliest.answer();
  }
  for (int i = 0; i < 3; ++i) {
    earliest.consider(vertexFace(one[i], other), vertexOf(i), kFace);
    earliest.consider(vertexFace(other[i], one), kFace, vertexOf(i));
    for (int j = 0; j < 3; ++j) {
      earliest.consider(edgeEdge(edge(one, i), edge(other, j)), edgeOf(i), edgeOf(j));
    }
  }
  return earliest.answer();
}

}  // namespace foretouch
