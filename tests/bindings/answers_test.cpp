// The C library answers what the C++ one does, bit for bit. They are two copies of the code in this
// program: libforetouch holds its own and shows none of it.
#include <cstring>
#include <optional>

#include "middleware/query/query.h"
#include "middleware/query_options.h"
#include "tests/bindings/c_world.h"
#include "tests/bindings/same_answers.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::expectSame;
using test::expectSameDetails;
using test::expectSameObjects;
using test::expectSamePose;
using test::expectSameVector;
using test::Random;

/// The same options, for both.
struct Options {
  QueryOptions cxx;
  ft_query_options c = test::initialised(ft_query_options_init);
  std::vector<ft_ignored_pair> ignored;
  std::vector<ft_link_policy> policies;
  std::vector<ft_object_policy> objectPolicies;
  std::vector<ObjectPolicy> cxxObjectPolicies;

  void ignore(LinkId link, ObjectId object) {
    cxx.ignored.push_back({link, object});
    ignored.push_back({link, object});
    c.ignored = ignored.data();
    c.ignored_count = ignored.size();
  }
  void objectPolicy(const ft_object_policy& policy) {
    ObjectPolicy same;
    if (policy.link != FT_EVERY_LINK) same.links = {policy.link};
    if (policy.object != FT_EVERY_OBJECT) same.objects = {policy.object};
    if (policy.tolerance != 0.0) same.tolerance = policy.tolerance;
    if (policy.ignore != FT_UNCHANGED) same.ignore = policy.ignore != 0;
    cxxObjectPolicies.push_back(same);
    objectPolicies.push_back(policy);
    c.object_policies = objectPolicies.data();
    c.object_policy_count = objectPolicies.size();
  }
  void policy(double tolerance, bool isExact) {
    cxx.linkPolicies.push_back({tolerance, isExact ? Fidelity::Exact : Fidelity::Link});
    policies.push_back({tolerance, isExact ? FT_FIDELITY_EXACT : FT_FIDELITY_LINK, 0});
    c.policies = policies.data();
    c.policy_count = policies.size();
  }
};

/// Of one step, all that can be asked, for links that differ from case to case.
void draw(Random& random, const test::RandomBody& body, int objects, Options& options) {
  const bool isExact = random.chance(0.4);
  options.cxx.fidelity = isExact ? Fidelity::Exact : Fidelity::Link;
  options.c.fidelity = isExact ? FT_FIDELITY_EXACT : FT_FIDELITY_LINK;
  options.cxx.tolerance = options.c.tolerance = random.magnitude(1e-6, 1e-2);
  const bool hasBudget = random.chance(0.2);
  if (hasBudget) {
    options.cxx.workBudget = options.c.work_budget = static_cast<std::uint64_t>(random.below(300));
  }
  if (random.chance(0.2)) {
    options.cxx.scope = Scope::FirstOfAvatar;
    options.c.scope = FT_SCOPE_FIRST_OF_AVATAR;
  } else if (!hasBudget && random.chance(0.6)) {
    options.cxx.scope = Scope::EveryObject;
    options.c.scope = FT_SCOPE_EVERY_OBJECT;
  }
  if (random.chance(0.4)) {
    options.cxx.passSeparating = true;
    options.c.pass_separating = 1;
  }
  for (int i = random.below(3); i > 0; --i) {
    options.ignore(random.below(body.avatar.numLinks()), random.below(objects + 1) - 1);
  }
  for (LinkId link = 0; random.chance(0.99) && link < body.avatar.numLinks(); ++link) {
    if (link == 0 && random.chance(0.7)) break;  // no policies at all
    options.policy(random.magnitude(1e-6, 1e-2), random.chance(0.5));
  }
  if (options.policies.size() == static_cast<std::size_t>(body.avatar.numLinks())) return;
  options.cxx.linkPolicies.clear();
  options.c.policies = nullptr;
  options.c.policy_count = 0;
  for (int i = random.below(4); i > 0; --i) {
    options.objectPolicy({random.below(body.avatar.numLinks() + 1) - 1,
                          random.below(objects + 1) - 1,
                          random.chance(0.3) ? 0.0 : random.magnitude(1e-6, 1e-2), FT_UNCHANGED,
                          random.below(3) - 1});
  }
  EXPECT_TRUE(
      applyObjectPolicies(options.cxxObjectPolicies, body.avatar.numLinks(), objects, options.cxx)
          .ok());
}

/// Those not clear, in the order of reports.
void expectReported(const ft_query* query, const StepContacts& step, const Scene& scene) {
  std::vector<LinkContact> expected;
  for (const LinkContact& contact : step.links) {
    if (contact.verdict != Verdict::Clear) expected.push_back(contact);
  }
  std::sort(expected.begin(), expected.end(), isReportedBefore);
  std::size_t count = 0;
  ASSERT_EQ(ft_query_contacts(query, nullptr, 0, &count), FT_OK);
  ASSERT_EQ(count, expected.size());
  std::vector<ft_contact> contacts(count + 1);
  contacts[0].size = sizeof(ft_contact);
  ASSERT_EQ(ft_query_contacts(query, contacts.data(), count, &count), FT_OK);
  for (std::size_t i = 0; i < count; ++i) expectSame(contacts[i], expected[i], scene);
  EXPECT_EQ(contacts[count].size, count == 0 ? sizeof(ft_contact) : 0u) << "written past the end";
}

void expectSameCounters(const ft_query* query, const QueryCounters& cxx) {
  ft_counters c{};
  c.size = sizeof c;
  ASSERT_EQ(ft_query_counters(query, &c), FT_OK);
  EXPECT_EQ(c.nodes, cxx.nodes);
  EXPECT_EQ(c.leaves, cxx.leaves);
  EXPECT_EQ(c.candidates, cxx.candidates);
  EXPECT_EQ(c.cluster_steps, cxx.clusterSteps);
  EXPECT_EQ(c.lane_steps, cxx.laneSteps);
  EXPECT_EQ(c.part_steps, cxx.partSteps);
  EXPECT_EQ(c.advancements, cxx.advancements);
  EXPECT_EQ(c.hierarchy_tests, cxx.hierarchyTests);
  EXPECT_EQ(c.plane_tests, cxx.planeTests);
  EXPECT_EQ(c.leaf_tests, cxx.leafTests);
  EXPECT_EQ(c.states, cxx.states);
  EXPECT_EQ(c.rung_tests, cxx.rungTests);
}

/// Where links are, and what a discrete check says, at one t.
void expectSameStates(ft_query* query, const test::RandomBody& body, const ChainMotion& motion,
                      double t, const Scene& scene, const QueryOptions& options) {
  std::vector<ft_transform> transforms(static_cast<std::size_t>(motion.numLinks()));
  ASSERT_EQ(ft_motion_transforms(query, t, transforms.data(), transforms.size(), nullptr), FT_OK);
  Scratch scratch;
  for (LinkId link = 0; link < motion.numLinks(); ++link) {
    const LinkState state = motion.stateAt(link, t);
    const ft_transform& c = transforms[static_cast<std::size_t>(link)];
    expectSameVector(c.translation, state.p_WL);
    expectSameVector(c.velocity, state.v_WL);
    expectSameVector(c.angular_velocity, state.w_WL);
    const Quaternion q(c.rotation[0], c.rotation[1], c.rotation[2], c.rotation[3]);
    EXPECT_LT((q.toRotationMatrix() - state.R_WL).norm(), 1e-14);
    std::int32_t touches = -1;
    ASSERT_EQ(ft_touches_at(query, link, t, &touches), FT_OK);
    EXPECT_EQ(touches,
              test::touchesAt(body.avatar, motion, link, t, scene, options, scratch) ? 1 : 0);
  }
}

/// What the cases of a test were about.
struct Seen {
  int contacts = 0, undecided = 0, clear = 0, exact = 0, detailed = 0, passing = 0;
  std::size_t ofObjects = 0;

  void add(const ft_contact& link) {
    contacts += link.verdict == FT_VERDICT_CONTACT;
    undecided += link.verdict == FT_VERDICT_UNDECIDED;
    clear += link.verdict == FT_VERDICT_CLEAR;
    exact += link.link_triangle >= 0;
  }
  void expectMany(int cases) const {
    EXPECT_GT(ofObjects, static_cast<std::size_t>(cases / 10));
    EXPECT_GT(detailed, cases / 10);
    EXPECT_GT(passing, cases / 10);
    EXPECT_GT(contacts, cases / 12);
    EXPECT_GT(undecided, cases / 10);
    EXPECT_GT(clear, cases / 2);
    EXPECT_GT(exact, cases / 10);
  }
};

TEST(CAnswers, AreThoseOfTheCxxApiBitForBit) {
  constexpr int kCases = 400;
  Seen seen;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    constexpr int kObjects = 4;
    const Vector3d center =
        random.chance(0.3) ? Vector3d(1e4 * random.direction()) : Vector3d(0, 0, 0);
    const RawScene raw = test::clutter(random, 700, kObjects, center);
    const Scene scene = Scene::build(raw).value();
    const test::RandomBody body = test::bodyInClutter(random, 1 + random.below(8), center);
    const auto mesh = test::meshWithin(body.avatar, random, 6, 0.9);
    Options options;
    draw(random, body, kObjects, options);
    options.cxx.surface = AvatarSurface::build(body.avatar, mesh).value();

    const auto query =
        test::makeQuery(test::makeScene(raw), test::makeAvatar(body.avatar, mesh), &options.c);
    ASSERT_NE(query, nullptr);
    const test::PoseArrays from(body.from), to(body.to);
    const ft_pose first = from.view(), second = to.view();
    ASSERT_EQ(ft_query_step(query.get(), &first, &second), FT_OK) << ft_last_error();
    const ChainMotion motion = body.motion();
    const Query question = Query::build(body.avatar, scene, options.cxx).value();
    Scratch scratch;
    const StepContacts step = question.answer(motion, scratch);

    std::vector<ft_contact> links(step.links.size());
    links[0].size = sizeof(ft_contact);
    std::size_t count = 0;
    ASSERT_EQ(ft_query_links(query.get(), links.data(), links.size(), &count), FT_OK);
    ASSERT_EQ(count, step.links.size());
    for (std::size_t link = 0; link < count; ++link) {
      expectSame(links[link], step.links[link], scene);
      seen.add(links[link]);
    }
    expectReported(query.get(), step, scene);
    seen.ofObjects += expectSameObjects(query.get(), step, scene, options.cxx.scope);
    seen.detailed += expectSameDetails(query.get(), FT_LIST_LINKS, step.links, question, motion);
    expectSameDetails(query.get(), FT_LIST_OBJECTS, step.perObject, question, motion);
    seen.passing += options.cxx.passSeparating;
    expectSameCounters(query.get(), step.counters);
    expectSameStates(query.get(), body, motion, random.uniform(0, 1), scene, options.cxx);
    expectSamePose(query.get(), motion, random.uniform(0, 1));
  }
  seen.expectMany(kCases);
}

TEST(CAnswers, FollowAStreamOfPosesFromWhereTheLastStepEnded) {
  Random random(7);
  const RawScene raw = test::clutter(random, 200, 2, Vector3d::Zero());
  const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
  const auto query = test::makeQuery(test::makeScene(raw), test::makeAvatar(body.avatar));
  const Scene scene = Scene::build(raw).value();
  const test::PoseArrays from(body.from), to(body.to);
  const ft_pose first = from.view(), second = to.view();
  ASSERT_EQ(ft_query_step(query.get(), &first, &second), FT_OK);
  ASSERT_EQ(ft_query_step(query.get(), nullptr, &first), FT_OK);  // and back
  const StepContacts back =
      firstContacts(body.avatar, ChainMotion(body.avatar.skeleton(), body.to, body.from), scene)
          .value();
  std::vector<ft_contact> links(back.links.size());
  links[0].size = sizeof(ft_contact);
  ASSERT_EQ(ft_query_links(query.get(), links.data(), links.size(), nullptr), FT_OK);
  for (std::size_t i = 0; i < links.size(); ++i) expectSame(links[i], back.links[i], scene);
}

// A hand that was stopped above the floor goes on from where it stands: up it is free, down it is
// not. Its places are known in closed form.
TEST(CAnswers, GoOnFromWhereTheAvatarWasStopped) {
  test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  options.pass_separating = 1;
  const auto query = test::makeQuery(world.scene, world.avatar, &options);
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_query_contacts(query.get(), &contact, 1, nullptr), FT_OK);
  ft_contact_details details{};
  details.size = sizeof details;
  ASSERT_EQ(ft_query_details(query.get(), FT_LIST_CONTACTS, 0, &details), FT_OK);
  EXPECT_NEAR(details.velocity_link[1], -1.5, 1e-12);
  EXPECT_LE(details.approach_lower, 1.5);
  EXPECT_GE(details.approach_upper, 1.5);
  EXPECT_GE(details.point_count, 2);  // both ends of a stick that lies flat

  double rotation[4], translation[3];
  ASSERT_EQ(ft_motion_pose(query.get(), contact.toi, rotation, translation, 1, nullptr), FT_OK);
  EXPECT_NEAR(translation[1], 1 - 1.5 * contact.toi, 1e-12);
  const ft_pose stopped = test::SmallWorld::poseOf(rotation, translation);
  ASSERT_EQ(ft_query_step(query.get(), &stopped, &up), FT_OK);
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CLEAR);
  ASSERT_EQ(ft_query_step(query.get(), &stopped, &lowered), FT_OK);
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);
  EXPECT_EQ(contact.toi, 0.0);
  options.pass_separating = 0;
  ASSERT_EQ(ft_query_set_options(query.get(), &options), FT_OK);
  ASSERT_EQ(ft_query_step(query.get(), &stopped, &up), FT_OK);
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);  // held where it stands
}

TEST(CAnswers, OutliveTheHandlesTheyWereMadeOf) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  world.scene.reset();
  world.avatar.reset();
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);
  // 1 m less the radius, at 1.5 m in the unit of t.
  EXPECT_LE(contact.toi, 0.96 / 1.5);
  EXPECT_GT(contact.toi, 0.95 / 1.5);
}

TEST(CAnswers, OfAStepThatFailedAreThoseOfTheOneBefore) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  const double nan[3] = {0, std::nan(""), 0};
  const ft_pose bad = test::SmallWorld::poseOf(test::SmallWorld::kIdentity, nan);
  EXPECT_EQ(ft_query_step(query.get(), nullptr, &bad), FT_ERROR_NON_FINITE);
  EXPECT_EQ(ft_query_step(query.get(), &bad, &up), FT_ERROR_NON_FINITE);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);
  ASSERT_EQ(ft_query_step(query.get(), nullptr, &up), FT_OK);  // from `lowered` still
  ft_transform start;
  ASSERT_EQ(ft_motion_transforms(query.get(), 0, &start, 1, nullptr), FT_OK);
  EXPECT_EQ(start.translation[1], test::SmallWorld::kLowered[1]);
}

}  // namespace
}  // namespace foretouch
