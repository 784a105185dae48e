#include "middleware/world/pair_asker.h"

#include <tuple>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// How far a mesh may turn in a span (radians) and still be the frame that others are seen from.
constexpr float kMostTurnOfFrame = 0.1F;
/// Where no more LSS than this are near its own, a mesh is asked as a link however little it turns:
/// few descents cost less than a frame's boxes around all of a body.
constexpr std::size_t kFewNear = 8;

}  // namespace

Result<Done> PairAsker::ask(std::size_t pair, std::uint64_t work) {
  const auto [a, b] = scratch_.meeting[pair];
  if (!world_.isAsked(a, b)) return Done{};
  ++worker_.counters.pairs;
  const std::uint64_t before = workSoFar();
  const std::size_t first = worker_.contacts.size();
  limit_ = work;
  startsAt_ = before;
  FORETOUCH_TRY(const bool isDone, askSpans(a, b));
  const std::uint64_t spent = workSoFar() - before;
  worker_.spent += spent;
  worker_.counters.work += spent;
  if (isDone) return Done{};
  const auto from = worker_.contacts.begin() + static_cast<std::ptrdiff_t>(first);
  worker_.undone.push_back({pair, {from, worker_.contacts.end()}});
  worker_.contacts.erase(from, worker_.contacts.end());
  return Done{};
}

/// A mesh that hardly turns is what the other one is seen from: boxes in its frame are tight, and
/// cull at once all triangles that they do not meet. While it turns they are not, and both move,
/// as they do where hardly anything is near.
SystemQuestion PairAsker::questionOf(BodyId a, BodyId b, std::int64_t utimeUs) const {
  if (isMesh(a) == isMesh(b)) return SystemQuestion::Pair;
  const BodyId mesh = isMesh(a) ? a : b;
  const bool isFrame = !world_.kindOf(mesh).surface ||
                       (worker_.apart.open().size() > kFewNear &&
                        scratch_.sweeps[slotOf(mesh)].at(utimeUs).turn <= kMostTurnOfFrame);
  return isFrame ? SystemQuestion::Mesh : SystemQuestion::Pair;
}

/// Asks span by span, until nothing is known any more; false if the work was spent before.
Result<bool> PairAsker::askSpans(BodyId a, BodyId b) {
  const BodySweep &one = scratch_.sweeps[slotOf(a)], &other = scratch_.sweeps[slotOf(b)];
  const std::size_t first = worker_.contacts.size();
  bool isNear = false, isDone = true;
  SystemSpans& spans = worker_.system.spans;
  spans.begin(world_, a, b, window_.fromUs, window_.toUs);
  while (isDone && spans.next()) {
    if (left() < kLeastShare) {
      query_.giveUp(a, b, worker_.contacts, UndecidedReason::WorkBudget);
      isDone = false;
      break;
    }
    const SpanSweep& ofA = one.at(spans.beginUs());
    const Apart apart = worker_.apart.prove(ofA, other.at(spans.beginUs()), spans.beginUs(),
                                            spans.endUs(), floor(), worker_.counters.queries);
    isNear = isNear || apart != Apart::ByBoxes;
    if (apart != Apart::Unproven) continue;
    const SystemQuestion question = questionOf(a, b, spans.beginUs());
    if (question == SystemQuestion::Pair && !leaveOpen(a, b, first, ofA)) continue;
    const bool isTurned = question == SystemQuestion::Mesh && isMesh(a);
    const BodyId asked = isTurned ? b : a, with = isTurned ? a : b;
    if (left() <= kSpanWork) {
      query_.giveUp(a, b, worker_.contacts, UndecidedReason::WorkBudget);
      isDone = false;
      break;
    }
    FORETOUCH_TRY(const SystemPlan* const plan, query_.prepare(question, asked, with));
    if (plan == nullptr) continue;
    if (!query_.isResolved()) {
      query_.giveUp(a, b, worker_.contacts);
      break;
    }
    isDone = askSpan(*plan, question, asked, with, first);
  }
  worker_.counters.nearPairs += isNear ? 1 : 0;
  return isDone;
}

bool PairAsker::askSpan(const SystemPlan& plan, SystemQuestion question, BodyId a, BodyId b,
                        std::size_t first) {
  ++worker_.counters.spans;
  query_.limit(left());
  QueryCounters& counters = worker_.counters.queries;
  if (question == SystemQuestion::Pair) {
    return query_.askAmong(plan, a, b, worker_.apart.meeting(), worker_.apart.open(), first,
                           worker_.contacts, counters);
  }
  return query_.ask(plan, a, b, first, worker_.contacts, counters);
}

/// Readies the open pairs of LSS for a question about the span: false if there are none but those
/// whose links have met in an earlier one.
bool PairAsker::leaveOpen(BodyId a, BodyId b, std::size_t first, const SpanSweep& sweep) {
  std::vector<PlanePair>& open = worker_.apart.open();
  const std::vector<LinkId>&linkOfA = world_.kindOf(a).linkOf, &linkOfB = world_.kindOf(b).linkOf;
  const auto haveMet = [&](const PlanePair& pair) {
    return std::any_of(worker_.contacts.begin() + static_cast<std::ptrdiff_t>(first),
                       worker_.contacts.end(), [&](const WorldContact& known) {
                         return known.a.link == linkOfA[slotOf(pair.i)] &&
                                known.b.link == linkOfB[slotOf(pair.j)];
                       });
  };
  open.erase(std::remove_if(open.begin(), open.end(), haveMet), open.end());
  leaveFollowed(a, b, open);
  // Pieces between nodes are those of the span, if it is the sweep's.
  const SystemSpans& spans = worker_.system.spans;
  if (spans.beginUs() != sweep.beginUs || spans.endUs() != sweep.endUs) {
    for (PlanePair& pair : open) pair.open = kEveryPiece;
  }
  return !open.empty();
}

/// Since when it is not carried, if it is there and not carried throughout the window.
std::optional<std::int64_t> PairAsker::freeSinceUs(BodyId id) const {
  const WorldBody& body = world_.body(id);
  const Episode* const episode = body.episodeAt(window_.fromUs);
  const bool isFree =
      episode != nullptr && !episode->carrier && body.nextEpisodeUs(window_.fromUs) >= window_.toUs;
  if (!isFree) return std::nullopt;
  return episode->beginUs;
}

/// Drops the pairs that the follower knows throughout, unless they are not asked in between. That
/// one was let go of where their motion begins may have been told of since.
void PairAsker::leaveFollowed(BodyId a, BodyId b, std::vector<PlanePair>& open) const {
  if (followed_ == nullptr) return;
  const auto ofA = freeSinceUs(a), ofB = freeSinceUs(b);
  if (!ofA || !ofB) return;
  const std::int64_t begunUs = std::max(*ofA, *ofB);
  const std::vector<LinkId>&linkOfA = world_.kindOf(a).linkOf, &linkOfB = world_.kindOf(b).linkOf;
  const auto comesBefore = [](const KnownLinks& x, const KnownLinks& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  };
  const auto known = std::equal_range(followed_->pairs.begin(), followed_->pairs.end(),
                                      KnownLinks{a, b, 0, 0, 0}, comesBefore);
  const auto isKnown = [&](const PlanePair& pair) {
    return std::any_of(known.first, known.second, [&](const KnownLinks& links) {
      return begunUs < links.sinceUs && links.linkOfA == linkOfA[slotOf(pair.i)] &&
             links.linkOfB == linkOfB[slotOf(pair.j)];
    });
  };
  open.erase(std::remove_if(open.begin(), open.end(), isKnown), open.end());
}

}  // namespace foretouch::internal
