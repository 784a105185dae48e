// assets/certificate/certificate_writer.h: planes and spans that show that a link touches nothing
// (docs/certificates.md). Slow, and apart from the kernel: it takes the kernel's answer and looks
// for a proof of it that foretouch-verify, which shares no code with either, can check.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/pose.h"
#include "middleware/scene/scene.h"

namespace foretouch {

struct CertificateCounts {
  std::int64_t links = 0, capsules = 0, spans = 0, planes = 0;
  std::int64_t unproven = 0;  ///< Links for which no spans were found.
};

/// Looks for spans and planes, LSS by LSS. For one thread.
class CertificateWriter {
 public:
  /// Both outlive it. O(triangles).
  CertificateWriter(const Avatar& avatar, const Scene& scene);

  /// The lines about these links on the motion, "step K" first; empty: about none of them. A link
  /// for which no proof is found is left out and counted.
  [[nodiscard]] std::string step(std::int64_t number, const ChainMotion& motion,
                                 const std::vector<LinkId>& links);

  [[nodiscard]] const CertificateCounts& counts() const { return counts_; }

 private:
  struct Bound;
  struct Hull;
  struct Plane;
  using Triangles = std::vector<TriangleId>;

  [[nodiscard]] std::optional<std::string> link(LinkId link, const ChainMotion& motion);
  bool spans(LinkId link, const Bound& bound, int level, std::int64_t index, const Triangles& near,
             std::string& text);
  [[nodiscard]] Hull hullOf(LinkId link, const Bound& bound, int level, std::int64_t index) const;
  [[nodiscard]] Triangles nearOf(const Hull& hull, double more, const Triangles& among) const;
  [[nodiscard]] bool planesFor(const Hull& hull, const Triangles& near,
                               std::vector<Plane>& planes) const;

  const Avatar& avatar_;
  const Scene& scene_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  Triangles all_;
  MotionEvaluator evaluator_;
  CertificateCounts counts_;
};

/// The scene as an OBJ of triangles, with all digits.
[[nodiscard]] std::string sceneAsObj(const Scene& scene);
/// A step's two poses as foretouch-steps has them.
[[nodiscard]] std::string stepText(std::int64_t number, const Pose& from, const Pose& to);

}  // namespace foretouch
