// Every option at every fidelity: honoured, or refused by its name. None is passed over.
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/pair/query_plan.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

constexpr std::int32_t kLinks = 6;
const std::vector<Fidelity> kFidelities = {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned};

struct WorldOfEverything {
  explicit WorldOfEverything(Random random)
      : scene(Scene::build(test::clutter(random, 200, 3, Vector3d::Zero())).value()),
        body(test::bodyInClutter(random, kLinks, Vector3d::Zero())),
        motion(body.motion()),
        surface(AvatarSurface::build(body.avatar, test::meshWithin(body.avatar, random, 6, 0.9))
                    .value()),
        skin(skinOf(body, motion, random)) {}

  static SkinnedSurface skinOf(const test::RandomBody& body, const ChainMotion& motion,
                               Random& random) {
    const test::RandomSkin made = test::randomSkin(body.avatar, motion, random);
    return SkinnedSurface::build(body.avatar, made.skin, made.counts).value();
  }

  /// With what the fidelity needs and nothing else.
  [[nodiscard]] QueryOptions options(Fidelity fidelity) const {
    QueryOptions options;
    options.fidelity = fidelity;
    if (fidelity == Fidelity::Exact) options.surface = surface;
    if (fidelity == Fidelity::Skinned) options.skin = skin;
    return options;
  }

  Scene scene;
  test::RandomBody body;
  ChainMotion motion;
  AvatarSurface surface;
  SkinnedSurface skin;
};

/// "accepted", or the name of what is refused and the text.
std::string said(const Result<Query>& query) {
  return query.ok() ? "accepted" : query.error().file + ": " + query.error().message;
}

struct Change {
  const char* name;
  std::function<void(QueryOptions&)> make;
  std::set<Fidelity> refusedAt = {};
};

TEST(QueryOptions, AreHonouredOrRefusedByNameAtEveryFidelity) {
  const WorldOfEverything world{Random(1)};
  const std::vector<Change> changes = {
      {"tolerance", [](QueryOptions& o) { o.tolerance = 0.02; }},
      {"scope", [](QueryOptions& o) { o.scope = Scope::FirstOfAvatar; }},
      {"ignored",
       [](QueryOptions& o) {
         o.ignored = {{1, 0}, {2, IgnoredPair::kEveryObject}};
       }},
      {"workBudget", [](QueryOptions& o) { o.workBudget = 1000; }},
      {"deadline", [](QueryOptions& o) { o.deadlineUs = 1000.0; }},
      {"linkPolicies",
       [](QueryOptions& o) { o.linkPolicies.assign(kLinks, LinkPolicy{}); },
       {Fidelity::Skinned}}};
  for (const Fidelity fidelity : kFidelities) {
    for (const Change& change : changes) {
      QueryOptions options = world.options(fidelity);
      change.make(options);
      const std::string got = said(Query::build(world.body.avatar, world.scene, options));
      const bool isRefused = change.refusedAt.count(fidelity) != 0;
      EXPECT_EQ(got.rfind(isRefused ? std::string(change.name) + ": expected none at fidelity " +
                                          toString(fidelity)
                                    : "accepted",
                          0),
                0u)
          << change.name << " at " << toString(fidelity) << ": " << got;
    }
  }
}

const std::set<Fidelity> kNotOfLinks = {Fidelity::Skinned};

// What looks beyond the first contact, or at own links, is honoured link by link or refused.
TEST(QueryOptions, BeyondTheFirstContactAreHonouredOrRefusedByName) {
  const WorldOfEverything world{Random(3)};
  const auto rules = PairRules::derive(world.body.avatar);
  ASSERT_TRUE(rules.ok());
  const std::vector<Change> changes = {
      {"passSeparating", [](QueryOptions& o) { o.passSeparating = true; }, kNotOfLinks},
      {"scope", [](QueryOptions& o) { o.scope = Scope::EveryObject; }, kNotOfLinks},
      {"self", [&](QueryOptions& o) { o.self = rules.value(); }, kNotOfLinks}};
  for (const Fidelity fidelity : kFidelities) {
    for (const Change& change : changes) {
      QueryOptions options = world.options(fidelity);
      change.make(options);
      const std::string got = said(Query::build(world.body.avatar, world.scene, options));
      const bool isRefused = change.refusedAt.count(fidelity) != 0;
      EXPECT_EQ(got.rfind(isRefused ? std::string(change.name) + ": expected" : "accepted", 0), 0u)
          << change.name << " at " << toString(fidelity) << ": " << got;
      if (isRefused) {
        EXPECT_NE(got.find(toString(fidelity)), std::string::npos) << got;
      }
    }
  }
}

TEST(QueryOptions, ThatExcludeEachOtherAreRefusedByName) {
  const WorldOfEverything world{Random(3)};
  const auto rules = PairRules::derive(world.body.avatar).value();
  const std::vector<Change> changes = {
      {"scope",
       [](QueryOptions& o) {
         o.scope = Scope::EveryObject;
         o.workBudget = 1000;
       }},
      {"scope",
       [](QueryOptions& o) {
         o.scope = Scope::EveryObject;
         o.deadlineUs = 10.0;
       }},
      {"self",
       [&](QueryOptions& o) {
         o.self = rules;
         o.scope = Scope::FirstOfAvatar;
       }},
      {"self", [&](QueryOptions& o) {
         o.self = PairRules::derive(WorldOfEverything(Random(4)).body.avatar).value();
       }}};
  for (const Change& change : changes) {
    QueryOptions options;
    change.make(options);
    const std::string got = said(Query::build(world.body.avatar, world.scene, options));
    EXPECT_EQ(got.rfind(std::string(change.name) + ": expected", 0), 0u) << got;
  }
}

// Policies may need what the fidelity beside them does not, and a program may keep one set of
// options: a surface or a skin that nobody asks for is not looked at.
TEST(QueryOptions, WithASurfaceThatNobodyNeedsChangeNothing) {
  int touched = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const WorldOfEverything world{Random(static_cast<std::uint64_t>(seed))};
    for (const Fidelity fidelity : kFidelities) {
      SCOPED_TRACE(std::string(toString(fidelity)) + " " + std::to_string(seed));
      const QueryOptions needed = world.options(fidelity);
      QueryOptions more = needed;
      more.surface = world.surface;
      more.skin = world.skin;
      const auto& [avatar, motion] = std::tie(world.body.avatar, world.motion);
      const StepContacts expected = firstContacts(avatar, motion, world.scene, needed).value();
      const StepContacts got = firstContacts(avatar, motion, world.scene, more).value();
      for (std::size_t i = 0; i < expected.links.size(); ++i) {
        EXPECT_EQ(got.links[i].verdict, expected.links[i].verdict);
        EXPECT_EQ(got.links[i].toi, expected.links[i].toi);
        EXPECT_EQ(got.links[i].p_WLink, expected.links[i].p_WLink);
        touched += expected.links[i].verdict != Verdict::Clear ? 1 : 0;
      }
    }
  }
  EXPECT_GT(touched, 100);
}

struct OtherWay {
  const char* name;
  const char* asked;
  std::function<void(ReferenceOptions&)> take;
  std::set<Fidelity> takenAt;
};

TEST(Fidelities, ThatAreGoneAreNamedWithTheReason) {
  for (const std::string gone : {"limb", "avatar", "ellipsoid"}) {
    EXPECT_EQ(whyFidelityIsGone(gone).rfind(gone + " is gone: ", 0), 0u) << gone;
  }
  for (const Fidelity fidelity : kFidelities) EXPECT_EQ(whyFidelityIsGone(toString(fidelity)), "");
  EXPECT_EQ(whyFidelityIsGone("limbs"), "");
}

TEST(ReferenceOptions, AreHonouredOrRefusedByNameAtEveryFidelity) {
  const WorldOfEverything world{Random(2)};
  const std::set<Fidelity> all(kFidelities.begin(), kFidelities.end());
  const std::vector<OtherWay> ways = {
      {"culler", "", [](ReferenceOptions& r) { r.culler = Culler::PointQuery; }, all},
      {"leafMethod",
       "expected advancement at fidelity ",
       [](ReferenceOptions& r) { r.leafMethod = LeafMethod::Cubics; },
       {Fidelity::Exact}},
      {"descent",
       "expected straight at fidelity ",
       [](ReferenceOptions& r) { r.descent = Descent::ByNeed; },
       {Fidelity::Link, Fidelity::Exact}},
      {"backtracking", "expected ",
       [](ReferenceOptions& r) { r.backtracking = Backtracking::Lanes; }, all},
      {"backtracking", "expected ",
       [](ReferenceOptions& r) { r.backtracking = Backtracking::Scalar; }, all}};
  for (const Fidelity fidelity : kFidelities) {
    for (const OtherWay& way : ways) {
      ReferenceOptions reference;
      way.take(reference);
      const std::string got =
          said(buildReference(world.body.avatar, world.scene, world.options(fidelity), reference));
      const std::string expected =
          way.takenAt.count(fidelity) != 0 ? "accepted" : std::string(way.name) + ": " + way.asked;
      EXPECT_EQ(got.rfind(expected, 0), 0u)
          << way.name << " at " << toString(fidelity) << ": " << got;
      if (got != "accepted") {
        EXPECT_NE(got.find(toString(fidelity)), std::string::npos) << got;
      }
    }
  }
}

// Where one link alone is exact, its pairs are followed by cubics.
TEST(ReferenceOptions, TakeCubicsForTheLinksThatAreExactByPolicy) {
  const WorldOfEverything world{Random(3)};
  QueryOptions options = world.options(Fidelity::Link);
  options.surface = world.surface;
  options.linkPolicies.assign(kLinks, LinkPolicy{});
  ReferenceOptions cubics;
  cubics.leafMethod = LeafMethod::Cubics;
  EXPECT_FALSE(buildReference(world.body.avatar, world.scene, options, cubics).ok());
  options.linkPolicies[3].fidelity = Fidelity::Exact;
  EXPECT_TRUE(buildReference(world.body.avatar, world.scene, options, cubics).ok());
}

TEST(ReferenceOptions, AreTheProductsByDefault) {
  const WorldOfEverything world{Random(4)};
  for (const Fidelity fidelity : kFidelities) {
    const Query query =
        buildReference(world.body.avatar, world.scene, world.options(fidelity), {}).value();
    EXPECT_EQ(query.plan().leafProver, nullptr);
    EXPECT_EQ(query.plan().stepAnswerer, nullptr);
    EXPECT_TRUE(query.plan().inLanes);
  }
}

}  // namespace
}  // namespace foretouch
