// bindings/c/pair_rules.cpp: ft_pair_rules.
#include "articulated/pair_rules.h"

#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "bindings/c/handles.h"
#include "bindings/c/robot_handle.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(PairReason::Asked) == FT_PAIR_ASKED);
static_assert(static_cast<int>(PairReason::Adjacent) == FT_PAIR_ADJACENT);
static_assert(static_cast<int>(PairReason::RestOverlap) == FT_PAIR_REST_OVERLAP);
static_assert(static_cast<int>(PairReason::Always) == FT_PAIR_ALWAYS);
static_assert(static_cast<int>(PairReason::User) == FT_PAIR_USER);

/// All pairs of the largest avatar.
constexpr std::size_t kMaxPairs = countOf(kMaxJoints) * countOf(kMaxJoints) / 2;
/// A million poses of thirty joints take a gigabyte.
constexpr std::size_t kMaxUsualPoses = std::size_t{1} << 20;

ft_pair_rule_options defaultRuleOptions() {
  const PairRuleOptions defaults;
  ft_pair_rule_options options{};
  options.size = sizeof options;
  options.rest_skin = defaults.restSkin;
  options.always_share = defaults.alwaysShare;
  return options;
}

ft_status readUsualPoses(const ft_pair_rule_options& given, const Skeleton& skeleton,
                         std::vector<Pose>& poses) {
  const auto s =
      neededArray(given.usual_rotations, given.usual_count, kMaxUsualPoses, "usual_rotations");
  if (s != FT_OK) return s;
  const auto joints = countOf(skeleton.numJoints());
  for (std::size_t i = 0; i < given.usual_count; ++i) {
    Pose pose = restPose(skeleton);
    for (std::size_t j = 0; j < joints; ++j) {
      const double* const q = given.usual_rotations + 4 * (i * joints + j);
      pose.rotations[j] = Quaternion(q[0], q[1], q[2], q[3]);
      if (given.usual_translations == nullptr) continue;
      pose.translations[j] =
          Eigen::Map<const Eigen::Vector3d>(given.usual_translations + 3 * (i * joints + j));
    }
    FORETOUCH_TRY_OR(failure, auto valid,
                     inFile(validatedPose(skeleton, std::move(pose)), "usual_rotations"));
    poses.push_back(std::move(valid));
  }
  return FT_OK;
}

ft_status readPairs(const ft_link_pair* given, std::size_t count, const char* name,
                    std::vector<LinkPair>& pairs) {
  if (const auto s = neededArray(given, count, kMaxPairs, name); s != FT_OK) return s;
  for (std::size_t i = 0; i < count; ++i) pairs.push_back({given[i].a, given[i].b});
  return FT_OK;
}

ft_robot_pair_options defaultRobotOptions() {
  const RobotPairOptions defaults;
  ft_robot_pair_options options{};
  options.size = sizeof options;
  options.samples = defaults.samples;
  options.seed = defaults.seed;
  options.always_share = defaults.alwaysShare;
  return options;
}

ft_status readExactly(const ft_left_out_pair* given, std::size_t count,
                      std::vector<LeftOutPair>& leftOut) {
  if (const auto s = neededArray(given, count, kMaxPairs, "left_out"); s != FT_OK) return s;
  for (std::size_t i = 0; i < count; ++i) {
    if (given[i].reason < FT_PAIR_ADJACENT || given[i].reason > FT_PAIR_USER) {
      return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(i),
                     "left_out: expected a `reason` from FT_PAIR_ADJACENT to FT_PAIR_USER, found "
                     "%d",
                     given[i].reason);
    }
    leftOut.push_back({given[i].a, given[i].b, static_cast<PairReason>(given[i].reason)});
  }
  return FT_OK;
}

/// The library's options by their names here.
Result<PairRules> withNames(Result<PairRules> made) {
  if (made.ok()) return made;
  Error error = made.error();
  if (error.file == "restSkin") error.file = "rest_skin";
  if (error.file == "alwaysShare") error.file = "always_share";
  return error;
}

ft_status makeRules(Result<PairRules> made, ft_pair_rules** rules) {
  FORETOUCH_TRY_OR(failure, auto known, std::move(made));
  *rules = new ft_pair_rules{ft_pair_rules::kMark, std::move(known)};
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_pair_rule_options_init(ft_pair_rule_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_pair_rule_options", defaultRuleOptions());
}

ft_status ft_pair_rules_create(const ft_avatar* avatar, const ft_pair_rule_options* options,
                               ft_pair_rules** rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(rules); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    ft_pair_rule_options known = defaultRuleOptions();
    if (options != nullptr) {
      const auto s = readStruct(options, "ft_pair_rule_options", known);
      if (s != FT_OK) return s;
    }
    if (known.use_pair_radii != 0 && known.use_pair_radii != 1) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "use_pair_radii: expected 0 or 1, found %d",
                     known.use_pair_radii);
    }
    const Avatar& of = avatar->parts->avatar;
    PairRuleOptions given;
    given.usePairRadii = known.use_pair_radii == 1;
    given.restSkin = known.rest_skin;
    given.alwaysShare = known.always_share;
    const auto s = readPairs(known.left_out, known.left_out_count, "left_out", given.leftOut);
    if (s != FT_OK) return s;
    std::vector<Pose> poses;
    if (const auto r = readUsualPoses(known, of.skeleton(), poses); r != FT_OK) return r;
    given.usualPoses = &poses;
    return makeRules(withNames(PairRules::derive(of, given)), rules);
  });
}

ft_status ft_pair_rules_create_exactly(const ft_avatar* avatar, const ft_left_out_pair* left_out,
                                       size_t left_out_count, const ft_pair_radius* radii,
                                       size_t radius_count, ft_pair_rules** rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(rules); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    std::vector<LeftOutPair> pairs;
    if (const auto s = readExactly(left_out, left_out_count, pairs); s != FT_OK) return s;
    if (const auto s = neededArray(radii, radius_count, kMaxPairs, "radii"); s != FT_OK) return s;
    std::vector<PairRadius> own;
    for (std::size_t i = 0; i < radius_count; ++i) {
      own.push_back({radii[i].a, radii[i].lss_a, radii[i].b, radii[i].lss_b, radii[i].radius});
    }
    return makeRules(PairRules::leavingOut(avatar->parts->avatar, std::move(pairs), std::move(own)),
                     rules);
  });
}

ft_status ft_pair_rules_create_asking(const ft_avatar* avatar, const ft_link_pair* asked,
                                      size_t asked_count, ft_pair_rules** rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(rules); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    std::vector<LinkPair> pairs;
    if (const auto s = readPairs(asked, asked_count, "asked", pairs); s != FT_OK) return s;
    return makeRules(PairRules::asking(avatar->parts->avatar, pairs), rules);
  });
}

ft_status ft_robot_pair_options_init(ft_robot_pair_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_robot_pair_options", defaultRobotOptions());
}

ft_status ft_pair_rules_create_of_robot(const ft_robot* robot, const ft_robot_pair_options* options,
                                        ft_pair_rules** rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(rules); s != FT_OK) return s;
    if (const auto s = checked(robot); s != FT_OK) return s;
    ft_robot_pair_options known = defaultRobotOptions();
    if (options != nullptr) {
      const auto s = readStruct(options, "ft_robot_pair_options", known);
      if (s != FT_OK) return s;
    }
    RobotPairOptions given{known.samples, known.seed, known.always_share, {}};
    const auto s = readPairs(known.left_out, known.left_out_count, "left_out", given.leftOut);
    if (s != FT_OK) return s;
    // The robot's own avatar is the one that ft_robot_avatar() hands out.
    return makeRules(withNames(PairRules::derive(robot->robot, given)), rules);
  });
}

ft_status ft_pair_rules_create_from_file(const char* path, const ft_avatar* avatar,
                                         ft_pair_rules** rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(rules); s != FT_OK) return s;
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    return makeRules(readPairsFile(path, avatar->parts->avatar), rules);
  });
}

ft_status ft_pair_rules_get_info(const ft_pair_rules* rules, ft_pair_rules_info* info) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(rules); s != FT_OK) return s;
    ft_pair_rules_info known{};
    known.pairs = static_cast<std::uint64_t>(rules->rules.numPairs());
    known.asked = static_cast<std::uint64_t>(rules->rules.numAsked());
    known.left_out = rules->rules.leftOut().size();
    known.radii = rules->rules.radii().size();
    return writeStruct(info, "ft_pair_rules_info", known);
  });
}

ft_status ft_pair_rules_left_out(const ft_pair_rules* rules, ft_left_out_pair* pairs,
                                 size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(rules); s != FT_OK) return s;
    const auto& all = rules->rules.leftOut();
    const Room room = roomFor(all.size(), pairs, capacity, required, "pairs");
    if (room.status != FT_OK || room.isAsking) return room.status;
    for (std::size_t i = 0; i < all.size(); ++i) {
      pairs[i] = {all[i].a, all[i].b, static_cast<std::int32_t>(all[i].reason)};
    }
    return FT_OK;
  });
}

ft_status ft_pair_rules_radii(const ft_pair_rules* rules, ft_pair_radius* radii, size_t capacity,
                              size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(rules); s != FT_OK) return s;
    const auto& all = rules->rules.radii();
    const Room room = roomFor(all.size(), radii, capacity, required, "radii");
    if (room.status != FT_OK || room.isAsking) return room.status;
    for (std::size_t i = 0; i < all.size(); ++i) {
      radii[i] = {all[i].a, all[i].lssA, all[i].b, all[i].lssB, all[i].radius};
    }
    return FT_OK;
  });
}

ft_status ft_pair_rules_touches(const ft_pair_rules* rules, ft_pair_touches* pairs, size_t capacity,
                                size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(rules); s != FT_OK) return s;
    const auto& all = rules->rules.touches();
    const Room room = roomFor(all.size(), pairs, capacity, required, "pairs");
    if (room.status != FT_OK || room.isAsking) return room.status;
    for (std::size_t i = 0; i < all.size(); ++i) {
      pairs[i] = {all[i].a, all[i].b, all[i].touches};
    }
    return FT_OK;
  });
}

void ft_pair_rules_destroy(ft_pair_rules* rules) {
  destroy(__func__, rules);
}
