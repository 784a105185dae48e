#include "middleware/query/near_places.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/closest_features.h"
#include "lss/hull.h"
#include "lss/segment_triangle.h"
#include "lss/separation.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// A share of the axis: closer to an end than this is at it.
constexpr double kAtEnd = 1e-9;
/// A sine: a direction is along the normal of a face, or across an edge, that goes on flat to
/// within kFlatSine if it deviates by at most this from it.
constexpr double kFlatDirection = 2.0 * kFlatSine;
/// Of the pair's extent: below it, the difference of the closest points is noise.
constexpr double kNoisyDifference = 1e-9;

double snapped(double share) {
  if (share < kAtEnd) return 0.0;
  return share > 1.0 - kAtEnd ? 1.0 : share;
}

/// Of a point of the axis.
double alongOf(const StandingLss& lss, const Vector3d& p) {
  return snapped(Edge(lss.a, lss.b - lss.a).project(p));
}

/// From triangle to axis. Where the two are not apart, the normal of the features that meet, to the
/// side of the axis' longer part.
Vector3d directionOf(const StandingLss& lss, const Triangle& triangle, const Vector3d& difference,
                     const Vector3d& featureNormal, const Vector3d& p_Scene) {
  const double extent = (lss.b - lss.a).lpNorm<1>() +
                        (triangle.vertices[1] - triangle.vertices[0]).lpNorm<1>() +
                        (triangle.vertices[2] - triangle.vertices[0]).lpNorm<1>();
  const double distance = difference.stableNorm();
  if (distance > kNoisyDifference * extent) return difference / distance;
  const double length = featureNormal.stableNorm();
  if (!(length > 0.0)) return distance > 0.0 ? Vector3d(difference / distance) : Vector3d::Zero();
  const double side = featureNormal.dot(lss.a - p_Scene) + featureNormal.dot(lss.b - p_Scene);
  return (side < 0.0 ? -1.0 : 1.0) / length * featureNormal;
}

/// `v` is within kFlatDirection of the direction of `w`, on either side; unit, and any length.
bool isAlong(const Vector3d& v, const Vector3d& w) {
  const double length = w.norm();
  return length > 0.0 && v.cross(w).norm() <= kFlatDirection * length;
}

/// `v` is within kFlatDirection of the plane across `w`.
bool isAcross(const Vector3d& v, const Vector3d& w) {
  const double length = w.norm();
  return length > 0.0 && std::abs(v.dot(w)) <= kFlatDirection * length;
}

Vector3d edgeOf(const Triangle& triangle, int k) {
  return triangle.vertices[slotOf((k + 1) % 3)] - triangle.vertices[slotOf(k)];
}

/// The edge of the triangle that ends at vertex k and is not flat; -1 if there is none.
int cornerEdgeAt(const FlatEdges& flat, TriangleId id, int k) {
  for (const int edge : {k, (k + 2) % 3}) {
    if (!flat.isFlatEdge(id, edge)) return edge;
  }
  return -1;
}

/// Says what holds the place, and whether it stands for something.
void classify(const Triangle& triangle, const FlatEdges& flat, NearPlace& place) {
  NearFeature& feature = place.feature;
  const FeaturePlace on = featurePlaceAt(triangle, feature.p_WScene);
  feature.feature = on.kind;
  const auto& v = triangle.vertices;
  const auto standsOnFace = [&] {
    return place.isAtEnd() && isAlong(feature.nhat_SL_W, (v[1] - v[0]).cross(v[2] - v[0]));
  };
  const TriangleId id = feature.triangle;
  if (on.kind == FeatureKind::Edge && flat.isFlatEdge(id, on.index)) {
    place.stands = standsOnFace();
    if (place.stands) feature.feature = FeatureKind::Face;
  } else if (on.kind == FeatureKind::Vertex && flat.isFlatVertex(id, on.index)) {
    place.stands = standsOnFace();
    if (place.stands) feature.feature = FeatureKind::Face;
  } else if (on.kind == FeatureKind::Vertex && flat.isStraightVertex(id, on.index)) {
    const int edge = cornerEdgeAt(flat, id, on.index);
    place.stands = edge >= 0 && isAcross(feature.nhat_SL_W, edgeOf(triangle, edge));
    if (place.stands) feature.feature = FeatureKind::Edge;
  }
}

NearPlace placeOf(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                  const FlatEdges& flat, NearPart part, const ClosestPoints& closest) {
  NearPlace place;
  NearFeature& feature = place.feature;
  feature.link = lss.link;
  feature.lss = lss.lss;
  feature.triangle = id;
  feature.along = part == NearPart::EndB ? 1.0 : alongOf(lss, closest.onSegment);
  feature.p_WScene = closest.onTriangle;
  feature.nhat_SL_W =
      directionOf(lss, triangle, closest.difference, closest.featureNormal, closest.onTriangle);
  feature.p_WLink = closest.onSegment - lss.radius * feature.nhat_SL_W;
  feature.gap = closest.distance - lss.radius;
  place.distance = closest.distance;
  place.part = part;
  classify(triangle, flat, place);
  return place;
}

/// The axis crosses the edge, both at inner points.
bool crossesEdge(const StandingLss& lss, const Triangle& triangle, int k, ClosestPoints& points) {
  const Vector3d& origin = triangle.vertices[slotOf(k)];
  Closest best;
  offerEdges(Edge(lss.a - origin, lss.b - lss.a), Edge(Vector3d::Zero(), edgeOf(triangle, k)),
             best);
  if (!(best.featureNormal.squaredNorm() > 0.0)) return false;
  points.onSegment = origin + best.onOne;
  points.onTriangle = origin + best.onOther;
  points.difference = best.onOne - best.onOther;
  points.distance = std::sqrt(best.squaredDistance);
  points.featureNormal = best.featureNormal;
  return true;
}

}  // namespace

NearPlace closestPlace(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                       const FlatEdges& flat) {
  return placeOf(lss, triangle, id, flat, NearPart::Whole, closestPoints(lss.a, lss.b, triangle));
}

void findPlaces(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                const FlatEdges& flat, NearPlaces& places) {
  places.count = 0;
  const double within = lss.radius + lss.reach;
  const NearPlace closest = closestPlace(lss, triangle, id, flat);
  if (closest.distance > within && provenGap(lss, triangle, NearPart::Whole) > lss.reach) return;
  places.place[places.count++] = closest;
  const double at = closest.feature.along;
  const auto offer = [&](NearPart part, const ClosestPoints& points) {
    if (points.distance > within) return;
    places.place[places.count++] = placeOf(lss, triangle, id, flat, part, points);
  };
  if (lss.a == lss.b) return;
  if (at != 0.0) offer(NearPart::EndA, closestPoints(lss.a, lss.a, triangle));
  if (at != 1.0) offer(NearPart::EndB, closestPoints(lss.b, lss.b, triangle));
  for (const int k : {0, 1, 2}) {
    if (flat.isFlatEdge(id, k)) continue;
    ClosestPoints points;
    if (!crossesEdge(lss, triangle, k, points)) continue;
    const double apart = (closest.feature.p_WScene - points.onTriangle).norm();
    if (apart <= kAtEnd * edgeOf(triangle, k).norm()) continue;
    offer(static_cast<NearPart>(static_cast<int>(NearPart::Edge0) + k), points);
  }
}

double provenGap(const StandingLss& lss, const Triangle& triangle, NearPart part) {
  const auto apart = [&] {
    switch (part) {
      case NearPart::Whole: break;
      case NearPart::EndA: return separation(Hull::segment(lss.a, lss.a), Hull::of(triangle));
      case NearPart::EndB: return separation(Hull::segment(lss.b, lss.b), Hull::of(triangle));
      case NearPart::Edge0:
      case NearPart::Edge1:
      case NearPart::Edge2: {
        const auto k = slotOf(part) - slotOf(NearPart::Edge0);
        const auto& v = triangle.vertices;
        return separation(Hull::segment(lss.a, lss.b), Hull::segment(v[k], v[(k + 1) % 3]));
      }
    }
    return separation(Hull::segment(lss.a, lss.b), Hull::of(triangle));
  }();
  const double gap = apart.lower() - lss.radius;
  // The last subtraction may round up.
  return gap - lss.rounding - kUnitRoundoff * (lss.radius + std::abs(gap));
}

}  // namespace foretouch::internal
