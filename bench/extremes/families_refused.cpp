// Illegal input: NaN, infinities, numbers beyond the limits, each in every possible place. The
// product must refuse all, naming the place; but a scene drops triangles that are not finite.
#include <cmath>
#include <limits>

#include "bench/extremes/families.h"
#include "middleware/query/query.h"

namespace foretouch::tools::extremes {
namespace {

using Eigen::Vector3d;
using Sizes = ExtremeSizes;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ExtremeCase legal(Draw& draw) {
  RigShape shape;
  shape.joints = 1 + static_cast<int>(draw.below(3));
  ExtremeCase extreme = rigged(draw, shape);
  aim(draw, extreme, {});
  cover(draw, extreme, false);
  return extreme;
}

/// A number that is not a coordinate.
double noCoordinate(Draw& draw) {
  return draw.pick({kNan, kInfinity, -kInfinity, std::nextafter(kMaxCoordinate, kInfinity), -1.1e7,
                    1e300, -std::numeric_limits<double>::max()});
}
double& someOf(Draw& draw, Vector3d& v) {
  return v[static_cast<Eigen::Index>(draw.below(3))];
}
Pose& somePose(Draw& draw, ExtremeCase& extreme) {
  return draw.chance(0.5) ? extreme.from : extreme.to;
}

using Spoil = void (*)(Draw&, ExtremeCase&);

void spoilTranslation(Draw& draw, ExtremeCase& extreme) {
  auto& translations = somePose(draw, extreme).translations;
  someOf(draw, translations[draw.below(translations.size())]) = noCoordinate(draw);
}
void spoilRotation(Draw& draw, ExtremeCase& extreme) {
  auto& rotations = somePose(draw, extreme).rotations;
  auto& coefficients = rotations[draw.below(rotations.size())].coeffs();
  coefficients[static_cast<Eigen::Index>(draw.below(4))] = draw.pick({kNan, kInfinity, -kInfinity});
}
void spoilNorm(Draw& draw, ExtremeCase& extreme) {
  auto& rotations = somePose(draw, extreme).rotations;
  rotations[draw.below(rotations.size())].coeffs() *=
      draw.pick({0.0, 1.0011, 0.9989, 1e-170, 1e-320, 1e160, 1e308, 2.0});
}
void spoilRadius(Draw& draw, ExtremeCase& extreme) {
  extreme.lss[draw.below(extreme.lss.size())][0].radius =
      draw.pick({kNan, kInfinity, -1.0, -5e-324, 1.1e7, 1e300});
}
void spoilAxis(Draw& draw, ExtremeCase& extreme) {
  Lss& lss = extreme.lss[draw.below(extreme.lss.size())][0];
  someOf(draw, draw.chance(0.5) ? lss.a : lss.b) = noCoordinate(draw);
}
void spoilOffset(Draw& draw, ExtremeCase& extreme) {
  auto& joints = extreme.skeleton.joints;
  someOf(draw, joints[draw.below(joints.size())].offset) = noCoordinate(draw);
}
void spoilRest(Draw& draw, ExtremeCase& extreme) {
  auto& joints = extreme.skeleton.joints;
  joints[draw.below(joints.size())].rotation.w() = draw.pick({kNan, kInfinity, 0.0, 1.01, 1e300});
}
void spoilScene(Draw& draw, ExtremeCase& extreme) {
  auto& triangles = extreme.scene.triangles;
  Vector3d& v = triangles[draw.below(triangles.size())].vertices[draw.below(3)];
  someOf(draw, v) = draw.pick({std::nextafter(kMaxCoordinate, kInfinity), -1.1e7, 1e300});
}
void spoilWholeScene(Draw& draw, ExtremeCase& extreme) {
  for (Triangle& t : extreme.scene.triangles) {
    someOf(draw, t.vertices[draw.below(3)]) = draw.pick({kNan, kInfinity, -kInfinity});
  }
}
void spoilSurface(Draw& draw, ExtremeCase& extreme) {
  auto& triangles = extreme.surface[draw.below(extreme.surface.size())];
  someOf(draw, triangles[draw.below(triangles.size())].vertices[draw.below(3)]) =
      draw.pick({kNan, kInfinity, -kInfinity, 1e3, 1e8, 1e300});
}
void spoilTolerance(Draw& draw, ExtremeCase& extreme) {
  extreme.tolerance = draw.pick(
      {kNan, kInfinity, -kInfinity, 0.0, -1e-3, 5e-324, std::nextafter(kMinTolerance, 0.0)});
}
void spoilCounts(Draw& draw, ExtremeCase& extreme) {
  switch (draw.below(5)) {
    case 0: extreme.from.rotations.pop_back(); break;
    case 1: extreme.to.translations.emplace_back(Vector3d::Zero()); break;
    case 2: extreme.lss.pop_back(); break;
    case 3: extreme.surface.emplace_back(); break;
    default: extreme.scene.objectOf.front() = 7; break;
  }
}

Family refusals() {
  Family family{"refused", "NaN, infinities and numbers beyond the limits, in every place", {}};
  const std::pair<const char*, Spoil> places[] = {{"translation", spoilTranslation},
                                                  {"rotation", spoilRotation},
                                                  {"norm", spoilNorm},
                                                  {"radius", spoilRadius},
                                                  {"axis", spoilAxis},
                                                  {"offset", spoilOffset},
                                                  {"rest rotation", spoilRest},
                                                  {"scene", spoilScene},
                                                  {"whole scene", spoilWholeScene},
                                                  {"surface", spoilSurface},
                                                  {"tolerance", spoilTolerance},
                                                  {"counts", spoilCounts}};
  for (const auto& [name, spoil] : places) {
    family.members.push_back({name, [spoil = spoil](Draw& draw, const Sizes&) {
                                ExtremeCase extreme = legal(draw);
                                spoil(draw, extreme);
                                extreme.isLegal = false;
                                return extreme;
                              }});
  }
  family.members.push_back(
      {"some triangles, which are dropped", [](Draw& draw, const Sizes&) {
         ExtremeCase extreme = legal(draw);
         for (int i = 0; i < 3; ++i) {
           Triangle t = extreme.scene.triangles[0];
           someOf(draw, t.vertices[draw.below(3)]) = draw.pick({kNan, kInfinity, -kInfinity});
           extreme.add(t);
         }
         return extreme;
       }});
  return family;
}

}  // namespace

void internal::addRefusals(std::vector<Family>& families) {
  families.push_back(refusals());
}

}  // namespace foretouch::tools::extremes
