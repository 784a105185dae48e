#include "tests/world_fuzz/fuzz_run.h"

#include <cstring>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "tests/world_fuzz/fuzz_in_c.h"
#include "tools/world/followed_world.h"
#include "tools/world/load_world.h"
#include "tools/world/world_windows.h"

namespace foretouch::test {
namespace {

Result<FuzzTold> askedAll(tools::LoadedWorld& world) {
  FuzzTold told;
  told.beginUs = world.beginUs;
  told.endUs = world.endUs;
  FORETOUCH_CHECK(tools::followWorld(world, world.beginUs, world.endUs, [&](const auto& stretch) {
    const auto &events = stretch.contacts.events, &more = told.events;
    told.events.insert(more.end(), events.begin(), events.end());
    const auto& inside = stretch.triggers.events;
    told.triggerEvents.insert(told.triggerEvents.end(), inside.begin(), inside.end());
    return true;
  }));
  FORETOUCH_TRY(told.cuts, tools::windowsOf(world, {}));
  FORETOUCH_CHECK(tools::replayWorld(world, told.cuts, [&](const tools::WorldStep& step) {
    told.windows.push_back(step.answer);
    return true;
  }));
  return told;
}

Result<tools::LoadedWorld> loaded(const std::string& text) {
  FORETOUCH_TRY(auto file, tools::parseWorldFile(text, "world.toml"));
  return tools::loadWorld(std::move(file));
}

bool areSame(const ContactSide& x, const ContactSide& y) {
  return x.body == y.body && x.link == y.link && x.lss == y.lss && x.triangle == y.triangle &&
         x.p_W == y.p_W;
}

bool areSame(const WorldContact& x, const WorldContact& y) {
  return x.verdict == y.verdict && x.time == y.time && x.separation == y.separation &&
         areSame(x.a, y.a) && areSame(x.b, y.b);
}

bool areSame(const WorldEvent& x, const WorldEvent& y) {
  return x.kind == y.kind && x.cause == y.cause && x.reason == y.reason &&
         x.isAssumed == y.isAssumed && x.time == y.time && x.since == y.since &&
         areSame(x.a, y.a) && areSame(x.b, y.b) && x.separation == y.separation &&
         x.nhat_BA_W == y.nhat_BA_W && x.velocity_W == y.velocity_W;
}

bool areSame(const TriggerEvent& x, const TriggerEvent& y) {
  return x.kind == y.kind && x.trigger == y.trigger && x.body == y.body && x.link == y.link &&
         x.time == y.time && x.since == y.since && x.isAssumed == y.isAssumed;
}

template <typename One>
bool areSame(const std::vector<One>& x, const std::vector<One>& y) {
  if (x.size() != y.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!areSame(x[i], y[i])) return false;
  }
  return true;
}

bool areSame(const FuzzTold& x, const FuzzTold& y) {
  if (x.beginUs != y.beginUs || x.endUs != y.endUs || x.cuts != y.cuts) return false;
  for (std::size_t i = 0; i < x.windows.size(); ++i) {
    if (!areSame(x.windows[i].contacts, y.windows[i].contacts)) return false;
  }
  return areSame(x.events, y.events) && areSame(x.triggerEvents, y.triggerEvents);
}

}  // namespace

FuzzTally runFuzzWorld(std::uint64_t seed, const std::function<void(FuzzTold&)>& lie) {
  FuzzTally tally;
  tally.worlds = 1;
  const FuzzWorld world = drawFuzzWorld(seed);
  const auto ask = [&](std::uint64_t order) -> Result<FuzzTold> {
    FORETOUCH_TRY(auto read, loaded(textOf(world, order)));
    FORETOUCH_TRY(auto told, askedAll(read));
    // Once is enough: the second order has the same poses.
    if (order == seed) {
      const std::string other = otherInC(world, read, told);
      if (!other.empty()) tally.say(FuzzFault::Differs, "in C: " + other);
    }
    return told;
  };
  auto told = ask(seed);
  const auto again = ask(seed + 1);
  for (const Result<FuzzTold>* const one : {&std::as_const(told), &again}) {
    if (!one->ok()) tally.say(FuzzFault::Refused, describe(one->error()));
  }
  if (!told.ok() || !again.ok()) return tally;
  if (!areSame(told.value(), again.value())) {
    tally.say(FuzzFault::Differs, "in another order of the tables");
  }
  FuzzTold judged = std::move(told).value();
  if (lie) lie(judged);
  judgeFuzzWorld(world, judged, tally);
  return tally;
}

}  // namespace foretouch::test
