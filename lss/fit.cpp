#include "lss/fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Rounds the radius up past the error of axisDistance(): fewer than sixteen roundings, each
/// relative to the lengths that it subtracts.
constexpr double kDistanceRounding = 16.0 * kUnitRoundoff;

/// Steps of the enclosing-circle iteration; its excess shrinks like 1/steps ([BadoiuClarkson03]).
constexpr int kCircleSteps = 64;
constexpr int kQuickCircleSteps = 8;

const Vector3d& farthestFrom(const Points& points, const Vector3d& from) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3d& p, const Vector3d& q) {
    return (p - from).squaredNorm() < (q - from).squaredNorm();
  });
}

/// A point of the line along `direction` around which all points lie in a near-minimal cylinder:
/// step towards the farthest point by 1/(i+1), [BadoiuClarkson03] for balls, here across the line.
Vector3d lineThrough(const Points& points, const Vector3d& direction, const Vector3d& start,
                     int steps) {
  const auto across = [&](const Vector3d& p) { return Vector3d(p - direction.dot(p) * direction); };
  Vector3d center = across(start);
  for (int i = 1; i <= steps; ++i) {
    const Vector3d* farthest = &points.front();
    double largest = -1.0;
    for (const Vector3d& p : points) {
      const double d2 = (across(p) - center).squaredNorm();
      if (d2 > largest) {
        largest = d2;
        farthest = &p;
      }
    }
    center += (across(*farthest) - center) / (i + 1.0);
  }
  return center;
}

/// The shortest axis on the line center + t*direction whose LSS of the line's radius holds all
/// points.
Lss alongLine(const Points& points, const Vector3d& direction, const Vector3d& center) {
  double radius2 = 0.0;
  for (const Vector3d& p : points) {
    const Vector3d w = p - center;
    radius2 = std::max(radius2, (w - direction.dot(w) * direction).squaredNorm());
  }
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Vector3d& p : points) {
    const Vector3d w = p - center;
    const double t = direction.dot(w);
    const double cap = std::sqrt(std::max(0.0, radius2 - (w - t * direction).squaredNorm()));
    begin = std::min(begin, t + cap);
    end = std::max(end, t - cap);
  }
  if (begin > end) begin = end = 0.5 * (begin + end);  // the caps alone reach: a sphere
  Lss lss{center + begin * direction, center + end * direction, 0.0};
  for (const Vector3d& p : points) growToContain(lss, p);
  return lss;
}

std::vector<Vector3d> principalAxes(const Points& points, const Vector3d& mean) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  std::vector<Vector3d> axes = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  if (solver.info() == Eigen::Success) {
    for (int i = 0; i < 3; ++i) axes[slotOf(i)] = solver.eigenvectors().col(i);
  }
  return axes;
}

std::vector<Vector3d> directionsToTry(const Points& points, const Vector3d& mean,
                                      FitEffort effort) {
  std::vector<Vector3d> directions = principalAxes(points, mean);
  if (effort == FitEffort::Quick) return directions;
  for (int i = 0; i < 3; ++i) directions.push_back(Vector3d::Unit(i));
  const Vector3d& one = farthestFrom(points, mean);
  const Vector3d span = farthestFrom(points, one) - one;
  if (span.norm() > 0.0) directions.push_back(span.normalized());
  return directions;
}

}  // namespace

double axisDistance(const Lss& lss, const Vector3d& point) {
  const Vector3d u = lss.b - lss.a, w = point - lss.a;
  const double uu = u.squaredNorm();
  const double s = uu > 0.0 ? std::min(1.0, std::max(0.0, w.dot(u) / uu)) : 0.0;
  return (w - s * u).norm();
}

double sticksOut(const Lss& lss, const Triangle& triangle) {
  double farthest = 0.0;  // both sets are convex: the corners decide
  for (const Vector3d& v : triangle.vertices) farthest = std::max(farthest, axisDistance(lss, v));
  return farthest - lss.radius;
}

void growToContain(Lss& lss, const Vector3d& point) {
  const double lost = kDistanceRounding * ((point - lss.a).norm() + (lss.b - lss.a).norm());
  lss.radius = std::max(lss.radius, axisDistance(lss, point) + lost);
}

Lss fitLss(const Points& points, FitEffort effort) {
  FORETOUCH_ASSERT(!points.empty());
  const int steps = effort == FitEffort::Quick ? kQuickCircleSteps : kCircleSteps;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Lss best;
  double bestVolume = std::numeric_limits<double>::infinity();
  for (const Vector3d& direction : directionsToTry(points, mean, effort)) {
    const Lss lss = alongLine(points, direction, lineThrough(points, direction, mean, steps));
    if (volume(lss) < bestVolume) {
      bestVolume = volume(lss);
      best = lss;
    }
  }
  FORETOUCH_ASSERT(isValid(best));
  return best;
}

}  // namespace foretouch
