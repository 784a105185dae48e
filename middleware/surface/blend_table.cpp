#include "middleware/surface/blend_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "articulated/motion.h"
#include "lss/fit.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Triangles of a cluster and of a part, at most. Smaller clusters mean more LSS to cull, larger
/// ones more parts for each that comes near; so it is for parts and triangles. Only speed depends
/// on it.
constexpr std::ptrdiff_t kTrianglesOfCluster = 64, kTrianglesOfPart = 8;

/// A merged point's rounding, relative to its coordinates; an LSS's ends are as far as its points.
constexpr double kMergeRounding = 64.0 * kUnitRoundoff;

/// The rounding of sums of weights, and of their means over the vertices of a cluster, in double.
constexpr double kWeightRounding = 256.0 * kUnitRoundoff;

/// Both are for so many shares of a vertex; more cost in proportion.
constexpr double kCountedShares = 8.0;

double sumOf(const std::vector<SkinInfluence>& vertex) {
  double sum = 0.0;
  for (const SkinInfluence& influence : vertex) sum += influence.weight;
  return sum;
}

/// A link's share of a vertex; null if the link has none.
const SkinInfluence* shareOf(const std::vector<SkinInfluence>& vertex, LinkId link) {
  for (const SkinInfluence& influence : vertex) {
    if (influence.link == link) return &influence;
  }
  return nullptr;
}

}  // namespace

/// Adds a link's share of a vertex; several of one link are as one, at their mean.
void merge(const SkinInfluence& influence, std::vector<SkinInfluence>& merged) {
  for (SkinInfluence& known : merged) {
    if (known.link != influence.link) continue;
    const double sum = known.weight + influence.weight;
    known.p_L = (known.weight * known.p_L + influence.weight * influence.p_L) / sum;
    known.weight = sum;
    return;
  }
  merged.push_back(influence);
}

class BlendTableBuilder {
 public:
  BlendTableBuilder(const Avatar& avatar, const SkinParts& skin, BlendTable& made)
      : avatar_(avatar), skin_(skin), made_(made) {
    const Pose rest = restPose(avatar.skeleton());
    ChainMotion(avatar.skeleton(), rest, rest).statesAt(0.0, rest_);
    placeVertices();
  }

  void run() {
    std::vector<std::vector<Lss>> own(countOf(avatar_.numLinks()));
    carried_.resize(countOf(avatar_.numLinks()));
    ownersOf_.resize(countOf(avatar_.numLinks()));
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (skin_.numTriangles(link) > 0) {
        addSurface(link, own[slotOf(link)]);
      } else {
        addRigid(link, own[slotOf(link)]);
      }
    }
    made_.table_.assign(own);
    made_.carried_.assign(carried_);
    for (const std::vector<LinkId>& owners : ownersOf_) {
      made_.owners_.insert(made_.owners_.end(), owners.begin(), owners.end());
    }
  }

 private:
  using Influences = std::vector<SkinInfluence>;

  [[nodiscard]] const Influences& influencesOf(std::int32_t vertex) const {
    return vertices_[slotOf(vertex)];
  }

  /// Where the vertices are at rest, which groups them; and their influences, one per link.
  void placeVertices() {
    double off = 0.0;
    for (const Influences& vertex : skin_.skin.vertices) {
      crowd_ = std::max(crowd_, static_cast<double>(vertex.size()) / kCountedShares);
      Vector3d place = Vector3d::Zero();
      Influences merged;
      for (const SkinInfluence& influence : vertex) {
        place += influence.weight * rest_[slotOf(influence.link)].pointAt(influence.p_L);
        merge(influence, merged);
      }
      places_.push_back(place);
      off = std::max(off, std::abs(sumOf(vertex) - 1.0));
      vertices_.push_back(std::move(merged));
    }
    // For the vertices' sums, and for the clusters', each against 1.
    made_.sumError_ = 4.0 * (off + crowd_ * kWeightRounding);
  }

  /// The link's own LSS, which no skin covers.
  void addRigid(LinkId link, std::vector<Lss>& own) {
    for (const Lss& lss : avatar_.lss(link)) {
      BlendShare share{};
      for (int axis = 0; axis < 3; ++axis) {
        share.a[axis] = lss.a[axis];
        share.b[axis] = lss.b[axis];
      }
      share.rho = std::max(lss.a.norm(), lss.b.norm()) * kInflation;
      share.weight = 1.0;
      share.link = link;
      made_.lss_.push_back(
          {static_cast<std::int32_t>(made_.shares_.size()), 1, 0, 0, lss.radius, lss.a == lss.b});
      addShare(share);
      own.push_back(lss);
      carry(link, link, lss);
    }
  }

  void addShare(const BlendShare& share) {
    made_.shares_.push_back(share);
    made_.endsA_.push_back(laneShare(share.link, share.weight, share.a));
    made_.endsB_.push_back(laneShare(share.link, share.weight, share.b));
  }

  void carry(LinkId carrier, LinkId owner, const Lss& lss) {
    carried_[slotOf(carrier)].push_back(lss);
    ownersOf_[slotOf(carrier)].push_back(owner);
  }

  void addSurface(LinkId link, std::vector<Lss>& own) {
    const auto first = static_cast<std::ptrdiff_t>(made_.order_.size());
    for (std::int32_t i = 0; i < skin_.numTriangles(link); ++i) made_.order_.push_back(i);
    const std::vector<std::int32_t> vertices =
        verticesOf(link, first, static_cast<std::ptrdiff_t>(made_.order_.size()));
    for (const LinkId mover : linksOf(vertices)) {
      std::vector<Vector3d> points;
      for (const std::int32_t vertex : vertices) {
        const SkinInfluence* const share = shareOf(influencesOf(vertex), mover);
        if (share != nullptr) points.push_back(share->p_L);
      }
      Lss hull = fitLss(points);
      // Merged points are off by a few roundings.
      hull.radius += crowd_ * kMergeRounding * (hull.a.norm() + hull.b.norm() + hull.radius);
      carry(mover, link, hull);
    }
    addClusters(link, first, static_cast<std::ptrdiff_t>(made_.order_.size()), own);
  }

  void addClusters(LinkId link, std::ptrdiff_t first, std::ptrdiff_t last, std::vector<Lss>& own) {
    if (last - first > kTrianglesOfCluster) {
      const std::ptrdiff_t middle = halve(link, first, last);
      addClusters(link, first, middle, own);
      addClusters(link, middle, last, own);
      return;
    }
    BlendedLss cluster = blendAround(link, first, last);
    cluster.first = made_.numParts();
    addParts(link, first, last);
    cluster.last = made_.numParts();
    made_.lss_.push_back(cluster);
    own.push_back({Vector3d::Zero(), Vector3d::Zero(), cluster.radius});
  }

  void addParts(LinkId link, std::ptrdiff_t first, std::ptrdiff_t last) {
    if (last - first > kTrianglesOfPart) {
      const std::ptrdiff_t middle = halve(link, first, last);
      addParts(link, first, middle);
      addParts(link, middle, last);
      return;
    }
    std::sort(made_.order_.begin() + first, made_.order_.begin() + last);
    BlendedLss part = blendAround(link, first, last);
    part.first = static_cast<std::int32_t>(first);
    part.last = static_cast<std::int32_t>(last);
    made_.parts_.push_back(part);
  }

  /// Cuts at the median of the triangles' middles along their longest extent; returns it.
  std::ptrdiff_t halve(LinkId link, std::ptrdiff_t first, std::ptrdiff_t last) {
    Eigen::AlignedBox3d extent;
    for (std::ptrdiff_t i = first; i < last; ++i) {
      extent.extend(middleOf(link, made_.order_[static_cast<std::size_t>(i)]));
    }
    Eigen::Index axis = 0;
    extent.sizes().maxCoeff(&axis);
    const std::ptrdiff_t middle = first + (last - first) / 2;
    const auto order = made_.order_.begin();
    std::nth_element(order + first, order + middle, order + last,
                     [&](std::int32_t x, std::int32_t y) {
                       const double at = middleOf(link, x)[axis], other = middleOf(link, y)[axis];
                       return at != other ? at < other : x < y;
                     });
    return middle;
  }

  [[nodiscard]] Vector3d middleOf(LinkId link, std::int32_t triangle) const {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t vertex : skin_.triangle(link, triangle)) sum += places_[slotOf(vertex)];
    return sum / 3.0;
  }

  [[nodiscard]] std::vector<std::int32_t> verticesOf(LinkId link, std::ptrdiff_t first,
                                                     std::ptrdiff_t last) const {
    std::vector<std::int32_t> vertices;
    for (std::ptrdiff_t i = first; i < last; ++i) {
      const auto& triangle = skin_.triangle(link, made_.order_[static_cast<std::size_t>(i)]);
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  [[nodiscard]] std::vector<LinkId> linksOf(const std::vector<std::int32_t>& vertices) const {
    std::vector<LinkId> links;
    for (const std::int32_t vertex : vertices) {
      for (const SkinInfluence& influence : influencesOf(vertex)) links.push_back(influence.link);
    }
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    return links;
  }

  /// The blended LSS around these triangles.
  BlendedLss blendAround(LinkId link, std::ptrdiff_t first, std::ptrdiff_t last) {
    const std::vector<std::int32_t> vertices = verticesOf(link, first, last);
    Eigen::AlignedBox3d extent;
    for (const std::int32_t vertex : vertices) extent.extend(places_[slotOf(vertex)]);
    std::vector<BlendShare> shares;
    for (const LinkId mover : linksOf(vertices)) {
      shares.push_back(shareAround(mover, vertices, extent.center()));
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const BlendShare& x, const BlendShare& y) { return x.weight > y.weight; });
    const auto firstShare = static_cast<std::int32_t>(made_.shares_.size());
    for (const BlendShare& share : shares) addShare(share);
    return {firstShare, static_cast<std::int32_t>(shares.size()), 0,
            0,          radiusAround(vertices, shares),           true};
  }

  /// The triangles' middle as the link sees it: from each vertex that the link moves, as far as the
  /// middle is at rest; the mean of these, in case they differ.
  [[nodiscard]] BlendShare shareAround(LinkId mover, const std::vector<std::int32_t>& vertices,
                                       const Vector3d& middle) const {
    const Eigen::Matrix3d& R = rest_[slotOf(mover)].R_WL;
    double weights = 0.0, count = 0.0;
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t vertex : vertices) {
      const SkinInfluence* const share = shareOf(influencesOf(vertex), mover);
      if (share == nullptr) continue;
      weights += share->weight;
      sum += share->p_L + R.transpose() * (middle - places_[slotOf(vertex)]);
      count += 1.0;
    }
    const Vector3d at = sum / count;
    BlendShare made{};
    for (int axis = 0; axis < 3; ++axis) made.a[axis] = made.b[axis] = at[axis];
    made.rho = at.norm() * kInflation;
    made.weight = weights / static_cast<double>(vertices.size());
    made.link = mover;
    for (const std::int32_t vertex : vertices) {
      const SkinInfluence* const share = shareOf(influencesOf(vertex), mover);
      const double own = share == nullptr ? 0.0 : share->weight;
      made.spread = std::max(made.spread, std::abs(own - made.weight) * kInflation);
    }
    return made;
  }

  [[nodiscard]] double radiusAround(const std::vector<std::int32_t>& vertices,
                                    const std::vector<BlendShare>& shares) const {
    double radius = 0.0;
    for (const std::int32_t vertex : vertices) {
      double reach = 0.0;
      for (const BlendShare& share : shares) {
        const SkinInfluence* const own = shareOf(influencesOf(vertex), share.link);
        if (own == nullptr) continue;
        reach += own->weight * (own->p_L - Vector3d(share.a[0], share.a[1], share.a[2])).norm();
      }
      radius = std::max(radius, reach);
    }
    // Coordinates that nearly cancel leave their rounding.
    double extent = 0.0;
    for (const BlendShare& share : shares) extent = std::max(extent, share.rho);
    return radius * kInflation + crowd_ * kMergeRounding * (extent + radius);
  }

  const Avatar& avatar_;
  const SkinParts& skin_;
  BlendTable& made_;
  double crowd_ = 1.0;  // the most shares of a vertex, in kCountedShares
  std::vector<LinkState> rest_;
  std::vector<Vector3d> places_;  // at rest, per vertex
  std::vector<Influences> vertices_;
  std::vector<std::vector<Lss>> carried_;
  std::vector<std::vector<LinkId>> ownersOf_;
};

BlendTable::BlendTable(const Avatar& avatar, const SkinParts& skin) {
  BlendTableBuilder(avatar, skin, *this).run();
}

}  // namespace foretouch::internal
