#include "middleware/near/near_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Bounds of the bins lie off the diagonals where things that people make have their normals, as
/// those of quarters do: rounding then does not move these from bin to bin.
const Eigen::Matrix3d kTilt = [] {
  const Vector3d axis = Vector3d(0.36, 0.48, 0.8);
  return Eigen::AngleAxisd(0.5, axis).toRotationMatrix();
}();

using RowMajorMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
/// The limit of a bin without a place.
constexpr double kNobody = std::numeric_limits<double>::infinity();
/// A squared distance beyond the square of another by this factor has a larger root in doubles,
/// too: the two squares and the root round by less.
constexpr double kBeyondEqual = 1.0 + 16.0 * kUnitRoundoff;

/// The cosine above which two normals count as one (10 degrees), and how far apart (m) on the LSS
/// such contacts are two. Doubled, a solver gets half as many rows, and a hand rocks on what is
/// left.
constexpr double kSameNormal = 0.985;
constexpr double kSamePlace = 0.02;
/// Halves of the axis are two places, however short it is: its ends.
constexpr double kSameHalf = 0.5;
/// What is in a plane (m): below what a hand feels, above what files in float lose.
constexpr double kInPlane = 1e-4;
/// A cosine: the planes of two faces within it are one plane, within a hand's length.
constexpr double kSamePlane = 1.0 - 1e-6;

bool isFace(const NearPlace& place) {
  return place.feature.feature == FeatureKind::Face;
}

}  // namespace

bool comesBefore(const Scene& scene, const NearPlace& x, const NearPlace& y) {
  if (x.distance != y.distance) return x.distance < y.distance;
  if (x.feature.triangle != y.feature.triangle) {
    const auto& v = scene.triangle(x.feature.triangle).vertices;
    const auto& w = scene.triangle(y.feature.triangle).vertices;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        if (v[i][k] != w[i][k]) return v[i][k] < w[i][k];
      }
    }
    return x.feature.triangle < y.feature.triangle;
  }
  if (x.feature.lss != y.feature.lss) return x.feature.lss < y.feature.lss;
  return x.part < y.part;
}

void NearReduction::begin(const Scene& scene, const StandingLss& lss, const Eigen::Matrix3d& R_WL) {
  scene_ = &scene;
  lss_ = &lss;
  Eigen::Map<RowMajorMatrix3d>(bins_.toBins[0]) = kTilt * R_WL.transpose();
  for (const std::size_t bin : heldBins_) {
    slots_[bin] = 0;
    bins_.limit[bin] = kNobody;
  }
  heldBins_.clear();
  places_.clear();
}

NearReduction::NearReduction() {
  std::fill(bins_.limit, bins_.limit + NearBins::kCount, kNobody);
}

/// The bin of faces; that of the rest is the next. The direction may have any length.
std::size_t NearReduction::binsOf(const Vector3d& direction_W, double along) const {
  // Operation for operation as near_bins.cpp.
  Vector3d n;
  for (int k = 0; k < 3; ++k) {
    const auto& row = bins_.toBins[k];
    n[k] = (row[0] * direction_W.x() + row[1] * direction_W.y()) + row[2] * direction_W.z();
  }
  int axis = 0;
  const double largest = n.cwiseAbs().maxCoeff(&axis);
  const auto thirdOf = [&](int other) -> std::size_t {
    const double tripled = 3.0 * n[other % 3];
    return tripled < -largest ? 0 : (tripled <= largest ? 1 : 2);
  };
  const std::size_t side = 2 * slotOf(axis) + (n[axis] < 0.0 ? 1 : 0);
  std::size_t quarter = 0;
  for (const double bound : NearBins::kQuarterBounds) quarter += along > bound ? 1 : 0;
  const std::size_t direction = (side * 3 + thirdOf(axis + 1)) * 3 + thirdOf(axis + 2);
  return (direction * NearBins::kQuarters + quarter) * NearBins::kKinds;
}

bool NearReduction::mayWin(const Vector3d& difference, double along, double distance) const {
  const std::size_t bin = binsOf(difference, along);
  for (std::size_t kind = 0; kind < NearBins::kKinds; ++kind) {
    const std::uint16_t slot = slots_[bin + kind];
    if (slot == 0 || !(places_[slot - 1U].distance < distance)) return true;
  }
  return false;
}

void NearReduction::offer(const NearPlace& place) {
  if (!place.stands) return;
  const std::size_t bin = binsOf(place.away, place.feature.along) + (isFace(place) ? 0 : 1);
  std::uint16_t& slot = slots_[bin];
  if (slot == 0) {
    places_.push_back(place);
    heldBins_.push_back(bin);
    slot = static_cast<std::uint16_t>(places_.size());
  } else if (comesBefore(*scene_, place, places_[slot - 1U])) {
    places_[slot - 1U] = place;
  } else {
    return;
  }
  bins_.limit[bin] = place.distance * place.distance * kBeyondEqual;
}

void NearReduction::finish(std::vector<NearPlace>& left) {
  order_.resize(places_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint16_t>(i);
  std::sort(order_.begin(), order_.end(), [this](std::uint16_t i, std::uint16_t j) {
    return comesBefore(*scene_, places_[i], places_[j]);
  });
  accepted_.clear();
  accept(true);
  accept(false);
  left.insert(left.end(), accepted_.begin(), accepted_.end());
}

/// Faces first: which of the others are needed depends on them.
void NearReduction::accept(bool faces) {
  for (const std::uint16_t i : order_) {
    const NearPlace& place = places_[i];
    if (isFace(place) != faces || isStoodFor(place)) continue;
    if (!faces && isKeptAbove(place)) continue;
    accepted_.push_back(place);
  }
}

/// Whether a nearer one holds the LSS along the same normal, at the same place.
bool NearReduction::isStoodFor(const NearPlace& place) const {
  const NearFeature& feature = place.feature;
  return std::any_of(accepted_.begin(), accepted_.end(), [&](const NearPlace& nearer) {
    const NearFeature& other = nearer.feature;
    return nearer.distance <= place.distance + kInPlane &&
           other.nhat_SL_W.dot(feature.nhat_SL_W) > kSameNormal &&
           std::abs(other.along - feature.along) <= kSameHalf &&
           (other.p_WLink - feature.p_WLink).squaredNorm() <= kSamePlace * kSamePlace;
  });
}

/// It lies in the plane of a face, and faces in that plane keep the axis above it there: its
/// height is linear along the axis, so the two ends keep all of it.
bool NearReduction::isKeptAbove(const NearPlace& place) const {
  const NearFeature& feature = place.feature;
  const Vector3d p_WAxis = feature.p_WLink + lss_->radius * feature.nhat_SL_W;
  return std::any_of(accepted_.begin(), accepted_.end(), [&](const NearPlace& face) {
    if (!isFace(face) || !face.isAtEnd()) return false;
    const Vector3d& n = face.feature.nhat_SL_W;
    if (std::abs(n.dot(feature.p_WScene - face.feature.p_WScene)) > kInPlane) return false;
    if (!(n.dot(p_WAxis - feature.p_WScene) > 0.0)) return false;
    return (feature.along == 1.0 || isKeptAbove(face, false)) &&
           (feature.along == 0.0 || isKeptAbove(face, true));
  });
}

/// The end is held by a face in the same plane, or cannot come near the plane.
bool NearReduction::isKeptAbove(const NearPlace& face, bool atB) const {
  const Vector3d& n = face.feature.nhat_SL_W;
  const Vector3d& p = face.feature.p_WScene;
  if (n.dot((atB ? lss_->b : lss_->a) - p) - lss_->radius > lss_->reach) return true;
  const double end = atB ? 1.0 : 0.0;
  return std::any_of(accepted_.begin(), accepted_.end(), [&](const NearPlace& other) {
    return isFace(other) && other.feature.along == end &&
           n.dot(other.feature.nhat_SL_W) >= kSamePlane &&
           std::abs(n.dot(other.feature.p_WScene - p)) <= kInPlane;
  });
}

}  // namespace foretouch::internal
