// bindings/c/query.cpp: ft_query, from its making to the step.
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/handles.h"
#include "bindings/c/query_options.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {

ft_status copyPose(const ft_pose* given, const char* name, const Skeleton& skeleton, Pose& pose) {
  ft_pose known{};
  if (const auto s = readStruct(given, name, known); s != FT_OK) return s;
  const auto joints = countOf(skeleton.numJoints());
  if (known.joint_count != joints) {
    return failure(FT_ERROR_MISMATCH, kNoIndex, "%s: expected %zu joints, found %u", name, joints,
                   known.joint_count);
  }
  if (const auto s = needed(known.rotations, "rotations"); s != FT_OK) return s;
  pose.rotations.resize(joints);
  pose.translations.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const double* const q = known.rotations + 4 * j;
    pose.rotations[j] = Quaternion(q[0], q[1], q[2], q[3]);
    if (known.translations == nullptr) {
      pose.translations[j] = skeleton.restOffset(static_cast<JointId>(j));
    } else {
      pose.translations[j] = Eigen::Map<const Eigen::Vector3d>(known.translations + 3 * j);
    }
  }
  return FT_OK;
}

ft_status readPose(const ft_pose* given, const char* name, const Skeleton& skeleton, Pose& pose) {
  if (const auto s = copyPose(given, name, skeleton, pose); s != FT_OK) return s;
  FORETOUCH_TRY_OR(failure, pose, inFile(validatedPose(skeleton, std::move(pose)), name));
  return FT_OK;
}

namespace {

/// Answers query.from to query.to into query.next.
void answerNext(ft_query& query) {
  if (query.isScratchSuspect) query.scratch = Scratch();
  query.isScratchSuspect = true;
  query.next.motion.assign(query.avatar->avatar.skeleton(), query.from, query.to);
  query.question->answer(query.next.motion, query.scratch, query.next.answer);
  query.isScratchSuspect = false;
  const auto& links = query.next.answer.links;
  listReported(links.data(), links.size(), query.next.reported);
}

/// Names the option as C does.
Result<Query> builtQuery(const AvatarParts& avatar, const Scene& scene,
                         const QueryOptions& options) {
  auto built = Query::build(avatar.avatar, scene, options);
  if (built.ok() || built.error().file != "passSeparating") return built;
  Error error = built.error();
  error.file = "pass_separating";
  return error;
}

ft_status takeOptions(const ft_query_options* given, const Scene& scene, ft_query& query) {
  QueryOptions options;
  if (const auto s = readQueryOptions(given, *query.avatar, scene, options); s != FT_OK) return s;
  if (!(options.deadlineUs >= 0.0)) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "deadline_us: expected microseconds, at least 0, found %g", options.deadlineUs);
  }
  options.self = query.self;
  FORETOUCH_TRY_OR(failure, auto question, builtQuery(*query.avatar, scene, options));
  query.question.emplace(std::move(question));
  query.hasStep = false;
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_pose_init(ft_pose* pose, size_t size) {
  return initStruct(__func__, pose, size, "ft_pose", ft_pose{});
}

ft_status ft_query_create(const ft_scene* scene, const ft_avatar* avatar,
                          const ft_query_options* options, ft_query** query) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(query); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    auto made = std::make_unique<ft_query>(avatar->parts);
    const auto links = countOf(avatar->parts->avatar.numLinks());
    made->step.reported.reserve(links);
    made->next.reported.reserve(links);
    if (const auto s = takeOptions(options, scene->scene, *made); s != FT_OK) return s;
    *query = made.release();
    return FT_OK;
  });
}

ft_status ft_query_set_options(ft_query* query, const ft_query_options* options) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(query); s != FT_OK) return s;
    return takeOptions(options, query->question->scene(), *query);
  });
}

ft_status ft_query_set_pair_rules(ft_query* query, const ft_pair_rules* rules) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(query); s != FT_OK) return s;
    std::optional<PairRules> self;
    if (rules != nullptr) {
      if (const auto s = checked(rules); s != FT_OK) return s;
      self = rules->rules;
    }
    QueryOptions options = query->question->options();
    options.self = self;
    FORETOUCH_TRY_OR(failure, auto question,
                     builtQuery(*query->avatar, query->question->scene(), options));
    query->self = std::move(self);
    query->question.emplace(std::move(question));
    query->hasStep = false;
    return FT_OK;
  });
}

ft_status ft_query_step(ft_query* query, const ft_pose* from, const ft_pose* to) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(query); s != FT_OK) return s;
    const Skeleton& skeleton = query->avatar->avatar.skeleton();
    if (from != nullptr) {
      if (const auto s = readPose(from, "from", skeleton, query->from); s != FT_OK) return s;
    } else if (query->hasLast) {
      query->from = query->last;
    } else {
      return failure(FT_ERROR_NO_STEP, kNoIndex,
                     "from: expected a pose, because no earlier step ends where this one begins");
    }
    if (const auto s = readPose(to, "to", skeleton, query->to); s != FT_OK) return s;
    answerNext(*query);
    std::swap(query->step, query->next);
    std::swap(query->last, query->to);
    query->hasLast = query->hasStep = true;
    return FT_OK;
  });
}

void ft_query_destroy(ft_query* query) {
  destroy(__func__, query);
}
