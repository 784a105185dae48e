#include "tests/verify/certificate_trial.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "assets/avatar/avatar_file.h"
#include "assets/certificate/certificate_texts.h"
#include "assets/certificate/certificate_writer.h"
#include "middleware/query/query.h"
#include "tests/support/random_geometry.h"
#include "verify/certificate.h"
#include "verify/motion.h"
#include "verify/proof.h"
#include "verify/statement.h"

namespace foretouch::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kJoints = 7;
constexpr std::size_t kTriangles = 40;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Seven links one after the other, each with an LSS to the next, and one more beside it.
Avatar armOf(Random& random) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int j = 0; j < kJoints; ++j) {
    const Eigen::Vector3d arm = random.uniform(0.08, 0.3) * random.direction();
    raw.joints.push_back({"joint" + std::to_string(j), j == 0 ? kNoParent : j - 1,
                          j == 0 ? Eigen::Vector3d(random.inBox(0.2)) : arm,
                          Quaternion::Identity()});
    lss.push_back({{Eigen::Vector3d::Zero(), arm, random.uniform(0.02, 0.05)}});
    if (random.chance(0.3)) lss.back().push_back({arm, arm, random.uniform(0.03, 0.06)});
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

Scene cellOf(Random& random) {
  std::vector<Triangle> triangles(kTriangles);
  for (Triangle& t : triangles) {
    t.vertices[0] = 1.5 * random.direction() * random.uniform(0.2, 1.0);
    const double size = random.magnitude(0.02, 0.5);
    t.vertices[1] = t.vertices[0] + random.inBox(size);
    t.vertices[2] = t.vertices[0] + random.inBox(size);
  }
  return Scene::build({triangles, std::vector<ObjectId>(kTriangles, 0), {"cell"}}).value();
}

/// All that the verifier reads, read.
struct Statement {
  std::vector<verify::Triangle> triangles;
  std::vector<verify::Link> links;
  std::vector<verify::Step> steps;
  std::vector<verify::StepClaim> claims;

  /// Empty where it is proven.
  [[nodiscard]] std::string whyNot(verify::Tally& tally) const {
    const verify::SceneProof scene(triangles);
    verify::Motion motion(links, steps.front());
    return scene.prove(links, claims.front(), motion, tally).what;
  }
};

struct Edge {
  Avatar avatar;
  Scene scene;
  ChainMotion motion;
};

/// A point of the axis of one of the link's LSS, where it is at t.
Eigen::Vector3d axisPoint(const Edge& edge, LinkId link, double t, Random& random,
                          std::size_t& lss) {
  const auto& all = edge.avatar.lss(link);
  lss = static_cast<std::size_t>(random.below(static_cast<int>(all.size())));
  const double s = random.uniform(0.0, 1.0);
  return edge.motion.stateAt(link, t).pointAt(all[lss].a + s * (all[lss].b - all[lss].a));
}

verify::Vector pointOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// A span with planes, and which LSS of which link it is of.
struct FoundSpan {
  verify::Span* span = nullptr;
  std::size_t link = 0, capsule = 0;
};

FoundSpan spanWithPlanes(Statement& statement, Random& random) {
  std::vector<FoundSpan> all;
  for (auto& link : statement.claims.front().links) {
    for (auto& capsule : link.capsules) {
      for (auto& span : capsule.spans) {
        if (!span.planes.empty()) all.push_back({&span, link.link, capsule.capsule});
      }
    }
  }
  if (all.empty()) return {};
  return all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))];
}

verify::CapsuleClaim& someCapsule(Statement& statement, Random& random) {
  auto& links = statement.claims.front().links;
  auto& link = links[static_cast<std::size_t>(random.below(static_cast<int>(links.size())))];
  return link
      .capsules[static_cast<std::size_t>(random.below(static_cast<int>(link.capsules.size())))];
}

/// A plane into the LSS, or the wrong way round. False: there is none.
bool tellOfAPlane(const Edge& edge, Statement& statement, Random& random, bool isFlipped) {
  const FoundSpan found = spanWithPlanes(statement, random);
  if (found.span == nullptr) return false;
  auto& planes = found.span->planes;
  verify::Plane& plane =
      planes[static_cast<std::size_t>(random.below(static_cast<int>(planes.size())))];
  if (isFlipped) {
    for (double& part : plane.normal) part = -part;
    plane.offset = -plane.offset;
    return true;
  }
  const Lss& lss = edge.avatar.lss(static_cast<LinkId>(found.link))[found.capsule];
  const double t = (static_cast<double>(found.span->index) + random.uniform(0.0, 1.0)) /
                   static_cast<double>(std::int64_t{1} << found.span->level);
  const Eigen::Vector3d normal(plane.normal[0], plane.normal[1], plane.normal[2]);
  const Eigen::Vector3d at = edge.motion.stateAt(static_cast<LinkId>(found.link), t).pointAt(lss.a);
  // As little as a millionth into it, or as much as all of its radius.
  const double deep = lss.radius * random.magnitude(1e-6, 1.0);
  plane.offset = normal.dot(at) - normal.norm() * (lss.radius - deep);
  return true;
}

bool tellOfASpan(Statement& statement, Random& random, bool isDropped) {
  verify::CapsuleClaim& claim = someCapsule(statement, random);
  const auto at = static_cast<std::ptrdiff_t>(random.below(static_cast<int>(claim.spans.size())));
  if (isDropped) {
    claim.spans.erase(claim.spans.begin() + at);
  } else {
    ++claim.spans[static_cast<std::size_t>(at)].level;  // half of it only
    claim.spans[static_cast<std::size_t>(at)].index *= 2;
  }
  return true;
}

/// A triangle that the LSS does meet: a new one, or one that was elsewhere.
bool tellOfATriangle(const Edge& edge, Statement& statement, Random& random, bool isNew) {
  const LinkId link = random.below(kJoints);
  std::size_t lss = 0;
  const Eigen::Vector3d centre = axisPoint(edge, link, random.uniform(0.0, 1.0), random, lss);
  // Within the radius of the axis, by at least a thousandth of it.
  const double far = edge.avatar.lss(link)[lss].radius * random.uniform(0.0, 0.999);
  const Eigen::Vector3d corner = centre + far * random.direction();
  verify::Triangle triangle;
  triangle.corners = {pointOf(corner), pointOf(corner + random.inBox(0.01)),
                      pointOf(corner + random.inBox(0.01))};
  auto& all = statement.triangles;
  if (isNew) {
    all.insert(all.begin() + random.below(static_cast<int>(all.size()) + 1), triangle);
  } else {
    all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))] = triangle;
  }
  return true;
}

/// The whole arm drifts until a corner of the scene is inside one of its LSS.
bool tellOfAPose(const Edge& edge, Statement& statement, Random& random) {
  const LinkId link = random.below(kJoints);
  std::size_t lss = 0;
  const Eigen::Vector3d at = axisPoint(edge, link, 1.0, random, lss);
  const auto& triangle = statement.triangles[static_cast<std::size_t>(
      random.below(static_cast<int>(statement.triangles.size())))];
  const verify::Vector& corner = triangle.corners[static_cast<std::size_t>(random.below(3))];
  verify::Point& root = statement.steps.front().to.front().translation;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    root[axis] += corner[axis].lo - at[static_cast<Eigen::Index>(axis)];
  }
  return true;
}

/// An LSS so thick that it reaches a corner of the scene.
bool tellOfARadius(const Edge& edge, Statement& statement, Random& random) {
  const LinkId link = random.below(kJoints);
  std::size_t lss = 0;
  const Eigen::Vector3d at = axisPoint(edge, link, random.uniform(0.0, 1.0), random, lss);
  const auto& corner = statement.triangles.front().corners[0];
  const double far = (at - Eigen::Vector3d(corner[0].lo, corner[1].lo, corner[2].lo)).norm();
  statement.links[static_cast<std::size_t>(link)].capsules[lss].radius = far * (1.0 + 1e-6);
  return true;
}

bool tell(int kind, const Edge& edge, Statement& statement, Random& random) {
  switch (kind) {
    case 0: return tellOfAPlane(edge, statement, random, false);
    case 1: return tellOfAPlane(edge, statement, random, true);
    case 2: return tellOfASpan(statement, random, true);
    case 3: return tellOfASpan(statement, random, false);
    case 4: return tellOfATriangle(edge, statement, random, true);
    case 5: return tellOfATriangle(edge, statement, random, false);
    case 6: return tellOfAPose(edge, statement, random);
    default: return tellOfARadius(edge, statement, random);
  }
}

/// The texts of the edge, read by the verifier's own readers. Empty, or what they say.
std::string readStatement(const Edge& edge, const std::string& steps, const std::string& proof,
                          Statement& statement) {
  std::string what = verify::readScene(sceneAsObj(edge.scene), statement.triangles).what;
  what += verify::readAvatar(formatAvatar(edge.avatar), statement.links).what;
  what += verify::readSteps("foretouch-steps 1\n" + steps, statement.links.size(), statement.steps)
              .what;
  what +=
      verify::readCertificate("foretouch-certificate 1\n" + proof + "end\n", statement.claims).what;
  return what;
}

std::string tellLies(std::uint64_t seed, int lies, const Edge& edge, const Statement& statement,
                     CertificateTally& tally) {
  for (int i = 0; i < lies; ++i) {
    Random random(seed * 977 + static_cast<std::uint64_t>(i));
    const int kind = static_cast<int>((seed + static_cast<std::uint64_t>(i)) % 8);
    Statement lie = statement;
    if (!tell(kind, edge, lie, random)) continue;
    ++tally.lies;
    ++tally.ofKind[kind];
    verify::Tally unused;
    if (!lie.whyNot(unused).empty()) continue;
    ++tally.believed;
    return std::string("a lie was believed: ") + kindOfLie(kind);
  }
  return "";
}

}  // namespace

const char* kindOfLie(int kind) {
  constexpr const char* kKinds[] = {"a plane moved",  "a plane turned round", "a span dropped",
                                    "a span cut",     "a triangle added",     "a triangle moved",
                                    "a pose changed", "a radius changed"};
  return kKinds[kind];
}

std::string runCertificateTrial(std::uint64_t seed, int lies, CertificateTally& tally) {
  Random random(seed);
  Edge edge{armOf(random), cellOf(random), {}};
  Pose from = restPose(edge.avatar.skeleton()), to = from;
  const double most = random.magnitude(0.01, 1.5);
  for (std::size_t j = 0; j < from.rotations.size(); ++j) {
    from.rotations[j] = random.rotation();
    to.rotations[j] = from.rotations[j] * random.turn(random.uniform(0.0, most));
    if (random.chance(0.2)) to.translations[j] += random.inBox(0.05);
  }
  from = validatedPose(edge.avatar.skeleton(), from).value();
  to = validatedPose(edge.avatar.skeleton(), to).value();
  edge.motion.assign(edge.avatar.skeleton(), from, to);
  const Query query = Query::build(edge.avatar, edge.scene).value();
  Scratch scratch;
  Clock::time_point start = Clock::now();
  const StepContacts answer = query.answer(edge.motion, scratch);
  tally.answerS += secondsSince(start);
  ++tally.edges;
  std::vector<LinkId> links;
  for (LinkId link = 0; link < kJoints; ++link) {
    if (answer.links[slotOf(link)].verdict == Verdict::Clear) links.push_back(link);
  }
  if (links.size() != static_cast<std::size_t>(kJoints)) return "";
  ++tally.clear;

  start = Clock::now();
  CertificateWriter writer(edge.avatar, edge.scene);
  const std::string proof = writer.step(7, edge.motion, links);
  tally.writeS += secondsSince(start);
  tally.bytes += static_cast<std::int64_t>(proof.size());
  tally.unproven += writer.counts().unproven > 0 ? 1 : 0;
  if (writer.counts().unproven > 0) return "no proof was found";
  Statement statement;
  std::string what = readStatement(edge, stepText(7, from, to), proof, statement);
  if (!what.empty()) return "the verifier cannot read it: " + what;
  verify::Tally found;
  start = Clock::now();
  what = statement.whyNot(found);
  tally.verifyS += secondsSince(start);
  if (!what.empty()) return "a proof is refused: " + what;
  tally.spans += found.spans;
  tally.planes += found.planes;
  ++tally.verified;
  return tellLies(seed, lies, edge, statement, tally);
}

}  // namespace foretouch::test
