// bindings/c/person.cpp: ft_brackets, what a person surely touched and may have touched.
#include "bindings/c/include/foretouch/person.h"

#include <memory>
#include <utility>
#include <vector>

#include "articulated/motion_model.h"
#include "articulated/try.h"
#include "assets/bounds/bound_presets.h"
#include "bindings/c/handles.h"
#include "bindings/c/link_bounds.h"
#include "bindings/c/query_options.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"
#include "middleware/bracket/bracket.h"

/// For one thread.
struct ft_brackets {
  static constexpr auto kMark = foretouch::c::Mark::Brackets;
  static constexpr const char* kName = "brackets";
  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;
  foretouch::Scene scene;
  foretouch::BracketQuery question;
  foretouch::Scratch scratch;
  foretouch::Pose before, from, to, after;
  std::vector<foretouch::LinkBound> bounds;
  foretouch::StepBrackets answer;
  bool hasAnswer = false;
};

namespace foretouch::c {
namespace {

/// The most seconds that a step or a gap may last.
constexpr double kMaxSeconds = 1e6;

ft_bracket_options defaultOptions() {
  ft_bracket_options options{};
  options.size = sizeof options;
  options.fidelity = FT_FIDELITY_LINK;
  options.resolution = BracketOptions{}.resolution;
  options.work_budget = BracketOptions{}.workBudget;
  return options;
}

ft_status readOptions(const ft_bracket_options* given, const AvatarParts& avatar,
                      BracketOptions& options) {
  ft_bracket_options known = defaultOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_bracket_options", known); s != FT_OK) return s;
  }
  if (known.fidelity != FT_FIDELITY_LINK && known.fidelity != FT_FIDELITY_EXACT) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "fidelity: expected FT_FIDELITY_LINK or _EXACT, found %d", known.fidelity);
  }
  if (known.fidelity == FT_FIDELITY_EXACT) {
    if (const auto s = checkedTriangles(avatar); s != FT_OK) return s;
    options.surface = avatar.surface;
  }
  options.resolution = known.resolution;
  options.workBudget = known.work_budget;
  if (known.self != nullptr) {
    if (const auto s = checked(known.self); s != FT_OK) return s;
    options.self = known.self->rules;
  }
  return readIgnored(known.ignored, known.ignored_count, options.ignored);
}

ft_status readModel(std::int32_t given, MotionModel& model) {
  switch (given) {
    case FT_BETWEEN_CONSTANT_RATE: model = MotionModel::ConstantRate; return FT_OK;
    case FT_BETWEEN_CUBIC: model = MotionModel::Cubic; return FT_OK;
    case FT_BETWEEN_CUBIC_LATE: model = MotionModel::CubicLate; return FT_OK;
    default: break;
  }
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "between: expected one of FT_BETWEEN_*, found %d",
                 given);
}

ft_status checkedSeconds(double seconds, const char* name) {
  if (seconds > 0.0 && seconds <= kMaxSeconds) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                 "%s: expected seconds, above 0 and at most 1e6, found %g", name, seconds);
}

struct GivenStep {
  PosedStep step;
  MotionModel model = MotionModel::ConstantRate;
};

/// A pose around the step, if it is given.
ft_status readNeighbour(const ft_pose* given, double seconds, const char* name,
                        const char* secondsName, const Skeleton& skeleton, Pose& pose,
                        const Pose*& known) {
  known = nullptr;
  if (given == nullptr) return FT_OK;
  if (const auto s = checkedSeconds(seconds, secondsName); s != FT_OK) return s;
  if (const auto s = readPose(given, name, skeleton, pose); s != FT_OK) return s;
  known = &pose;
  return FT_OK;
}

ft_status readStep(const ft_posed_step* given, ft_brackets& brackets, GivenStep& step) {
  ft_posed_step known{};
  if (const auto s = needed(given, "step"); s != FT_OK) return s;
  if (const auto s = readStruct(given, "ft_posed_step", known); s != FT_OK) return s;
  if (const auto s = readModel(known.between, step.model); s != FT_OK) return s;
  if (const auto s = checkedSeconds(known.seconds, "seconds"); s != FT_OK) return s;
  const Skeleton& skeleton = brackets.avatar->avatar.skeleton();
  if (const auto s = readPose(known.from, "from", skeleton, brackets.from); s != FT_OK) return s;
  if (const auto s = readPose(known.to, "to", skeleton, brackets.to); s != FT_OK) return s;
  step.step = {nullptr,       &brackets.from,     &brackets.to, nullptr, known.seconds_before,
               known.seconds, known.seconds_after};
  const auto s = readNeighbour(known.before, known.seconds_before, "before", "seconds_before",
                               skeleton, brackets.before, step.step.before);
  if (s != FT_OK) return s;
  return readNeighbour(known.after, known.seconds_after, "after", "seconds_after", skeleton,
                       brackets.after, step.step.after);
}

ft_status readBounds(const ft_link_bound* given, std::size_t count,
                     std::vector<LinkBound>& bounds) {
  if (const auto s = neededArray(given, count, countOf(kMaxJoints), "bounds"); s != FT_OK) return s;
  bounds.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ft_link_bound& from = given[i];
    bounds[i] = {from.error, from.acceleration, from.follow_floor,      from.follow_share,
                 from.speed, from.ahead_speed,  from.ahead_acceleration};
  }
  return FT_OK;
}

ft_link_bound boundOf(const LinkBound& bound) {
  return {bound.error, bound.acceleration, bound.followFloor,      bound.followShare,
          bound.speed, bound.aheadSpeed,   bound.aheadAcceleration};
}

/// `ask(step, model)` answers into `brackets`.
template <typename Ask>
ft_status answered(const char* function, ft_brackets* handle, const ft_posed_step* given,
                   const ft_link_bound* bounds, std::size_t count, const Ask& ask) {
  return guarded(function, [&]() -> ft_status {
    if (const auto s = checked(handle); s != FT_OK) return s;
    GivenStep step;
    if (const auto s = readStep(given, *handle, step); s != FT_OK) return s;
    if (const auto s = readBounds(bounds, count, handle->bounds); s != FT_OK) return s;
    // An exception leaves no answer, and memory that nothing may be read from.
    const bool hadAnswer = std::exchange(handle->hasAnswer, false);
    if (!hadAnswer) handle->scratch.forget(foretouch::internal::ScratchKind::Bracket);
    const auto done = ask(*handle, step);
    handle->hasAnswer = done.ok() || hadAnswer;
    return done.ok() ? FT_OK : failure(done.error());
  });
}

ft_link_bracket bracketOf(const LinkBracket& bracket, const Scene& scene) {
  ft_link_bracket b{};
  b.link = bracket.link;
  b.other = bracket.other;
  b.verdict = static_cast<std::int32_t>(bracket.verdict);
  b.triangle = bracket.triangle;
  b.object = bracket.triangle < 0 ? -1 : scene.object(bracket.triangle);
  b.possible_from = bracket.possibleFrom;
  b.possible_until = bracket.possibleUntil;
  b.certain_from = bracket.certainFrom;
  b.certain_until = bracket.certainUntil;
  b.growth = bracket.growth;
  return b;
}

ft_status write(const char* function, const ft_brackets* handle, const char* name,
                std::vector<LinkBracket> StepBrackets::*list, ft_link_bracket* given,
                std::size_t capacity, std::size_t* required) {
  return guarded(function, [&]() -> ft_status {
    if (const auto s = checked(handle); s != FT_OK) return s;
    if (!handle->hasAnswer) {
      return failure(FT_ERROR_NO_STEP, kNoIndex, "expected an answered ft_brackets_answer()");
    }
    const std::vector<LinkBracket>& found = handle->answer.*list;
    const auto at = [&](std::size_t i) { return bracketOf(found[i], handle->scene); };
    return writeList("ft_link_bracket", name, found.size(), at, given, capacity, required);
  });
}

}  // namespace

ft_status writeBounds(const Result<BoundsFile>& file, const std::string& name,
                      const ft_avatar* avatar, std::int32_t between, double rateHz,
                      ft_link_bound* bounds, std::size_t capacity, std::size_t* required) {
  if (const auto s = checked(avatar); s != FT_OK) return s;
  MotionModel model{};
  if (const auto s = readModel(between, model); s != FT_OK) return s;
  if (!file.ok()) return failure(file.error());
  FORETOUCH_TRY_OR(
      failure, const auto known,
      inFile(boundsOf(file.value(), avatar->parts->avatar.skeleton(), model, rateHz), name));
  const auto& found = known.bounds;
  const Room room = roomFor(found.size(), bounds, capacity, required, "bounds");
  if (room.status != FT_OK || room.isAsking) return room.status;
  for (std::size_t i = 0; i < found.size(); ++i) bounds[i] = boundOf(found[i]);
  return FT_OK;
}

}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_link_bound_init(ft_link_bound* bound) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(bound, "bound"); s != FT_OK) return s;
    *bound = boundOf(LinkBound{});
    return FT_OK;
  });
}

ft_status ft_bounds_read(const char* path, const ft_avatar* avatar, int32_t between, double rate_hz,
                         ft_link_bound* bounds, size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    return writeBounds(readBounds(path), path, avatar, between, rate_hz, bounds, capacity,
                       required);
  });
}

ft_status ft_bracket_options_init(ft_bracket_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_bracket_options", defaultOptions());
}

ft_status ft_posed_step_init(ft_posed_step* step, size_t size) {
  return initStruct(__func__, step, size, "ft_posed_step", ft_posed_step{});
}

ft_status ft_brackets_create(const ft_scene* scene, const ft_avatar* avatar,
                             const ft_bracket_options* options, ft_brackets** brackets) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(brackets); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    BracketOptions known;
    if (const auto s = readOptions(options, *avatar->parts, known); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto question,
                     BracketQuery::build(avatar->parts->avatar, scene->scene, known));
    *brackets = new ft_brackets{ft_brackets::kMark,
                                avatar->parts,
                                scene->scene,
                                std::move(question),
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                false};
    return FT_OK;
  });
}

ft_status ft_brackets_answer(ft_brackets* brackets, const ft_posed_step* step,
                             const ft_link_bound* bounds, size_t count) {
  return answered(__func__, brackets, step, bounds, count, [](ft_brackets& b, const GivenStep& s) {
    return b.question.answer(s.step, s.model, b.bounds, b.scratch, b.answer);
  });
}

ft_status ft_brackets_answer_gap(ft_brackets* brackets, const ft_posed_step* step,
                                 const ft_link_bound* bounds, size_t count) {
  return answered(__func__, brackets, step, bounds, count, [](ft_brackets& b, const GivenStep& s) {
    return b.question.answerGap(s.step, b.bounds, b.scratch, b.answer);
  });
}

ft_status ft_brackets_look_ahead(ft_brackets* brackets, const ft_posed_step* step, double horizon,
                                 const ft_link_bound* bounds, size_t count) {
  return answered(__func__, brackets, step, bounds, count,
                  [horizon](ft_brackets& b, const GivenStep& s) {
                    return b.question.lookAhead(s.step, horizon, b.bounds, b.scratch, b.answer);
                  });
}

ft_status ft_brackets_links(const ft_brackets* brackets, ft_link_bracket* links, size_t capacity,
                            size_t* required) {
  return write(__func__, brackets, "links", &StepBrackets::links, links, capacity, required);
}

ft_status ft_brackets_pairs(const ft_brackets* brackets, ft_link_bracket* pairs, size_t capacity,
                            size_t* required) {
  return write(__func__, brackets, "pairs", &StepBrackets::pairs, pairs, capacity, required);
}

void ft_brackets_destroy(ft_brackets* brackets) {
  destroy(__func__, brackets);
}
