#include "bench/trade/nearest_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "articulated/skeleton.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/segment_triangle.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kLeaf = 4;
/// One pending sibling per level: kDeepest, and the 24 halvings that 50 million triangles need.
constexpr std::size_t kMostPending = 64;

/// Squared distance of two boxes.
double squaredGap(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                  const Eigen::Vector3d& otherLow, const Eigen::Vector3d& otherHigh) {
  return (otherLow - high).cwiseMax(low - otherHigh).cwiseMax(0.0).squaredNorm();
}

Eigen::Vector3d middleOf(const Triangle& t) {
  return t.vertices[0] / 3.0 + t.vertices[1] / 3.0 + t.vertices[2] / 3.0;
}

constexpr std::size_t kBins = 16;
/// From this depth on halves have equal size, so that no search reaches kMostPending.
constexpr int kDeepest = 32;

/// Triangles whose middles lie in one slice.
struct Bin {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kMaxCoordinate);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-kMaxCoordinate);
  double count = 0.0;

  void add(const Triangle& triangle) {
    for (const Eigen::Vector3d& v : triangle.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    count += 1.0;
  }
  void add(const Bin& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    count += other.count;
  }
  /// The expected cost of a visit: surface times triangles.
  [[nodiscard]] double cost() const {
    if (count == 0.0) return 0.0;
    const Eigen::Vector3d size = high - low;
    return count * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  }
};

/// The first bin of the second half at the least total cost of both halves.
std::size_t cheapestCut(const std::array<Bin, kBins>& bins) {
  std::array<double, kBins> above{};
  Bin sum;
  for (std::size_t i = kBins - 1; i > 0; --i) {
    sum.add(bins[i]);
    above[i] = sum.cost();
  }
  sum = Bin();
  std::size_t best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t cut = 1; cut < kBins; ++cut) {
    sum.add(bins[cut - 1]);
    if (sum.cost() + above[cut] >= least) continue;
    least = sum.cost() + above[cut];
    best = cut;
  }
  return best;
}

}  // namespace

NearestTree::NearestTree(const Scene& scene) : scene_(scene) {
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    const auto id = static_cast<TriangleId>(i);
    middles_.push_back(middleOf(scene.triangle(id)));
    if (isFinite(scene.triangle(id))) order_.push_back(id);
  }
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  split(0, 0, order_.size(), 0);
  middles_ = {};
}

NearestTree::Box NearestTree::boxOf(std::size_t begin, std::size_t end) const {
  Box box{Eigen::Vector3d::Constant(kMaxCoordinate), Eigen::Vector3d::Constant(-kMaxCoordinate)};
  for (std::size_t i = begin; i < end; ++i) {
    for (const Eigen::Vector3d& v : scene_.triangle(order_[i]).vertices) {
      box.low = box.low.cwiseMin(v);
      box.high = box.high.cwiseMax(v);
    }
  }
  return box;
}

void NearestTree::split(std::size_t node, std::size_t begin, std::size_t end, int depth) {
  nodes_[node].box = boxOf(begin, end);
  if (end - begin <= kLeaf) {
    nodes_[node].first = static_cast<std::int32_t>(begin);
    nodes_[node].count = static_cast<std::int32_t>(end - begin);
    return;
  }
  const std::size_t middle = partition(begin, end, depth);
  const std::size_t child = nodes_.size();
  nodes_[node].first = static_cast<std::int32_t>(child);
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(child, begin, middle, depth + 1);
  split(child + 1, middle, end, depth + 1);
}

std::size_t NearestTree::partition(std::size_t begin, std::size_t end, int depth) {
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  Eigen::Vector3d low = middles_[slotOf(order_[begin])], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(middles_[slotOf(order_[i])]);
    high = high.cwiseMax(middles_[slotOf(order_[i])]);
  }
  Eigen::Index axis = 0;
  const double width = (high - low).maxCoeff(&axis);
  const auto placeOf = [&](TriangleId id) { return middles_[slotOf(id)][axis]; };
  const auto binOf = [&](TriangleId id) {
    const double bin = static_cast<double>(kBins) * (placeOf(id) - low[axis]) / width;
    return std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, bin)));
  };
  if (width > 0.0 && depth < kDeepest) {
    std::array<Bin, kBins> bins;
    for (std::size_t i = begin; i < end; ++i) {
      bins[binOf(order_[i])].add(scene_.triangle(order_[i]));
    }
    const std::size_t cut = cheapestCut(bins);
    const auto middle =
        std::partition(at(begin), at(end), [&](TriangleId id) { return binOf(id) < cut; });
    const auto found = static_cast<std::size_t>(middle - order_.begin());
    if (found > begin && found < end) return found;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end),
                   [&](TriangleId x, TriangleId y) { return placeOf(x) < placeOf(y); });
  return middle;
}

double NearestTree::distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cap,
                             double enough, TradeWork& work) const {
  const Eigen::Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
  const auto gapOf = [&](std::int32_t node) {
    const Box& box = nodes_[slotOf(node)].box;
    return squaredGap(low, high, box.low, box.high);
  };
  std::array<std::pair<double, std::int32_t>, kMostPending> pending;
  std::size_t size = 0;
  pending[size++] = {gapOf(0), 0};
  double best = cap;
  while (size > 0) {
    const auto [gap, index] = pending[--size];
    if (gap >= best * best) continue;
    ++work.nodes;
    const Node& node = nodes_[slotOf(index)];
    if (node.count > 0) {
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        ++work.pairs;
        const Triangle& triangle = scene_.triangle(order_[slotOf(i)]);
        best = std::min(best, closestPoints(a, b, triangle).distance);
      }
      if (best <= enough) return best;
      continue;
    }
    const std::pair<double, std::int32_t> one{gapOf(node.first), node.first};
    const std::pair<double, std::int32_t> other{gapOf(node.first + 1), node.first + 1};
    FORETOUCH_ASSERT(size + 2 <= kMostPending);
    pending[size++] = std::max(one, other);  // visits the nearer one first
    pending[size++] = std::min(one, other);
  }
  return best;
}

}  // namespace foretouch::tools
