#include "tools/solid/solid_player.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "articulated/try.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// An error about an option of the library is one about the option that sets it.
Error withOptionNames(Error error) {
  static const std::map<std::string, std::string> kOptions = {
      {"skin", "--solid-skin"},      {"tolerance", "--tolerance"},  {"catchUp", "--catch-up"},
      {"aroundPerTick", "--around"}, {"workBudget", "--budget-us"}, {"dtS", "--rate"}};
  const auto found = kOptions.find(error.file);
  if (found != kOptions.end()) error.file = found->second;
  return error;
}

double microsecondsFrom(Clock::time_point start) {
  constexpr double kTenths = 10.0;
  const double us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  return std::round(kTenths * us) / kTenths;
}

}  // namespace

bool areSamePoses(const Pose& a, const Pose& b) {
  const auto isSame = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x.front()) == 0);
  };
  return isSame(a.rotations, b.rotations) && isSame(a.translations, b.translations);
}

bool PlayedTick::isShownTracked() const {
  return areSamePoses(answer.shown, tracked);
}

SolidOptions solidOptionsOf(const SolidRequest& request, const ReplayInputs& inputs,
                            bool hasTolerance) {
  constexpr double kToleranceOfSkin = 0.25;
  SolidOptions options = request.options;
  options.tolerance = hasTolerance ? inputs.query.tolerance
                                   : std::min(options.tolerance, kToleranceOfSkin * options.skin);
  options.ignored = inputs.query.ignored;
  options.self = inputs.query.self;
  if (inputs.request.budgetUs > 0) options.workBudget = inputs.query.workBudget;
  return options;
}

Result<SolidOptions> completedOptions(const ReplayInputs& inputs, const SolidOptions& options) {
  const auto built = SolidAvatar::build(inputs.avatar, inputs.scene, options);
  if (!built.ok()) return withOptionNames(built.error());
  return built.value().options();
}

Result<Done> playSolid(const ReplayInputs& inputs, const SolidOptions& options,
                       const TickSink& sink) {
  auto built = SolidAvatar::build(inputs.avatar, inputs.scene, options);
  if (!built.ok()) return withOptionNames(built.error());
  SolidAvatar& solid = built.value();
  PlayedTick played;
  for (std::int64_t tick = 0; tick < ticksOf(inputs); ++tick) {
    played.tick = tick;
    played.timeS = inputs.timeOfStep(tick);
    FORETOUCH_TRY(played.tracked, poseAtFrame(inputs, inputs.steps.frameOf(tick)));
    const Clock::time_point start = Clock::now();
    const auto followed = solid.follow({played.tracked, tickS(inputs)}, played.answer);
    if (!followed.ok()) return withOptionNames(followed.error());
    played.latencyUs = microsecondsFrom(start);
    if (!sink(played)) return Done{};
  }
  return Done{};
}

}  // namespace foretouch::tools
