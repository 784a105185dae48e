#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/certificate/certificate_texts.h"
#include "assets/certificate/certificate_writer.h"
#include "assets/json_writer.h"
#include "lss/index.h"

namespace foretouch {
namespace {

/// What moves one joint: a line of the edges' text.
std::string driveLine(const char* kind, std::size_t joint, const Eigen::Vector3d& axis,
                      std::size_t coordinate, double factor = 1.0, double offset = 0.0) {
  return fmt::format("{} {} {} {} {} {} {} {}\n", kind, joint, numberText(axis.x()),
                     numberText(axis.y()), numberText(axis.z()), coordinate, numberText(factor),
                     numberText(offset));
}

std::string drivesOf(const Robot& robot) {
  const auto& joints = robot.joints();
  std::vector<std::size_t> first(joints.size());
  for (std::size_t i = robot.numCoordinates(); i-- > 0;) {
    first[slotOf(robot.coordinates()[i].joint)] = i;
  }
  std::string text;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const RobotJoint& joint = joints[i];
    const bool follows = joint.mimicOf != kNoParent;
    const std::size_t own = first[follows ? slotOf(joint.mimicOf) : i];
    const double factor = follows ? joint.mimicFactor : 1.0;
    const double offset = follows ? joint.mimicOffset : 0.0;
    switch (joint.kind) {
      case RobotJointKind::Fixed: continue;
      case RobotJointKind::Prismatic:
        text += driveLine("shift", i, joint.axis, own, factor, offset);
        continue;
      case RobotJointKind::Revolute:
      case RobotJointKind::Continuous:
        text += driveLine("turn", i, joint.axis, own, factor, offset);
        continue;
      case RobotJointKind::Planar: {
        const auto [x, y] = planeAcross(joint.axis);
        text += driveLine("shift", i, x, own) + driveLine("shift", i, y, own + 1) +
                driveLine("turn", i, joint.axis, own + 2);
        continue;
      }
    }
  }
  return text;
}

/// A pair of a link and an object as runs of triangles of the scene's text.
std::string ignoredLines(const Scene& scene, const IgnoredPair& pair) {
  if (pair.object == IgnoredPair::kEveryObject) return fmt::format("ignore {}\n", pair.link);
  std::string text;
  std::int64_t at = 0, begin = -1;
  const auto endRun = [&] {
    if (begin >= 0) text += fmt::format("ignore {} {} {}\n", pair.link, begin, at - begin);
    begin = -1;
  };
  for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
    if (!isFinite(scene.triangle(id))) continue;  // as sceneAsObj() does
    if (scene.object(id) != pair.object) {
      endRun();
    } else if (begin < 0) {
      begin = at;
    }
    ++at;
  }
  endRun();
  return text;
}

std::string configurationLine(const double* q, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + numberText(q[i]);
  return text + "\n";
}

/// What each edge is asked.
Result<CertificateAsked> askedOf(const EdgeQuery& edges) {
  const EdgeOptions& options = edges.options();
  if (edges.numProps() > 0) {
    return Error::in("props", ErrorCode::Mismatch,
                     "a certificate is of a robot and one scene: expected no props");
  }
  CertificateAsked asked{options.clearance, options.ignored, {}};
  if (!options.self) return asked;
  if (!options.self->radii().empty()) {
    return Error::in("self", ErrorCode::Mismatch,
                     "expected pair rules without radii of their own: a certificate has the LSS");
  }
  const Avatar& avatar = edges.robot().avatar();
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      const bool haveLss = !avatar.lss(a).empty() && !avatar.lss(b).empty();
      if (haveLss && options.self->reasonOf(a, b) == PairReason::Asked)
        asked.pairs.push_back({a, b});
    }
  }
  return asked;
}

/// The statement, without its edges.
std::string headOf(const EdgeQuery& edges, const CertificateAsked& asked) {
  std::string text = fmt::format("foretouch-edges 1\nclearance {}\ncoordinates {}\n",
                                 numberText(asked.clearance), edges.robot().numCoordinates());
  text += drivesOf(edges.robot());
  for (const IgnoredPair& pair : asked.ignored) text += ignoredLines(edges.scene(), pair);
  for (const LinkPair& pair : asked.pairs) text += fmt::format("pair {} {}\n", pair.a, pair.b);
  return text;
}

/// The motions that an edge is cut into, as EdgeQuery::answer() cuts it.
void partsOf(const Robot& robot, const double* q0, const double* q1,
             std::vector<ChainMotion>& parts) {
  const int count = robot.partsBetween(q0, q1, EdgeQuery::kMostParts);
  std::vector<double> q(robot.numCoordinates());
  Pose from, to;
  robot.poseAt(q0, to);
  parts.resize(slotOf(count));
  for (int part = 0; part < count; ++part) {
    std::swap(from, to);
    robot.between(q0, q1, static_cast<double>(part + 1) / count, q.data());
    robot.poseAt(q.data(), to);
    parts[slotOf(part)].assign(robot.avatar().skeleton(), from, to);
  }
}

}  // namespace

Result<EdgeCertificate> certifyEdges(const EdgeQuery& edges, const double* q0, const double* q1,
                                     std::size_t count) {
  if (count == 0) return Error::in("edges", ErrorCode::Empty, "expected at least one edge");
  FORETOUCH_TRY(const CertificateAsked asked, askedOf(edges));
  const Robot& robot = edges.robot();
  const std::size_t n = robot.numCoordinates();
  EdgeCertificate made;
  made.scene = sceneAsObj(edges.scene());
  made.avatar = formatAvatar(robot.avatar());
  made.edges = headOf(edges, asked);
  made.proof = "foretouch-certificate 2\n";
  CertificateWriter writer(robot.avatar(), edges.scene(), asked);
  Scratch scratch;
  std::vector<ChainMotion> parts;
  for (std::size_t i = 0; i < count; ++i) {
    const double *const from = q0 + i * n, *const to = q1 + i * n;
    const auto ofEdge = [i](Error error) {
      error.index = static_cast<std::int64_t>(i);
      return error;
    };
    FORETOUCH_TRY_OR(ofEdge, auto answer, edges.answer(from, to, n, scratch));
    made.edges +=
        fmt::format("edge {}\n{}{}", i, configurationLine(from, n), configurationLine(to, n));
    std::optional<std::string> proof;
    if (answer.verdict == Verdict::Clear) {
      partsOf(robot, from, to, parts);
      proof = writer.edge(static_cast<std::int64_t>(i), parts);
      made.proof += proof ? *proof : fmt::format("edge {} unproven\n", i);
    } else {
      made.proof += fmt::format("edge {} {}\n", i, toString(answer.verdict));
    }
    made.isProven.push_back(proof.has_value());
    made.answers.push_back(std::move(answer));
  }
  made.edges += "end\n";
  made.proof += "end\n";
  made.counts = writer.counts();
  return made;
}

Result<Done> writeEdgeCertificate(const EdgeCertificate& certificate, const std::string& folder) {
  return writeTexts(folder, {{"scene.obj", certificate.scene},
                             {"avatar.json", certificate.avatar},
                             {"edges.txt", certificate.edges},
                             {"certificate.txt", certificate.proof}});
}

}  // namespace foretouch
