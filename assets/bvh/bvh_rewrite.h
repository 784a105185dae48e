// assets/bvh/bvh_rewrite.h: a BVH file with another motion: the same text but for the numbers that
// the change of a pose asks for. Metres, radians; the file's angles are degrees.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch {

/// Three angles (degrees) about different axes, each in the frame that the ones before it turned,
/// that make `R`: nearest to the old ones, of the two ways that there are.
[[nodiscard]] std::array<double, 3> anglesAbout(const Eigen::Matrix3d& R,
                                                const std::array<int, 3>& axes,
                                                const std::array<double, 3>& old);

/// Digits after the point that a number is written with, at least six and at most twelve.
[[nodiscard]] int digitsBehindPoint(std::string_view number);

/// What a file's columns can say of a joint.
struct BvhJointChannels {
  std::vector<int> turns;        ///< Axes (0 to 2: x, y, z) in the file's order.
  std::array<bool, 3> shifts{};  ///< Per axis: there is a position channel.
  /// Three different axes: any rotation can be said.
  [[nodiscard]] bool saysAnyTurn() const {
    return turns.size() == 3 && turns[0] != turns[1] && turns[1] != turns[2] &&
           turns[0] != turns[2];
  }
};

/// Per joint of the clip that the text is read as. Errors: as parseBvh().
[[nodiscard]] Result<std::vector<BvhJointChannels>> bvhChannelsOf(std::string_view text,
                                                                  const std::string& name);

/// `text` with the frames `after` in place of `clip.frames`, which is what it was read as at
/// `scale`. A number stays, letter by letter, where its joint's part of the pose did not change,
/// and where the change is below what its digits, or six of them, can say. Angles are those nearest
/// to the old ones. Errors (Error::index is the joint): a change that a joint has no channels for;
/// texts that are not what the clip was read from. Precondition: as many frames.
[[nodiscard]] Result<std::string> rewriteBvh(std::string_view text, const std::string& name,
                                             double scale, const Clip& clip,
                                             const std::vector<Pose>& after);

}  // namespace foretouch
