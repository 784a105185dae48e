// A link that nobody has answered claims nothing. Every path through the query is broken off, ended
// early or refused here, and what it leaves behind is looked at.
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query/lane_query.h"
#include "middleware/query/query.h"
#include "middleware/query/scalar_query.h"
#include "middleware/scene/scene_parts.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

bool isUnanswered(const LinkContact& contact) {
  return contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::None &&
         contact.toi == 0.0 && contact.freeUntil == 0.0;
}

bool isSame(const LinkContact& x, const LinkContact& y) {
  return x.verdict == y.verdict && x.reason == y.reason && x.toi == y.toi &&
         x.freeUntil == y.freeUntil && x.triangle == y.triangle;
}

/// A body in clutter, one of its links bare and one ignored, and what any fidelity needs of it.
struct Case {
  explicit Case(std::uint64_t seed, int triangles = 200) : Case(Random(seed), triangles) {}
  Case(Random random, int triangles)
      : scene(Scene::build(test::clutter(random, triangles, 3, Vector3d::Zero())).value()),
        body(withBareLink(test::bodyInClutter(random, kLinks, Vector3d::Zero()))),
        motion(body.motion()) {
    surface = AvatarSurface::build(body.avatar, test::meshWithin(body.avatar, random, 6, 0.9));
    const test::RandomSkin made = test::randomSkin(body.avatar, motion, random);
    skin = SkinnedSurface::build(body.avatar, made.skin, made.counts);
  }
  static test::RandomBody withBareLink(test::RandomBody body) {
    std::vector<std::vector<Lss>> lss;
    for (LinkId link = 0; link < kLinks; ++link) lss.push_back(body.avatar.lss(link));
    lss[kBare].clear();
    body.avatar = Avatar::build(body.avatar.skeleton(), std::move(lss)).value();
    return body;
  }

  [[nodiscard]] QueryOptions options(Fidelity fidelity) const {
    QueryOptions options;
    options.fidelity = fidelity;
    options.ignored = {{kIgnored, IgnoredPair::kEveryObject}, {2, 1}};
    options.surface = surface.value();
    options.skin = skin.value();
    return options;
  }

  static constexpr LinkId kLinks = 8, kBare = 4, kIgnored = 5;
  Scene scene;
  test::RandomBody body;
  ChainMotion motion;
  Result<AvatarSurface> surface = Error{};
  Result<SkinnedSurface> skin = Error{};
};

struct Path {
  std::string name;
  QueryOptions options;
  ReferenceOptions reference;
};

StepContacts answer(const Case& c, const Path& path) {
  return firstContacts(c.body.avatar, c.motion, c.scene, path.options, path.reference).value();
}

/// The ways of backtracking that a fidelity has.
std::vector<std::optional<Backtracking>> backtrackingsOf(Fidelity fidelity) {
  if (fidelity == Fidelity::Skinned) return {Backtracking::Scalar};
  return {Backtracking::Lanes, Backtracking::Scalar};
}

/// Every way that a query goes, each link asked for by itself and without a budget.
std::vector<Path> pathsOf(const Case& c) {
  std::vector<Path> paths;
  for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    for (const std::optional<Backtracking> way : backtrackingsOf(fidelity)) {
      for (const Culler culler : {Culler::FlatBvh, Culler::PointQuery}) {
        Path path{toString(fidelity), c.options(fidelity), {}};
        path.reference.backtracking = way;
        path.reference.culler = culler;
        if (way) path.name += std::string(" ") + toString(*way);
        paths.push_back(std::move(path));
      }
    }
  }
  for (const Rung rung : {Rung::Limb, Rung::Avatar, Rung::Ellipsoid}) {
    for (const Culler culler : {Culler::FlatBvh, Culler::PointQuery}) {
      paths.push_back({toString(rung), c.options(Fidelity::Link), {}});
      paths.back().reference.rung = rung;
      paths.back().reference.culler = culler;
    }
  }
  paths.push_back({"cubics", c.options(Fidelity::Exact), {}});
  paths.back().reference.leafMethod = LeafMethod::Cubics;
  QueryOptions options = c.options(Fidelity::Link);
  paths.push_back({"by need", options, {}});
  paths.back().reference.descent = Descent::ByNeed;
  for (LinkId link = 0; link < Case::kLinks; ++link) {
    options.linkPolicies.push_back(
        {link % 2 == 0 ? 1e-4 : 5e-3, link % 3 == 0 ? Fidelity::Exact : Fidelity::Link});
  }
  paths.push_back({"policies", options, {}});
  paths.back().reference.descent = Descent::ByNeed;
  return paths;
}

TEST(Unanswered, IsWhatALinkIsFromTheBeginning) {
  EXPECT_TRUE(isUnanswered(LinkContact{}));
}

/// That every link has been answered, and none better than without a budget.
void expectAnswers(const StepContacts& step, const StepContacts& whole, const Path& path) {
  ASSERT_EQ(step.links.size(), whole.links.size());
  for (std::size_t i = 0; i < step.links.size(); ++i) {
    const LinkContact& got = step.links[i];
    EXPECT_EQ(got.link, static_cast<LinkId>(i));
    EXPECT_FALSE(isUnanswered(got)) << path.name << " link " << i;
    EXPECT_EQ(got.toi, got.freeUntil) << path.name << " link " << i;
    if (got.link == Case::kBare && path.options.fidelity != Fidelity::Skinned) {
      EXPECT_EQ(got.verdict, Verdict::Clear) << path.name << ": the link has no surface";
    }
    if (got.verdict == Verdict::Undecided) {
      EXPECT_NE(got.reason, UndecidedReason::None);
      continue;
    }
    EXPECT_EQ(got.verdict, whole.links[i].verdict) << path.name << " link " << i;
    EXPECT_EQ(got.verdict == Verdict::Clear, got.freeUntil == 1.0) << path.name << " link " << i;
  }
}

TEST(Unanswered, NoPathLeavesALinkSo) {
  int cut = 0, first = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Case c(seed);
    for (const Path& path : pathsOf(c)) {
      const StepContacts whole = answer(c, path);
      expectAnswers(whole, whole, path);
      EXPECT_EQ(whole.links[Case::kIgnored].verdict, Verdict::Clear) << path.name;
      for (const std::uint64_t budget : {0, 30, 1000, 100000}) {
        for (const Scope scope : {Scope::EveryLink, Scope::FirstOfAvatar}) {
          Path less = path;
          less.options.workBudget = budget;
          less.options.scope = scope;
          const StepContacts step = answer(c, less);
          expectAnswers(step, whole, path);
          for (const LinkContact& contact : step.links) {
            cut += contact.reason == UndecidedReason::WorkBudget ? 1 : 0;
            first += contact.reason == UndecidedReason::AfterFirst ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(cut, 500);
  EXPECT_GT(first, 500);
}

// It cuts off work and does nothing else: neither how links share it nor that there is one shows.
TEST(Budget, ThatIsNotSpentChangesNothing) {
  constexpr std::uint64_t kMuchWork = 1e4, kAmple = 4;
  int touched = 0, heavy = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Case c(seed, seed % 2 == 0 ? 200 : 2000);
    for (Path path : pathsOf(c)) {
      for (const Scope scope : {Scope::EveryLink, Scope::FirstOfAvatar}) {
        SCOPED_TRACE(path.name + ", seed " + std::to_string(seed));
        path.options.scope = scope;
        path.options.workBudget = std::numeric_limits<std::uint64_t>::max();
        const StepContacts whole = answer(c, path);
        const std::uint64_t work = internal::WorkMeter::workOf(whole.counters);
        path.options.workBudget = kAmple * std::max<std::uint64_t>(work, 1);
        const StepContacts step = answer(c, path);
        for (std::size_t i = 0; i < whole.links.size(); ++i) {
          EXPECT_TRUE(isSame(step.links[i], whole.links[i])) << "link " << i;
          EXPECT_EQ(step.links[i].separation, whole.links[i].separation);
          EXPECT_EQ(step.links[i].p_WScene, whole.links[i].p_WScene);
          touched += whole.links[i].verdict != Verdict::Clear ? 1 : 0;
        }
        heavy += work > kMuchWork ? 1 : 0;
      }
    }
  }
  EXPECT_GT(touched, 1000);
  EXPECT_GT(heavy, 100);
}

struct BrokenOff {};

/// Finds what the tree finds, and is broken off at the n-th question.
class BreakingCuller : public internal::TriangleCuller {
 public:
  BreakingCuller(const Scene& scene, int questions) : scene_(scene), left_(questions) {}
  void collect(const Aabb& box, std::vector<TriangleId>& ids,
               std::uint64_t& visited) const override {
    if (left_-- == 0) throw BrokenOff{};
    scene_.parts().bvh.collect(box, ids, visited);
  }
  void collectLeaves(const internal::BoxLanes& boxes, std::vector<internal::LeafHit>& hits,
                     std::uint64_t& nodes, std::uint64_t& leaves) const override {
    if (left_-- == 0) throw BrokenOff{};
    scene_.parts().bvh.collectLeaves(boxes, hits, nodes, leaves);
  }

 private:
  const Scene& scene_;
  mutable int left_;
};

/// As Query::answer(), up to the culler.
void ask(const Case& c, const Path& path, const internal::TriangleCuller& culler, Scratch& scratch,
         StepContacts& step) {
  const QueryOptions& options = path.options;
  internal::QueryPlan plan =
      buildReference(c.body.avatar, c.scene, options, path.reference).value().plan();
  plan.culler = {std::shared_ptr<const void>(), &culler};  // the caller's
  const internal::Body body(plan.avatar.lss(), plan.options.ignored);
  auto& parts = scratch.of<internal::QueryMemory>();
  const internal::WorkMeter meter(options);
  parts.beginStep(c.motion);
  if (plan.stepAnswerer != nullptr &&
      plan.stepAnswerer->answers(plan, c.motion, meter, parts, step)) {
    return;
  }
  if (plan.inLanes) {
    internal::LaneQuery(plan, body, plan.table, c.motion, meter, parts).run(step);
  } else {
    internal::scalarQuery(plan, body, c.motion, meter, parts, step);
  }
}

TEST(Unanswered, QueriesThatAreBrokenOffLeaveNothingClear) {
  int broken = 0, unanswered = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Case c(seed);
    for (const Path& path : pathsOf(c)) {
      Scratch scratch;
      const StepContacts whole = answer(c, path);
      bool isBroken = true;
      for (int questions = 0; isBroken; ++questions) {
        isBroken = false;
        StepContacts step;
        internal::leaveUnanswered(Case::kLinks, step.links);
        try {
          ask(c, path, BreakingCuller(c.scene, questions), scratch, step);
        } catch (const BrokenOff&) {
          isBroken = true;
        }
        broken += isBroken ? 1 : 0;
        for (std::size_t i = 0; i < step.links.size(); ++i) {
          if (isBroken && isUnanswered(step.links[i])) {
            ++unanswered;
            continue;
          }
          EXPECT_TRUE(isSame(step.links[i], whole.links[i]))
              << path.name << " link " << i << " of seed " << seed << " after " << questions;
        }
      }
    }
  }
  EXPECT_GT(broken, 1000);
  EXPECT_GT(unanswered, 4000);
}

// Lanes return once something touches: what they have not looked at to the end is not clear, also
// before anyone has tidied up behind them.
TEST(Unanswered, TheFirstOfAllLeavesNothingClear) {
  int early = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Case c(seed);
    for (const std::uint64_t budget :
         {std::numeric_limits<std::uint64_t>::max(), std::uint64_t{10000000}}) {
      QueryOptions options = c.options(Fidelity::Link);
      options.scope = Scope::FirstOfAvatar;
      options.workBudget = budget;
      Scratch scratch;
      StepContacts step;
      internal::leaveUnanswered(Case::kLinks, step.links);
      ask(c, {"link", options, {}}, c.scene.parts().bvh, scratch, step);
      double first = 1.0;
      for (const LinkContact& contact : step.links) first = std::min(first, contact.freeUntil);
      for (const LinkContact& contact : step.links) {
        EXPECT_FALSE(isUnanswered(contact));
        if (first == 1.0 || contact.link == Case::kIgnored || contact.link == Case::kBare) continue;
        EXPECT_NE(contact.verdict, Verdict::Clear) << seed << " link " << contact.link;
        if (contact.verdict != Verdict::Undecided) continue;
        EXPECT_EQ(contact.reason, UndecidedReason::AfterFirst);
        EXPECT_EQ(contact.freeUntil, first);
        ++early;
      }
    }
  }
  EXPECT_GT(early, 100);
}

TEST(Unanswered, OptionsThatCannotBeHonouredAreRefusedByName) {
  const Case c(1);
  const QueryOptions good = c.options(Fidelity::Link);
  std::vector<std::pair<const char*, QueryOptions>> refused = {
      {"tolerance", good},    {"deadline", good}, {"ignored", good},
      {"linkPolicies", good}, {"fidelity", good}, {"fidelity", good}};
  refused[0].second.tolerance = -1.0;
  refused[1].second.deadlineUs = -1.0;
  refused[2].second.ignored = {{1000, 0}};
  refused[3].second.linkPolicies.resize(1);
  refused[4].second.fidelity = Fidelity::Exact;
  refused[4].second.surface.reset();
  refused[5].second.fidelity = Fidelity::Skinned;
  refused[5].second.skin.reset();
  EXPECT_TRUE(Query::build(c.body.avatar, c.scene, good).ok());
  for (const auto& [name, options] : refused) {
    const auto query = Query::build(c.body.avatar, c.scene, options);
    ASSERT_FALSE(query.ok()) << name;
    EXPECT_EQ(query.error().file, name);
  }
}

// Where checks are on, it is a bug that stops the program.
TEST(Unanswered, MotionsOfAnotherAvatarForgetWhatWasAnsweredBefore) {
  if (FORETOUCH_CHECKS) GTEST_SKIP() << "asserted in this build";
  const Case c(1);
  const Query query = Query::build(c.body.avatar, c.scene, c.options(Fidelity::Link)).value();
  RawSkeleton raw;
  raw.joints.push_back({"alone", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  const Skeleton other = Skeleton::build(raw).value();
  const Pose rest = restPose(other);
  Scratch scratch;
  StepContacts step = query.answer(c.motion, scratch);
  EXPECT_EQ(step.links[Case::kIgnored].verdict, Verdict::Clear);
  query.answer(ChainMotion(other, rest, rest), scratch, step);
  ASSERT_EQ(step.links.size(), static_cast<std::size_t>(Case::kLinks));
  for (const LinkContact& contact : step.links) EXPECT_TRUE(isUnanswered(contact));
}

}  // namespace
}  // namespace foretouch
