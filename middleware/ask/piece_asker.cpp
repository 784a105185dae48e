#include "middleware/ask/piece_asker.h"

#include <cmath>
#include <optional>

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

/// From the piece to the shape.
Vector3d normalOf(const AskedShape& shape, const Hull& piece, const Separation& apart) {
  if (apart.distance > kAskTolerance) return unitOf(apart.difference);
  // Their difference is noise: what faces the shape on its way says more.
  if (!shape.moves()) return Vector3d::Zero();
  Vector3d normal = unitOf(apart.featureNormal);
  if (normal.isZero(0.0)) normal = unitOf(faceOf(piece));
  return normal.dot(shape.way) > 0.0 ? Vector3d(-normal) : normal;
}

/// Shares of p in the corners: not below 0, together 1.
std::array<double, 3> weightsOf(const Hull& triangle, const Vector3d& p) {
  const auto& v = triangle.points;
  const Vector3d normal = faceOf(triangle);
  const double square = normal.squaredNorm();
  std::array<double, 3> weights{};
  if (square > 0.0) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d &from = v[(i + 1) % 3], &to = v[(i + 2) % 3];
      weights[i] = std::max(0.0, (to - from).cross(p - from).dot(normal) / square);
    }
  } else {
    // A segment or a point: along its longest edge.
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      const auto length = [&](std::size_t k) { return (v[(k + 1) % 3] - v[k]).squaredNorm(); };
      if (length(i) > length(longest)) longest = i;
    }
    const std::size_t to = (longest + 1) % 3;
    const Vector3d edge = v[to] - v[longest];
    const double length = edge.squaredNorm();
    const double share = length > 0.0 ? (p - v[longest]).dot(edge) / length : 0.0;
    weights[to] = std::min(1.0, std::max(0.0, share));
    weights[longest] = 1.0 - weights[to];
  }
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0.0)) return {1.0, 0.0, 0.0};
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

void PieceAsker::askLss(const Lss& lss, const ContactSide& side) {
  if (!filter_.takes(side.body, side.link, kEveryObject)) return;
  shape_.reach = limit();
  Meeting meeting;
  const Hull piece = Hull::segment(lss.a, lss.b);
  if (!meets(shape_, piece, lss.radius, meeting)) return;
  add(meeting, piece, lss.radius, side, kEveryObject);
}

void PieceAsker::askTriangle(const Triangle& triangle, const ContactSide& side, ObjectId object) {
  if (shape_.moves() && shape_.isPoint() && shape_.lss.radius == 0.0 &&
      lineMisses(shape_, triangle)) {
    return;
  }
  if (!filter_.takes(side.body, side.link, object)) return;
  shape_.reach = limit();
  Meeting meeting;
  const Hull piece = Hull::of(triangle);
  if (!meets(shape_, piece, 0.0, meeting)) return;
  add(meeting, piece, 0.0, side, object);
}

void PieceAsker::add(const Meeting& meeting, const Hull& piece, double radius,
                     const ContactSide& side, ObjectId object) {
  WorldHit hit;
  hit.what = side;
  hit.object = object;
  hit.isAssumed = isAssumed_;
  const double whole = shape_.moved + meeting.distance;
  hit.distance = shape_.moved > 0.0 ? std::nextafter(whole, 0.0) : whole;
  const Separation& apart = meeting.apart;
  const Vector3d normal = normalOf(shape_, piece, apart);
  const Vector3d p = apart.onOther + std::min(radius, apart.distance) * normal;
  if (piece.count == 3) hit.weights = weightsOf(piece, p);
  hit.what.p_W = frame_.at(p);
  hit.nhat_W = frame_.R_WL * normal;
  hits_.add(hit);
}

}  // namespace foretouch::internal
