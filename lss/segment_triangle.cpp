#include "lss/segment_triangle.h"

#include <cmath>

#include "lss/closest_features.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Closest;
using internal::Edge;
using internal::Face;

void offerProjection(const Vector3d& p, const Face& face, Closest& best) {
  Vector3d onFace;
  if (face.project(p, onFace)) best.offer(p, onFace, face.normal);
}

void offerFace(const Edge& axis, const Vector3d& b, const Face& face, Closest& best) {
  if (!face.hasArea()) return;  // the edges are the whole triangle
  const double heightA = face.height(axis.a);
  const double heightB = face.height(b);
  if (Face::crosses(heightA, heightB)) {
    offerProjection(axis.at(internal::clamp01(heightA / (heightA - heightB))), face, best);
  }
  offerProjection(axis.a, face, best);
  offerProjection(b, face, best);
}

}  // namespace

ClosestPoints closestPoints(const Vector3d& a, const Vector3d& b, const Triangle& triangle) {
  const Vector3d& origin = triangle.vertices[0];
  const Vector3d aLocal = a - origin, bLocal = b - origin;
  const Edge axis(aLocal, bLocal - aLocal);
  const Face face(Vector3d::Zero(), triangle.vertices[1] - origin, triangle.vertices[2] - origin);

  Closest best;
  offerFace(axis, bLocal, face, best);
  offerEdges(axis, Edge(Vector3d::Zero(), face.e1), best);
  offerEdges(axis, Edge(Vector3d::Zero(), face.e2), best);
  offerEdges(axis, Edge(face.e1, triangle.vertices[2] - triangle.vertices[1]), best);

  ClosestPoints result;
  result.onSegment = origin + best.onOne;
  result.onTriangle = origin + best.onOther;
  result.difference = best.onOne - best.onOther;
  result.distance = std::sqrt(best.squaredDistance);
  result.featureNormal = best.featureNormal;
  return result;
}

}  // namespace foretouch
