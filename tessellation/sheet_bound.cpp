#include "tessellation/sheet_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/rounding.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Number of tried shares p : s of the two ends' displacements.
constexpr int kShares = 16;

struct Sheet {
  Vector3d pathA, pathB, axisBegin, axisEnd;
};

/// The bound for one pair of weights p, s >= 0 that are not both 0.
double boundFor(const Sheet& sheet, double p, double s, double shortestAxis) {
  const double roots = std::sqrt(p) + std::sqrt(s);
  const Vector3d rest = p * sheet.pathB - s * sheet.pathA;
  const double plain = rest.norm();
  if (!(shortestAxis > 0.0)) return plain / (roots * roots);
  const double across =
      std::max(rest.cross(sheet.axisBegin).norm(), rest.cross(sheet.axisEnd).norm()) / shortestAxis;
  const double along =
      std::max(std::abs(rest.dot(sheet.axisBegin)), std::abs(rest.dot(sheet.axisEnd))) /
      shortestAxis;
  const double shift = along / shortestAxis;
  const double room = std::min(p, s);
  const double taken = shift > room ? room / shift : 1.0;
  const double left = (1.0 - taken) * std::min(along, plain);
  return std::min(plain, std::hypot(across, left)) / (roots * roots);
}

}  // namespace

double hullLeavesSheetBy(const AxisEnds& begin, const AxisEnds& end) {
  const Sheet sheet{end.a - begin.a, end.b - begin.b, begin.b - begin.a, end.b - end.a};
  const double turned = (sheet.axisEnd - sheet.axisBegin).norm();
  const double length = std::min(sheet.axisBegin.norm(), sheet.axisEnd.norm());
  // At least half the axis remains: a shorter rest would magnify rounding.
  const double shortestAxis = turned < length ? length - 0.5 * turned : 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kShares; ++i) {
    const double p = static_cast<double>(i) / kShares;
    least = std::min(least, boundFor(sheet, p, 1.0 - p, shortestAxis));
  }
  // The displacements' shares normal to the axis: exact if the sheet is flat.
  const Vector3d axis = sheet.axisBegin + sheet.axisEnd;
  const double square = axis.squaredNorm();
  const Vector3d sum = sheet.pathA + sheet.pathB;
  const Vector3d across = square > 0.0 ? Vector3d(sum - axis * (axis.dot(sum) / square)) : sum;
  const double p = across.dot(sheet.pathA), s = across.dot(sheet.pathB);
  const double larger = std::max(p, s);
  if (p >= 0.0 && s >= 0.0 && larger > 0.0) {
    least = std::min(least, boundFor(sheet, p / larger, s / larger, shortestAxis));
  }
  // Differences and products of the displacements: a few units of roundoff of their lengths.
  constexpr double kRounding = 64.0 * kUnitRoundoff;
  return least * (1.0 + 1e-12) + kRounding * (sheet.pathA.norm() + sheet.pathB.norm() + turned);
}

}  // namespace foretouch
