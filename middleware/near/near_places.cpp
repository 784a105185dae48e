#include "middleware/near/near_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/clearance.h"
#include "lss/closest_features.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

double snapped(double share) {
  if (share < kAtEnd) return 0.0;
  return share > 1.0 - kAtEnd ? 1.0 : share;
}

/// A point of the axis and one of the triangle, relative to the triangle's first vertex.
struct Spot {
  double squared = std::numeric_limits<double>::infinity();  // of their distance
  Vector3d onAxis, onTriangle;
  double along = 0.0;
  FeaturePlace on{FeatureKind::Face, 0};
  Vector3d normal = Vector3d::Zero();  // of the features, where the two face each other
};

/// Both, relative to the triangle's first vertex.
class LocalPair {
 public:
  LocalPair(const StandingLss& lss, const Triangle& triangle)
      : a_(lss.a - triangle.vertices[0]),
        b_(lss.b - triangle.vertices[0]),
        axis_(b_ - a_),
        squaredAxis_(axis_.squaredNorm()),
        v_{Vector3d::Zero(), triangle.vertices[1] - triangle.vertices[0],
           triangle.vertices[2] - triangle.vertices[0]},
        face_(v_[0], v_[1], v_[2]) {
    for (std::size_t k = 0; k < 3; ++k) {
      edge_[k] = v_[(k + 1) % 3] - v_[k];
      squaredEdge_[k] = edge_[k].squaredNorm();
    }
  }

  [[nodiscard]] const Face& face() const { return face_; }
  [[nodiscard]] const Vector3d& edge(int k) const { return edge_[slotOf(k)]; }
  [[nodiscard]] double squaredAxis() const { return squaredAxis_; }
  [[nodiscard]] double extent() const {
    return axis_.lpNorm<1>() + v_[1].lpNorm<1>() + v_[2].lpNorm<1>();
  }
  /// The height of the axis' middle over a plane through `p`, doubled.
  [[nodiscard]] double side(const Vector3d& normal, const Vector3d& p) const {
    return normal.dot(a_ - p) + normal.dot(b_ - p);
  }

  /// The sphere at an end of the axis, and the triangle.
  [[nodiscard]] Spot ofEnd(bool atB) const { return ofPoint(atB ? b_ : a_, atB ? 1.0 : 0.0); }

  /// The axis and an edge. `isInner`: at inner points of both, which are not nearly parallel.
  [[nodiscard]] Spot ofEdge(int k, bool& isInner, bool& isTrusted) const {
    const auto i = slotOf(k);
    const double mixed = axis_.dot(edge_[i]);
    const double scale = squaredAxis_ * squaredEdge_[i];
    const double determinant = scale - mixed * mixed;
    const Vector3d w = a_ - v_[i];
    const double onAxis = axis_.dot(w), onEdge = edge_[i].dot(w);
    isTrusted = determinant > kNearParallelSin2 * scale;
    double s = 0.0;
    if (determinant > 0.0) {
      s = clamp01((mixed * onEdge - squaredEdge_[i] * onAxis) / determinant);
    }
    const double t = squaredEdge_[i] > 0.0 ? clamp01((onEdge + s * mixed) / squaredEdge_[i]) : 0.0;
    s = squaredAxis_ > 0.0 ? clamp01((t * mixed - onAxis) / squaredAxis_) : 0.0;
    Spot spot = at(s, k, t);
    isInner =
        isTrusted && spot.along > 0.0 && spot.along < 1.0 && spot.on.kind == FeatureKind::Edge;
    if (isInner) spot.normal = axis_.cross(edge_[i]);
    return spot;
  }

  /// The axis and a vertex.
  [[nodiscard]] Spot ofVertex(int k) const {
    const double onAxis = axis_.dot(v_[slotOf(k)] - a_);
    return at(squaredAxis_ > 0.0 ? clamp01(onAxis / squaredAxis_) : 0.0, k, 0.0);
  }

  /// Where the axis passes through the face, if it does.
  void offerCrossing(Spot& best) const {
    if (!face_.hasArea()) return;
    const double heightA = face_.height(a_), heightB = face_.height(b_);
    if (!Face::crosses(heightA, heightB)) return;
    const double s = clamp01(heightA / (heightA - heightB));
    offerFace(a_ + s * axis_, s, best);
  }

 private:
  [[nodiscard]] Spot at(double s, int k, double t) const {
    Spot spot;
    const auto i = slotOf(k);
    spot.onAxis = a_ + s * axis_;
    spot.onTriangle = v_[i] + t * edge_[i];
    spot.squared = (spot.onAxis - spot.onTriangle).squaredNorm();
    spot.along = snapped(s);
    spot.on = placeOf(k, t);
    return spot;
  }

  static FeaturePlace placeOf(int k, double t) {
    const double share = snapped(t);
    if (share == 0.0) return {FeatureKind::Vertex, k};
    return share == 1.0 ? FeaturePlace{FeatureKind::Vertex, (k + 1) % 3}
                        : FeaturePlace{FeatureKind::Edge, k};
  }

  [[nodiscard]] Spot ofPoint(const Vector3d& p, double along) const {
    Spot best;
    best.along = along;
    if (face_.hasArea()) offerFace(p, along, best);
    if (best.squared < std::numeric_limits<double>::infinity()) return best;
    for (const int k : {0, 1, 2}) {
      const auto i = slotOf(k);
      const double onEdge = edge_[i].dot(p - v_[i]);
      const double t = squaredEdge_[i] > 0.0 ? clamp01(onEdge / squaredEdge_[i]) : 0.0;
      const Vector3d q = v_[i] + t * edge_[i];
      const double squared = (p - q).squaredNorm();
      if (!(squared < best.squared)) continue;
      best.squared = squared;
      best.onTriangle = q;
      best.on = placeOf(k, t);
    }
    best.onAxis = p;
    return best;
  }

  /// The foot of a point on the face, if it has one; a foot on an edge is the edge's.
  void offerFace(const Vector3d& p, double along, Spot& best) const {
    const Vector3d w = p - v_[0];
    const double beta = w.cross(face_.e2).dot(face_.normal) / face_.nn;
    const double gamma = face_.e1.cross(w).dot(face_.normal) / face_.nn;
    const double alpha = 1.0 - beta - gamma;
    if (!(beta >= 0.0 && gamma >= 0.0 && alpha >= 0.0)) return;
    const Vector3d foot = beta * face_.e1 + gamma * face_.e2;
    const double squared = (p - foot).squaredNorm();
    if (!(squared < best.squared)) return;
    best = {squared, p, foot, snapped(along), {FeatureKind::Face, 0}, face_.normal};
    if (gamma < kAtEnd) {
      best.on = placeOf(0, beta);
    } else if (alpha < kAtEnd) {
      best.on = placeOf(1, gamma);
    } else if (beta < kAtEnd) {
      best.on = placeOf(2, alpha);
    }
  }

  Vector3d a_, b_, axis_;
  double squaredAxis_;
  std::array<Vector3d, 3> v_, edge_;
  std::array<double, 3> squaredEdge_;
  Face face_;
};

/// Makes places of spots.
class PlaceMaker {
 public:
  PlaceMaker(const StandingLss& lss, const Triangle& triangle, TriangleId id, const FlatEdges& flat)
      : lss_(lss), triangle_(triangle), id_(id), flat_(flat), pair_(lss, triangle) {}

  [[nodiscard]] const LocalPair& pair() const { return pair_; }

  /// Whether the difference of its points has a direction.
  [[nodiscard]] bool isApart(const Spot& spot) const {
    return std::sqrt(spot.squared) > kNoisyDifference * pair_.extent();
  }

  void make(NearPart part, const Spot& spot, NearPlace& place) const {
    NearFeature& feature = place.feature;
    feature.link = lss_.link;
    feature.lss = lss_.lss;
    feature.triangle = id_;
    feature.along = spot.along;
    feature.p_WScene = triangle_.vertices[0] + spot.onTriangle;
    place.distance = std::sqrt(spot.squared);
    place.part = part;
    feature.nhat_SL_W = directionOf(spot, place.distance);
    place.away = isApart(spot) ? Vector3d(spot.onAxis - spot.onTriangle) : feature.nhat_SL_W;
    feature.p_WLink = triangle_.vertices[0] + (spot.onAxis - lss_.radius * feature.nhat_SL_W);
    feature.gap = place.distance - lss_.radius;
    classify(spot, place);
  }

 private:
  /// The way from triangle to axis. Where the two are not apart, the normal of the features that
  /// meet, to the side of the axis' longer part.
  [[nodiscard]] Vector3d directionOf(const Spot& spot, double distance) const {
    const Vector3d difference = spot.onAxis - spot.onTriangle;
    if (distance > kNoisyDifference * pair_.extent()) return difference / distance;
    const double length = spot.normal.norm();
    if (length > 0.0) {
      const double sign = pair_.side(spot.normal, spot.onTriangle) < 0.0 ? -1.0 : 1.0;
      return sign / length * spot.normal;
    }
    return distance > 0.0 ? Vector3d(difference / distance) : Vector3d::Zero();
  }

  /// Says what holds the place, and whether it stands for something.
  void classify(const Spot& spot, NearPlace& place) const {
    NearFeature& feature = place.feature;
    feature.feature = spot.on.kind;
    place.stands = true;
    if (spot.on.kind == FeatureKind::Face) return;
    const bool isFlat = spot.on.kind == FeatureKind::Edge ? flat_.isFlatEdge(id_, spot.on.index)
                                                          : flat_.isFlatVertex(id_, spot.on.index);
    if (isFlat) {
      place.stands = place.isAtEnd() && isAlong(feature.nhat_SL_W, pair_.face().normal);
      if (place.stands) feature.feature = FeatureKind::Face;
    } else if (spot.on.kind == FeatureKind::Vertex && flat_.isStraightVertex(id_, spot.on.index)) {
      const int edge = cornerEdgeAt(spot.on.index);
      place.stands = edge >= 0 && isAcross(feature.nhat_SL_W, pair_.edge(edge));
      if (place.stands) feature.feature = FeatureKind::Edge;
    }
  }

  /// Whether the unit `v` is within kFlatDirection of the direction of `w`, on either side.
  static bool isAlong(const Vector3d& v, const Vector3d& w) {
    const double length = w.norm();
    return length > 0.0 && v.cross(w).norm() <= kFlatDirection * length;
  }
  /// Whether the unit `v` is within kFlatDirection of the plane across `w`.
  static bool isAcross(const Vector3d& v, const Vector3d& w) {
    const double length = w.norm();
    return length > 0.0 && std::abs(v.dot(w)) <= kFlatDirection * length;
  }
  /// The edge that ends at vertex k and is not flat; -1 if there is none.
  [[nodiscard]] int cornerEdgeAt(int k) const {
    for (const int edge : {k, (k + 2) % 3}) {
      if (!flat_.isFlatEdge(id_, edge)) return edge;
    }
    return -1;
  }

  const StandingLss& lss_;
  const Triangle& triangle_;
  TriangleId id_;
  const FlatEdges& flat_;
  LocalPair pair_;
};

NearPart edgePart(int k) {
  return static_cast<NearPart>(static_cast<int>(NearPart::Edge0) + k);
}

/// What a pair's closest points are among.
struct Spots {
  Spot whole, endA, endB, edge[3];
  bool isInner[3];

  explicit Spots(const LocalPair& pair) : endA(pair.ofEnd(false)) {
    whole = endA;
    if (!(pair.squaredAxis() > 0.0)) {
      endB = endA;
      std::fill(isInner, isInner + 3, false);
      return;
    }
    endB = pair.ofEnd(true);
    offer(endB);
    pair.offerCrossing(whole);
    for (const int k : {0, 1, 2}) {
      bool isTrusted = false;
      edge[k] = pair.ofEdge(k, isInner[k], isTrusted);
      offer(edge[k]);
      if (isTrusted) continue;
      offer(pair.ofVertex(k));
      offer(pair.ofVertex((k + 1) % 3));
    }
  }

 private:
  void offer(const Spot& spot) {
    if (spot.squared < whole.squared) whole = spot;
  }
};

}  // namespace

NearPlace closestPlace(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                       const FlatEdges& flat) {
  const PlaceMaker maker(lss, triangle, id, flat);
  NearPlace place;
  maker.make(NearPart::Whole, Spots(maker.pair()).whole, place);
  return place;
}

void findPlaces(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                const FlatEdges& flat, const NearFilter* filter, NearPlaces& places) {
  places.count = 0;
  const PlaceMaker maker(lss, triangle, id, flat);
  const Spots spots(maker.pair());
  const double within = lss.radius + lss.reach, squared = within * within;
  const Spot& whole = spots.whole;
  const auto make = [&](NearPart part, const Spot& spot) {
    if (filter != nullptr && maker.isApart(spot) &&
        !filter->mayWin(spot.onAxis - spot.onTriangle, spot.along, std::sqrt(spot.squared))) {
      return;
    }
    maker.make(part, spot, places.place[places.count++]);
  };
  make(NearPart::Whole, whole);
  if (whole.squared > squared) {
    // Rounding may have put it there.
    if (places.count == 1 && provenGap(lss, triangle, places.place[0]) > lss.reach) {
      places.count = 0;
    }
    return;
  }
  if (!(maker.pair().squaredAxis() > 0.0)) return;
  const auto offer = [&](NearPart part, const Spot& spot) {
    if (spot.squared <= squared) make(part, spot);
  };
  if (whole.along != 0.0) offer(NearPart::EndA, spots.endA);
  if (whole.along != 1.0) offer(NearPart::EndB, spots.endB);
  for (const int k : {0, 1, 2}) {
    if (!spots.isInner[k] || flat.isFlatEdge(id, k)) continue;
    const bool isWhole = whole.on.kind == FeatureKind::Edge && whole.on.index == k &&
                         std::abs(whole.along - spots.edge[k].along) <= kAtEnd;
    if (!isWhole) offer(edgePart(k), spots.edge[k]);
  }
}

NearPlace placeFrom(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                    const FlatEdges& flat, int source, NearPart part) {
  const PlaceMaker maker(lss, triangle, id, flat);
  NearPlace place;
  if (source < 2) {
    maker.make(part, maker.pair().ofEnd(source == 1), place);
  } else {
    bool isInner = false, isTrusted = false;
    maker.make(part, maker.pair().ofEdge(source - 2, isInner, isTrusted), place);
  }
  return place;
}

double provenGap(const StandingLss& lss, const Triangle& triangle, const NearPlace& place) {
  const auto& v = triangle.vertices;
  const bool isOfEdge = place.part >= NearPart::Edge0;
  const auto k = isOfEdge ? slotOf(place.part) - slotOf(NearPart::Edge0) : 0;
  const Hull axis = Hull::segment(place.part == NearPart::EndB ? lss.b : lss.a,
                                  place.part == NearPart::EndA ? lss.a : lss.b);
  const Hull other = isOfEdge ? Hull::segment(v[k], v[(k + 1) % 3]) : Hull::of(triangle);
  const double gap = clearanceAlong(axis, other, place.feature.nhat_SL_W) - lss.radius;
  // The last subtractions may round up.
  return gap - lss.rounding - 2.0 * kUnitRoundoff * (lss.radius + std::abs(gap));
}

}  // namespace foretouch::internal
