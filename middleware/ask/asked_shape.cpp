#include "middleware/ask/asked_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/clearance.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/ask/ask.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Steps of a cast. Each halves what is left at least, and mostly squares it; a cast that took so
/// many is reported as a hit where it is, which is early.
constexpr int kMostSteps = 128;

/// How far a point of the axis may be from its true place after it moved: a product, a sum, and the
/// rounding of the unit way (ask.md 2).
double roundingOfWay(const AskedShape& shape, double along) {
  const double from = std::max(shape.lss.a.lpNorm<1>(), shape.lss.b.lpNorm<1>());
  return kSeparationRounding * (from + shape.moved + along) + kInflation * shape.ofWay * along;
}

/// Tries planes along each edge of both, where rounding has tilted the one between their closest
/// points: of two that are nanometres apart, by more than they are.
void straighten(const Hull& one, const Hull& other, Separation& apart) {
  const Vector3d direction = apart.difference;
  const auto tryAlong = [&](const Vector3d& edge) {
    const double square = edge.squaredNorm();
    if (!(square > 0.0)) return;
    const Vector3d across = direction - direction.dot(edge) / square * edge;
    const double length = across.norm();
    if (!(length > 0.0)) return;
    const Vector3d nhat = (kUnitShrink / length) * across;
    const double gap = gapAlong(one, other, nhat);
    if (!(gap > apart.lower())) return;
    apart.nhat = nhat;
    apart.clearance.fill(gap);
  };
  tryAlong(one.points[1] - one.points[0]);
  for (std::size_t i = 0; i < countOf(other.count); ++i) {
    tryAlong(other.points[(i + 1) % countOf(other.count)] - other.points[i]);
  }
}

bool isNear(const AskedShape& shape, const Hull& piece, double sum, Meeting& meeting) {
  meeting.apart = apartAfter(shape, 0.0, piece);
  meeting.distance = std::max(0.0, (meeting.apart.lower() - sum) / kInflation);
  return meeting.distance <= shape.reach;
}

/// Newton's steps on the distance, which is convex along the way: the plane that keeps the two
/// apart says how far the shape may go on. It never steps over the first touch.
bool touches(const AskedShape& shape, const Hull& piece, double sum, Meeting& meeting) {
  double along = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    meeting.distance = along;
    meeting.apart = apartAfter(shape, along, piece);
    const double more = sum + roundingOfWay(shape, along);
    const double free = meeting.apart.lower() - more;
    if (free <= 0.0 || meeting.apart.upper <= more + kAskTolerance) return true;
    // How fast, at most, the free space shrinks, per metre of way.
    const double pace = kSeparationRounding + shape.ofWay - meeting.apart.nhat.dot(shape.way);
    if (pace <= 0.0) return false;
    // Steps do not depend on the reach, which what was found before may have shortened.
    const double next = std::nextafter(along + free / (kInflation * pace), 0.0);
    if (next > shape.reach) return false;
    if (!(next > along)) return true;  // doubles do not resolve what is left
    along = next;
  }
  return true;
}

}  // namespace

AskedShape AskedShape::movedBy(double along, double until) const {
  AskedShape later = *this;
  later.lss.a += along * way;
  later.lss.b += along * way;
  later.moved += along;
  later.reach = std::max(0.0, until - along);
  return later;
}

void AskedShape::takeHull(const std::vector<Vector3d>& corners, ConvexShape& memory) {
  if (corners.empty()) return;
  rounding += memory.assign(corners, lss.a);
  lss.b = lss.a;
  hull = &memory;
}

Aabb AskedShape::box() const {
  Aabb box;
  box.add(hull != nullptr ? Vector3d(lss.a + hull->low) : lss.a);
  box.add(hull != nullptr ? Vector3d(lss.b + hull->high) : lss.b);
  return box;
}

AskedShape AskedShape::seenFrom(const LinkPlace& frame, ConvexShape& memory) const {
  AskedShape seen = *this;
  seen.lss = internal::seenFrom(frame, lss, seen.rounding);
  if (hull != nullptr) {
    seen.rounding += hull->seenFrom(frame, memory);
    seen.hull = &memory;
  }
  seen.way = frame.R_WL.transpose() * way;
  seen.ofWay = kInflation * (ofWay + frame.ofTurn + MotionBounds::kPointRounding);
  return seen;
}

Separation apartAfter(const AskedShape& shape, double along, const Hull& piece) {
  const Vector3d a = shape.lss.a + along * shape.way;
  if (shape.hull != nullptr) return separation(*shape.hull, a, piece);
  const Hull axis = Hull::segment(a, shape.lss.b + along * shape.way);
  Separation apart = foretouch::separation(axis, piece);
  if (apart.upper - apart.lower() > 0.5 * kAskTolerance) straighten(axis, piece, apart);
  return apart;
}

bool meets(const AskedShape& shape, const Hull& piece, double radius, Meeting& meeting) {
  const double sum = kInflation * (shape.lss.radius + radius + shape.rounding);
  return shape.moves() ? touches(shape, piece, sum, meeting) : isNear(shape, piece, sum, meeting);
}

bool lineMisses(const AskedShape& shape, const Triangle& triangle) {
  const double moved = shape.rounding + roundingOfWay(shape, 0.0);
  std::array<Vector3d, 3> from;
  std::array<double, 3> size;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = triangle.vertices[i] - shape.lss.a;
    size[i] = from[i].lpNorm<1>();
  }
  bool isLeft = false, isRight = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const double turn = shape.way.dot(from[i].cross(from[next]));
    // Eight roundings of the determinant, and four of the way (ask.md 3).
    const double bound = (2.0 * kSeparationRounding + shape.ofWay) * size[i] * size[next] +
                         2.0 * moved * (size[i] + size[next] + 2.0 * moved) + kUnderflow;
    isLeft = isLeft || turn > bound;
    isRight = isRight || turn < -bound;
  }
  return isLeft && isRight;
}

}  // namespace foretouch::internal
