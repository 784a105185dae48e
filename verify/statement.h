// verify/statement.h: what is to be proven: a scene, an avatar, and steps from one pose to another.
// Formats: docs/certificates.md. Metres; quaternions w, x, y, z.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace verify {

using Point = std::array<double, 3>;

struct Triangle {
  std::array<Point, 3> corners;
};

struct Capsule {  ///< A segment and a radius, in the frame of its link.
  Point a, b;
  double radius;
};

struct Link {
  std::string name;
  int parent = -1;  ///< Before it; -1: a root.
  std::vector<Capsule> capsules;
};

/// Of one joint, in its parent's frame.
struct JointPose {
  Point translation;
  std::array<double, 4> rotation;
};

struct Step {
  long long number = 0;
  std::vector<JointPose> from, to;
};

/// What is wrong with a text; `what` is empty where nothing is.
struct Fault {
  long long line = 0;
  std::string what;
};

/// An OBJ of triangles: lines v and f; f with three corners, each a vertex, slashes behind it
/// ignored. Lines that say nothing of the shape are skipped, all others are faults.
[[nodiscard]] Fault readScene(std::string_view text, std::vector<Triangle>& scene);
/// An avatar file (JSON): names, parents and LSS of its links; what else it says is skipped.
[[nodiscard]] Fault readAvatar(std::string_view text, std::vector<Link>& links);
/// "foretouch-steps 1": for each step its number, and for each joint both poses.
[[nodiscard]] Fault readSteps(std::string_view text, std::size_t joints, std::vector<Step>& steps);

}  // namespace verify
