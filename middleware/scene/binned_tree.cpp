// buildBinnedTree(): our own builder. Plain floats in a fixed order of operations and a partition
// of our own, so that compilers, standard libraries and processors all make the same tree.
#include <array>
#include <cstring>
#include <deque>

#include "lss/assert.h"
#include "middleware/scene/bvh_tree.h"

namespace foretouch::internal {
namespace {

constexpr unsigned kMaxBins = 32;
/// Centres that lie closer together than this (m, doubled) count as one: its reciprocal and
/// 32 bins stay finite.
constexpr float kLeastExtent = 1e-30f;

/// Four lanes of which three are used: compilers turn loops over them into one instruction.
struct alignas(16) Lanes {
  float of[4];
};

struct Box {
  Lanes lower{{kFloatInfinity, kFloatInfinity, kFloatInfinity, kFloatInfinity}};
  Lanes upper{{-kFloatInfinity, -kFloatInfinity, -kFloatInfinity, -kFloatInfinity}};

  void add(const Box& other) {
    for (int k = 0; k < 4; ++k) {
      lower.of[k] = other.lower.of[k] < lower.of[k] ? other.lower.of[k] : lower.of[k];
    }
    for (int k = 0; k < 4; ++k) {
      upper.of[k] = other.upper.of[k] > upper.of[k] ? other.upper.of[k] : upper.of[k];
    }
  }
  [[nodiscard]] float halfArea() const {
    const float x = upper.of[0] - lower.of[0], y = upper.of[1] - lower.of[1],
                z = upper.of[2] - lower.of[2];
    return x * y + y * z + z * x;
  }
  [[nodiscard]] TreeBox box() const {
    return {{lower.of[0], lower.of[1], lower.of[2]}, {upper.of[0], upper.of[1], upper.of[2]}};
  }
};

struct alignas(16) Primitive {
  float lower[3];
  std::uint32_t zero;
  float upper[3];
  std::uint32_t place;

  /// Its last lanes hold no number.
  [[nodiscard]] Box box() const {
    Box box;
    static_assert(sizeof(Box) == sizeof(Primitive));
    std::memcpy(static_cast<void*>(&box), this, sizeof box);
    return box;
  }
  /// Twice the box's centre.
  [[nodiscard]] Box centre() const {
    Box point;
    for (int k = 0; k < 3; ++k) point.lower.of[k] = point.upper.of[k] = lower[k] + upper[k];
    return point;
  }
};

/// Some primitives that follow one another.
struct Range {
  std::size_t begin, end;
  Box box, centres;

  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Where a range is cut: after bin `last` of an axis.
struct Cut {
  int axis = -1;  ///< None, if negative.
  int last = 0;
  float cost = kFloatInfinity;
};

/// Which bin a centre falls into. More bins than this pay for large ranges only.
class Binning {
 public:
  explicit Binning(const Range& range) {
    count_ = static_cast<int>(range.size() < 560 ? 4 + static_cast<unsigned>(range.size()) / 20
                                                 : kMaxBins);
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = range.centres.upper.of[axis] - range.centres.lower.of[axis];
      base_[axis] = range.centres.lower.of[axis];
      scale_[axis] = extent > kLeastExtent ? static_cast<float>(count_) / extent : 0.0f;
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool cuts(int axis) const { return scale_[axis] > 0.0f; }
  [[nodiscard]] int binOf(const Primitive& primitive, int axis) const {
    const float centre = primitive.lower[axis] + primitive.upper[axis];
    const int bin = static_cast<int>((centre - base_[axis]) * scale_[axis]);
    return bin < count_ ? bin : count_ - 1;
  }

 private:
  int count_;
  float base_[3], scale_[3];
};

/// Leaves that `size` primitives need: eight cost as much as one, and a leaf is not split.
float leavesOf(unsigned size) {
  return static_cast<float>((size + kBvhWidth - 1) / kBvhWidth);
}

struct Bins {
  std::array<Box, kMaxBins> box;
  std::array<unsigned, kMaxBins> size{};

  /// The cheapest cut, the first of several, if it is cheaper than `best`.
  void improve(Cut& best, int axis, int count) const {
    std::array<float, kMaxBins> costAbove{};
    std::array<unsigned, kMaxBins> sizeAbove{};
    Box above;
    unsigned total = 0;
    for (int i = count - 1; i > 0; --i) {
      above.add(box[std::size_t(i)]);
      total += size[std::size_t(i)];
      sizeAbove[std::size_t(i)] = total;
      costAbove[std::size_t(i)] = total > 0 ? above.halfArea() * leavesOf(total) : 0.0f;
    }
    Box below;
    total = 0;
    for (int i = 0; i + 1 < count; ++i) {
      const auto next = std::size_t(i) + 1;
      below.add(box[std::size_t(i)]);
      total += size[std::size_t(i)];
      if (total == 0 || sizeAbove[next] == 0) continue;
      const float cost = below.halfArea() * leavesOf(total) + costAbove[next];
      if (cost < best.cost) best = {axis, i, cost};
    }
  }
};

class BinnedTree final : public BvhTree {
 public:
  BinnedTree(std::vector<Primitive> primitives, int deepest)
      : primitives_(std::move(primitives)), deepest_(deepest) {
    const Range all = rangeOf(0, primitives_.size());
    box = all.box.box();
    root = make(all, 0);
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      next.parent->children[next.slot] = make(next.range, next.depth);
    }
    primitives_ = {};  // makes room for the flat arrays
  }

 private:
  struct Waiting {
    Range range;
    TreeInner* parent;
    unsigned slot;
    int depth;
  };

  const TreeNode* make(const Range& range, int depth) {
    return range.size() <= kBvhWidth ? makeLeaf(range) : makeInner(range, depth);
  }

  const TreeNode* makeLeaf(const Range& range) {
    TreeLeaf& leaf = leaves_.emplace_back();
    leaf.size = static_cast<unsigned>(range.size());
    for (std::size_t i = 0; i < range.size(); ++i) {
      leaf.primitives[i] = primitives_[range.begin + i].place;
    }
    return &leaf;
  }

  /// Cuts the child with the largest surface, again and again, until there are eight.
  const TreeNode* makeInner(const Range& range, int depth) {
    const bool inHalves = !hasRoomBelow(range.size() - 1, depth);
    std::array<Range, kBvhWidth> children{range};
    unsigned count = 1;
    while (count < kBvhWidth) {
      unsigned chosen = kBvhWidth;
      float greatest = -1.0f;
      for (unsigned i = 0; i < count; ++i) {
        if (children[i].size() <= kBvhWidth) continue;
        const float weight =
            inHalves ? static_cast<float>(children[i].size()) : children[i].box.halfArea();
        if (weight <= greatest) continue;
        greatest = weight;
        chosen = i;
      }
      if (chosen == kBvhWidth) break;
      const auto [first, second] = split(children[chosen], inHalves);
      children[chosen] = first;
      children[count++] = second;
    }
    TreeInner& inner = inners_.emplace_back();
    inner.numChildren = count;
    for (unsigned i = 0; i < count; ++i) {
      inner.boxes[i] = children[i].box.box();
      waiting_.push_back({children[i], &inner, i, depth + 1});
    }
    return &inner;
  }

  /// Do `size` primitives have room in a child of a node at `depth`?
  [[nodiscard]] bool hasRoomBelow(std::size_t size, int depth) const {
    std::size_t room = kBvhWidth;  // a leaf
    for (int below = depth; below < deepest_ && room < size; ++below) room *= kBvhWidth;
    return size <= room;
  }

  std::pair<Range, Range> split(const Range& range, bool inHalves) {
    if (!inHalves) {
      const Binning binning(range);
      const Cut cut = cheapestCut(range, binning);
      if (cut.axis >= 0) return partition(range, binning, cut);
    }
    const std::size_t middle = range.begin + (range.size() + 1) / 2;
    return {rangeOf(range.begin, middle), rangeOf(middle, range.end)};
  }

  [[nodiscard]] Cut cheapestCut(const Range& range, const Binning& binning) const {
    std::array<Bins, 3> bins;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Primitive& primitive = primitives_[i];
      const Box around = primitive.box();
      for (int axis = 0; axis < 3; ++axis) {
        const auto bin = static_cast<std::size_t>(binning.binOf(primitive, axis));
        bins[std::size_t(axis)].box[bin].add(around);
        ++bins[std::size_t(axis)].size[bin];
      }
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      if (binning.cuts(axis)) bins[std::size_t(axis)].improve(best, axis, binning.count());
    }
    return best;
  }

  std::pair<Range, Range> partition(const Range& range, const Binning& binning, const Cut& cut) {
    Range first{range.begin, range.begin, {}, {}}, second{range.end, range.end, {}, {}};
    while (first.end < second.begin) {
      const Primitive primitive = primitives_[first.end];
      if (binning.binOf(primitive, cut.axis) <= cut.last) {
        first.box.add(primitive.box());
        first.centres.add(primitive.centre());
        ++first.end;
      } else {
        second.box.add(primitive.box());
        second.centres.add(primitive.centre());
        primitives_[first.end] = primitives_[--second.begin];
        primitives_[second.begin] = primitive;
      }
    }
    FORETOUCH_ASSERT(first.size() > 0 && second.size() > 0);
    return {first, second};
  }

  [[nodiscard]] Range rangeOf(std::size_t begin, std::size_t end) const {
    Range range{begin, end, {}, {}};
    for (std::size_t i = begin; i < end; ++i) {
      range.box.add(primitives_[i].box());
      range.centres.add(primitives_[i].centre());
    }
    return range;
  }

  std::vector<Primitive> primitives_;
  const int deepest_;
  std::vector<Waiting> waiting_;
  std::deque<TreeInner> inners_;  // stay where they are
  std::deque<TreeLeaf> leaves_;
};

}  // namespace

std::unique_ptr<BvhTree> buildBinnedTree(const std::vector<Triangle>& triangles,
                                         const std::vector<TriangleId>& ids,
                                         const Eigen::Vector3d& origin, int deepest) {
  FORETOUCH_ASSERT(!ids.empty());
  return std::make_unique<BinnedTree>(primitivesOf<Primitive>(triangles, ids, origin), deepest);
}

}  // namespace foretouch::internal
