#include "middleware/bracket/surface_passage.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "lss/rounding.h"
#include "lss/separation.h"
#include "middleware/exact/side_of.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// The way is looked at this far aside (m), so that it passes through no corner of what is built on
/// round numbers. A longer one only makes the region larger.
constexpr double kAside = 1e-6;
/// Among more triangles nothing is claimed: the time of one step has an end.
constexpr std::size_t kMostTriangles = 4096;

auto key(const Vector3d& v) {
  return std::make_tuple(v.x(), v.y(), v.z());
}
auto key(const Triangle& t) {
  return std::make_tuple(key(t.vertices[0]), key(t.vertices[1]), key(t.vertices[2]));
}

Aabb boxOf(const Vector3d& a, const Vector3d& b, double margin) {
  Aabb box;
  box.add(a);
  box.add(b);
  box.grow(margin);
  return box;
}

enum class Meeting : std::uint8_t { Misses, Crosses, Unclear };

/// The segment and the triangle: exact; unclear where a plane or an edge passes through an end, or
/// through the segment's line.
Meeting meeting(const Vector3d& p, const Vector3d& q, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const int before = sideOf(a, b, c, p), after = sideOf(a, b, c, q);
  if (before == after && before != 0) return Meeting::Misses;
  const std::array<int, 3> turns{sideOf(p, q, a, b), sideOf(p, q, b, c), sideOf(p, q, c, a)};
  const auto has = [&](int sign) {
    return std::find(turns.begin(), turns.end(), sign) != turns.end();
  };
  if (has(1) && has(-1)) return Meeting::Misses;
  return has(0) || before == 0 || after == 0 ? Meeting::Unclear : Meeting::Crosses;
}

}  // namespace

std::optional<PassageSpan> SurfacePassage::find(const Scene& scene, const IgnoredObjects& ignored,
                                                const std::vector<PassagePart>& way) {
  begin(way);
  if (!mayCross(scene, ignored)) return std::nullopt;
  collect(scene, ignored);
  if (triangles_.size() > kMostTriangles) return std::nullopt;
  findCrossings();
  if (crossings_.empty()) return std::nullopt;
  joinAcrossEdges();
  tried_.clear();
  std::optional<PassageSpan> first;
  for (const Crossing& crossing : crossings_) {
    const Index surface = surfaceOf(crossing.triangle);
    if (std::find(tried_.begin(), tried_.end(), surface) != tried_.end()) continue;
    tried_.push_back(surface);
    const auto passed = through(surface);
    if (passed && (!first || passed->by < first->by)) first = passed;
  }
  return first;
}

/// Moves the way aside, and knows its region.
void SurfacePassage::begin(const std::vector<PassagePart>& way) {
  way_ = way;
  boxes_.clear();
  region_ = {};
  const Vector3d aside = kAside * Vector3d(0.61, 0.43, 0.59);
  for (PassagePart& part : way_) {
    part.from += aside;
    part.to += aside;
    for (double* const radius : {&part.radius, &part.radiusFrom, &part.radiusTo}) {
      *radius = (*radius + kAside) * kInflation;
    }
    boxes_.push_back(boxOf(part.from, part.to, part.radius));
    region_.add(boxes_.back());
  }
}

/// Most ways cross nothing, and that takes a look at what their chords are near.
bool SurfacePassage::mayCross(const Scene& scene, const IgnoredObjects& ignored) {
  Aabb chords;
  for (const PassagePart& part : way_) chords.add(boxOf(part.from, part.to, 0.0));
  ids_.clear();
  std::uint64_t visited = 0;
  scene.parts().bvh.collect(chords, ids_, visited);
  return std::any_of(ids_.begin(), ids_.end(), [&](TriangleId id) {
    return !ignored.has(scene, id) && meetsWay(scene.triangle(id));
  });
}

bool SurfacePassage::meetsWay(const Triangle& triangle) const {
  const Aabb of = boxOf(triangle);
  return std::any_of(way_.begin(), way_.end(), [&](const PassagePart& part) {
    return of.overlaps(boxOf(part.from, part.to, 0.0)) &&
           meeting(part.from, part.to, triangle) != Meeting::Misses;
  });
}

/// What stands twice is one.
void SurfacePassage::collect(const Scene& scene, const IgnoredObjects& ignored) {
  ids_.clear();
  triangles_.clear();
  std::uint64_t visited = 0;
  scene.parts().bvh.collect(region_, ids_, visited);
  for (const TriangleId id : ids_) {
    if (!ignored.has(scene, id)) triangles_.push_back(scene.triangle(id));
  }
  std::sort(triangles_.begin(), triangles_.end(),
            [](const Triangle& x, const Triangle& y) { return key(x) < key(y); });
  triangles_.erase(
      std::unique(triangles_.begin(), triangles_.end(),
                  [](const Triangle& x, const Triangle& y) { return key(x) == key(y); }),
      triangles_.end());
}

void SurfacePassage::findCrossings() {
  crossings_.clear();
  for (std::size_t part = 0; part < way_.size(); ++part) {
    const PassagePart& own = way_[part];
    const Aabb box = boxOf(own.from, own.to, 0.0);
    for (Index i = 0; i < triangles_.size(); ++i) {
      Aabb of;
      for (const Vector3d& v : triangles_[i].vertices) of.add(v);
      if (!of.overlaps(box)) continue;
      const Meeting found = meeting(own.from, own.to, triangles_[i]);
      if (found == Meeting::Misses) continue;
      crossings_.push_back({part, i, found == Meeting::Crosses});
    }
  }
}

bool SurfacePassage::meetsRegion(const Vector3d& a, const Vector3d& b) const {
  const Aabb box = boxOf(a, b, 0.0);
  if (!box.overlaps(region_)) return false;
  for (std::size_t part = 0; part < way_.size(); ++part) {
    if (!box.overlaps(boxes_[part])) continue;
    const Hull segment = Hull::segment(way_[part].from, way_[part].to);
    if (separation(segment, Hull::segment(a, b)).lower() <= way_[part].radius) return true;
  }
  return false;
}

SurfacePassage::Index SurfacePassage::surfaceOf(Index triangle) {
  while (above_[triangle] != triangle) {
    above_[triangle] = above_[above_[triangle]];
    triangle = above_[triangle];
  }
  return triangle;
}

/// Triangles that share an edge in the region are of one surface, which has a border where an odd
/// number of them does.
void SurfacePassage::joinAcrossEdges() {
  edges_.clear();
  for (Index i = 0; i < triangles_.size(); ++i) {
    const auto& [a, b, c] = triangles_[i].vertices;  // in order, so equal edges have equal ends
    const std::array<std::pair<const Vector3d*, const Vector3d*>, 3> sides{
        {{&a, &b}, {&b, &c}, {&a, &c}}};
    for (const auto& [begin, end] : sides) {
      if (meetsRegion(*begin, *end)) edges_.push_back({*begin, *end, i});
    }
  }
  const auto ends = [](const Edge& edge) { return std::make_pair(key(edge.a), key(edge.b)); };
  std::sort(edges_.begin(), edges_.end(),
            [&](const Edge& x, const Edge& y) { return ends(x) < ends(y); });
  above_.resize(triangles_.size());
  std::iota(above_.begin(), above_.end(), Index{0});
  isBordered_.assign(triangles_.size(), 0);
  for (auto first = edges_.begin(); first != edges_.end();) {
    const auto last = std::find_if(first, edges_.end(),
                                   [&](const Edge& edge) { return ends(edge) != ends(*first); });
    const bool isBorder = (last - first) % 2 != 0;
    for (auto edge = first; edge != last; ++edge) {
      above_[surfaceOf(edge->triangle)] = surfaceOf(first->triangle);
      if (isBorder) isBordered_[edge->triangle] = 1;
    }
    first = last;
  }
}

bool SurfacePassage::isFree(const Vector3d& centre, double radius, Index surface) {
  const Aabb box = boxOf(centre, centre, radius);
  for (Index i = 0; i < triangles_.size(); ++i) {
    if (surfaceOf(i) != surface) continue;
    Aabb of;
    for (const Vector3d& v : triangles_[i].vertices) of.add(v);
    if (!of.overlaps(box)) continue;
    const Hull point = Hull::segment(centre, centre);
    if (separation(point, Hull::of(triangles_[i])).lower() <= radius) return false;
  }
  return true;
}

std::optional<PassageSpan> SurfacePassage::through(Index surface) {
  for (Index i = 0; i < triangles_.size(); ++i) {
    if (isBordered_[i] != 0 && surfaceOf(i) == surface) return std::nullopt;
  }
  std::optional<double> after;  // when the point was last surely beside the surface
  if (isFree(way_.front().from, way_.front().radiusFrom, surface)) after = way_.front().begin;
  bool hasCrossed = false;  // since then, an odd number of times
  for (std::size_t part = 0; part < way_.size(); ++part) {
    for (const Crossing& crossing : crossings_) {
      if (crossing.part != part || surfaceOf(crossing.triangle) != surface) continue;
      if (!crossing.isClear) return std::nullopt;
      hasCrossed = !hasCrossed;
    }
    const PassagePart& own = way_[part];
    if (!isFree(own.to, own.radiusTo, surface)) continue;
    if (after && hasCrossed) return PassageSpan{*after, own.end};
    after = own.end;
    hasCrossed = false;
  }
  return std::nullopt;
}

}  // namespace foretouch::internal
