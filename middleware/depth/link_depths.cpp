#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"
#include "middleware/depth/depth.h"
#include "middleware/depth/hull_depth.h"
#include "middleware/exact/closed_mesh.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/surface/link_surface.h"
#include "tessellation/open_edges.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::RoundHull;

/// A piece that has to shrink by more than this share to be convex counts as not convex: balls say
/// more of it.
constexpr double kMostShrinking = 0.02;
/// The rounding of heights over a plane, relative to the extent: twice what their operations round.
constexpr double kHeightRounding = 32.0 * kUnitRoundoff;
/// Triangles times corners that a piece is looked at for: what is larger counts as not convex.
constexpr double kMostLooks = 3e8;

struct Place {
  Eigen::Matrix3d R;
  Vector3d p;

  [[nodiscard]] Vector3d at(const Vector3d& point) const { return R * point + p; }
  [[nodiscard]] Place inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

RoundHull placed(const RoundHull& hull, const Place& place) {
  RoundHull moved = hull;
  for (Vector3d& centre : moved.centres) centre = place.at(centre);
  return moved;
}

Aabb boxOf(const RoundHull& hull) {
  Aabb box;
  for (std::size_t i = 0; i < hull.centres.size(); ++i) {
    box.add(hull.centres[i] + Vector3d::Constant(hull.radii[i]));
    box.add(hull.centres[i] - Vector3d::Constant(hull.radii[i]));
  }
  return box;
}

std::vector<Vector3d> cornersOf(const std::vector<Triangle>& triangles) {
  std::vector<Vector3d> corners;
  for (const Triangle& triangle : triangles) {
    corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  const auto isBefore = [](const Vector3d& x, const Vector3d& y) {
    return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
  };
  std::sort(corners.begin(), corners.end(), isBefore);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// By which share a closed piece has to shrink towards `centre`, so that its hull is inside it; 1:
/// by nothing less than all. Proof: depth.md 7.
double shrinking(const std::vector<Triangle>& triangles, const std::vector<Vector3d>& corners,
                 const Vector3d& centre) {
  if (static_cast<double>(triangles.size()) * static_cast<double>(corners.size()) > kMostLooks)
    return 1.0;
  double extent = 0.0, most = 0.0;
  for (const Vector3d& corner : corners) extent = std::max(extent, (corner - centre).lpNorm<1>());
  for (const Triangle& triangle : triangles) {
    const auto& v = triangle.vertices;
    Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]);
    const double length = normal.norm();
    if (!(length > 0.0)) continue;  // a segment, which others share
    normal /= normal.dot(v[0] - centre) < 0.0 ? -length : length;
    double below = std::numeric_limits<double>::infinity(), above = 0.0;
    for (const Vector3d& corner : v) below = std::min(below, normal.dot(corner - centre));
    for (const Vector3d& corner : corners) above = std::max(above, normal.dot(corner - centre));
    below -= kHeightRounding * extent;
    const double beyond = above + kHeightRounding * extent - below;
    if (!(below > 0.0)) return 1.0;
    most = std::max(most, beyond / (below + beyond));
    if (most > kMostShrinking) return 1.0;
  }
  return std::min(1.0, most * (1.0 + 1e-9) + 4.0 * kUnitRoundoff);
}

/// Nothing if the piece is not nearly convex.
std::optional<RoundHull> coreOf(const std::vector<Triangle>& triangles) {
  const std::vector<Vector3d> corners = cornersOf(triangles);
  const Vector3d centre =
      std::accumulate(corners.begin(), corners.end(), Vector3d(Vector3d::Zero())) /
      static_cast<double>(corners.size());
  const double share = shrinking(triangles, corners, centre);
  if (share > kMostShrinking) return std::nullopt;
  internal::ObjectsAround around;
  internal::findObjectsAround(triangles, centre, 0.0, around);
  if (around.inside.empty() || !around.atSurface.empty()) return std::nullopt;
  RoundHull core;
  for (const Vector3d& corner : corners) core.add(centre + (1.0 - share) * (corner - centre), 0.0);
  return core;
}

}  // namespace

/// A link in its frame.
class LinkDepths::Solid {
 public:
  Solid(std::vector<Lss> lss, std::shared_ptr<const internal::LinkSurface> surface)
      : lss_(std::move(lss)), surface_(std::move(surface)) {}

  void prepare() const {
    std::call_once(built_, [this] { build(); });
  }
  [[nodiscard]] bool hasInside() const { return room_ || !cores_.empty(); }
  /// All of it.
  [[nodiscard]] const RoundHull& whole() const { return whole_; }
  /// Convex sets inside it.
  [[nodiscard]] const std::vector<RoundHull>& cores() const { return cores_; }
  /// Whether the cores are nearly all that it has inside.
  [[nodiscard]] bool isByCores() const { return isByCores_; }
  [[nodiscard]] double reach() const { return reach_; }

  /// The radius of a ball around the point that is inside the link, not above the truth; 0: none.
  [[nodiscard]] double roomAt(const Vector3d& p, internal::ObjectsAround& around) const {
    double most = 0.0;
    for (const Lss& lss : bare_) {
      const Separation apart = separation(Hull::segment(p, p), Hull::segment(lss.a, lss.b));
      most = std::max(most, lss.radius - apart.upper);
    }
    if (!room_) return most;
    internal::findObjectsAround(room_->parts(), p, 0.0, around);
    if (!around.atSurface.empty()) return most;
    const std::vector<ObjectId> inside = around.inside;
    for (const ObjectId object : inside) most = std::max(most, fromSurface(p, object, around.ids));
    return most;
  }

 private:
  void build() const {
    const std::vector<Triangle>& triangles = surface_->triangles();
    for (const Vector3d& corner : cornersOf(triangles)) whole_.add(corner, 0.0);
    for (std::size_t i = 0; i < lss_.size(); ++i) {
      if (!surface_->hasTriangles(static_cast<std::int32_t>(i))) addBare(lss_[i]);
    }
    for (std::size_t i = 0; i < whole_.centres.size(); ++i) {
      reach_ = std::max(reach_, whole_.centres[i].norm() + whole_.radii[i]);
    }
    if (!triangles.empty()) addPieces(triangles);
  }

  void addBare(const Lss& lss) const {
    bare_.push_back(lss);
    RoundHull& core = cores_.emplace_back();
    for (const Vector3d& end : {lss.a, lss.b}) {
      core.add(end, lss.radius);
      whole_.add(end, lss.radius);
    }
  }

  void addPieces(const std::vector<Triangle>& triangles) const {
    const std::vector<std::int32_t>& pieceOf = surface_->pieceOf();
    const std::size_t count = surface_->cornerOfPieces().size();
    std::vector<std::int32_t> ids(triangles.size());
    std::iota(ids.begin(), ids.end(), 0);
    const auto rooms = internal::objectRooms(triangles.data(), ids, pieceOf.data(), count);
    std::vector<std::vector<Triangle>> pieces(count);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      pieces[slotOf(pieceOf[i])].push_back(triangles[i]);
    }
    RawScene closed;
    for (std::size_t i = 0; i < count; ++i) {
      if (!rooms[i].isClosed) continue;
      if (auto core = coreOf(pieces[i])) {
        cores_.push_back(std::move(*core));
      } else {
        isByCores_ = false;
      }
      const auto object = static_cast<ObjectId>(closed.objectNames.size());
      closed.triangles.insert(closed.triangles.end(), pieces[i].begin(), pieces[i].end());
      closed.objectOf.resize(closed.triangles.size(), object);
      closed.objectNames.emplace_back();
    }
    if (closed.triangles.empty()) return;
    auto room = Scene::build(std::move(closed));
    if (room.ok()) room_ = std::move(room).value();
  }

  /// A lower bound on the distance to an object's surface.
  [[nodiscard]] double fromSurface(const Vector3d& p, ObjectId object,
                                   std::vector<TriangleId>& ids) const {
    const internal::SceneParts& parts = room_->parts();
    for (double reach = reach_ / 32.0;; reach *= 2.0) {
      Aabb box;
      box.add(p);
      box.grow(reach);
      std::uint64_t visited = 0;
      ids.clear();
      parts.bvh.collect(box, ids, visited);
      double least = std::numeric_limits<double>::infinity();
      for (const TriangleId id : ids) {
        if (parts.objectOf[slotOf(id)] != object) continue;
        const Hull triangle = Hull::of(parts.triangles[slotOf(id)]);
        least = std::min(least, separation(Hull::segment(p, p), triangle).lower());
      }
      if (least <= reach) return std::max(0.0, least);
      // What is not in the box is farther away than its half; all of it is within twice the reach.
      if (reach > 2.0 * reach_) return 0.0;
    }
  }

  std::vector<Lss> lss_;
  std::shared_ptr<const internal::LinkSurface> surface_;
  mutable std::once_flag built_;
  mutable RoundHull whole_;
  mutable std::vector<RoundHull> cores_;
  mutable std::vector<Lss> bare_;
  mutable std::optional<Scene> room_;
  mutable bool isByCores_ = true;
  mutable double reach_ = 0.0;
};

namespace {

/// Looks for the point around which two solids have the most room together.
template <typename Room>
class MostRoom {
 public:
  MostRoom(const Room& roomAt, const Aabb& box) : roomAt_(roomAt), box_(box) {}

  /// `met`: a point where they meet, if one is known.
  double find(const std::optional<Vector3d>& met) {
    const Vector3d size = box_.max - box_.min;
    if (!(size.minCoeff() > 0.0)) return 0.0;
    for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
      const Vector3d share(i % kGrid, (i / kGrid) % kGrid, i / (kGrid * kGrid));
      offer(box_.min + size.cwiseProduct((share + Vector3d::Constant(0.5)) / kGrid));
    }
    const double first = size.norm() / (2.0 * kGrid);
    for (double step = first; met && step > kLeastShare * first; step *= 0.5) around(*met, step);
    if (!(most_ > 0.0)) return 0.0;
    for (double step = first; step > kLeastStep * most_; step *= 0.5) {
      for (int k = 0; k < kMostMoves && move(step); ++k) continue;
    }
    return most_;
  }

 private:
  static constexpr int kGrid = 4, kMostMoves = 8;
  static constexpr double kLeastStep = 1e-3, kLeastShare = 1e-3;

  bool offer(const Vector3d& p) {
    const double room = roomAt_(p);
    if (!(room > most_)) return false;
    most_ = room;
    at_ = p;
    return true;
  }

  /// Moves to a corner, a face or an edge of the cube around the best.
  bool move(double step) { return around(Vector3d(at_), step); }

  bool around(const Vector3d& from, double step) {
    bool isBetter = false;
    for (int i = 0; i < 27; ++i) {
      const Vector3d way(i % 3 - 1, (i / 3) % 3 - 1, i / 9 - 1);
      if (i != 13) isBetter = offer(from + step * way.normalized()) || isBetter;
    }
    return isBetter;
  }

  const Room& roomAt_;
  Aabb box_;
  double most_ = 0.0;
  Vector3d at_ = Vector3d::Zero();
};

/// The lower bound of the deepest of the convex pieces.
double lowerOfCores(const std::vector<RoundHull>& ofOne, const std::vector<RoundHull>& ofOther,
                    const Place& place, double rounding) {
  double lower = 0.0;
  for (const RoundHull& core : ofOther) {
    const RoundHull other = placed(core, place);
    for (const RoundHull& one : ofOne) {
      lower = std::max(lower, internal::depthOf(one, other, rounding).lower);
    }
  }
  return lower;
}

Aabb sharedBox(Aabb one, const Aabb& other) {
  one.min = one.min.cwiseMax(other.min);
  one.max = one.max.cwiseMin(other.max);
  return one;
}

/// The bound by the two balls around one point of the box that both links have most room for.
template <typename Solid>
double lowerOfRoom(const Solid& one, const Solid& other, const Place& place, const Aabb& box,
                   const std::optional<Vector3d>& met, double rounding) {
  internal::ObjectsAround around;
  const Place back = place.inverse();
  const auto roomAt = [&](const Vector3d& p) {
    const double ofOne = one.roomAt(p, around);
    if (!(ofOne > 0.0)) return 0.0;
    const double ofOther = other.roomAt(back.at(p), around);
    return ofOther > 0.0 ? ofOne + ofOther : 0.0;
  };
  return (MostRoom(roomAt, box).find(met) - 4.0 * rounding) / internal::kInflation;
}

/// No point of `b`, seen from `a`, nor of `a`, is farther from where it is computed.
double roundingOf(const MotionBounds& a, const MotionBounds& b, double reachOfA, double reachOfB,
                  double apart) {
  constexpr double kPoint = MotionBounds::kPointRounding;
  return internal::kInflation *
         (a.positionRoundingAt(reachOfA) + b.positionRoundingAt(reachOfB) +
          (2.0 * a.rotationRounding + 4.0 * kPoint) * (apart + reachOfA + reachOfB) +
          kPoint * (a.reach + b.reach));
}

}  // namespace

LinkDepths::LinkDepths(const Avatar& avatar, const AvatarSurface& surface) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    solids_.push_back(
        std::make_unique<Solid>(avatar.lss(link), surface.parts().links[slotOf(link)]));
  }
}
LinkDepths::~LinkDepths() = default;
LinkDepths::LinkDepths(LinkDepths&&) noexcept = default;
LinkDepths& LinkDepths::operator=(LinkDepths&&) noexcept = default;

const LinkDepths::Solid& LinkDepths::solid(LinkId link) const {
  const Solid& solid = *solids_[slotOf(link)];
  solid.prepare();
  return solid;
}

bool LinkDepths::hasInside(LinkId link) const {
  return solid(link).hasInside();
}

LinkDepth LinkDepths::at(const ChainMotion& motion, double t, LinkId a, LinkId b,
                         const Vector3d* met_W) const {
  const Solid &one = solid(a), &other = solid(b);
  const LinkState A = motion.stateAt(a, t), B = motion.stateAt(b, t);
  // Everything is seen from a.
  const Place place{A.R_WL.transpose() * B.R_WL, A.R_WL.transpose() * (B.p_WL - A.p_WL)};
  const double rounding = roundingOf(motion.bounds(a), motion.bounds(b), one.reach(), other.reach(),
                                     (B.p_WL - A.p_WL).norm());
  LinkDepth depth;
  if (one.whole().centres.empty() || other.whole().centres.empty()) return depth;
  const RoundHull otherWhole = placed(other.whole(), place);
  const internal::HullDepth ofHulls = internal::depthOf(one.whole(), otherWhole, rounding);
  depth.upper = ofHulls.upper;
  depth.nhat_BA_W = internal::kUnitShrink * (A.R_WL * ofHulls.nhat);
  if (depth.upper == 0.0) return depth;
  depth.lower = lowerOfCores(one.cores(), other.cores(), place, rounding);
  if (!one.hasInside() || !other.hasInside()) return depth;
  if (one.isByCores() && other.isByCores()) return depth;
  std::optional<Vector3d> met;
  if (met_W != nullptr) met = A.R_WL.transpose() * (*met_W - A.p_WL);
  const Aabb box = sharedBox(boxOf(one.whole()), boxOf(otherWhole));
  depth.lower = std::max(depth.lower, lowerOfRoom(one, other, place, box, met, rounding));
  return depth;
}

}  // namespace foretouch
