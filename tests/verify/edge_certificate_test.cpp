// Certificates of a robot's edges: the verifier's kinematics against long double, random robots
// whose clear edges are proven, and lies about them.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/certificate/certificate_writer.h"
#include "lss/segment_triangle.h"
#include "tests/support/holds.h"
#include "tests/support/random_geometry.h"
#include "verify/edge_proof.h"

namespace foretouch::test {
namespace {

/// A chain, or two that share its first links, of joints of all kinds, some turning more than once.
Robot randomRobot(Random& random) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  std::vector<RobotJoint> joints;
  const int count = 4 + random.below(4);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d arm = random.uniform(0.1, 0.3) * random.direction();
    const int parent = i == 0 ? kNoParent : random.chance(0.2) ? random.below(i) : i - 1;
    raw.joints.push_back(
        {"j" + std::to_string(i), parent,
         i == 0 ? Eigen::Vector3d(random.inBox(0.2))
                : Eigen::Vector3d(lss[slotOf(parent)].front().b),
         random.chance(0.5) ? random.rotation() : Quaternion(Quaternion::Identity())});
    lss.push_back({{Eigen::Vector3d::Zero(), arm, random.uniform(0.01, 0.04)}});
    if (random.chance(0.3)) lss.back().push_back({arm, arm, random.uniform(0.02, 0.05)});
    RobotJoint joint;
    constexpr std::array kKinds = {RobotJointKind::Continuous, RobotJointKind::Revolute,
                                   RobotJointKind::Revolute, RobotJointKind::Prismatic,
                                   RobotJointKind::Fixed};
    joint.kind = i == 0 && random.chance(0.3)
                     ? RobotJointKind::Planar
                     : kKinds[static_cast<std::size_t>(random.below(i == 0 ? 4 : 5))];
    joint.axis = random.uniform(0.5, 2.0) * random.direction();
    const bool leads = i > 0 && joints[0].kind == RobotJointKind::Revolute;
    if (leads && joint.kind == RobotJointKind::Revolute && random.chance(0.4)) {
      joint.mimicOf = 0;
      joint.mimicFactor = random.uniform(-2.0, 2.0);
      joint.mimicOffset = random.uniform(-1.0, 1.0);
    }
    joints.push_back(joint);
  }
  return Robot::build(Avatar::build(Skeleton::build(raw).value(), lss).value(), joints).value();
}

Scene randomScene(Random& random) {
  RawScene raw;
  raw.objectNames = {"cell", "bench"};
  for (int i = 0; i < 16; ++i) {
    Triangle t;
    t.vertices[0] = random.uniform(0.4, 1.6) * random.direction();
    t.vertices[1] = t.vertices[0] + random.inBox(0.3);
    t.vertices[2] = t.vertices[0] + random.inBox(0.3);
    raw.triangles.push_back(t);
    raw.objectOf.push_back(random.below(2));
  }
  return Scene::build(raw).value();
}

/// One robot in one scene, its question, and a list of edges.
struct Case {
  Robot robot;
  Scene scene;
  EdgeOptions options;
  std::vector<double> q0, q1;
  std::size_t count = 6;

  static Case draw(std::uint64_t seed) {
    Random random(seed);
    Case made{randomRobot(random), randomScene(random), {}, {}, {}};
    const LinkId links = made.robot.avatar().numLinks();
    if (random.chance(0.7)) made.options.clearance = random.magnitude(1e-4, 0.05);
    made.options.ignored.push_back({0, 1});
    if (random.chance(0.2)) made.options.ignored.push_back({1});
    std::vector<LinkPair> pairs;
    for (LinkId a = 0; a < links; ++a) {
      for (LinkId b = a + 1; b < links; ++b) {
        const Skeleton& of = made.robot.avatar().skeleton();
        const bool meet = of.parent(b) == a || of.parent(b) == of.parent(a);
        if (!meet && random.chance(0.5)) pairs.push_back({a, b});
      }
    }
    if (!pairs.empty()) made.options.self = PairRules::asking(made.robot.avatar(), pairs).value();
    for (std::size_t i = 0; i < made.count; ++i) {
      const double most = random.magnitude(0.05, 7.0);
      for (const RobotCoordinate& coordinate : made.robot.coordinates()) {
        const double turn = coordinate.isAngle ? 3.0 : 0.2;
        made.q0.push_back(random.uniform(-turn, turn));
        made.q1.push_back(made.q0.back() + random.uniform(-most, most) * turn / 3.0);
      }
    }
    return made;
  }
  [[nodiscard]] EdgeCertificate certified() const {
    const auto edges = EdgeQuery::build(robot, scene, options).value();
    return certifyEdges(edges, q0.data(), q1.data(), count).value();
  }
};

/// Where a joint's frame is, by sines in long double.
struct TruePlace {
  Eigen::Matrix<long double, 3, 3> R;
  Eigen::Matrix<long double, 3, 1> p;
};

std::vector<TruePlace> placesAt(const Robot& robot, const double* q) {
  using Real = Eigen::Matrix<long double, 3, 1>;
  std::vector<TruePlace> places;
  std::size_t next = 0;
  std::vector<long double> own(robot.joints().size());
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const RobotJoint& joint = robot.joints()[i];
    const Skeleton& skeleton = robot.avatar().skeleton();
    const auto j = static_cast<JointId>(i);
    TruePlace place{skeleton.restRotation(j).cast<long double>().normalized().toRotationMatrix(),
                    skeleton.restOffset(j).cast<long double>()};
    const Real axis = joint.axis.cast<long double>().normalized();
    const bool follows = joint.mimicOf != kNoParent;
    if (joint.kind == RobotJointKind::Planar) {
      const auto [x, y] = planeAcross(joint.axis);
      place.p += place.R * (q[next] * x.cast<long double>() + q[next + 1] * y.cast<long double>());
      own[i] = q[next + 2];
      next += 3;
    } else if (follows) {
      own[i] = joint.mimicFactor * own[slotOf(joint.mimicOf)] + joint.mimicOffset;
    } else if (joint.kind != RobotJointKind::Fixed) {
      own[i] = q[next++];
    }
    if (joint.kind == RobotJointKind::Prismatic) {
      place.p += place.R * (own[i] * axis);
    } else if (joint.kind != RobotJointKind::Fixed) {
      place.R = place.R * Eigen::AngleAxis<long double>(own[i], axis).toRotationMatrix();
    }
    if (const JointId up = skeleton.parent(j); up != kNoParent) {
      const TruePlace& above = places[slotOf(up)];
      place = {above.R * place.R, above.p + above.R * place.p};
    }
    places.push_back(place);
  }
  return places;
}

std::vector<double> between(const Case& c, std::size_t edge, double t) {
  std::vector<double> q(c.robot.numCoordinates());
  const std::size_t n = q.size();
  c.robot.between(c.q0.data() + edge * n, c.q1.data() + edge * n, t, q.data());
  return q;
}

/// How near the robot comes to what it is asked about on an edge, by samples: never too near.
double gapOf(const Case& c, std::size_t edge) {
  double least = 10.0;
  const Avatar& avatar = c.robot.avatar();
  for (int k = 0; k <= 60; ++k) {
    const auto places = placesAt(c.robot, between(c, edge, k / 60.0).data());
    std::vector<std::vector<Lss>> at;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      at.push_back(avatar.lss(link));
      const TruePlace& place = places[slotOf(link)];
      for (Lss& lss : at.back()) {
        lss.a = (place.p + place.R * lss.a.cast<long double>()).cast<double>();
        lss.b = (place.p + place.R * lss.b.cast<long double>()).cast<double>();
      }
      for (TriangleId id = 0; id < static_cast<TriangleId>(c.scene.numTriangles()); ++id) {
        const auto& ignored = c.options.ignored;
        if (std::any_of(ignored.begin(), ignored.end(), [&](const IgnoredPair& pair) {
              return pair.link == link && (pair.object == IgnoredPair::kEveryObject ||
                                           pair.object == c.scene.object(id));
            })) {
          continue;
        }
        for (const Lss& lss : at.back()) {
          const double far = closestPoints(lss.a, lss.b, c.scene.triangle(id)).distance;
          least = std::min(least, far - lss.radius);
        }
      }
    }
    for (LinkId a = 0; c.options.self && a < avatar.numLinks(); ++a) {
      for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
        if (c.options.self->reasonOf(a, b) != PairReason::Asked) continue;
        for (const Lss& one : at[slotOf(a)]) {
          for (const Lss& other : at[slotOf(b)]) {
            const double far = closestPoints(one.a, one.b, {other.a, other.b, other.b}).distance;
            least = std::min(least, far - one.radius - other.radius);
          }
        }
      }
    }
  }
  return least;
}

/// All that the verifier reads, read.
struct Statement {
  std::vector<verify::Triangle> triangles;
  std::vector<verify::Link> links;
  verify::EdgeStatement edges;
  std::vector<verify::StepClaim> claims;

  static Statement of(const EdgeCertificate& made) {
    Statement read;
    EXPECT_EQ(verify::readScene(made.scene, read.triangles).what, "");
    EXPECT_EQ(verify::readAvatar(made.avatar, read.links).what, "");
    EXPECT_EQ(verify::readEdges(made.edges, read.links, read.triangles.size(), read.edges).what,
              "");
    EXPECT_EQ(verify::readCertificate(made.proof, read.claims, verify::kOfEdges).what, "");
    return read;
  }
  /// Why the edge is not proven; empty: it is.
  [[nodiscard]] std::string whyNot(std::size_t edge) const {
    const verify::SceneProof scene(triangles);
    verify::Motion motion(links, edges, edges.edges[edge]);
    verify::Tally tally;
    return verify::EdgeProof(scene, links, edges).prove(claims[edge], motion, tally).what;
  }
};

TEST(VerifyEdgeMotion, HoldsTheTruePlacesBeyondAnyTurn) {
  int all = 0, tight = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Case c = Case::draw(seed);
    Random random(seed);
    if (seed % 4 == 0) c.q1.front() *= 200.0;
    const EdgeCertificate made = c.certified();
    const Statement read = Statement::of(made);
    const std::size_t edge = static_cast<std::size_t>(random.below(static_cast<int>(c.count)));
    verify::Motion motion(read.links, read.edges, read.edges.edges[edge]);
    const int level = random.below(8), index = random.below((1 << level) + 1);
    // In long double as well: the verifier's edge is that of real numbers.
    const auto places =
        placesAt(c.robot, between(c, edge, std::ldexp(static_cast<double>(index), -level)).data());
    for (std::size_t link = 0; link < read.links.size(); ++link) {
      const auto& place = motion.at(level, index, link);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // The coordinate is rounded here: some 1e-16 of it, which moves the far end by as much.
        const long double slack = 1e-12L, at = places[link].p[static_cast<Eigen::Index>(axis)];
        EXPECT_LE(place.origin[axis].lo - slack, at);
        EXPECT_GE(place.origin[axis].hi + slack, at);
        ++all;
        tight += place.origin[axis].hi - place.origin[axis].lo < 1e-10;
      }
    }
  }
  EXPECT_GT(tight, 0.95 * all) << "or it holds anything";
}

TEST(VerifyEdges, ByHandAtTheVeryEdge) {
  // Two spheres of radius 0.1 side by side, the first stands; the second runs from x = 1 to x = 2.
  const std::string avatar =
      R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null,"offset":[0,0,0],)"
      R"("lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},{"name":"b","parent":"a","offset":)"
      R"([0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]}]})";
  const auto whyNot = [&](const std::string& clearance, const std::string& from,
                          const std::string& proof) {
    Statement read;
    EXPECT_EQ(verify::readScene("v 9 -5 -5\nv 9 5 -5\nv 9 0 9\nf 1 2 3\n", read.triangles).what,
              "");
    EXPECT_EQ(verify::readAvatar(avatar, read.links).what, "");
    const std::string text = "foretouch-edges 1\nclearance " + clearance +
                             "\ncoordinates 1\nshift 1 2 0 0 0 1 0\nignore 0\nignore 1\npair 0 1\n"
                             "edge 0\n" +
                             from + "\n2\nend\n";
    EXPECT_EQ(verify::readEdges(text, read.links, 1, read.edges).what, "");
    const auto fault = verify::readCertificate(
        "foretouch-certificate 2\nedge 0\n" + proof + "end\n", read.claims, verify::kOfEdges);
    return fault.what.empty() ? read.whyNot(0) : fault.what;
  };
  EXPECT_EQ(whyNot("0", "1", "pair 0 1\nspan 0 0\n"), "");
  EXPECT_EQ(whyNot("0.7999999", "1", "pair 0 1\nspan 0 0\n"), "");
  EXPECT_TRUE(holds(whyNot("0.8000001", "1", "pair 0 1\nspan 0 0\n"), "none of its planes"));
  const std::string wall = "pair 0 1\nspan 0 0\nplane -1 0 0 -0.15\n";
  EXPECT_EQ(whyNot("0", "0.3", wall), "");
  EXPECT_TRUE(holds(whyNot("0.06", "0.2", wall), "none of its planes"));
  EXPECT_TRUE(holds(whyNot("0", "-1", "pair 0 1\nspan 0 0\n"), "none of its planes"));
  EXPECT_TRUE(holds(whyNot("0", "1", "pair 0 1\nspan 1 0\n"), "end before t = 1"));
  EXPECT_TRUE(holds(whyNot("0", "1", ""), "links 0 and 1 are not proven apart"));
  EXPECT_TRUE(holds(whyNot("0", "1", "pair 1 1\nspan 0 0\n"), "no such pair"));
  EXPECT_TRUE(holds(whyNot("0", "1", "pair 0 2\nspan 0 0\n"), "no such pair"));
  EXPECT_TRUE(holds(whyNot("0", "1", "lss 0\n"), "expected edge K"));
}

enum Lie {
  kPlaneMoved,
  kPlaneTurned,
  kSpanDropped,
  kTriangleAdded,
  kEdgeSwapped,
  kMoreClearance,
  kPairOut,
  kLinkOut,
  kThicker,
  kPairSpanDropped,
  kNumLies
};

/// False: there is nothing to lie about. Else `edge` is what the lie is about.
bool tell(Lie lie, const Case& c, const std::vector<double>& gaps, Random& random, Statement& told,
          std::size_t& edge) {
  auto& claim = told.claims[edge];
  const auto some = [&](auto& list) -> auto& {
    return list[static_cast<std::size_t>(random.below(static_cast<int>(list.size())))];
  };
  auto& link = some(claim.links);
  auto& capsule = some(link.capsules);
  auto& span = some(capsule.spans);
  const Lss& lss = c.robot.avatar().lss(static_cast<LinkId>(link.link))[capsule.capsule];
  const double t =
      (static_cast<double>(span.index) + random.uniform(0.0, 1.0)) / std::ldexp(1.0, span.level);
  const TruePlace place = placesAt(c.robot, between(c, edge, t).data())[link.link];
  const Eigen::Vector3d at = (place.p + place.R * lss.a.cast<long double>()).cast<double>();
  const double keeps = lss.radius + c.options.clearance;
  const auto turn = [](verify::Plane& plane) {
    for (double& part : plane.normal) part = -part;
    plane.offset = -plane.offset;
  };
  switch (lie) {
    case kPlaneMoved: {
      if (span.planes.empty()) return false;
      verify::Plane& plane = some(span.planes);
      const Eigen::Vector3d normal(plane.normal[0], plane.normal[1], plane.normal[2]);
      plane.offset = normal.dot(at) - normal.norm() * keeps * (1.0 - random.magnitude(1e-6, 1.0));
      return true;
    }
    case kPlaneTurned:
      if (span.planes.empty()) return false;
      turn(some(span.planes));
      return true;
    case kSpanDropped:
      capsule.spans.erase(capsule.spans.begin() + (&span - capsule.spans.data()));
      return true;
    case kTriangleAdded: {
      const Eigen::Vector3d corner = at + keeps * random.uniform(0.0, 0.999) * random.direction();
      verify::Triangle triangle;
      for (auto& vertex : triangle.corners) vertex = {corner.x(), corner.y(), corner.z()};
      told.triangles.push_back(triangle);  // behind those that are ignored
      return told.edges.ignored[link.link].empty();
    }
    case kEdgeSwapped:
      for (std::size_t other = 0; other < gaps.size(); ++other) {
        if (!(gaps[other] < c.options.clearance - 1e-9)) continue;
        told.claims[other] = claim;
        edge = other;
        return true;
      }
      return false;
    case kMoreClearance: told.edges.clearance = gaps[edge] + 1e-6; return true;
    case kPairOut:
      if (claim.pairs.empty()) return false;
      claim.pairs.erase(claim.pairs.begin());
      return true;
    case kLinkOut:
      if (link.link < 2) return false;  // it may touch all of the scene
      claim.links.erase(claim.links.begin() + (&link - claim.links.data()));
      return true;
    case kThicker:
    default:
      if (claim.pairs.empty()) return false;
      auto& spans = some(claim.pairs).spans;
      auto& one = some(spans);
      if (lie == kPairSpanDropped) {
        spans.erase(spans.begin() + (&one - spans.data()));
        return true;
      }
      // So thick that they come nearer than the clearance.
      const auto& own = some(claim.pairs);
      const Lss& other = c.robot.avatar().lss(static_cast<LinkId>(own.b)).front();
      auto& mine = told.links[own.a].capsules.front();
      const auto places = placesAt(c.robot, between(c, edge, random.uniform(0.0, 1.0)).data());
      const auto pointOf = [&](std::size_t of, const Eigen::Vector3d& p) {
        return Eigen::Vector3d(
            (places[of].p + places[of].R * p.cast<long double>()).cast<double>());
      };
      const Eigen::Vector3d a(mine.a[0], mine.a[1], mine.a[2]);
      const double far = (pointOf(own.a, a) - pointOf(own.b, other.a)).norm();
      mine.radius = far - other.radius - c.options.clearance + 1e-6;
      return true;
  }
}

TEST(VerifyEdges, RandomClearEdgesAreProvenAndLiesAreNot) {
  int clear = 0, proven = 0, all = 0, farTurns = 0;
  std::array<int, kNumLies> told{};
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const Case c = Case::draw(seed);
    const EdgeCertificate made = c.certified();
    const Statement read = Statement::of(made);
    ASSERT_EQ(read.claims.size(), c.count);
    std::vector<double> gaps;
    for (std::size_t i = 0; i < c.count; ++i) gaps.push_back(gapOf(c, i));
    for (std::size_t i = 0; i < c.count; ++i) {
      SCOPED_TRACE(i);
      ++all;
      EXPECT_EQ(made.isProven[i], read.claims[i].verdict.empty());
      if (made.answers[i].verdict != Verdict::Clear) {
        EXPECT_EQ(read.claims[i].verdict, toString(made.answers[i].verdict));
        continue;
      }
      ++clear;
      EXPECT_GT(gaps[i], c.options.clearance);
      if (!made.isProven[i]) continue;
      ++proven;
      const std::size_t n = c.robot.numCoordinates();
      farTurns += c.robot.largestTurn(c.q0.data() + i * n, c.q1.data() + i * n) > 3.2;
      EXPECT_EQ(read.whyNot(i), "");
      Random random(seed * 31 + i);
      for (int lie = 0; lie < kNumLies; ++lie) {
        Statement lying = read;
        std::size_t edge = i;
        if (!tell(static_cast<Lie>(lie), c, gaps, random, lying, edge)) continue;
        ++told[static_cast<std::size_t>(lie)];
        EXPECT_NE(lying.whyNot(edge), "") << "lie " << lie << " was believed";
      }
    }
  }
  EXPECT_GT(clear, 0.2 * all);
  EXPECT_LT(clear, 0.9 * all);
  EXPECT_GE(proven, 0.99 * clear);
  EXPECT_GT(farTurns, 20);
  for (int lie = 0; lie < kNumLies; ++lie) {
    EXPECT_GT(told[static_cast<std::size_t>(lie)], 30) << "lie " << lie;
  }
}

}  // namespace
}  // namespace foretouch::test
