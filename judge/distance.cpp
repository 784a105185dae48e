// judge/distance.cpp: the least distance over pairs of features.
#include "judge/distance.h"

#include <limits>
#include <optional>

#include "judge/wide.h"

namespace foretouch::oracle {
namespace {

template <typename S>
class Least {
 public:
  void offer(const Vec3<S>& onSegment, const Vec3<S>& onTriangle) {
    const Vec3<S> difference = onSegment - onTriangle;
    const S squared = dot(difference, difference);
    if (squared >= squared_) return;
    squared_ = squared;
    best_.onSegment = onSegment;
    best_.onTriangle = onTriangle;
  }
  [[nodiscard]] Closest<S> result() const {
    Closest<S> closest = best_;
    using std::sqrt;
    closest.distance = sqrt(squared_);
    return closest;
  }

 private:
  S squared_ = S(std::numeric_limits<double>::infinity());
  Closest<S> best_;
};

/// The foot of p on a segment: an end point, or the point inside it.
template <typename S>
Vec3<S> footOnSegment(const Vec3<S>& p, const Vec3<S>& a, const Vec3<S>& b) {
  const Vec3<S> along = b - a;
  const S length2 = dot(along, along);
  if (!(length2 > 0)) return a;
  const S s = dot(p - a, along) / length2;
  if (s <= 0) return a;
  // From the nearer end, so that the foot errs by rounding times the distance to that end only.
  if (s <= S(0.5)) return a + s * along;
  const S rest = dot(b - p, along) / length2;
  return rest <= 0 ? b : b - rest * along;
}

/// Both feet inside: the common perpendicular of the two lines. Found with `across` freed of its
/// part along the segment, so that nearly parallel lines lose no more than that part's digits.
template <typename S>
void offerLines(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, const Vec3<S>& d,
                Least<S>& least) {
  const Vec3<S> along = b - a, across = d - c, gap = a - c;
  const S length2 = dot(along, along);
  if (!(length2 > 0)) return;
  const Vec3<S> sideways = across - (dot(across, along) / length2) * along;
  const S width2 = dot(sideways, sideways);
  if (!(width2 > 0)) return;
  const Vec3<S> gapSideways = gap - (dot(gap, along) / length2) * along;
  const S t = dot(gapSideways, sideways) / width2;
  if (!(t > 0 && t < 1)) return;
  const Vec3<S> onEdge = c + t * across;
  const S s = dot(onEdge - a, along) / length2;
  if (!(s > 0 && s < 1)) return;
  least.offer(a + s * along, onEdge);
}

/// A triangle's plane: the first axis along its longest edge, the second towards the third vertex.
template <typename S>
struct Face {
  Vec3<S> origin, first, second, normal;
  S length = 0, height = 0, apex = 0;  // apex: the third vertex's place along the first axis
  bool flat = true;                    // no area: its edges are the whole triangle

  explicit Face(const Corners<S>& v) {
    int longest = 0;
    S best = -1;
    for (int i = 0; i < 3; ++i) {
      const Vec3<S> e = v[(i + 1) % 3] - v[i];
      if (dot(e, e) > best) {
        best = dot(e, e);
        longest = i;
      }
    }
    origin = v[longest];
    using std::sqrt;
    length = sqrt(best);
    if (!(length > 0)) return;
    first = (1 / length) * (v[(longest + 1) % 3] - origin);
    const Vec3<S> side = v[(longest + 2) % 3] - origin;
    apex = dot(side, first);
    Vec3<S> up = side - apex * first;
    up = up - dot(up, first) * first;  // once more: the first pass leaves rounding along `first`
    height = norm(up);
    if (!(height > 0)) return;
    second = (1 / height) * up;
    normal = cross(first, second);
    flat = false;
  }
  [[nodiscard]] S elevation(const Vec3<S>& p) const { return dot(p - origin, normal); }
  /// The foot of p on the plane, if it lies inside the triangle.
  [[nodiscard]] std::optional<Vec3<S>> foot(const Vec3<S>& p) const {
    const Vec3<S> r = p - origin;
    const S x = dot(r, first);
    const S y = dot(r - x * first, second);
    // Above the base, and between the two other sides at that height.
    const S share = y / height;
    const bool inside =
        y > 0 && share < 1 && x > share * apex && length - x > share * (length - apex);
    if (!inside) return std::nullopt;
    return origin + x * first + y * second;
  }
};

template <typename S>
std::optional<Vec3<S>> piercing(const Vec3<S>& a, const Vec3<S>& b, const Face<S>& face) {
  const S above = face.elevation(a), below = face.elevation(b);
  if ((above < 0) == (below < 0) || above == below) return std::nullopt;
  const Vec3<S> p = a + (above / (above - below)) * (b - a);
  if (!face.foot(p)) return std::nullopt;
  return p;
}

template <typename S>
void offerFace(const Vec3<S>& a, const Vec3<S>& b, const Face<S>& face, Least<S>& least) {
  for (const Vec3<S>* p : {&a, &b}) {
    if (const auto foot = face.foot(*p)) least.offer(*p, *foot);
  }
  if (const auto p = piercing(a, b, face)) least.offer(*p, *p);
}

template <typename S>
void offerEdges(const Corners<S>& one, const Corners<S>& other, Least<S>& least) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<S>&a = one[i], &b = one[(i + 1) % 3];
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3<S>&c = other[j], &d = other[(j + 1) % 3];
      least.offer(a, footOnSegment(a, c, d));
      least.offer(footOnSegment(c, a, b), c);
      offerLines(a, b, c, d, least);
    }
  }
}

}  // namespace

template <typename S>
Closest<S> closestPoints(const Vec3<S>& a, const Vec3<S>& b, const Corners<S>& v) {
  Least<S> least;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<S>& c = v[i];
    const Vec3<S>& d = v[(i + 1) % 3];
    least.offer(a, footOnSegment(a, c, d));
    least.offer(b, footOnSegment(b, c, d));
    least.offer(footOnSegment(c, a, b), c);
    offerLines(a, b, c, d, least);
  }
  const Face<S> face(v);
  if (!face.flat) offerFace(a, b, face, least);
  return least.result();
}

template <typename S>
Closest<S> closestPoints(const Corners<S>& one, const Corners<S>& other) {
  Least<S> least;
  offerEdges(one, other, least);
  const Face<S> faceOne(one), faceOther(other);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (!faceOther.flat) {
      if (const auto foot = faceOther.foot(one[i])) least.offer(one[i], *foot);
      if (const auto p = piercing(one[i], one[next], faceOther)) least.offer(*p, *p);
    }
    if (!faceOne.flat) {
      if (const auto foot = faceOne.foot(other[i])) least.offer(*foot, other[i]);
      if (const auto p = piercing(other[i], other[next], faceOne)) least.offer(*p, *p);
    }
  }
  return least.result();
}

template Closest<double> closestPoints(const Vec3d&, const Vec3d&, const Triangle&);
template Closest<Real> closestPoints(const Vec3r&, const Vec3r&, const Corners<Real>&);
template Closest<Wide> closestPoints(const Vec3<Wide>&, const Vec3<Wide>&, const Corners<Wide>&);
template Closest<double> closestPoints(const Triangle&, const Triangle&);
template Closest<Real> closestPoints(const Corners<Real>&, const Corners<Real>&);
template Closest<Wide> closestPoints(const Corners<Wide>&, const Corners<Wide>&);

template <typename S>
S pointSegmentDistance(const Vec3<S>& p, const Vec3<S>& a, const Vec3<S>& b) {
  return norm(p - footOnSegment(p, a, b));
}

template double pointSegmentDistance(const Vec3d&, const Vec3d&, const Vec3d&);
template Real pointSegmentDistance(const Vec3r&, const Vec3r&, const Vec3r&);

}  // namespace foretouch::oracle
