// verify/statement.h: what is to be proven: a scene, an avatar, and steps from one pose to another.
// Formats: docs/certificates.md. Metres; quaternions w, x, y, z.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "verify/fault.h"
#include "verify/interval.h"

namespace verify {

using Point = std::array<double, 3>;

inline Vector exactly(const Point& p) {
  return {Interval(p[0]), Interval(p[1]), Interval(p[2])};
}

/// Wherever readers of single and of double precision see it.
struct Triangle {
  std::array<Vector, 3> corners;
};

/// At most as many as the product takes.
inline constexpr std::size_t kMostLinks = 4096;

struct Capsule {  ///< A segment and a radius, in the frame of its link.
  Point a, b;
  double radius;
};

struct Link {
  std::string name;
  int parent = -1;  ///< Before it; -1: a root.
  std::vector<Capsule> capsules;
  /// At rest, in its parent's frame: only for edges. Without: the file does not say it.
  bool hasRest = false;
  Point offset{};
  std::array<double, 4> rotation{1.0, 0.0, 0.0, 0.0};
};

/// The pose of one joint, in its parent's frame.
struct JointPose {
  Point translation;
  std::array<double, 4> rotation;
};

struct Step {
  long long number = 0;
  std::vector<JointPose> from, to;
};

/// An OBJ of triangles: lines v and f; f with three corners, each a vertex above. Lines that say
/// nothing of the shape are skipped. All others are faults, and so is what readers read in two
/// ways: a fourth coordinate, something behind a line, lines that begin with blanks, coordinates
/// above it that are not there, bytes that are not printable ASCII.
[[nodiscard]] Fault readScene(std::string_view text, std::vector<Triangle>& scene);
/// An avatar file (JSON): names, parents, LSS and rest frames of its links; the rest is skipped.
/// Names are without
/// escapes, each once, at most kMostLinks.
[[nodiscard]] Fault readAvatar(std::string_view text, std::vector<Link>& links);
/// "foretouch-steps 1": for each step its number, and for each joint both poses.
[[nodiscard]] Fault readSteps(std::string_view text, std::size_t joints, std::vector<Step>& steps);

}  // namespace verify
