// What is said of a contact is said of the nearest triangle at its instant, whatever was found
// first: the judge, who shares no code with the query, looks at all of them.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/judged.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

/// A body in clutter of two objects; links with odd numbers ignore the second one. The tolerance is
/// so wide that many triangles are within it at once.
struct Case {
  explicit Case(std::uint64_t seed) : Case(Random(seed)) {}
  explicit Case(Random random)
      : raw(test::clutter(random, 400, 2, Vector3d::Zero())),
        scene(Scene::build(raw).value()),
        body(test::bodyInClutter(random, 8, Vector3d::Zero())),
        meshes(test::meshWithin(body.avatar, random, 12, 0.9)),
        surface(AvatarSurface::build(body.avatar, meshes).value()),
        tolerance(random.magnitude(1e-2, 0.3)) {}

  [[nodiscard]] StepContacts answer(Fidelity fidelity, Backtracking way) const {
    QueryOptions options;
    options.tolerance = tolerance;
    options.fidelity = fidelity;
    options.surface = surface;
    ReferenceOptions reference;
    reference.backtracking = way;
    for (LinkId link = 1; link < body.avatar.numLinks(); link += 2) {
      options.ignored.push_back({link, 1});
    }
    return firstContacts(body.avatar, body.motion(), scene, options, reference).value();
  }

  /// Of all triangles that the link does not ignore.
  [[nodiscard]] double nearestTo(LinkId link, double t, Fidelity fidelity) const {
    std::vector<Triangle> asked;
    for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
      if (link % 2 == 0 || scene.object(id) == 0) asked.push_back(scene.triangle(id));
    }
    const oracle::Scene others(test::plain(asked));
    const oracle::Motion motion(test::plainJoints(body.avatar.skeleton(), body.from, body.to));
    const auto i = static_cast<std::size_t>(link);
    auto judge = fidelity == Fidelity::Exact
                     ? oracle::Judge(others, motion, link, test::plain(meshes[i]))
                     : oracle::Judge(others, motion, link, test::plainCapsules(body.avatar, link));
    return static_cast<double>(judge.separationAt(static_cast<oracle::Real>(t)));
  }

  RawScene raw;
  Scene scene;
  test::RandomBody body;
  std::vector<std::vector<Triangle>> meshes;
  AvatarSurface surface;
  double tolerance;
};

class Nearest : public testing::TestWithParam<std::pair<Fidelity, Backtracking>> {};

TEST_P(Nearest, TriangleAtTheContactIsTheOneThatIsReported) {
  constexpr double kRounding = 1e-12;
  const auto [fidelity, way] = GetParam();
  int contacts = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Case c(seed);
    for (const LinkContact& contact : c.answer(fidelity, way).links) {
      if (contact.verdict != Verdict::Contact) continue;
      ++contacts;
      EXPECT_NEAR(contact.separation, c.nearestTo(contact.link, contact.toi, fidelity), kRounding)
          << "seed " << seed << ", link " << contact.link << " at " << contact.toi;
    }
  }
  EXPECT_GT(contacts, 250);
}

INSTANTIATE_TEST_SUITE_P(Ways, Nearest,
                         testing::Values(std::pair{Fidelity::Link, Backtracking::Lanes},
                                         std::pair{Fidelity::Link, Backtracking::Scalar},
                                         std::pair{Fidelity::Exact, Backtracking::Lanes},
                                         std::pair{Fidelity::Exact, Backtracking::Scalar}),
                         [](const auto& way) {
                           return std::string(toString(way.param.first)) + "_" +
                                  toString(way.param.second);
                         });

}  // namespace
}  // namespace foretouch
