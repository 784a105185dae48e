#include "tools/setup/body_offer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "articulated/motion.h"
#include "assets/bvh/bvh_reader.h"
#include "tools/inputs/first_pose.h"
#include "tools/settings/plain_figures.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

struct Unit {
  double metres;
  const char* name;
};
/// What exporters use, the commonest first. CMU's: inches over 0.45, as its own skeletons say.
/// Neighbours differ by 1.7 at least, so that only one of them makes an adult of a skeleton.
constexpr std::array<Unit, 7> kUnits = {{{1.0, "metres"},
                                         {0.01, "centimetres"},
                                         {0.0564, "CMU's unit, 1/0.45 inch"},
                                         {0.0254, "inches"},
                                         {0.1, "decimetres, as MakeHuman's"},
                                         {0.001, "millimetres"},
                                         {0.3048, "feet"}}};

/// Adults, with room for short and long legs.
constexpr double kShortestAdult = 1.3, kTallestAdult = 2.2;
constexpr double kUsualAdult = 1.7;
/// Without legs: a hand, an animal, a robot.
constexpr double kSmallestBody = 0.15, kLargestBody = 10.0;

/// The size of the box around all joints at rest, against the height by the legs: arms, wings,
/// tails and what hands hold stay below.
constexpr double kWidestReach = 2.5;

/// The number of frames of a clip among which to look.
constexpr std::size_t kFramesLookedAt = 32;

const Unit& nearestUnit(double size, double wanted) {
  return *std::min_element(kUnits.begin(), kUnits.end(), [&](const Unit& a, const Unit& b) {
    return std::abs(std::log(size * a.metres / wanted)) <
           std::abs(std::log(size * b.metres / wanted));
  });
}

/// The size of the box around all joints.
Vector3d sizeOf(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  Eigen::AlignedBox3d box;
  for (const LinkState& state : states) box.extend(state.p_WL);
  return box.sizes();
}

/// No known unit: the one of the usual adult, to two digits.
double guessedUnit(double size) {
  const double unit = kUsualAdult / size;
  const double digits = std::pow(10.0, 1.0 - std::floor(std::log10(unit)));
  return std::round(unit * digits) / digits;
}

/// The unit of a file whose format says metres, and whose body is far from a person's or an
/// animal's size: exporters forget to convert centimetres and millimetres.
double forgottenUnit(double size) {
  return size > kLargestBody ? (size > 100.0 * kLargestBody ? 0.001 : 0.01) : 1.0;
}

Offer<double> byStature(double stature, bool isInMetres, double readAs) {
  const auto isAdult = [](double tall) { return tall >= kShortestAdult && tall <= kTallestAdult; };
  if (isInMetres) {
    const double unit = forgottenUnit(stature);
    return {unit, isAdult(stature),
            "as the file says, by its legs the body is " + plainFigures(stature) + " m tall"};
  }
  const Unit& unit = nearestUnit(stature, kUsualAdult);
  if (isAdult(stature * unit.metres)) {
    return {unit.metres, true,
            fmt::format("{} make it {} m tall, by the length of its legs",
                        unitInWords(readAs * unit.metres), plainFigures(stature * unit.metres))};
  }
  return {
      guessedUnit(stature), false,
      fmt::format("its legs make it {} m tall, and no unit that is known makes that an adult: {} "
                  "to {} m per unit do",
                  plainFigures(stature), plainFigures(readAs * kShortestAdult / stature),
                  plainFigures(readAs * kTallestAdult / stature))};
}

Offer<double> bySize(double size, bool isInMetres) {
  if (!(size > 0.0)) return {1.0, false, "its skeleton has no size"};
  if (isInMetres) {
    const double unit = forgottenUnit(size);
    return {unit, unit == 1.0 && size >= kSmallestBody,
            "as the file says, it is " + plainFigures(size) + " m long"};
  }
  const double unit = size <= kLargestBody ? 1.0 : guessedUnit(size);
  return {unit, false,
          "its joints' names show no legs; this makes it " + plainFigures(size * unit) + " m long"};
}

/// Legs of a plausible length beside joints far off: two bodies, or something that is not a body.
void doubtReach(const Clip& clip, double stature, Offer<double>& offer) {
  const double reach = reachOf(clip);
  if (!(reach > kWidestReach * stature)) return;
  offer.isSure = false;
  offer.reason += ", but its joints lie " + plainFigures(reach * offer.value) +
                  " m apart: are all of them of one body?";
}

/// Feet to head, summed over the clip's frames, each as a direction.
Vector3d meanUpright(const Clip& clip, std::size_t& found) {
  Vector3d sum = Vector3d::Zero();
  const std::size_t stride = std::max<std::size_t>(1, clip.frames.size() / kFramesLookedAt);
  for (std::size_t frame = 0; frame < clip.frames.size(); frame += stride) {
    const auto stance = stanceOf(clip.skeleton, clip.frames[frame]);
    if (!stance || !(stance->headFromFeet.norm() > 0.0)) continue;
    sum += stance->headFromFeet.normalized();
    ++found;
  }
  return found == 0 ? sum : Vector3d(sum / static_cast<double>(found));
}

Offer<UpAxis> byShape(const Clip& clip) {
  const Vector3d size = sizeOf(clip.skeleton, clip.frames.front());
  const bool isZ = size.z() > 1.5 * size.y();
  return {isZ ? UpAxis::Z : UpAxis::Y, false,
          fmt::format("its joints' names show no feet and head; it is {:.3g} x {:.3g} x {:.3g} of "
                      "its units",
                      size.x(), size.y(), size.z())};
}

}  // namespace

double reachOf(const Clip& clip) {
  return sizeOf(clip.skeleton, restPose(clip.skeleton)).maxCoeff();
}

std::string unitInWords(double metres) {
  for (const Unit& unit : kUnits) {
    if (unit.metres == metres) return unit.name;
  }
  return fmt::format("{:g} m per unit", metres);
}

Offer<double> unitOf(const Clip& clip, bool isInMetres, double readAs) {
  const auto stature = statureOf(clip.skeleton);
  if (stature) {
    Offer<double> offer = byStature(*stature, isInMetres, readAs);
    doubtReach(clip, *stature, offer);
    return offer;
  }
  return bySize(reachOf(clip), isInMetres);
}

Offer<UpAxis> upAxisOf(const Clip& clip, bool isUpright) {
  std::size_t found = 0;
  const Vector3d up = meanUpright(clip, found);
  if (found == 0) {
    if (isUpright) return {UpAxis::Y, true, "its reader turns it by what the file's format says"};
    return byShape(clip);
  }
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  constexpr double kClearly = 0.7;  // within 45 degrees, on the average
  const bool isClear = up[axis] >= kClearly && axis != 0;
  const char* const name = axis == 0 ? "x" : axis == 1 ? "y" : "z";
  const std::string reason =
      fmt::format("its feet and head lie along {}{}", name, up[axis] < 0.0 ? ", head down" : "");
  const UpAxis value = axis == 2 && !isUpright ? UpAxis::Z : UpAxis::Y;
  return {value, isClear && (!isUpright || axis == 1), reason};
}

}  // namespace foretouch::tools
