#include "middleware/ask/piece_asker.h"

#include <cmath>

#include <Eigen/Geometry>

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Zero if it has no length.
Vector3d unitOf(const Vector3d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vector3d(v / length) : Vector3d(Vector3d::Zero());
}

Vector3d faceOf(const Hull& piece) {
  if (piece.count < 3) return Vector3d::Zero();
  const auto& v = piece.points;
  return (v[1] - v[0]).cross(v[2] - v[0]);
}

/// The normal from the piece to the shape.
Vector3d normalOf(const AskedShape& shape, const Hull& piece, const Separation& apart) {
  if (apart.distance > kAskTolerance) return unitOf(apart.difference);
  // Their difference is noise: what faces the shape on its way says more.
  if (!shape.moves()) return Vector3d::Zero();
  Vector3d normal = unitOf(apart.featureNormal);
  if (normal.isZero(0.0)) normal = unitOf(faceOf(piece));
  return normal.dot(shape.way) > 0.0 ? Vector3d(-normal) : normal;
}

/// Shares of p in the corners: not below 0, together 1. By its places along the longest edge and
/// across it, so that the sum is at p for a sliver, too.
std::array<double, 3> weightsOf(const Hull& triangle, const Vector3d& p) {
  const auto& v = triangle.points;
  const auto squareOf = [&](std::size_t k) { return (v[(k + 1) % 3] - v[k]).squaredNorm(); };
  std::size_t from = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (squareOf(k) > squareOf(from)) from = k;
  }
  const std::size_t to = (from + 1) % 3, top = (from + 2) % 3;
  std::array<double, 3> weights{};
  weights[from] = 1.0;
  const Vector3d edge = v[to] - v[from], side = v[top] - v[from], way = p - v[from];
  const double square = edge.squaredNorm();
  if (!(square > 0.0)) return weights;  // a point
  const double x = std::clamp(way.dot(edge) / square, 0.0, 1.0);
  const double xOfTop = std::clamp(side.dot(edge) / square, 0.0, 1.0);
  const Vector3d height = side - xOfTop * edge;
  const double high = height.squaredNorm();
  // The share of a sliver's top is noise: no more than leaves the two others theirs.
  const double most = std::min(
      {1.0, xOfTop > 0.0 ? x / xOfTop : 1.0, xOfTop < 1.0 ? (1.0 - x) / (1.0 - xOfTop) : 1.0});
  const double share = high > 0.0 ? std::clamp(way.dot(height) / high, 0.0, most) : 0.0;
  weights[top] = share;
  weights[to] = std::max(0.0, x - share * xOfTop);
  weights[from] = std::max(0.0, 1.0 - share - weights[to]);
  return weights;
}

}  // namespace

WorldHit hitOf(const AskedShape& shape, const Hull& piece, double radius, const Meeting& meeting) {
  WorldHit hit;
  const double whole = shape.moved + meeting.distance;
  hit.distance = shape.moved > 0.0 ? std::nextafter(whole, 0.0) : whole;
  const Separation& apart = meeting.apart;
  hit.nhat_W = normalOf(shape, piece, apart);
  hit.what.p_W = apart.onOther + std::min(radius, apart.distance) * hit.nhat_W;
  if (piece.count == 3) hit.weights = weightsOf(piece, hit.what.p_W);
  return hit;
}

void takeOwner(const ContactSide& side, WorldHit& hit) {
  hit.what.body = side.body;
  hit.what.link = side.link;
  hit.what.lss = side.lss;
  hit.what.triangle = side.triangle;
}

void PieceAsker::askLss(const Lss& lss, const ContactSide& side) {
  if (!filter_.takes(side.body, side.link, kEveryObject)) return;
  shape_.reach = limit();
  if (shape_.reach < 0.0) return;
  Meeting meeting;
  const Hull piece = Hull::segment(lss.a, lss.b);
  if (!meets(shape_, piece, lss.radius, meeting)) return;
  add(meeting, piece, lss.radius, side, kEveryObject);
}

void PieceAsker::askTriangle(const Triangle& triangle, const ContactSide& side, ObjectId object) {
  if (shape_.isRay() && lineMisses(shape_, triangle)) return;
  if (!filter_.takes(side.body, side.link, object)) return;
  shape_.reach = limit();
  if (shape_.reach < 0.0) return;
  Meeting meeting;
  const Hull piece = Hull::of(triangle);
  if (!meets(shape_, piece, 0.0, meeting)) return;
  add(meeting, piece, 0.0, side, object);
}

void PieceAsker::add(const Meeting& meeting, const Hull& piece, double radius,
                     const ContactSide& side, ObjectId object) {
  WorldHit hit = hitOf(shape_, piece, radius, meeting);
  takeOwner(side, hit);
  const Vector3d p = hit.what.p_W;
  hit.what.p_W = frame_.at(p);
  hit.nhat_W = frame_.R_WL * hit.nhat_W;
  hit.object = object;
  hit.isAssumed = isAssumed_;
  hits_.add(hit);
}

}  // namespace foretouch::internal
