#include "middleware/world/world_query.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/query/link_query.h"
#include "middleware/world/bodies_apart.h"
#include "middleware/world/body_sweeper.h"
#include "middleware/world/box_sweep.h"
#include "middleware/world/system_query.h"
#include "middleware/world/world_parts.h"

namespace foretouch {

namespace internal {

struct WorldScratchParts {
  std::uint64_t world = 0;    // whose this is
  std::uint64_t windows = 0;  // asked so far
  SystemPlans plans;
  std::vector<BodySweep> sweeps;  // per body
  std::vector<BodyBox> boxes;     // per body, of the whole window
  BoxSweep broad;
  std::vector<MeetingBodies> meeting;
  SystemScratch system;
  BodiesApart apart;
};

namespace {

bool comesBefore(const WorldContact& x, const WorldContact& y) {
  if (!(x.time == y.time)) return x.time < y.time;
  return std::tie(x.a.body, x.a.link, x.b.body, x.b.link) <
         std::tie(y.a.body, y.a.link, y.b.body, y.b.link);
}

/// One window.
class WorldQuery {
 public:
  WorldQuery(const WorldParts& world, std::int64_t fromUs, std::int64_t toUs,
             WorldScratchParts& scratch, WorldContacts& answer)
      : world_(world),
        window_{fromUs, toUs, ++scratch.windows, Eigen::Vector3d::Zero()},
        scratch_(scratch),
        answer_(answer),
        query_(world, scratch.plans, scratch.system) {}

  Result<Done> run() {
    answer_.contacts.clear();
    answer_.silent.clear();
    answer_.counters = {};
    if (scratch_.world != world_.identity) {
      scratch_.plans.clear();
      scratch_.system.motions.clear();
      scratch_.sweeps.clear();
      scratch_.world = world_.identity;
    }
    window_.origin = windowOrigin();
    tellSilent();
    FORETOUCH_CHECK(sweepBodies());
    scratch_.broad.collect(scratch_.boxes, scratch_.meeting);
    for (const MeetingBodies& pair : scratch_.meeting) FORETOUCH_CHECK(askPair(pair.a, pair.b));
    std::sort(answer_.contacts.begin(), answer_.contacts.end(), comesBefore);
    return Done{};
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(world_.bodies.size()); }

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
    scratch_.sweeps.resize(countOf(numBodies()));
    scratch_.boxes.resize(countOf(numBodies()));
    BodySweeper sweeper(world_, scratch_.plans, window_, scratch_.system);
    for (BodyId id = 0; id < numBodies(); ++id) {
      BodySweep& sweep = scratch_.sweeps[slotOf(id)];
      FORETOUCH_CHECK(sweeper.sweep(id, sweep, answer_.contacts, answer_.counters));
      scratch_.boxes[slotOf(id)] = sweep.whole;
    }
    return Done{};
  }

  Result<Done> askPair(BodyId a, BodyId b) {
    if (!world_.isAsked(a, b)) return Done{};
    ++answer_.counters.pairs;
    // A mesh is what the other one is seen from.
    if (!world_.kindOf(a).avatar) return askSpans(b, a, SystemQuestion::Mesh);
    return askSpans(a, b, world_.kindOf(b).avatar ? SystemQuestion::Pair : SystemQuestion::Mesh);
  }

  /// Span by span, until nothing is known any more.
  Result<Done> askSpans(BodyId a, BodyId b, SystemQuestion question) {
    const BodySweep &one = scratch_.sweeps[slotOf(a)], &other = scratch_.sweeps[slotOf(b)];
    const std::size_t first = answer_.contacts.size();
    QueryCounters& counters = answer_.counters.queries;
    bool isNear = false;
    SystemSpans& spans = scratch_.system.spans;
    spans.begin(world_, a, b, window_.fromUs, window_.toUs);
    while (spans.next()) {
      const Apart apart = scratch_.apart.prove(one.at(spans.beginUs()), other.at(spans.beginUs()),
                                               floor(), counters);
      isNear = isNear || apart != Apart::ByBoxes;
      if (apart != Apart::Unproven) continue;
      FORETOUCH_TRY(const SystemPlan* const plan, query_.prepare(question, a, b));
      if (plan == nullptr) continue;
      if (!query_.isResolved()) {
        query_.giveUp(a, b, answer_.contacts);
        break;
      }
      ++answer_.counters.spans;
      query_.ask(*plan, a, b, first, answer_.contacts, counters);
    }
    answer_.counters.nearPairs += isNear ? 1 : 0;
    return Done{};
  }

  /// What is free stays so far apart, as it does by the queries (m).
  [[nodiscard]] double floor() const {
    return kFloorShare * kAskedShare * world_.options.tolerance;
  }

  const WorldParts& world_;
  Window window_;
  WorldScratchParts& scratch_;
  WorldContacts& answer_;
  SystemQuery query_;
};

}  // namespace
}  // namespace internal

namespace {

Error windowError(ErrorCode code, std::int64_t fromUs, std::int64_t toUs, const std::string& what) {
  return Error::in(
      "window", code,
      "the window from " + std::to_string(fromUs) + " to " + std::to_string(toUs) + " us " + what);
}

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

}  // namespace

WorldScratch::WorldScratch() : parts_(std::make_unique<internal::WorldScratchParts>()) {}
WorldScratch::~WorldScratch() = default;
WorldScratch::WorldScratch(WorldScratch&&) noexcept = default;
WorldScratch& WorldScratch::operator=(WorldScratch&&) noexcept = default;

Result<Done> worldContacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                           WorldScratch& scratch, WorldContacts& answer) {
  FORETOUCH_CHECK(checkedWindow(world, fromUs, toUs));
  return internal::WorldQuery(world.parts(), fromUs, toUs, scratch.parts(), answer).run();
}

}  // namespace foretouch
