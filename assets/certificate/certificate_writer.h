// assets/certificate/certificate_writer.h: planes and spans that show that a link touches nothing
// (docs/certificates.md), of steps and of edges of a robot. Slow, and apart from the kernel: it
// takes the kernel's answer and looks for a proof of it that foretouch-verify, which shares no code
// with either, can check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/edges/edge_query.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"

namespace foretouch {

struct CertificateCounts {
  std::int64_t links = 0, capsules = 0, spans = 0, planes = 0;
  std::int64_t unproven = 0;  ///< Links, or edges, for which no spans were found.
  std::int64_t pairs = 0;     ///< Pairs of own links.
};

/// What is to be shown beyond that each link touches nothing.
struct CertificateAsked {
  double clearance = 0.0;  ///< Metres: from the scene, and between own links.
  std::vector<IgnoredPair> ignored;
  std::vector<LinkPair> pairs;  ///< Own links.
};

/// Looks for spans and planes, LSS by LSS. For one thread.
class CertificateWriter {
 public:
  /// Both outlive it. O(triangles).
  CertificateWriter(const Avatar& avatar, const Scene& scene, CertificateAsked asked = {});

  /// The lines about these links on the motion, "step K" first; empty: about none of them. A link
  /// for which no proof is found is left out and counted.
  [[nodiscard]] std::string step(std::int64_t number, const ChainMotion& motion,
                                 const std::vector<LinkId>& links);

  /// The lines about an edge, "edge K" first, on which the avatar makes these motions one after the
  /// other, each as long: a power of two of them. They prove all that is asked, of all links.
  /// Nothing: no proof is found of some of it.
  [[nodiscard]] std::optional<std::string> edge(std::int64_t number,
                                                const std::vector<ChainMotion>& parts);

  [[nodiscard]] const CertificateCounts& counts() const { return counts_; }

 private:
  struct Bound;
  struct Hull;
  struct Plane;
  using Triangles = std::vector<TriangleId>;

  /// A link in the frame of one that carries it; kNoParent: the world.
  [[nodiscard]] Bound boundOf(LinkId carrier, LinkId link, const Lss& lss) const;
  [[nodiscard]] std::optional<std::string> link(LinkId link);
  bool spans(LinkId link, const Bound& bound, int level, std::int64_t index, const Triangles& near,
             std::string& text);
  [[nodiscard]] std::optional<std::string> pair(const LinkPair& pair);
  bool pairSpans(const LinkPair& pair, LinkId carrier, int level, std::int64_t index,
                 std::string& text);
  [[nodiscard]] std::vector<Hull> hullsOf(LinkId carrier, LinkId link, int level,
                                          std::int64_t index, double more);
  [[nodiscard]] Hull hullOf(LinkId carrier, LinkId link, const Bound& bound, int level,
                            std::int64_t index, double more);
  [[nodiscard]] Triangles nearOf(const Hull& hull, double more, const Triangles& among) const;
  [[nodiscard]] bool isHeld(const Plane& plane, TriangleId id) const;
  [[nodiscard]] bool planesFor(const Hull& hull, const Triangles& near,
                               std::vector<Plane>& planes) const;
  [[nodiscard]] static bool planesBetween(const std::vector<Hull>& ones,
                                          const std::vector<Hull>& others,
                                          std::vector<Plane>& planes);
  void addSpan(int level, std::int64_t index, const std::vector<Plane>& planes, std::string& text);
  [[nodiscard]] Triangles trianglesFor(LinkId link) const;
  void setParts(const ChainMotion* first, std::size_t count);

  const Avatar& avatar_;
  const Scene& scene_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // per triangle, around all that the verifier may read
  std::vector<double> blurs_;               // per triangle, how far that is from what is here
  Triangles all_;
  CertificateAsked asked_;
  std::vector<MotionEvaluator> parts_;  // of the step or the edge
  std::size_t numParts_ = 0, part_ = 0;
  std::vector<ChainMotion::JointBounds> joints_;  // the most of all parts
  CertificateCounts counts_;
};

/// What foretouch-verify reads, and what was found.
struct EdgeCertificate {
  std::string scene, avatar, edges, proof;  ///< Texts of its four files.
  std::vector<EdgeAnswer> answers;          ///< One per edge.
  std::vector<bool> isProven;  ///< One per edge. False also for a clear one that comes so near to
                               ///< something that no proof was found.
  CertificateCounts counts;    ///< `unproven` counts edges.
};

/// `count` edges: q0 and q1 each hold `count` configurations one after the other. The same texts on
/// every machine that answers alike. Errors: as EdgeQuery::answer() (Error::index is the edge); no
/// edge; props, which are not of the one scene that a certificate is about; pair rules with radii
/// of their own.
[[nodiscard]] Result<EdgeCertificate> certifyEdges(const EdgeQuery& edges, const double* q0,
                                                   const double* q1, std::size_t count);

/// Writes scene.obj, avatar.json, edges.txt and certificate.txt; makes the folder.
[[nodiscard]] Result<Done> writeEdgeCertificate(const EdgeCertificate& certificate,
                                                const std::string& folder);

}  // namespace foretouch
