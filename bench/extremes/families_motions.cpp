// Extreme motions: half turns, quaternions of any norm and sign, no motion and too much of it,
// grazing, touching exactly at the step's ends, parallel and coplanar motions, long chains.
#include <algorithm>
#include <cmath>

#include "bench/extremes/families.h"

namespace foretouch::tools::extremes {
namespace {

using Eigen::Vector3d;
using Sizes = ExtremeSizes;
constexpr double kPi = 3.14159265358979323846;

ExtremeCase turning(Draw& draw, double angle, bool isExact) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  ExtremeCase extreme = rigged(draw, shape);
  extreme.tolerance = draw.magnitude(1e-8, 1e-3);
  for (std::size_t j = 0; j < extreme.to.rotations.size(); ++j) {
    Quaternion& start = extreme.from.rotations[j];
    if (isExact) {
      // Half a turn to the bit: two of the four units.
      const Eigen::Index one = static_cast<Eigen::Index>(draw.below(4)),
                         other = (one + 1 + static_cast<Eigen::Index>(draw.below(3))) % 4;
      start.coeffs().setZero();
      start.coeffs()[one] = draw.sign();
      extreme.to.rotations[j].coeffs().setZero();
      extreme.to.rotations[j].coeffs()[other] = draw.sign();
    } else {
      extreme.to.rotations[j] = (start * draw.rotation(angle)).normalized();
    }
  }
  aim(draw, extreme, {});
  return extreme;
}

Family halfTurns() {
  Family family{
      "half-turn", "rotations of exactly and nearly 180 degrees, and of next to nothing", {}};
  family.members = {
      {"exactly", [](Draw& draw, const Sizes&) { return turning(draw, kPi, true); }},
      {"to rounding", [](Draw& draw, const Sizes&) { return turning(draw, kPi, false); }},
      {"nearly",
       [](Draw& draw, const Sizes&) {
         return turning(draw, kPi + draw.sign() * draw.magnitude(1e-15, 1e-2), false);
       }},
      {"1e-12 rad", [](Draw& draw, const Sizes&) { return turning(draw, 1e-12, false); }},
      {"next to nothing",
       [](Draw& draw, const Sizes&) { return turning(draw, draw.magnitude(1e-170, 1e-9), false); }},
      {"exactly, covered", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = turning(draw, kPi, true);
         cover(draw, extreme, false);
         return extreme;
       }}};
  return family;
}

ExtremeCase requaternioned(Draw& draw, double normError, bool isAntipodal, bool isStill) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  ExtremeCase extreme = rigged(draw, shape);
  extreme.tolerance = draw.magnitude(1e-8, 1e-3);
  if (isStill) extreme.to.rotations = extreme.from.rotations;
  aim(draw, extreme, {});
  for (Pose* pose : {&extreme.from, &extreme.to}) {
    for (Quaternion& q : pose->rotations) {
      q.coeffs() *= 1.0 + normError * draw.uniform(-1.0, 1.0);
      if (isAntipodal && draw.chance(0.5)) q.coeffs() *= -1.0;
    }
  }
  return extreme;
}

Family quaternions() {
  Family family{
      "quaternions", "quaternions off unit norm as far as is let in, and of either sign", {}};
  family.members = {
      {"off by 1e-3",
       [](Draw& d, const Sizes&) { return requaternioned(d, 9.9e-4, false, false); }},
      {"off by roundoffs",
       [](Draw& d, const Sizes&) { return requaternioned(d, 3e-15, false, false); }},
      {"antipodal", [](Draw& d, const Sizes&) { return requaternioned(d, 0.0, true, false); }},
      {"both", [](Draw& d, const Sizes&) { return requaternioned(d, 9e-4, true, false); }},
      {"antipodal and still",
       [](Draw& d, const Sizes&) { return requaternioned(d, 0.0, true, true); }}};
  return family;
}

Family travels() {
  Family family{"travel", "steps of no motion, of a scene's length and of kilometres", {}};
  const auto moved = [](Draw& draw, double travel, double turn) {
    RigShape shape;
    shape.joints = 1 + static_cast<int>(draw.below(3));
    shape.travel = travel;
    shape.turn = turn;
    ExtremeCase extreme = rigged(draw, shape);
    extreme.tolerance = draw.magnitude(1e-8, 1e-3);
    return extreme;
  };
  family.members = {{"none",
                     [moved](Draw& draw, const Sizes&) {
                       ExtremeCase extreme = moved(draw, 0.0, 0.0);
                       extreme.to = extreme.from;
                       AimShape around;
                       around.gapLow = 0.1 * extreme.tolerance;
                       around.inside = draw.chance(0.5) ? 0.0 : 0.2;
                       aim(draw, extreme, around);
                       return extreme;
                     }},
                    {"a scene's length",
                     [moved](Draw& draw, const Sizes&) {
                       ExtremeCase extreme = moved(draw, 50.0, 1.0);
                       AimShape around;
                       around.size = draw.pick({0.01, 1.0, 30.0});
                       around.count = 12;
                       aim(draw, extreme, around);
                       return extreme;
                     }},
                    {"kilometres past a mote",
                     [moved](Draw& draw, const Sizes&) {
                       ExtremeCase extreme = moved(draw, draw.magnitude(1e3, 1e5), 3.0);
                       extreme.tolerance = draw.magnitude(1e-6, 1e-3);
                       AimShape around;
                       around.size = draw.pick({1e-6, 1e-3, 0.1});
                       around.inside = 0.5;
                       aim(draw, extreme, around);
                       return extreme;
                     }},
                    {"the largest there is", [moved](Draw& draw, const Sizes&) {
                       ExtremeCase extreme = moved(draw, 0.0, 1.0);
                       extreme.from.translations[0] = Vector3d::Constant(-1e7);
                       extreme.to.translations[0] = Vector3d::Constant(1e7);
                       extreme.tolerance = draw.magnitude(1e-5, 1e-3);
                       AimShape around;
                       around.inside = 0.5;
                       aim(draw, extreme, around);
                       for (Triangle& t : extreme.scene.triangles) {
                         for (Vector3d& v : t.vertices) v = v.cwiseMax(-1e7).cwiseMin(1e7);
                       }
                       return extreme;
                     }}};
  return family;
}

/// The gap by which a graze misses or hits: at the surface or at the tolerance.
double grazingGap(Draw& draw, double tolerance) {
  const double off = draw.sign() * draw.pick({0.0, 1e-12, 1e-13, 1e-15, 1e-16, 1e-10});
  return off + draw.pick({0.0, 0.0, 1.0, 0.25}) * tolerance;
}

/// A ball flies past a point, an edge or over a face.
ExtremeCase flyingPast(Draw& draw) {
  const double tolerance = draw.magnitude(1e-9, 1e-3), r = draw.pick({0.0, 0.125, 0.1, 1e-3});
  const double height = r + grazingGap(draw, tolerance), span = draw.pick({2.0, 1.0, 37.0});
  ExtremeCase extreme = sliding({Vector3d::Zero(), Vector3d::Zero(), r}, Vector3d(-span, height, 0),
                                Vector3d(span, height, 0));
  const Vector3d down(0, -1, 0);
  switch (draw.below(4)) {
    case 0: extreme.add({{Vector3d::Zero(), down + Vector3d(0, 0, 0.3), down}}); break;
    case 1: extreme.add({{Vector3d(0, 0, -1), Vector3d(0, 0, 1), down}}); break;
    case 2: extreme.add({{Vector3d(-1, 0, 0), Vector3d(1, 0, 0), down}}); break;
    default: extreme.add(floorAt(0.0, 0.25)); break;
  }
  if (draw.chance(0.3)) extreme.to.rotations[0] = draw.rotation(draw.uniform(0.0, 2.0));
  extreme.tolerance = tolerance;
  return extreme;
}

/// A rod swings about its end; its tip is lowest half way, at the floor.
ExtremeCase swingingPast(Draw& draw) {
  const double tolerance = draw.magnitude(1e-8, 1e-3), length = draw.uniform(0.2, 2.0);
  const double r = draw.pick({0.0, 0.05}), angle = draw.uniform(0.1, 1.5);
  ExtremeCase extreme =
      sliding({Vector3d::Zero(), Vector3d(0, -length, 0), r},
              Vector3d(0, length + r + grazingGap(draw, tolerance), 0), Vector3d::Zero());
  extreme.to.translations = extreme.from.translations;
  extreme.from.rotations[0] = aboutAxis(Vector3d::UnitZ(), -angle);
  extreme.to.rotations[0] = aboutAxis(Vector3d::UnitZ(), angle);
  extreme.add(floorAt(0.0, draw.pick({0.01, 5.0})));
  extreme.tolerance = tolerance;
  return extreme;
}

Family grazing() {
  Family family{
      "grazing", "tangential passes within 1e-12 m of touching, and of the tolerance", {}};
  family.members = {{"a ball", [](Draw& draw, const Sizes&) { return flyingPast(draw); }},
                    {"a swinging rod", [](Draw& draw, const Sizes&) { return swingingPast(draw); }},
                    {"a covered rod", [](Draw& draw, const Sizes&) {
                       ExtremeCase extreme = swingingPast(draw);
                       const Vector3d tip = extreme.lss[0][0].b;
                       extreme.lss[0][0].radius = 0.01;
                       extreme.surface = {{{{tip, Vector3d(0.5 * tip),
                                             Vector3d(0.5 * tip + Vector3d(0.005, 0, 0))}}}};
                       return extreme;
                     }}};
  return family;
}

/// A ball or a level rod falls from `high` to `low` above the floor; the instant is known exactly.
ExtremeCase falling(Draw& draw, double radius, double high, double low) {
  const Vector3d b =
      draw.chance(0.5) ? Vector3d(Vector3d::Zero()) : Vector3d(draw.uniform(0.1, 1.0), 0, 0);
  ExtremeCase extreme = sliding({Vector3d::Zero(), b, radius}, Vector3d(0, high, 0),
                                Vector3d(draw.pick({0.0, 0.5}), low, draw.pick({0.0, -0.25})));
  extreme.add(floorAt(0.0));
  if (low <= radius) extreme.fall = Fall{high, low, radius};
  extreme.tolerance = draw.magnitude(1e-9, 1e-3);
  return extreme;
}

Family touching() {
  Family family{
      "touching", "contact exactly at t = 0 and t = 1, and at instants known as ratios", {}};
  family.members = {
      {"at t = 1 exactly",
       [](Draw& draw, const Sizes&) {
         const double r = draw.pick({0.0, 0.25, 0.1, 1e-9, 1e-300});
         return falling(draw, r, r + draw.magnitude(1e-6, 10.0), r);
       }},
      {"at t = 0 exactly",
       [](Draw& draw, const Sizes&) {
         const double r = draw.pick({0.0, 0.25, 0.1, 1e-9});
         return falling(draw, r, r, r + draw.pick({-1.0, 0.0, 1.0}) * draw.magnitude(1e-9, 1.0));
       }},
      {"between",
       [](Draw& draw, const Sizes&) {
         const double r = draw.magnitude(1e-6, 1.0);
         return falling(draw, r, r + draw.magnitude(1e-9, 10.0), r - draw.magnitude(1e-15, 10.0));
       }},
      {"a roundoff from the end",
       [](Draw& draw, const Sizes&) {
         const double r = draw.pick({0.25, 0.1, 1e-3});
         return falling(draw, r, r + 1.0,
                        draw.chance(0.5) ? std::nextafter(r, 0.0) : std::nextafter(r, 1.0));
       }},
      {"covered", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = falling(draw, 0.0, draw.pick({1.0, 0.3}), 0.0);
         extreme.lss[0] = {{Vector3d::Zero(), Vector3d(0.5, 0, 0), 0.5}};
         extreme.surface = {{{{Vector3d::Zero(), Vector3d(0.5, 0, 0), Vector3d(0.25, 0, 0.25)}},
                             {{Vector3d::Zero(), Vector3d(0.5, 0, 0), Vector3d(0.25, 0.25, 0)}}}};
         extreme.fall.reset();  // it is about the triangles, not the LSS
         return extreme;
       }}};
  return family;
}

/// A rod lies parallel to a triangle, in its plane or above it, and moves along it.
ExtremeCase alongside(Draw& draw, double height, double radius) {
  const Vector3d axis(draw.pick({1.0, 0.5, 0.0}), 0, draw.pick({1.0, 0.0, 0.25}));
  const double start = draw.pick({-3.0, -1.5, 0.0});
  ExtremeCase extreme =
      sliding({Vector3d::Zero(), axis, radius}, Vector3d(start, height, 0),
              Vector3d(start + draw.pick({3.0, 1.0, 0.5, 0.0}), height, draw.pick({0.0, 1.0})));
  extreme.add({{Vector3d::Zero(), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}});
  extreme.add({{Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(1, 0, 1)}});
  extreme.tolerance = draw.pick({1e-3, 1e-5, 1e-7});
  return extreme;
}

/// The same, spinning in its own plane: it hovers throughout, and no plane stays uncrossed long.
ExtremeCase spinning(Draw& draw) {
  const double tolerance = draw.pick({1e-3, 1e-5, 1e-8});
  const double height = tolerance * draw.pick({1.05, 2.0, 100.0, 0.5});
  ExtremeCase extreme = alongside(draw, height, draw.pick({0.0, 0.05}));
  extreme.lss[0][0].b = Vector3d(1, 0, 0);
  const double r = extreme.lss[0][0].radius;
  for (Pose* pose : {&extreme.from, &extreme.to}) pose->translations[0].y() += r;
  extreme.to.rotations[0] = aboutAxis(Vector3d::UnitY(), draw.pick({kPi, 1.0, 3.0}));
  extreme.tolerance = tolerance;
  return extreme;
}

Family parallels() {
  Family family{
      "parallel", "axes and triangles that are parallel or in one plane, and stay so", {}};
  family.members = {
      {"in the plane", [](Draw& draw, const Sizes&) { return alongside(draw, 0.0, 0.0); }},
      {"above it",
       [](Draw& draw, const Sizes&) {
         const double r = draw.pick({0.0, 0.125});
         return alongside(draw, r + draw.pick({1e-3, 2e-3, 1e-5, 1e-12, 0.0}), r);
       }},
      {"spinning above it", [](Draw& draw, const Sizes&) { return spinning(draw); }},
      {"covered",
       [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = alongside(draw, 0.0, 0.0);
         extreme.lss[0] = {{Vector3d::Zero(), Vector3d(1, 0, 0), 1.0}};
         extreme.surface = {
             {{{Vector3d::Zero(), Vector3d(1, 0, 0), Vector3d(0.5, 0, 0.5)}},
              {{Vector3d(0.25, 0, 0), Vector3d(0.75, 0, 0), Vector3d(0.5, 0, -0.5)}}}};
         return extreme;
       }},
      {"spinning, covered", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = spinning(draw);
         extreme.lss[0] = {{Vector3d::Zero(), Vector3d(1, 0, 0), 0.5}};
         extreme.surface = {{{{Vector3d::Zero(), Vector3d(1, 0, 0), Vector3d(0.5, 0, 0.5)}}}};
         return extreme;
       }}};
  return family;
}

/// Links in a row, stretched straight, each turning by `turn` about the same axis.
ExtremeCase stretched(Draw& draw, int links, double turn, const Vector3d& origin) {
  constexpr double kLink = 0.1;
  RigShape shape;
  shape.joints = links;
  shape.radius = 0.03;
  shape.origin = origin;
  ExtremeCase extreme = rigged(draw, shape);
  const Vector3d limb(kLink, 0, 0), axis = draw.direction();
  for (std::size_t j = 0; j < extreme.lss.size(); ++j) {
    extreme.lss[j][0].b = limb;
    extreme.from.rotations[j] = Quaternion::Identity();
    extreme.to.rotations[j] = aboutAxis(axis, turn * draw.uniform(0.5, 1.0));
    if (j > 0) extreme.from.translations[j] = extreme.to.translations[j] = limb;
  }
  extreme.tolerance = draw.magnitude(1e-6, 1e-3);
  AimShape around;
  around.count = 10;
  around.inside = 0.1;
  around.gapLow = 1e-2;
  aim(draw, extreme, around);
  return extreme;
}

Family chains() {
  Family family{"chain", "128 links in a row, stretched straight, whipping, far away", {}, 10};
  family.members = {
      {"still",
       [](Draw& draw, const Sizes& sizes) {
         return stretched(draw, sizes.chain, 0.0, Vector3d::Zero());
       }},
      {"bending",
       [](Draw& draw, const Sizes& sizes) {
         return stretched(draw, sizes.chain, draw.magnitude(1e-12, 0.01), Vector3d::Zero());
       }},
      {"whipping",
       [](Draw& draw, const Sizes& sizes) {
         return stretched(draw, sizes.chain, draw.uniform(0.02, 0.2), Vector3d::Zero());
       }},
      {"limbs of 10,000 km",
       [](Draw& draw, const Sizes& sizes) {
         ExtremeCase extreme =
             stretched(draw, sizes.chain, draw.pick({0.0, 1e-3, 0.01}), Vector3d::Zero());
         for (std::size_t j = 0; j < extreme.lss.size(); ++j) {
           extreme.lss[j][0] = {Vector3d::Zero(), Vector3d(kMaxCoordinate, 0, 0), 1e5};
           for (Pose* pose : {&extreme.from, &extreme.to}) {
             pose->translations[j] = Vector3d(kMaxCoordinate, 0, draw.sign() * kMaxCoordinate);
           }
         }
         extreme.tolerance = draw.magnitude(1e-3, 1e5);
         return extreme;
       }},
      {"whipping far away", [](Draw& draw, const Sizes& sizes) {
         return stretched(draw, sizes.chain, draw.uniform(0.01, 0.1),
                          draw.magnitude(1e3, 1e6) * draw.direction());
       }}};
  return family;
}

}  // namespace

void internal::addMotions(std::vector<Family>& families) {
  for (Family& family : std::vector<Family>{halfTurns(), quaternions(), travels(), grazing(),
                                            touching(), parallels(), chains()}) {
    families.push_back(std::move(family));
  }
}

}  // namespace foretouch::tools::extremes
