// Extreme shapes: slivers, no area, zero radii and segments, denormals, many triangles in one
// place.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/extremes/families.h"

namespace foretouch::tools::extremes {
namespace {

using Eigen::Vector3d;
using Sizes = ExtremeSizes;

ExtremeCase usual(Draw& draw) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  ExtremeCase extreme = rigged(draw, shape);
  extreme.tolerance = draw.magnitude(1e-8, 1e-3);
  return extreme;
}

Vector3d acrossOf(const Vector3d& d) {
  return d.cross(std::abs(d.x()) < 0.5 ? Vector3d::UnitX() : Vector3d::UnitY()).normalized();
}

ExtremeCase withSlivers(Draw& draw, double length, double aspect) {
  ExtremeCase extreme = usual(draw);
  for (int i = 0; i < 6; ++i) {
    const Vector3d p = aimed(draw, extreme, {}), d = draw.direction();
    const Vector3d begin = p - draw.uniform(0.0, 1.0) * length * d, end = begin + length * d;
    const double along = draw.pick({0.0, 0.5, 1.0, draw.uniform(0.0, 1.0)});
    extreme.add({{begin, end, begin + along * length * d + length / aspect * acrossOf(d)}});
  }
  return extreme;
}

Family slivers() {
  Family family{"slivers", "triangles of aspect up to 1e12, on the avatar too", {}};
  family.members = {
      {"any aspect",
       [](Draw& draw, const Sizes&) {
         return withSlivers(draw, draw.magnitude(0.1, 10.0), draw.magnitude(1e3, 1e12));
       }},
      {"1e12",
       [](Draw& draw, const Sizes&) { return withSlivers(draw, draw.magnitude(0.1, 1e3), 1e12); }},
      {"beyond doubles",
       [](Draw& draw, const Sizes&) { return withSlivers(draw, 1.0, draw.magnitude(1e14, 1e18)); }},
      {"on both", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = withSlivers(draw, draw.magnitude(0.1, 10.0), 1e12);
         cover(draw, extreme, true);
         return extreme;
       }}};
  return family;
}

Family zeroArea() {
  Family family{"zero-area", "triangles that are segments or points", {}};
  family.members = {
      {"points",
       [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = usual(draw);
         for (int i = 0; i < 8; ++i) {
           const Vector3d p = aimed(draw, extreme, {});
           extreme.add({{p, p, p}});
         }
         return extreme;
       }},
      {"segments",
       [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = usual(draw);
         for (int i = 0; i < 8; ++i) {
           const Vector3d p = aimed(draw, extreme, {}), q = p + draw.inBox(1.0);
           extreme.add(draw.chance(0.5) ? Triangle{{p, q, q}} : Triangle{{p, q, p}});
         }
         return extreme;
       }},
      {"three on a line",
       [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = usual(draw);
         for (int i = 0; i < 8; ++i) {
           const Vector3d p = aimed(draw, extreme, {}), d = draw.inBox(1.0);
           extreme.add({{p, p + d, p + draw.uniform(-1.0, 2.0) * d}});
         }
         return extreme;
       }},
      {"on the avatar too", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = usual(draw);
         cover(draw, extreme, false);
         for (std::vector<Triangle>& triangles : extreme.surface) {
           for (Triangle& t : triangles) {
             t.vertices[2] = t.vertices[1];
             if (draw.chance(0.5)) t.vertices[1] = t.vertices[2] = t.vertices[0];
           }
         }
         for (int i = 0; i < 6; ++i) {
           const Vector3d p = aimed(draw, extreme, {});
           extreme.add({{p, p, draw.chance(0.5) ? p : Vector3d(p + draw.inBox(1.0))}});
         }
         return extreme;
       }}};
  return family;
}

ExtremeCase withRadius(Draw& draw, double radius) {
  ExtremeCase extreme = usual(draw);
  for (std::vector<Lss>& lss : extreme.lss) lss.front().radius = radius;
  extreme.tolerance = std::max(extreme.tolerance, 1e-11 * radius);
  AimShape around;
  around.size = std::max(0.3, 0.3 * radius);
  around.inside = 0.1;
  aim(draw, extreme, around);
  return extreme;
}

Family radius() {
  Family family{"radius", "LSS of radius 0, 1e-9 m, 1e3 m and the largest", {}};
  for (const double value : {0.0, 1e-9, 1e3, 1e-300, 1e6}) {
    family.members.push_back({fmt::format("radius {:g}", value), [value](Draw& draw, const Sizes&) {
                                return withRadius(draw, value);
                              }});
  }
  return family;
}

Family shortSegments() {
  Family family{"short-segment", "LSS of length 0, and of lengths that hardly are", {}};
  for (const double value : {0.0, 1e-12, 1e-160, 1e-300, 5e-324}) {
    family.members.push_back({fmt::format("length {:g}", value), [value](Draw& draw, const Sizes&) {
                                ExtremeCase extreme = usual(draw);
                                for (std::vector<Lss>& lss : extreme.lss) {
                                  lss.front().a = draw.chance(0.5) ? Vector3d(Vector3d::Zero())
                                                                   : draw.inBox(0.2);
                                  lss.front().b = lss.front().a + Vector3d(value, 0.0, 0.0);
                                  if (draw.chance(0.2)) lss.front().radius = 0.0;
                                }
                                aim(draw, extreme, {});
                                return extreme;
                              }});
  }
  return family;
}

/// Half of all numbers of zero become denormals or other tiny numbers.
void speckle(Draw& draw, double& number) {
  constexpr double kLeastNormal = std::numeric_limits<double>::min();
  if (number == 0.0 && draw.chance(0.5)) {
    number = draw.sign() * draw.pick({5e-324, 1e-320, 1e-310, kLeastNormal, 1e-300, 1e-160, 1e-42});
  }
}

ExtremeCase speckled(Draw& draw) {
  const double radius = draw.pick({0.0, 5e-324, 1e-310, 1e-155, 0.05});
  ExtremeCase extreme =
      sliding({Vector3d::Zero(), Vector3d(draw.pick({0.0, 0.3, 1e-310}), 0, 0), radius},
              Vector3d(0, draw.uniform(0.1, 0.5), 0), Vector3d(0, -draw.uniform(0.0, 0.5), 0));
  if (draw.chance(0.5)) extreme.to.rotations[0] = aboutAxis(Vector3d::UnitY(), 0.7);
  extreme.add({{Vector3d(-1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}});
  extreme.add({{Vector3d::Zero(), Vector3d(0, -1, 0), Vector3d(0, -1, 1)}});
  for (Triangle& triangle : extreme.scene.triangles) {
    for (Vector3d& v : triangle.vertices) {
      for (int k = 0; k < 3; ++k) speckle(draw, v[k]);
    }
  }
  for (Pose* pose : {&extreme.from, &extreme.to}) {
    for (int k = 0; k < 3; ++k) speckle(draw, pose->translations[0][k]);
    for (int k = 0; k < 4; ++k) speckle(draw, pose->rotations[0].coeffs()[k]);
  }
  for (int k = 0; k < 3; ++k) {
    speckle(draw, extreme.lss[0][0].a[k]);
    speckle(draw, extreme.lss[0][0].b[k]);
  }
  extreme.tolerance = draw.magnitude(1e-9, 1e-3);
  return extreme;
}

/// A half turn whose arc a dot product next to zero decides.
ExtremeCase tinyDotProduct(Draw& draw) {
  ExtremeCase extreme = sliding({Vector3d::Zero(), Vector3d(0.5, 0, 0), 0.02}, Vector3d::Zero(),
                                Vector3d(0, draw.uniform(-0.01, 0.01), 0));
  const double w = draw.sign() * draw.pick({5e-324, 1e-310, 1e-300, 1e-200, 1e-170});
  extreme.to.rotations[0] = Quaternion(w, 0.0, draw.sign(), 0.0);
  aim(draw, extreme, {});
  extreme.tolerance = draw.magnitude(1e-8, 1e-3);
  return extreme;
}

/// A whole scene and motion of denormals, around the origin.
ExtremeCase nothingButDenormals(Draw& draw) {
  const double s = draw.pick({1e-310, 5e-324, 1e-300, 1e-200, 1e-100, 1e-40});
  ExtremeCase extreme =
      sliding({Vector3d::Zero(), s * draw.direction(), draw.chance(0.5) ? s : 0.0},
              s * draw.inBox(10.0), s * draw.inBox(10.0));
  extreme.to.rotations[0] = draw.rotation(draw.uniform(0.0, 2.0));
  for (int i = 0; i < 4; ++i) {
    extreme.add({{s * draw.inBox(5.0), s * draw.inBox(5.0), s * draw.inBox(5.0)}});
  }
  extreme.tolerance = 1e-9;
  return extreme;
}

Family denormals() {
  Family family{
      "denormals", "coordinates, radii, rotations and poses below the least normal double", {}};
  family.members = {
      {"speckled", [](Draw& draw, const Sizes&) { return speckled(draw); }},
      {"speckled and covered",
       [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = speckled(draw);
         extreme.lss[0][0].radius = 0.05;
         cover(draw, extreme, draw.chance(0.5));
         return extreme;
       }},
      {"a dot product next to zero", [](Draw& draw, const Sizes&) { return tinyDotProduct(draw); }},
      {"nothing else", [](Draw& draw, const Sizes&) { return nothingButDenormals(draw); }}};
  return family;
}

ExtremeCase coincident(Draw& draw, std::size_t count, std::size_t places, bool isCovered) {
  ExtremeCase extreme = usual(draw);
  extreme.tolerance = draw.magnitude(1e-6, 1e-3);
  if (isCovered) cover(draw, extreme, false);
  AimShape around;
  around.count = static_cast<int>(places);
  around.inside = 0.05;
  aim(draw, extreme, around);
  const std::vector<Triangle> originals = extreme.scene.triangles;
  while (extreme.scene.triangles.size() < count) {
    Triangle copy = originals[draw.below(places)];
    std::swap(copy.vertices[0], copy.vertices[draw.below(3)]);
    extreme.add(copy);
  }
  return extreme;
}

Family coincidence() {
  Family family{"coincident", "1e5 triangles in one place, or in few", {}, 50};
  family.members = {
      {"one place",
       [](Draw& draw, const Sizes& sizes) { return coincident(draw, sizes.coincident, 1, false); }},
      {"three places",
       [](Draw& draw, const Sizes& sizes) { return coincident(draw, sizes.coincident, 3, false); }},
      {"covered",
       [](Draw& draw, const Sizes& sizes) { return coincident(draw, sizes.coincident, 2, true); }}};
  return family;
}

}  // namespace

void internal::addShapes(std::vector<Family>& families) {
  for (Family& family : std::vector<Family>{slivers(), zeroArea(), radius(), shortSegments(),
                                            denormals(), coincidence()}) {
    families.push_back(std::move(family));
  }
}

}  // namespace foretouch::tools::extremes
