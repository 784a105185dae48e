// Extreme places and sizes: far from the origin, scaled, at tolerances of every size.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/extremes/families.h"
#include "middleware/query/query.h"

namespace foretouch::tools::extremes {
namespace {

using Eigen::Vector3d;
using Sizes = ExtremeSizes;

/// Leaves room for a body and its surroundings within the largest coordinate.
constexpr double kFarthest = kMaxCoordinate - 4.0;

ExtremeCase at(Draw& draw, const Vector3d& origin, double tolerance) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  shape.origin = origin;
  ExtremeCase extreme = rigged(draw, shape);
  extreme.tolerance = tolerance;
  AimShape around;
  around.gapLow = std::max(1e-9, 0.1 * tolerance);
  aim(draw, extreme, around);
  return extreme;
}

Family far() {
  Family family{
      "far", "scene and avatar up to 1e6 m, and to the largest coordinate, off origin", {}};
  family.members = {
      {"any distance",
       [](Draw& draw, const Sizes&) {
         return at(draw, draw.magnitude(1.0, 1e6) * draw.direction(), draw.magnitude(1e-7, 1e-2));
       }},
      {"1e6 m",
       [](Draw& draw, const Sizes&) {
         return at(draw, 1e6 * draw.direction(), draw.magnitude(1e-8, 1e-3));
       }},
      {"along one axis",
       [](Draw& draw, const Sizes&) {
         Vector3d origin = Vector3d::Zero();
         origin[static_cast<Eigen::Index>(draw.below(3))] = draw.sign() * draw.magnitude(1e3, 1e6);
         return at(draw, origin, draw.magnitude(1e-8, 1e-3));
       }},
      {"the largest coordinate",
       [](Draw& draw, const Sizes&) {
         const Vector3d corner(draw.sign(), draw.sign(), draw.sign());
         return at(draw, kFarthest * corner, draw.magnitude(1e-6, 1e-2));
       }},
      {"below resolution",
       [](Draw& draw, const Sizes&) {
         return at(draw, draw.magnitude(1e5, 5e6) * draw.direction(),
                   draw.magnitude(kMinTolerance, 1e-8));
       }},
      {"covered", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme =
             at(draw, draw.magnitude(1e3, 1e6) * draw.direction(), draw.magnitude(1e-6, 1e-3));
         cover(draw, extreme, false);
         return extreme;
       }}};
  return family;
}

ExtremeCase scaled(Draw& draw, double avatar, double scene, double tolerance) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  shape.reach *= avatar;
  shape.radius *= avatar;
  shape.travel = 0.5 * std::max(avatar, std::min(scene, 10.0 * avatar));
  ExtremeCase extreme = rigged(draw, shape);
  extreme.tolerance = std::max(kMinTolerance, tolerance);
  AimShape around;
  around.size *= scene;
  around.gapLow *= avatar;
  around.gapHigh *= avatar;
  aim(draw, extreme, around);
  return extreme;
}

Family scale() {
  Family family{"scale", "scene, avatar and tolerance scaled by 1e-6 to 1e6, alike and not", {}};
  family.members = {
      {"alike",
       [](Draw& draw, const Sizes&) {
         const double s = draw.magnitude(1e-6, 1e6);
         return scaled(draw, s, s, 1e-3 * s);
       }},
      {"tolerance apart",
       [](Draw& draw, const Sizes&) {
         const double s = draw.magnitude(1e-6, 1e6);
         return scaled(draw, s, s, s * draw.magnitude(1e-9, 1.0));
       }},
      {"scene apart",
       [](Draw& draw, const Sizes&) {
         const double s = draw.magnitude(1e-3, 1e3), other = draw.magnitude(1e-6, 1e6);
         return scaled(draw, s, other, draw.magnitude(1e-5, 1e-2) * s);
       }},
      {"micrometres",
       [](Draw& draw, const Sizes&) { return scaled(draw, 1e-6, 1e-6, kMinTolerance); }},
      {"megametres",
       [](Draw& draw, const Sizes&) { return scaled(draw, 1e6, 1e6, draw.magnitude(1e-5, 1e3)); }},
      {"dust and continents", [](Draw& draw, const Sizes&) {
         return draw.chance(0.5) ? scaled(draw, 1e-6, 1e6, kMinTolerance)
                                 : scaled(draw, 1e5, 1e-6, draw.magnitude(1e-4, 1.0));
       }}};
  return family;
}

Family tolerance() {
  Family family{"tolerance", "tolerances from the least to the largest, and beyond", {}};
  const auto with = [](Draw& draw, double tolerance) {
    ExtremeCase extreme = at(draw, Vector3d::Zero(), 1e-3);
    if (draw.chance(0.5)) cover(draw, extreme, false);
    extreme.tolerance = tolerance;
    return extreme;
  };
  family.members = {
      {"the least", [with](Draw& draw, const Sizes&) { return with(draw, kMinTolerance); }},
      {"small",
       [with](Draw& draw, const Sizes&) { return with(draw, draw.magnitude(1e-9, 1e-6)); }},
      {"a room's",
       [with](Draw& draw, const Sizes&) { return with(draw, draw.magnitude(0.1, 1e3)); }},
      {"a planet's",
       [with](Draw& draw, const Sizes&) {
         return with(draw, draw.chance(0.5) ? kMaxTolerance : draw.magnitude(1e4, 9e6));
       }},
      {"beyond the limit", [with](Draw& draw, const Sizes&) {
         ExtremeCase extreme =
             with(draw, draw.pick({std::nextafter(kMaxTolerance, 1e8), draw.magnitude(2e7, 1e300),
                                   std::numeric_limits<double>::max()}));
         extreme.isLegal = false;
         return extreme;
       }}};
  return family;
}

}  // namespace

void internal::addPlaces(std::vector<Family>& families) {
  for (Family& family : std::vector<Family>{far(), scale(), tolerance()}) {
    families.push_back(std::move(family));
  }
}

}  // namespace foretouch::tools::extremes
