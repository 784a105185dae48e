#include "middleware/ask/convex_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/ask/ask.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Three corners, or fewer, of which the closest point is a mean.
using Face = std::array<std::size_t, 3>;

/// Faces that are tried. Each is nearer than the last one; what is not proven apart by then, or by
/// rounding, is taken to touch.
constexpr int kMostFaces = 64;

/// The corner that comes least far along a direction.
std::size_t lowestAlong(const ConvexShape& shape, const Vector3d& direction) {
  std::size_t lowest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    const double height = direction.dot(shape.corners[i]);
    if (height < least) {
      least = height;
      lowest = i;
    }
  }
  return lowest;
}

class ConvexSearch {
 public:
  ConvexSearch(const ConvexShape& shape, const Hull& piece) : shape_(shape), piece_(piece) {
    double extent = shape.extent;
    for (std::size_t j = 0; j < countOf(piece.count); ++j) extent += piece.points[j].lpNorm<1>();
    slack_ = kSeparationRounding * extent + kUnderflow;
    best_ = -slack_;
  }

  Separation search() {
    const std::size_t first = lowestAlong(shape_, -piece_.points[0]);
    take({first, first, first});
    for (int i = 0; i < kMostFaces && !isTight(); ++i) {
      if (!(apart_.distance > 0.0) || !descend()) break;
    }
    if (!isTight()) straighten();
    Separation result = apart_;
    result.numOne = 3;
    result.nhat = nhat_;
    result.clearance.fill(best_);
    // Rounding takes what is nanometres apart for enclosed: a plane between the two knows better.
    if (isEnclosed_ && !(best_ > 0.0)) {
      result.upper = result.distance = 0.0;
      result.difference = Vector3d::Zero();
    }
    return result;
  }

 private:
  [[nodiscard]] bool isTight() const { return apart_.upper - best_ <= 0.5 * kAskTolerance; }
  [[nodiscard]] Hull hullOf(const Face& face) const {
    return {{shape_.corners[face[0]], shape_.corners[face[1]], shape_.corners[face[2]]}, 3};
  }

  void take(const Face& face) { take(face, separation(hullOf(face), piece_)); }
  void take(const Face& face, const Separation& apart) {
    face_ = face;
    apart_ = apart;
    tryPlane(apart.nhat);
  }

  /// What a plane proves with all corners.
  void tryPlane(const Vector3d& nhat) {
    double top = -std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < countOf(piece_.count); ++j) {
      top = std::max(top, nhat.dot(piece_.points[j]));
    }
    const double gap = nhat.dot(shape_.corners[lowestAlong(shape_, nhat)]) - top - slack_;
    if (!(gap > best_)) return;
    best_ = gap;
    nhat_ = nhat;
  }

  /// Goes to the face, with the corner nearest along the plane, that is nearest to the piece.
  /// False: no face is nearer, or the piece is within the four corners.
  bool descend() {
    const std::size_t corner = lowestAlong(shape_, apart_.difference);
    if (std::find(face_.begin(), face_.end(), corner) != face_.end()) return false;
    std::size_t left = 0;
    Separation nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      // The same corner twice: a face less to try.
      if (std::find(face_.begin(), face_.begin() + k, face_[k]) != face_.begin() + k) continue;
      Face face = face_;
      face[k] = corner;
      const Separation apart = separation(hullOf(face), piece_);
      if (!(apart.distance < nearest.distance)) continue;
      nearest = apart;
      left = k;
    }
    const Vector3d& other = shape_.corners[face_[left]];
    Face face = face_;
    face[left] = corner;
    take(face, nearest);
    // The face is not between the piece and the rest: the piece is behind all four.
    isEnclosed_ = nearest.difference.dot(other - nearest.onOne) < 0.0 &&
                  nearest.difference.dot(other - nearest.onOther) < 0.0;
    return !isEnclosed_;
  }

  /// As for two hulls: rounding tilts the plane between what is nanometres apart, by more than
  /// that.
  void straighten() {
    const Vector3d direction = apart_.difference;
    const auto tryAlong = [&](const Vector3d& edge) {
      const double square = edge.squaredNorm();
      if (!(square > 0.0)) return;
      const Vector3d across = direction - direction.dot(edge) / square * edge;
      const double length = across.norm();
      if (length > 0.0) tryPlane((kUnitShrink / length) * across);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      tryAlong(shape_.corners[face_[(i + 1) % 3]] - shape_.corners[face_[i]]);
    }
    for (std::size_t j = 0; j < countOf(piece_.count); ++j) {
      tryAlong(piece_.points[(j + 1) % countOf(piece_.count)] - piece_.points[j]);
    }
  }

  const ConvexShape& shape_;
  const Hull& piece_;
  double slack_ = 0.0;
  Face face_{};
  Separation apart_;
  Vector3d nhat_ = Vector3d::Zero();
  double best_ = 0.0;  ///< Proven apart, along nhat_.
  bool isEnclosed_ = false;
};

Error cornerError(ErrorCode code, std::size_t corner, const std::string& expected) {
  const std::string message = "corner " + std::to_string(corner) + ": " + expected;
  return inFile(Error::at(static_cast<std::int64_t>(corner), code, message), "hull");
}

}  // namespace

void ConvexShape::measure() {
  low = high = corners.front();
  extent = 0.0;
  for (const Vector3d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
    extent = std::max(extent, corner.lpNorm<1>());
  }
}

double ConvexShape::assign(const std::vector<Vector3d>& given, Vector3d& place) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : given) middle += corner / static_cast<double>(given.size());
  corners.clear();
  double most = 0.0;
  for (const Vector3d& corner : given) {
    most = std::max(most, corner.lpNorm<1>());
    corners.push_back(corner - middle);
  }
  const double rounding = kSeparationRounding * (place.lpNorm<1>() + middle.lpNorm<1>() + most);
  place += middle;
  measure();
  return rounding;
}

double ConvexShape::seenFrom(const LinkPlace& frame, ConvexShape& seen) const {
  seen.corners.clear();
  for (const Vector3d& corner : corners) seen.corners.push_back(frame.R_WL.transpose() * corner);
  seen.measure();
  return frame.roundingAt(kInflation * std::max(extent, seen.extent));
}

Separation separation(const ConvexShape& shape, const Vector3d& place, const Hull& piece) {
  Hull seen = piece;
  for (Vector3d& point : seen.points) point -= place;
  Separation apart = ConvexSearch(shape, seen).search();
  apart.onOne += place;
  apart.onOther += place;
  return apart;
}

Result<Done> checkedHull(const std::vector<Vector3d>& hull, const Lss& shape) {
  if (hull.empty()) return Done{};
  if (hull.size() > kMostCorners) {
    return Error::in("hull", ErrorCode::LimitExceeded,
                     "expected at most " + std::to_string(kMostCorners) + " corners, found " +
                         std::to_string(hull.size()));
  }
  if (shape.a != shape.b) {
    return Error::in(
        "shape", ErrorCode::Mismatch,
        "expected both ends alike beside a hull: the place from which its corners are");
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (!hull[i].allFinite()) {
      return cornerError(ErrorCode::NonFinite, i, "expected finite coordinates");
    }
    const double most =
        std::max(hull[i].cwiseAbs().maxCoeff(), (hull[i] + shape.a).cwiseAbs().maxCoeff());
    if (most > kMaxCoordinate) {
      return cornerError(ErrorCode::OutOfRange, i, "expected coordinates within 1e7 m");
    }
  }
  return Done{};
}

}  // namespace foretouch::internal
