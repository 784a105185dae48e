// Every way in which a query, a step and what is asked of it can be refused.
#include <cstring>
#include <limits>

#include "tests/bindings/c_world.h"

namespace foretouch {
namespace {

using test::expectRefused;
using test::refuse;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr auto kNegative = static_cast<std::size_t>(-1);

struct Asking {
  test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  [[nodiscard]] ft_status make() const {
    ft_query* query = reinterpret_cast<ft_query*>(1);
    const ft_status status =
        ft_query_create(world.scene.get(), world.avatar.get(), &options, &query);
    EXPECT_EQ(query == nullptr, status != FT_OK);
    ft_query_destroy(query);
    return status;
  }
};

TEST(CQueryErrors, OfQueryOptions) {
  EXPECT_EQ(Asking().make(), FT_OK);
  const ft_ignored_pair ignored[1] = {{0, 1}};
  const ft_link_policy policies[2] = {{1e-3, FT_FIDELITY_LINK, 0}, {1e-3, FT_FIDELITY_LINK, 0}};
  for (const double tolerance : {0.0, -1.0, kNotANumber, 1e-10, 2e7}) {
    Asking a;
    a.options.tolerance = tolerance;
    expectRefused(a.make(), FT_ERROR_OUT_OF_RANGE, {"tolerance"});
  }
  refuse<Asking>([&](Asking& a) { a.options.deadline_us = kNotANumber; }, FT_ERROR_OUT_OF_RANGE,
                 {"deadline"});
  refuse<Asking>([&](Asking& a) { a.options.deadline_us = -1; }, FT_ERROR_OUT_OF_RANGE,
                 {"deadline"});
  refuse<Asking>([&](Asking& a) { a.options.fidelity = 5; }, FT_ERROR_OUT_OF_RANGE,
                 {"fidelity", "5"});
  refuse<Asking>([&](Asking& a) { a.options.fidelity = FT_FIDELITY_EXACT; }, FT_ERROR_MISMATCH,
                 {"triangles"});
  refuse<Asking>([&](Asking& a) { a.options.scope = -1; }, FT_ERROR_OUT_OF_RANGE, {"scope"});
  refuse<Asking>([&](Asking& a) { a.options.scope = 3; }, FT_ERROR_OUT_OF_RANGE, {"scope", "3"});
  refuse<Asking>([&](Asking& a) { a.options.reserved = 1; }, FT_ERROR_STRUCT_SIZE, {"reserved"});
  refuse<Asking>([&](Asking& a) { a.options.reserved_end = 1; }, FT_ERROR_STRUCT_SIZE,
                 {"reserved"});
  refuse<Asking>([&](Asking& a) { a.options.ignored_count = 1; }, FT_ERROR_NULL_ARGUMENT,
                 {"ignored"});
  refuse<Asking>(
      [&](Asking& a) {
        a.options.ignored_count = kNegative;
        a.options.ignored = ignored;
      },
      FT_ERROR_LIMIT_EXCEEDED, {"ignored"});
  refuse<Asking>(
      [&](Asking& a) {
        a.options.ignored_count = 1;
        a.options.ignored = ignored;
      },
      FT_ERROR_OUT_OF_RANGE, {"ignored"});
  refuse<Asking>([&](Asking& a) { a.options.policy_count = 1; }, FT_ERROR_NULL_ARGUMENT,
                 {"policies"});
  refuse<Asking>(
      [&](Asking& a) {
        a.options.policy_count = 2;
        a.options.policies = policies;
      },
      FT_ERROR_MISMATCH, {"one per link"});
  refuse<Asking>(
      [&](Asking& a) {
        a.options.policy_count = kNegative;
        a.options.policies = policies;
      },
      FT_ERROR_LIMIT_EXCEEDED, {"policies"});
  for (const ft_link_policy policy : {ft_link_policy{kNotANumber, 0, 0}, ft_link_policy{1e-3, 1, 0},
                                      ft_link_policy{1e-3, 77, 0}}) {
    Asking a;
    a.options.policy_count = 1;
    a.options.policies = &policy;
    expectRefused(a.make(), FT_ERROR_OUT_OF_RANGE, {});
    EXPECT_EQ(ft_last_error_index(), 0);
  }
  const ft_link_policy reserved = {1e-3, FT_FIDELITY_LINK, 1};
  Asking a;
  a.options.policies = &reserved;
  a.options.policy_count = 1;
  expectRefused(a.make(), FT_ERROR_STRUCT_SIZE, {"reserved"});
}

ft_object_policy policyOf(std::int32_t link, std::int32_t object) {
  return {link, object, 0.0, FT_UNCHANGED, FT_UNCHANGED};
}

TEST(CQueryErrors, OfObjectPolicies) {
  refuse<Asking>([](Asking& a) { a.options.object_policy_count = 1; }, FT_ERROR_NULL_ARGUMENT,
                 {"object_policies"});
  const auto refused = [](const ft_object_policy& policy, ft_status status, const char* why) {
    Asking a;
    a.options.object_policies = &policy;
    a.options.object_policy_count = 1;
    expectRefused(a.make(), status, {why});
    EXPECT_EQ(ft_last_error_index(), 0) << why;
  };
  refused(policyOf(7, FT_EVERY_OBJECT), FT_ERROR_OUT_OF_RANGE, "expected links");
  refused(policyOf(-2, FT_EVERY_OBJECT), FT_ERROR_OUT_OF_RANGE, "expected links");
  refused(policyOf(0, 9), FT_ERROR_OUT_OF_RANGE, "expected links");
  ft_object_policy policy = policyOf(0, FT_EVERY_OBJECT);
  for (const double tolerance : {kNotANumber, -1.0, 1e-10, 2e7}) {
    policy.tolerance = tolerance;
    refused(policy, FT_ERROR_OUT_OF_RANGE, "tolerance");
  }
  policy.tolerance = 0.0;
  policy.fidelity = 1;
  refused(policy, FT_ERROR_OUT_OF_RANGE, "limb is gone");
  policy.fidelity = 77;
  refused(policy, FT_ERROR_OUT_OF_RANGE, "77");
  policy.fidelity = FT_FIDELITY_LINK;
  policy.object = 0;
  refused(policy, FT_ERROR_MISMATCH, "no objects beside it");
  policy = policyOf(0, 0);
  policy.ignore = 2;
  refused(policy, FT_ERROR_OUT_OF_RANGE, "ignore");
}

// Nothing reads a pair that is not there, nor takes a number for a tolerance that is none.
TEST(CQueryErrors, OfOptionsBesideObjectPolicies) {
  const ft_object_policy policy = {0, 0, 1e-3, FT_UNCHANGED, FT_UNCHANGED};
  const ft_ignored_pair far[] = {{0, 1 << 30}};
  Asking a;
  a.options.object_policies = &policy;
  a.options.object_policy_count = 1;
  a.options.ignored = far;
  a.options.ignored_count = 1;
  expectRefused(a.make(), FT_ERROR_OUT_OF_RANGE, {"ignored"});
  a.options.ignored_count = 0;
  a.options.tolerance = kNotANumber;
  expectRefused(a.make(), FT_ERROR_OUT_OF_RANGE, {"tolerance"});
}

// What looks beyond the first contact is honoured link by link, or refused by name.
TEST(CQueryErrors, OfOptionsBeyondTheFirstContact) {
  const auto ofEveryObject = [](Asking& a) { a.options.scope = FT_SCOPE_EVERY_OBJECT; };
  refuse<Asking>([&](Asking& a) { ofEveryObject(a), a.options.work_budget = 1000; },
                 FT_ERROR_MISMATCH, {"scope", "budget"});
  refuse<Asking>([&](Asking& a) { ofEveryObject(a), a.options.deadline_us = 1000; },
                 FT_ERROR_MISMATCH, {"scope", "budget"});
  refuse<Asking>([](Asking& a) { a.options.pass_separating = 2; }, FT_ERROR_OUT_OF_RANGE,
                 {"pass_separating", "2"});
}

// Programs that were compiled with an older header still ask by these numbers.
TEST(CQueryErrors, OfFidelitiesThatAreGone) {
  const char* const gone[] = {"limb", "avatar", "ellipsoid"};
  for (std::int32_t i = 0; i < 3; ++i) {
    refuse<Asking>([&](Asking& a) { a.options.fidelity = i + 1; }, FT_ERROR_OUT_OF_RANGE,
                   {"fidelity: " + std::string(gone[i]) + " is gone: ", "use link"});
  }
}

TEST(CQueryErrors, OfDetails) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  ft_contact_details details{};
  details.size = sizeof details;
  const auto expectNot = [&](std::int32_t list, std::size_t index, ft_status status,
                             const std::vector<std::string>& words) {
    expectRefused(ft_query_details(query.get(), list, index, &details), status, words);
  };
  expectNot(FT_LIST_LINKS, 0, FT_ERROR_NO_STEP, {"ft_query_step"});
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &up), FT_OK);
  expectNot(FT_LIST_LINKS, 0, FT_ERROR_MISMATCH, {"clear"});
  expectNot(FT_LIST_CONTACTS, 0, FT_ERROR_OUT_OF_RANGE, {"index", "0 contacts"});
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  expectNot(FT_LIST_LINKS, 1, FT_ERROR_OUT_OF_RANGE, {"index", "1 contacts", "found 1"});
  EXPECT_EQ(ft_last_error_index(), 1);
  expectNot(FT_LIST_LINKS, kNegative, FT_ERROR_OUT_OF_RANGE, {"index"});
  expectNot(4, 0, FT_ERROR_OUT_OF_RANGE, {"list", "4"});
  expectNot(-1, 0, FT_ERROR_OUT_OF_RANGE, {"list", "-1"});
  expectNot(FT_LIST_OBJECTS, 0, FT_ERROR_MISMATCH, {"FT_SCOPE_EVERY_OBJECT"});
  expectNot(FT_LIST_PAIRS, 0, FT_ERROR_MISMATCH, {"ft_query_set_pair_rules"});
  expectRefused(ft_query_details(query.get(), FT_LIST_LINKS, 0, nullptr), FT_ERROR_NULL_ARGUMENT,
                {"details"});
  details.size = 3;
  expectNot(FT_LIST_LINKS, 0, FT_ERROR_STRUCT_SIZE, {"ft_contact_details", "3"});
  // An older program's struct is filled as far as it goes.
  std::memset(&details, 0x5a, sizeof details);
  details.size = 64;
  ASSERT_EQ(ft_query_details(query.get(), FT_LIST_LINKS, 0, &details), FT_OK);
  EXPECT_NEAR(details.approach_speed, 1.5, 1e-12);
  EXPECT_EQ(std::memcmp(&details.approach_lower, "ZZZZZZZZ", 8), 0) << "written past the end";
}

TEST(CQueryErrors, OfPosesOnTheWay) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  double rotation[4] = {}, translation[3] = {};
  std::size_t joints = 0;
  expectRefused(ft_motion_pose(query.get(), 0, rotation, translation, 1, &joints), FT_ERROR_NO_STEP,
                {"ft_query_step"});
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  for (const double t : {-0.1, 1.1, kNotANumber}) {
    expectRefused(ft_motion_pose(query.get(), t, rotation, translation, 1, &joints),
                  FT_ERROR_OUT_OF_RANGE, {"t:"});
  }
  expectRefused(ft_motion_pose(query.get(), 0, rotation, translation, 0, &joints),
                FT_ERROR_BUFFER_TOO_SMALL, {"room for 1"});
  EXPECT_EQ(joints, 1u);
  ASSERT_EQ(ft_motion_pose(query.get(), 1, nullptr, translation, 1, nullptr), FT_OK);
  EXPECT_EQ(translation[1], test::SmallWorld::kLowered[1]);
  expectRefused(ft_query_objects(query.get(), nullptr, 0, &joints), FT_ERROR_MISMATCH,
                {"FT_SCOPE_EVERY_OBJECT"});
}

TEST(CQueryErrors, OfSteps) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  const ft_pose up = world.up();
  expectRefused(ft_query_step(query.get(), nullptr, &up), FT_ERROR_NO_STEP, {"from"});
  expectRefused(ft_query_step(query.get(), &up, nullptr), FT_ERROR_NULL_ARGUMENT, {"to"});
  ft_pose pose = up;
  pose.joint_count = 2;
  expectRefused(ft_query_step(query.get(), &up, &pose), FT_ERROR_MISMATCH, {"to", "1 joints", "2"});
  pose = up;
  pose.rotations = nullptr;
  expectRefused(ft_query_step(query.get(), &pose, &up), FT_ERROR_NULL_ARGUMENT, {"rotations"});
  pose = up;
  pose.size = 3;
  expectRefused(ft_query_step(query.get(), &pose, &up), FT_ERROR_STRUCT_SIZE, {"from"});
  const double rotation[4] = {2, 0, 0, 0}, far[3] = {0, 1e8, 0};
  pose = test::SmallWorld::poseOf(rotation, test::SmallWorld::kUp);
  expectRefused(ft_query_step(query.get(), &up, &pose), FT_ERROR_OUT_OF_RANGE,
                {"to", "stick", "norm"});
  EXPECT_EQ(ft_last_error_index(), 0);
  pose = test::SmallWorld::poseOf(test::SmallWorld::kIdentity, far);
  expectRefused(ft_query_step(query.get(), &up, &pose), FT_ERROR_OUT_OF_RANGE, {"1e7"});
  pose.translations = nullptr;  // the rest offset
  EXPECT_EQ(ft_query_step(query.get(), &up, &pose), FT_OK);
}

TEST(CQueryErrors, OfAnswers) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  ft_contact contact{};
  contact.size = sizeof contact;
  ft_transform transform;
  ft_counters counters{};
  counters.size = sizeof counters;
  std::int32_t touches = 7;
  std::size_t count = 7;
  const auto expectNoStep = [&] {
    expectRefused(ft_query_links(query.get(), &contact, 1, &count), FT_ERROR_NO_STEP,
                  {"ft_query_step"});
    expectRefused(ft_query_contacts(query.get(), &contact, 1, &count), FT_ERROR_NO_STEP, {});
    expectRefused(ft_motion_transforms(query.get(), 0, &transform, 1, &count), FT_ERROR_NO_STEP,
                  {});
    expectRefused(ft_touches_at(query.get(), 0, 0, &touches), FT_ERROR_NO_STEP, {});
    expectRefused(ft_query_counters(query.get(), &counters), FT_ERROR_NO_STEP, {});
  };
  expectNoStep();
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  expectRefused(ft_query_links(query.get(), nullptr, 1, &count), FT_ERROR_NULL_ARGUMENT,
                {"contacts"});
  expectRefused(ft_query_links(query.get(), &contact, 0, &count), FT_ERROR_BUFFER_TOO_SMALL,
                {"room for 1"});
  EXPECT_EQ(count, 1u);
  contact.size = 0;
  expectRefused(ft_query_contacts(query.get(), &contact, 1, &count), FT_ERROR_STRUCT_SIZE,
                {"ft_contact"});
  for (const double t : {-0.1, 1.1, kNotANumber, std::numeric_limits<double>::infinity()}) {
    expectRefused(ft_motion_transforms(query.get(), t, &transform, 1, &count),
                  FT_ERROR_OUT_OF_RANGE, {"t:"});
    expectRefused(ft_touches_at(query.get(), 0, t, &touches), FT_ERROR_OUT_OF_RANGE, {"t:"});
  }
  expectRefused(ft_motion_transforms(query.get(), 0, &transform, 0, nullptr),
                FT_ERROR_BUFFER_TOO_SMALL, {});
  expectRefused(ft_touches_at(query.get(), 1, 0, &touches), FT_ERROR_OUT_OF_RANGE, {"link"});
  expectRefused(ft_touches_at(query.get(), -1, 0, &touches), FT_ERROR_OUT_OF_RANGE, {"link"});
  expectRefused(ft_touches_at(query.get(), 0, 0, nullptr), FT_ERROR_NULL_ARGUMENT, {"touches"});
  expectRefused(ft_query_counters(query.get(), nullptr), FT_ERROR_NULL_ARGUMENT, {"ft_counters"});
  EXPECT_EQ(touches, 7);
  ASSERT_EQ(ft_touches_at(query.get(), 0, 1, &touches), FT_OK);
  EXPECT_EQ(touches, 0);  // it went right through
  ASSERT_EQ(ft_query_set_options(query.get(), nullptr), FT_OK);
  expectNoStep();
  EXPECT_EQ(ft_query_step(query.get(), nullptr, &up), FT_OK);  // the pose is kept
}

}  // namespace
}  // namespace foretouch
