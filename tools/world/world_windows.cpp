#include "tools/world/world_windows.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "articulated/try.h"
#include "middleware/world/world.h"

namespace foretouch::tools {
namespace {

/// The part of the world's time that is asked.
struct AskedTime {
  std::int64_t fromUs = 0, untilUs = 0;
};

Result<AskedTime> askedTime(const LoadedWorld& world, const WindowRequest& request) {
  AskedTime asked{world.beginUs, world.endUs};
  const auto read = [&](const char* option, const std::optional<std::int64_t>& instantUs,
                        std::int64_t& place) -> Result<Done> {
    place = instantUs.value_or(place);
    if (place >= world.beginUs && place <= world.endUs) return Done{};
    return Error::in(
        option, ErrorCode::OutOfRange,
        fmt::format("expected an instant of the world, {} s to {} s, found {} s",
                    LoadedWorld::secondsOf(world.beginUs), LoadedWorld::secondsOf(world.endUs),
                    LoadedWorld::secondsOf(place)));
  };
  FORETOUCH_CHECK(read("--from", request.fromUs, asked.fromUs));
  FORETOUCH_CHECK(read("--until", request.untilUs, asked.untilUs));
  if (asked.untilUs > asked.fromUs) return asked;
  return Error::in(
      "--until", ErrorCode::OutOfRange,
      fmt::format("expected an instant after {} s, found {} s",
                  LoadedWorld::secondsOf(asked.fromUs), LoadedWorld::secondsOf(asked.untilUs)));
}

/// Where a body appears or changes its carrier.
void addChanges(const LoadedWorld& world, std::vector<std::int64_t>& cuts) {
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const LoadedBody& body = world.bodies[i];
    for (const BodyStretch& stretch : body.stretches) cuts.push_back(stretch.beginUs);
  }
}

void addKnots(const LoadedWorld& world, std::vector<std::int64_t>& cuts) {
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const LoadedBody& body = world.bodies[i];
    if (body.numPoses == 0) continue;
    for (const BodyStretch& stretch : body.stretches) {
      const Track& track = stretch.track;
      for (std::int64_t us = track.knownFromUs(); us <= track.knownUntilUs();
           us = track.nextKnotUs(us)) {
        cuts.push_back(us);
      }
    }
  }
}

/// Bodies in a trigger touch nothing by that.
void leaveOutTriggers(const LoadedWorld& world, WorldContacts& answer) {
  const auto isOne = [&](BodyId body) { return world.isTrigger(body); };
  auto& contacts = answer.contacts;
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                [&](const WorldContact& contact) {
                                  return isOne(contact.a.body) || isOne(contact.b.body);
                                }),
                 contacts.end());
  auto& silent = answer.silent;
  silent.erase(std::remove_if(silent.begin(), silent.end(),
                              [&](const SilentBody& one) { return isOne(one.body); }),
               silent.end());
}

}  // namespace

Result<std::vector<std::int64_t>> windowsOf(const LoadedWorld& world,
                                            const WindowRequest& request) {
  FORETOUCH_TRY(const AskedTime asked, askedTime(world, request));
  std::vector<std::int64_t> cuts{asked.fromUs, asked.untilUs};
  addChanges(world, cuts);
  if (request.rateHz) {
    const double periodUs = kUsPerS / *request.rateHz;
    const double count = static_cast<double>(asked.untilUs - asked.fromUs) / periodUs;
    if (!(count <= static_cast<double>(kMostWindows))) {
      return Error::in(
          "--rate", ErrorCode::LimitExceeded,
          fmt::format("expected at most {} windows, found {:.3g}", kMostWindows, count));
    }
    for (std::int64_t i = 1; static_cast<double>(i) < count; ++i) {
      cuts.push_back(asked.fromUs + std::llround(static_cast<double>(i) * periodUs));
    }
  } else {
    addKnots(world, cuts);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const auto isOutside = [&](std::int64_t us) { return us < asked.fromUs || us > asked.untilUs; };
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(), isOutside), cuts.end());
  return cuts;
}

Result<Done> replayWorld(const LoadedWorld& world, const std::vector<std::int64_t>& cuts,
                         const std::function<bool(const WorldStep&)>& take) {
  using Clock = std::chrono::steady_clock;
  Scratch scratch;
  WorldContacts answer;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const auto begin = Clock::now();
    const auto asked = world.world.contacts(cuts[i], cuts[i + 1], scratch, answer);
    const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
    if (!asked.ok()) {
      Error error = named(asked.error(), world.file);
      error.file = world.file.path;
      return error;
    }
    if (world.file.hasTriggers()) leaveOutTriggers(world, answer);
    const WorldStep step{static_cast<std::int64_t>(i), cuts[i], cuts[i + 1], answer, took.count()};
    if (!take(step)) break;
  }
  return Done{};
}

Result<std::vector<WorldContact>> overlapsAtStart(const LoadedWorld& world) {
  std::set<std::int64_t> appearances;
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    appearances.insert(world.bodies[i].stretches.front().beginUs);
  }
  std::vector<WorldContact> found;
  const auto appears = [&](const ContactSide& side, std::int64_t utimeUs) {
    return side.body != kStillScene &&
           world.bodies[slotOf(side.body)].stretches.front().beginUs == utimeUs;
  };
  for (const std::int64_t us : appearances) {
    if (us + 1 > world.endUs) continue;
    const auto asked = replayWorld(world, {us, us + 1}, [&](const WorldStep& step) {
      for (const WorldContact& contact : step.answer.contacts) {
        if (contact.verdict != Verdict::StartsInContact) continue;
        if (appears(contact.a, us) || appears(contact.b, us)) found.push_back(contact);
      }
      return true;
    });
    if (!asked.ok()) return asked.error();
  }
  return found;
}

}  // namespace foretouch::tools
