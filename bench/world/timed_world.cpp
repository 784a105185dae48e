#include "bench/world/timed_world.h"

#include <algorithm>
#include <utility>

#include "bench/machine.h"
#include "middleware/world/window_query.h"

namespace foretouch::tools {
namespace {

/// All input here is the benchmark's own: an error stops the program, and says why.
template <typename T>
T mustBeOk(Result<T> result) {
  return std::move(result).value();
}

}  // namespace

double WindowFigures::perWindow(std::uint64_t count) const {
  return answerUs.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(windows());
}

TimedWorld::TimedWorld(std::optional<Scene> still)
    : world_(mustBeOk(World::build(std::move(still), {kBenchWorldTolerance}))) {}

BodyId TimedWorld::add(const Person& person, bool asksSelf, BodyGroup group) {
  BodyOptions options;
  options.group = group;
  const Avatar& avatar = person.clip->actor->avatar;
  if (auto rules = PairRules::derive(avatar); asksSelf && rules.ok()) {
    options.self = std::move(rules).value();
  }
  return add(person, options);
}

BodyId TimedWorld::add(const Person& person, const BodyOptions& options) {
  return mustBeOk(world_.add(person.clip->actor->avatar, options));
}

void TimedWorld::push(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  const ThreadStopwatch watch;
  mustBeOk(world_.push(body, utimeUs, pose));
  pushedUs_ += watch.us();
}

void TimedWorld::ask(std::int64_t fromUs, std::int64_t toUs, bool isCounted) {
  const ThreadStopwatch watch;
  mustBeOk(world_.contacts(fromUs, toUs, scratch_, answer_));
  const double us = watch.us();
  world_.forgetBefore(toUs);
  const double pushed = std::exchange(pushedUs_, 0.0);
  if (!isCounted) return;
  figures.answerUs.push_back(us);
  figures.pushUs.push_back(pushed);
  internal::addCounters(answer_.counters, figures.sum);
  for (const WorldContact& contact : answer_.contacts) {
    figures.contacts += contact.verdict == Verdict::Contact;
    figures.starts += contact.verdict == Verdict::StartsInContact;
    figures.undecided += contact.verdict == Verdict::Undecided;
  }
}

void runCrowd(const std::vector<Person>& people, const CrowdWindows& windows, TimedWorld& world) {
  std::vector<std::int64_t> next(people.size(), 0);
  std::int64_t begin = 0;
  for (const Person& person : people) begin = std::max(begin, person.instant(0));
  for (int window = 0; window < windows.warm + windows.counted; ++window) {
    const std::int64_t end = begin + windows.windowUs;
    for (std::size_t i = 0; i < people.size(); ++i) {
      while (next[i] == 0 || people[i].instant(next[i] - 1) < end) {
        world.push(static_cast<BodyId>(i), people[i].instant(next[i]), people[i].pose(next[i]));
        ++next[i];
      }
    }
    world.ask(begin, end, window >= windows.warm);
    begin = end;
  }
}

}  // namespace foretouch::tools
