// Pair rules in C: they are those of the C++ library, and what a query answers by them is too.
#include "articulated/pair_rules.h"

#include <cstring>
#include <vector>

#include "assets/avatar/avatar_file.h"
#include "middleware/query/query.h"
#include "tests/bindings/c_world.h"
#include "tests/bindings/same_answers.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using test::expectRefused;

/// A trunk with two hands, spheres of 0.05 m; the left one at x = `leftX` at rest.
Avatar figure(double leftX = 0.5) {
  RawSkeleton raw;
  const auto add = [&](const char* name, JointId parent, const Eigen::Vector3d& offset) {
    RawJoint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = offset;
    raw.joints.push_back(joint);
  };
  add("Trunk", kNoParent, {0, 2, 0});
  add("LeftHand", 0, {leftX, -1, 0});
  add("RightHand", 0, {-0.2, -1, 0});
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return Avatar::build(Skeleton::build(raw).value(),
                       {{{zero, zero, 0.1}}, {{zero, zero, 0.05}}, {{zero, zero, 0.05}}})
      .value();
}

RawScene farFloor() {
  return {{Triangle{{Eigen::Vector3d(-9, -9, -9), Eigen::Vector3d(9, -9, -9),
                     Eigen::Vector3d(0, -9, 9)}}},
          {0},
          {"floor"}};
}

/// The handle that a call makes; the call must succeed.
template <typename Make>
test::RulesHandle madeBy(const Make& make) {
  ft_pair_rules* rules = nullptr;
  EXPECT_EQ(make(&rules), FT_OK) << ft_last_error();
  return test::RulesHandle(rules);
}

std::vector<ft_left_out_pair> leftOutOf(const test::RulesHandle& rules) {
  std::size_t count = 0;
  EXPECT_EQ(ft_pair_rules_left_out(rules.get(), nullptr, 0, &count), FT_OK);
  std::vector<ft_left_out_pair> pairs(count);
  EXPECT_EQ(ft_pair_rules_left_out(rules.get(), pairs.data(), count, &count), FT_OK);
  return pairs;
}

ft_pair_rules_info infoOf(const test::RulesHandle& rules) {
  ft_pair_rules_info info{};
  info.size = sizeof info;
  EXPECT_EQ(ft_pair_rules_get_info(rules.get(), &info), FT_OK);
  return info;
}

TEST(CPairRules, AreDerivedListedAndMadeAgain) {
  const Avatar avatar = figure(-0.12);
  const test::AvatarHandle handle = test::makeAvatar(avatar);
  ft_pair_rule_options options = test::initialised(ft_pair_rule_options_init);
  EXPECT_EQ(options.rest_skin, PairRuleOptions().restSkin);
  EXPECT_EQ(options.always_share, PairRuleOptions().alwaysShare);
  options.use_pair_radii = 1;
  const auto rules = madeBy(
      [&](ft_pair_rules** made) { return ft_pair_rules_create(handle.get(), &options, made); });
  const ft_pair_rules_info info = infoOf(rules);
  EXPECT_EQ(info.pairs, 3u);
  EXPECT_EQ(info.asked, 1u);
  EXPECT_EQ(info.left_out, 2u);
  EXPECT_EQ(info.radii, 1u);
  const auto leftOut = leftOutOf(rules);
  ASSERT_EQ(leftOut.size(), 2u);
  EXPECT_EQ(leftOut[1].a, 0);
  EXPECT_EQ(leftOut[1].b, 2);
  EXPECT_EQ(leftOut[1].reason, FT_PAIR_ADJACENT);
  ft_pair_radius radius{};
  std::size_t required = 0;
  ASSERT_EQ(ft_pair_rules_radii(rules.get(), &radius, 1, &required), FT_OK);
  EXPECT_NEAR(radius.radius, 0.078, 1e-12);

  const auto same = madeBy([&](ft_pair_rules** made) {
    return ft_pair_rules_create_exactly(handle.get(), leftOut.data(), leftOut.size(), &radius, 1,
                                        made);
  });
  EXPECT_EQ(std::memcmp(leftOutOf(same).data(), leftOut.data(), sizeof(ft_left_out_pair) * 2), 0);
  EXPECT_EQ(infoOf(same).radii, 1u);
}

TEST(CPairRules, AskOnlyWhatIsListed) {
  const Avatar avatar = figure(-0.12);
  const test::AvatarHandle handle = test::makeAvatar(avatar);
  const ft_link_pair asked{2, 0};
  const auto rules = madeBy([&](ft_pair_rules** made) {
    return ft_pair_rules_create_asking(handle.get(), &asked, 1, made);
  });
  EXPECT_EQ(infoOf(rules).asked, 1u);
  const auto leftOut = leftOutOf(rules);
  ASSERT_EQ(leftOut.size(), 2u);
  for (const ft_left_out_pair& pair : leftOut) {
    EXPECT_EQ(pair.reason, FT_PAIR_USER);
    EXPECT_FALSE(pair.a == 0 && pair.b == 2);
  }
  std::size_t required = 9;
  EXPECT_EQ(ft_pair_rules_touches(rules.get(), nullptr, 0, &required), FT_OK);
  EXPECT_EQ(required, 0u);
  ft_pair_rules* none = nullptr;
  expectRefused(ft_pair_rules_create_asking(handle.get(), nullptr, 0, &none), FT_ERROR_EMPTY,
                {"at least one pair"});
}

TEST(CPairRules, LookAtUsualPosesAndAtFiles) {
  const Avatar avatar = figure();
  const test::AvatarHandle handle = test::makeAvatar(avatar);
  const test::PoseArrays rest(restPose(avatar.skeleton()));
  std::vector<double> rotations = rest.rotations, translations = rest.translations;
  translations[3] = -0.15;  // the left hand at the right one
  ft_pair_rule_options options = test::initialised(ft_pair_rule_options_init);
  options.usual_rotations = rotations.data();
  options.usual_translations = translations.data();
  options.usual_count = 1;
  ft_pair_rules* none = nullptr;
  expectRefused(ft_pair_rules_create(handle.get(), &options, &none), FT_ERROR_EMPTY,
                {"at least one pair"});
  EXPECT_EQ(none, nullptr);

  const test::TempFolder folder;
  const std::string path = folder / "figure.pairs.json";
  ASSERT_TRUE(writePairsFile(PairRules::derive(avatar).value(), avatar, path).ok());
  const auto read = madeBy([&](ft_pair_rules** made) {
    return ft_pair_rules_create_from_file(path.c_str(), handle.get(), made);
  });
  EXPECT_EQ(leftOutOf(read).size(), 2u);
}

TEST(CPairRules, AnswerWhatTheCxxLibraryAnswers) {
  const Avatar avatar = figure();
  const RawScene raw = farFloor();
  const test::AvatarHandle handle = test::makeAvatar(avatar);
  const test::SceneHandle scene = test::makeScene(raw);
  const test::QueryHandle query = test::makeQuery(scene, handle);
  Pose from = restPose(avatar.skeleton()), to = from;
  to.translations[1].x() = -0.7;
  const test::PoseArrays fromArrays(from), toArrays(to);
  const ft_pose fromC = fromArrays.view(), toC = toArrays.view();
  ft_contact contact{};
  contact.size = sizeof contact;
  ft_other_link other{};
  std::size_t required = 0;
  ASSERT_EQ(ft_query_step(query.get(), &fromC, &toC), FT_OK);
  expectRefused(ft_query_pairs(query.get(), &contact, &other, 1, &required), FT_ERROR_MISMATCH,
                {"ft_query_set_pair_rules"});

  auto rules = madeBy(
      [&](ft_pair_rules** made) { return ft_pair_rules_create(handle.get(), nullptr, made); });
  ASSERT_EQ(ft_query_set_pair_rules(query.get(), rules.get()), FT_OK) << ft_last_error();
  rules.reset();  // the query keeps none of the handle
  expectRefused(ft_query_pairs(query.get(), &contact, &other, 1, &required), FT_ERROR_NO_STEP, {});
  ASSERT_EQ(ft_query_step(query.get(), &fromC, &toC), FT_OK);
  ASSERT_EQ(ft_query_pairs(query.get(), nullptr, nullptr, 0, &required), FT_OK);
  EXPECT_EQ(required, 1u);
  expectRefused(ft_query_pairs(query.get(), &contact, nullptr, 1, &required),
                FT_ERROR_NULL_ARGUMENT, {"others"});
  ASSERT_EQ(ft_query_pairs(query.get(), &contact, &other, 1, &required), FT_OK);

  QueryOptions options;
  options.self = PairRules::derive(avatar).value();
  const Query question = Query::build(avatar, Scene::build(raw).value(), options).value();
  Scratch scratch;
  const StepContacts step = question.answer(ChainMotion(avatar.skeleton(), from, to), scratch);
  ASSERT_EQ(step.pairs.size(), 1u);
  EXPECT_EQ(contact.link, 1);
  EXPECT_EQ(other.link, 2);
  EXPECT_EQ(other.lss, step.pairs[0].otherLss);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);
  EXPECT_EQ(contact.toi, step.pairs[0].toi);
  EXPECT_EQ(contact.separation, step.pairs[0].separation);
  EXPECT_EQ(contact.point_scene[0], step.pairs[0].p_WScene.x());
  EXPECT_EQ(contact.triangle, -1);
  EXPECT_EQ(contact.object, -1);

  ft_contact_details details{};
  details.size = sizeof details;
  ASSERT_EQ(ft_query_details(query.get(), FT_LIST_PAIRS, 0, &details), FT_OK) << ft_last_error();
  test::expectSame(
      details, question.details(ChainMotion(avatar.skeleton(), from, to), step.pairs[0], scratch));
  EXPECT_NEAR(details.velocity_link[0], -1.2, 1e-12);  // one hand moves, from 0.5 to -0.7
}

TEST(CPairRules, AreAskedBesideEveryObject) {
  const test::AvatarHandle handle = test::makeAvatar(figure());
  ft_query_options options = test::initialised(ft_query_options_init);
  options.scope = FT_SCOPE_EVERY_OBJECT;
  const test::QueryHandle query = test::makeQuery(test::makeScene(farFloor()), handle, &options);
  const auto rules = madeBy(
      [&](ft_pair_rules** made) { return ft_pair_rules_create(handle.get(), nullptr, made); });
  EXPECT_EQ(ft_query_set_pair_rules(query.get(), rules.get()), FT_OK) << ft_last_error();
  options.scope = FT_SCOPE_FIRST_OF_AVATAR;
  expectRefused(ft_query_set_options(query.get(), &options), FT_ERROR_MISMATCH,
                {"self", "links or objects"});
}

TEST(CPairRules, StayWhenOptionsChangeAndCanBeTakenAway) {
  const test::AvatarHandle handle = test::makeAvatar(figure());
  const test::AvatarHandle twin = test::makeAvatar(figure());
  const test::QueryHandle query = test::makeQuery(test::makeScene(farFloor()), handle);
  const auto create = [](const test::AvatarHandle& avatar) {
    return madeBy(
        [&](ft_pair_rules** made) { return ft_pair_rules_create(avatar.get(), nullptr, made); });
  };
  const auto rules = create(handle), others = create(twin);
  expectRefused(ft_query_set_pair_rules(query.get(), others.get()), FT_ERROR_MISMATCH,
                {"pair rules of this avatar"});
  ASSERT_EQ(ft_query_set_pair_rules(query.get(), rules.get()), FT_OK);
  ft_query_options options = test::initialised(ft_query_options_init);
  options.scope = FT_SCOPE_FIRST_OF_AVATAR;
  expectRefused(ft_query_set_options(query.get(), &options), FT_ERROR_MISMATCH,
                {"self", "scope links"});
  ASSERT_EQ(ft_query_set_pair_rules(query.get(), nullptr), FT_OK);
  EXPECT_EQ(ft_query_set_options(query.get(), &options), FT_OK) << ft_last_error();
  expectRefused(ft_query_set_pair_rules(query.get(), rules.get()), FT_ERROR_MISMATCH,
                {"scope links"});
}

TEST(CPairRules, RefuseBadArguments) {
  const test::AvatarHandle handle = test::makeAvatar(figure());
  ft_pair_rules* rules = nullptr;
  const ft_left_out_pair unknown{0, 9, FT_PAIR_USER}, asked{0, 1, FT_PAIR_ASKED};
  expectRefused(ft_pair_rules_create_exactly(handle.get(), &unknown, 1, nullptr, 0, &rules),
                FT_ERROR_OUT_OF_RANGE, {"a link of the avatar"});
  EXPECT_EQ(ft_last_error_index(), 9);
  expectRefused(ft_pair_rules_create_exactly(handle.get(), &asked, 1, nullptr, 0, &rules),
                FT_ERROR_OUT_OF_RANGE, {"left_out", "reason"});
  const ft_pair_radius wide{1, 0, 2, 0, 0.2};
  expectRefused(ft_pair_rules_create_exactly(handle.get(), nullptr, 0, &wide, 1, &rules),
                FT_ERROR_OUT_OF_RANGE, {"radii", "below the sum"});
  ft_pair_rule_options options = test::initialised(ft_pair_rule_options_init);
  options.use_pair_radii = 2;
  expectRefused(ft_pair_rules_create(handle.get(), &options, &rules), FT_ERROR_OUT_OF_RANGE,
                {"use_pair_radii", "2"});
  options = test::initialised(ft_pair_rule_options_init);
  options.always_share = 0.0;
  expectRefused(ft_pair_rules_create(handle.get(), &options, &rules), FT_ERROR_OUT_OF_RANGE,
                {"always_share"});
  expectRefused(ft_pair_rules_create_from_file("/absent.json", handle.get(), &rules),
                FT_ERROR_FILE_NOT_FOUND, {"/absent.json"});
  EXPECT_EQ(rules, nullptr);
}

}  // namespace
}  // namespace foretouch
