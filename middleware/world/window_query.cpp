#include "middleware/world/window_query.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/world/body_sweeper.h"
#include "middleware/world/pair_asker.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {
namespace {

bool comesBefore(const ContactPlace& x, const ContactPlace& y) {
  if (!(x.time == y.time)) return x.time < y.time;
  return std::tie(x.bodyOfA, x.linkOfA, x.bodyOfB, x.linkOfB) <
         std::tie(y.bodyOfA, y.linkOfA, y.bodyOfB, y.linkOfB);
}

/// Sorts what consists of a few sorted runs, by merging them; `merged` is memory.
void sortRuns(std::vector<ContactPlace>& places, std::vector<ContactPlace>& merged) {
  constexpr int kFewRuns = 4;
  for (int run = 0; run < kFewRuns; ++run) {
    const auto middle = std::is_sorted_until(places.begin(), places.end(), comesBefore);
    if (middle == places.end()) return;
    const auto end = std::is_sorted_until(middle, places.end(), comesBefore);
    merged.resize(places.size());
    const auto rest = std::merge(places.begin(), middle, middle, end, merged.begin(), comesBefore);
    std::copy(end, places.end(), rest);
    places.swap(merged);
  }
  std::sort(places.begin(), places.end(), comesBefore);
}

/// Tasks that a thread takes at a time: each is some microseconds.
constexpr std::size_t kTasksAtOnce = 8;

/// One window. Which thread does what decides nothing: each body and each pair has answers of its
/// own, and their order is that of the contacts.
class WindowQuery {
 public:
  WindowQuery(const WorldParts& world, std::int64_t fromUs, std::int64_t toUs, WorkerPool* pool,
              WorldMemory& scratch, WorldContacts& answer, const FollowedLinks* followed)
      : world_(world),
        window_{fromUs, toUs, ++scratch.windows, Eigen::Vector3d::Zero(), followed != nullptr},
        pool_(pool),
        followed_(followed),
        scratch_(scratch),
        answer_(answer) {}

  Result<Done> run() {
    begin();
    tellSilent();
    FORETOUCH_CHECK(sweepBodies());
    scratch_.broad.collect(scratch_.boxes, scratch_.meeting);
    leaveCrowds();
    FORETOUCH_CHECK(sweepNear());
    FORETOUCH_CHECK(askPairs());
    gather();
    return Done{};
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(world_.bodies.size()); }

  void begin() {
    answer_.contacts.clear();
    answer_.silent.clear();
    answer_.counters = {};
    const std::size_t count = pool_ != nullptr ? static_cast<std::size_t>(pool_->threads()) : 1;
    while (scratch_.workers.size() < count) {
      scratch_.workers.push_back(std::make_unique<WindowWorker>());
    }
    const bool isNew = scratch_.world != world_.identity;
    for (const auto& worker : scratch_.workers) {
      if (isNew) worker->system.motions.clear();
      worker->contacts.clear();
      worker->undone.clear();
      worker->spent = 0;
      worker->counters = {};
    }
    if (isNew) {
      scratch_.plans.clear();
      scratch_.sweeps.clear();
      scratch_.world = world_.identity;
    }
    scratch_.sweeps.resize(countOf(numBodies()));
    scratch_.boxes.resize(countOf(numBodies()));
    window_.origin = windowOrigin();
  }

  void tellSilent() {
    for (BodyId id = 0; id < numBodies(); ++id) {
      const WorldBody& body = world_.body(id);
      if (body.episodes.empty() || body.episodes.back().isHeldFast()) continue;
      const std::int64_t last = body.episodes.back().track.knownUntilUs();
      if (last >= window_.toUs) continue;
      answer_.silent.push_back({id, std::max(last, window_.fromUs), body.options.whenSilent});
    }
  }

  [[nodiscard]] Eigen::Vector3d windowOrigin() const {
    for (const WorldBody& body : world_.bodies) {
      const Episode* const episode = body.episodeAt(window_.fromUs);
      if (episode == nullptr || episode->carrier) continue;
      return episode->track.pieceAt(window_.fromUs).from->translations[0];
    }
    return Eigen::Vector3d::Zero();
  }

  Result<Done> sweepBodies() {
    return forEach(world_.bodies.size(), [this](WindowWorker& worker, std::size_t i) {
      BodySweep& sweep = scratch_.sweeps[i];
      BodySweeper sweeper(world_, scratch_.plans, window_, worker.system);
      const auto body = static_cast<BodyId>(i);
      sweep.isRough = sweeper.sweepRoughly(body, sweep);
      Result<Done> done = Done{};
      if (!sweep.isRough) done = sweeper.sweep(body, sweep, worker.contacts, worker.counters);
      scratch_.boxes[i] = sweep.whole;
      worker.counters.bodies += sweep.whole.isEmpty() ? 0 : 1;
      return done;
    });
  }

  /// Reports each body that may meet too many others once, and leaves out pairs of such bodies.
  void leaveCrowds() {
    std::vector<std::uint32_t>& near = scratch_.numNear;
    scratch_.isCrowded.clear();
    const std::size_t most = world_.options.mostNear;
    if (scratch_.meeting.size() <= most) return;
    near.assign(world_.bodies.size(), 0);
    for (const MeetingBodies& pair : scratch_.meeting) {
      if (!world_.isAsked(pair.a, pair.b)) continue;
      ++near[slotOf(pair.a)];
      ++near[slotOf(pair.b)];
    }
    if (std::none_of(near.begin(), near.end(), [&](std::uint32_t n) { return n > most; })) return;
    std::vector<bool>& isCrowded = scratch_.isCrowded;
    for (const std::uint32_t n : near) isCrowded.push_back(n > most);
    // One that is silent as well is so from its last pose on, and crowded from the begin.
    auto& silent = answer_.silent;
    silent.erase(std::remove_if(silent.begin(), silent.end(),
                                [&](const SilentBody& s) { return isCrowded[slotOf(s.body)]; }),
                 silent.end());
    for (BodyId id = 0; id < numBodies(); ++id) {
      if (!isCrowded[slotOf(id)]) continue;
      silent.push_back({id, window_.fromUs, WhenSilent::Undecided, UndecidedReason::WorkBudget});
    }
    std::sort(silent.begin(), silent.end(),
              [](const SilentBody& x, const SilentBody& y) { return x.body < y.body; });
    std::vector<MeetingBodies>& pairs = scratch_.meeting;
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const MeetingBodies& pair) {
                                 return isCrowded[slotOf(pair.a)] && isCrowded[slotOf(pair.b)];
                               }),
                pairs.end());
  }

  /// Most props are far from everything: only the others need more than a rough box.
  Result<Done> sweepNear() {
    std::vector<BodyId>& near = scratch_.near;
    near.clear();
    for (const MeetingBodies& pair : scratch_.meeting) {
      if (!world_.isAsked(pair.a, pair.b)) continue;
      for (const BodyId body : {pair.a, pair.b}) {
        BodySweep& sweep = scratch_.sweeps[slotOf(body)];
        if (std::exchange(sweep.isRough, false)) near.push_back(body);
      }
    }
    return forEach(near.size(), [this](WindowWorker& worker, std::size_t i) {
      const BodyId body = scratch_.near[i];
      return BodySweeper(world_, scratch_.plans, window_, worker.system)
          .sweep(body, scratch_.sweeps[slotOf(body)], worker.contacts, worker.counters);
    });
  }

  Result<Done> askPairs() {
    sharePairs();
    FORETOUCH_CHECK(forEach(scratch_.meeting.size(), [this](WindowWorker& worker, std::size_t i) {
      return askPair(worker, i);
    }));
    // What is left over goes to those that need more, until that is not much more.
    while (shareRest()) {
      FORETOUCH_CHECK(forEach(scratch_.undone.size(), [this](WindowWorker& worker, std::size_t i) {
        return askPair(worker, scratch_.undone[i]);
      }));
    }
    return Done{};
  }

  Result<Done> askPair(WindowWorker& worker, std::size_t pair) {
    return PairAsker(world_, window_, followed_, scratch_, worker)
        .ask(pair, scratch_.shares.of(pair));
  }

  void sharePairs() {
    WorkShares& shares = scratch_.shares;
    shares.begin(world_.bodies.size());
    for (const MeetingBodies& pair : scratch_.meeting) {
      // A pair that is not asked costs nothing, and takes nothing from others.
      world_.isAsked(pair.a, pair.b) ? shares.add(pair.a, pair.b) : shares.addNobody();
    }
    shares.share(world_.options.workPerWindow, world_.options.workPerPair);
  }

  /// Shares out what is left; false if none gets more. All threads together have spent the same,
  /// whichever did what.
  bool shareRest() {
    std::uint64_t spent = 0;
    std::vector<std::size_t>& undone = scratch_.undone;
    undone.clear();
    for (const auto& worker : scratch_.workers) {
      spent += worker->spent;
      for (const UndonePair& pair : worker->undone) undone.push_back(pair.pair);
    }
    const std::uint64_t total = world_.options.workPerWindow;
    if (undone.empty() || total == WorkShares::kUnlimited || spent >= total) return false;
    std::sort(undone.begin(), undone.end());
    scratch_.shares.shareAgain(total - spent, world_.options.workPerPair, undone);
    for (const auto& worker : scratch_.workers) {
      std::vector<UndonePair>& all = worker->undone;
      all.erase(std::remove_if(all.begin(), all.end(),
                               [&](const UndonePair& pair) {
                                 return std::binary_search(undone.begin(), undone.end(), pair.pair);
                               }),
                all.end());
    }
    return !undone.empty();
  }

  /// Does all tasks; the error is that of the first one that fails.
  template <typename Task>
  Result<Done> forEach(std::size_t count, const Task& task) {
    if (pool_ == nullptr) {
      for (std::size_t i = 0; i < count; ++i) FORETOUCH_CHECK(task(*scratch_.workers[0], i));
      return Done{};
    }
    std::atomic<std::size_t> next{0};
    const auto takePart = [&](std::size_t number) {
      WindowWorker& worker = *scratch_.workers[number];
      worker.failure.clear();
      for (;;) {
        const std::size_t first = next.fetch_add(kTasksAtOnce, std::memory_order_relaxed);
        if (first >= count) return;
        for (std::size_t i = first; i < std::min(first + kTasksAtOnce, count); ++i) {
          worker.failure.attempt(
              i, [&] { return task(worker, i); },
              [&] {
                worker.system = SystemScratch();
                worker.apart = BodiesApart();
              });
        }
      }
    };
    pool_->run(std::ref(takePart));
    return FirstFailure::of(
        scratch_.workers.size(), [&](std::size_t i) -> const auto& {
          return scratch_.workers[i]->failure;
        });
  }

  void gather() {
    // Most touch on from the window before, and come in order: bodies, then pairs of them.
    std::vector<ContactPlace>&atBegin = scratch_.atBegin, &later = scratch_.later;
    atBegin.clear();
    later.clear();
    const WorldTime begin{window_.fromUs, 0.0};
    for (const auto& worker : scratch_.workers) {
      std::vector<WorldContact>& own = worker->contacts;
      for (const UndonePair& pair : worker->undone) {
        own.insert(own.end(), pair.found.begin(), pair.found.end());
      }
      for (const WorldContact& contact : own) {
        (begin < contact.time ? later : atBegin)
            .push_back({contact.time, contact.a.body, contact.a.link, contact.b.body,
                        contact.b.link, &contact});
      }
      addCounters(worker->counters, answer_.counters);
    }
    sortRuns(atBegin, scratch_.merged);
    std::sort(later.begin(), later.end(), comesBefore);
    answer_.contacts.reserve(atBegin.size() + later.size());
    for (const ContactPlace& place : atBegin) answer_.contacts.push_back(*place.contact);
    for (const ContactPlace& place : later) answer_.contacts.push_back(*place.contact);
  }

  const WorldParts& world_;
  Window window_;
  WorkerPool* pool_;
  const FollowedLinks* followed_;
  WorldMemory& scratch_;
  WorldContacts& answer_;
};

Error windowError(ErrorCode code, std::int64_t fromUs, std::int64_t toUs, const std::string& what) {
  return Error::in(
      "window", code,
      "the window from " + std::to_string(fromUs) + " to " + std::to_string(toUs) + " us " + what);
}

}  // namespace

Result<Done> checkedWindow(const World& world, std::int64_t fromUs, std::int64_t toUs) {
  if (fromUs >= toUs || fromUs < -kMostUtimeUs || toUs > kMostUtimeUs) {
    return windowError(ErrorCode::OutOfRange, fromUs, toUs,
                       "has no length, or no legal instants; expected from < to");
  }
  const std::int64_t forgotten = world.parts().forgottenUs;
  if (fromUs < forgotten) {
    return windowError(
        ErrorCode::OutOfRange, fromUs, toUs,
        "begins before " + std::to_string(forgotten) + " us; all before that is forgotten");
  }
  const auto known = world.knownUntilUs();
  if (known && toUs <= *known) return Done{};
  if (!known) {
    return windowError(ErrorCode::Empty, fromUs, toUs, "has no body in it; expected a pose of one");
  }
  const auto slowest = world.waitsFor();
  return windowError(ErrorCode::OutOfRange, fromUs, toUs,
                     "ends after what is known, until " + std::to_string(*known) + " us" +
                         (slowest ? ", of body " + std::to_string(*slowest) : std::string()));
}

void addCounters(const WorldCounters& more, WorldCounters& sum) {
  sum.bodies += more.bodies;
  sum.pairs += more.pairs;
  sum.nearPairs += more.nearPairs;
  sum.spans += more.spans;
  sum.work += more.work;
  addCounters(more.queries, sum.queries);
}

Result<Done> askWindow(const World& world, std::int64_t fromUs, std::int64_t toUs, WorkerPool* pool,
                       WorldMemory& scratch, WorldContacts& answer, const FollowedLinks* followed) {
  FORETOUCH_CHECK(checkedWindow(world, fromUs, toUs));
  return WindowQuery(world.parts(), fromUs, toUs, pool, scratch, answer, followed).run();
}

}  // namespace foretouch::internal

namespace foretouch {

Result<Done> World::contacts(std::int64_t fromUs, std::int64_t toUs, Scratch& scratch,
                             WorldContacts& answer) const {
  auto& parts = scratch.of<internal::WorldMemory>();
  return internal::askWindow(*this, fromUs, toUs, nullptr, parts, answer);
}

Result<Done> World::contacts(std::int64_t fromUs, std::int64_t toUs, WorkerPool& pool,
                             WorldContacts& answer) const {
  auto& parts = pool.scratch().of<internal::WorldMemory>();
  return internal::askWindow(*this, fromUs, toUs, &pool, parts, answer);
}

}  // namespace foretouch
