// bindings/c/ask.cpp: questions to an ft_world at an instant, and through a time.
#include "bindings/c/include/foretouch/ask.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"
#include "middleware/ask/ask.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(AskWhat::Nearest) == FT_ASK_NEAREST);
static_assert(static_cast<int>(AskWhich::All) == FT_ASK_ALL);
static_assert(static_cast<int>(AskVerdict::Clear) == FT_ASK_CLEAR);
static_assert(static_cast<int>(AskVerdict::Hit) == FT_ASK_HIT);
static_assert(static_cast<int>(AskVerdict::Unknown) == FT_ASK_UNKNOWN);
static_assert(static_cast<int>(AskUnknown::Assumed) == FT_ASK_ASSUMED);
static_assert(static_cast<int>(AskUnknown::Open) == FT_ASK_OPEN);
static_assert(kMostCorners == 1024);  // as the header says
static_assert(kEveryObject == FT_EVERY_OBJECT);

/// As many as a world may have bodies.
constexpr std::size_t kMaxParts = 100'000;
/// The most in one call; their answers fit into memory.
constexpr std::size_t kMaxQuestions = 10'000'000;

ft_ask_whom everybody() {
  ft_ask_whom whom{};
  whom.size = sizeof whom;
  whom.groups = AskWhom{}.groups;
  whom.asks_still = 1;
  return whom;
}

ft_question defaultQuestion() {
  ft_question question{};
  question.size = sizeof question;
  return question;
}

ft_flight defaultFlight() {
  ft_flight flight{};
  flight.size = sizeof flight;
  return flight;
}

ft_status readParts(const ft_ask_part* given, std::size_t count, const char* name,
                    std::vector<AskPart>& parts) {
  if (const auto s = neededArray(given, count, kMaxParts, name); s != FT_OK) return s;
  parts.clear();
  for (std::size_t i = 0; i < count; ++i) {
    parts.push_back({given[i].body, given[i].link, given[i].object});
  }
  return FT_OK;
}

ft_status readWhom(const ft_ask_whom* given, AskWhom& whom) {
  ft_ask_whom known = everybody();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_ask_whom", known); s != FT_OK) return s;
    if (const auto s = zero(std::uint32_t(known.reserved), "reserved"); s != FT_OK) return s;
  }
  whom.groups = known.groups;
  if (const auto s = readTruth(known.asks_still, "asks_still", whom.asksStill); s != FT_OK)
    return s;
  if (const auto s = readParts(known.only, known.only_count, "only", whom.only); s != FT_OK) {
    return s;
  }
  return readParts(known.without, known.without_count, "without", whom.without);
}

ft_status readChoice(std::int32_t given, std::int32_t last, const char* name) {
  if (given >= 0 && given <= last) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "%s: expected one of FT_ASK_*, 0 to %d, found %d",
                 name, last, given);
}

ft_status readHull(const double* given, std::size_t count, std::vector<Eigen::Vector3d>& hull) {
  if (const auto s = neededArray(given, count, kMostCorners, "hull"); s != FT_OK) return s;
  hull.clear();
  for (std::size_t i = 0; i < count; ++i) {
    hull.emplace_back(Eigen::Map<const Eigen::Vector3d>(given + 3 * i));
  }
  return FT_OK;
}

Lss lssOf(const ft_lss& given) {
  return {Eigen::Map<const Eigen::Vector3d>(given.a), Eigen::Map<const Eigen::Vector3d>(given.b),
          given.radius};
}

ft_status readQuestion(const ft_question* given, WorldQuestion& question) {
  ft_question known = defaultQuestion();
  if (const auto s = needed(given, "question"); s != FT_OK) return s;
  if (const auto s = readStruct(given, "ft_question", known); s != FT_OK) return s;
  if (const auto s = readChoice(known.what, FT_ASK_NEAREST, "what"); s != FT_OK) return s;
  if (const auto s = readChoice(known.which, FT_ASK_ALL, "which"); s != FT_OK) return s;
  if (const auto s = zero(std::uint32_t(known.reserved), "reserved"); s != FT_OK) return s;
  if (const auto s = neededArray(known.instants, known.instant_count, kMaxParts, "instants");
      s != FT_OK) {
    return s;
  }
  question.what = static_cast<AskWhat>(known.what);
  question.which = static_cast<AskWhich>(known.which);
  question.shape = lssOf(known.shape);
  question.direction = Eigen::Map<const Eigen::Vector3d>(known.direction);
  question.reach = known.reach;
  question.time = {known.time_us, known.time_fraction};
  question.instants.clear();
  for (std::size_t i = 0; i < known.instant_count; ++i) {
    const ft_ask_instant& instant = known.instants[i];
    question.instants.push_back({instant.body, {instant.time_us, instant.time_fraction}});
  }
  if (const auto s = readHull(known.hull, known.hull_count, question.hull); s != FT_OK) return s;
  if (const auto s = readTruth(known.solids, "solids", question.solids); s != FT_OK) return s;
  if (const auto s = zero(std::uint32_t(known.reserved_end), "reserved_end"); s != FT_OK) return s;
  return readWhom(known.whom, question);
}

ft_status readOneOf(const ft_question* given, std::size_t stride, WorldQuestion& question) {
  std::size_t size = 0;
  if (const auto s = readSize(given, "ft_question", size); s != FT_OK) return s;
  if (size == stride) return readQuestion(given, question);
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "size: expected that of the first one, %zu, found %zu", stride, size);
}

ft_status readQuestions(const ft_question* given, std::size_t count,
                        std::vector<WorldQuestion>& questions) {
  questions.resize(count);
  std::size_t stride = 0;
  const auto* place = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = 0; i < count; ++i, place += stride) {
    const auto* const one = reinterpret_cast<const ft_question*>(place);
    ft_status s = i == 0 ? readSize(one, "ft_question", stride) : FT_OK;
    if (s == FT_OK) s = readOneOf(one, stride, questions[i]);
    if (s == FT_OK) continue;
    const std::string why = ft_last_error();
    return failure(s, static_cast<std::int64_t>(i), "questions[%zu]: %s", i, why.c_str());
  }
  return FT_OK;
}

ft_status readFlight(const ft_flight* given, FlightQuestion& question) {
  ft_flight known = defaultFlight();
  if (const auto s = needed(given, "flight"); s != FT_OK) return s;
  if (const auto s = readStruct(given, "ft_flight", known); s != FT_OK) return s;
  if (const auto s = zero(known.reserved, "reserved"); s != FT_OK) return s;
  question.shape = lssOf(known.shape);
  question.way = Eigen::Map<const Eigen::Vector3d>(known.way);
  if (const auto s = readHull(known.hull, known.hull_count, question.hull); s != FT_OK) return s;
  question.fromUs = known.from_us;
  question.toUs = known.to_us;
  return readWhom(known.whom, question);
}

/// The fields that a hit of a cast and one of a flight have in common.
template <typename Told>
void tell(const WorldHit& hit, Told& told) {
  told.is_assumed = hit.isAssumed ? 1 : 0;
  told.what = sideOf(hit.what, hit.object);
  told.distance = hit.distance;
  Eigen::Map<Eigen::Vector3d>(told.normal) = hit.nhat_W;
  std::copy(hit.weights.begin(), hit.weights.end(), told.weights);
}

ft_world_hit hitOf(const WorldHit& hit) {
  ft_world_hit told{};
  tell(hit, told);
  return told;
}

ft_flight_hit flightHitOf(const FlightAnswer& answer) {
  ft_flight_hit told{};
  told.verdict = static_cast<std::int32_t>(answer.verdict());
  if (!answer.first) return told;
  told.time_us = answer.first->time.us;
  told.time_fraction = answer.first->time.fraction;
  tell(answer.first->hit, told);
  return told;
}

ft_unknown_body unknownOf(const UnknownBody& body) {
  ft_unknown_body told{};
  told.body = body.body;
  told.why = static_cast<std::int32_t>(body.why);
  told.object = body.object;
  return told;
}

template <typename Item>
void append(const std::vector<Item>& more, std::vector<Item>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

/// `isAnswered`: which of the answers there must be.
ft_status checkedAsked(const ft_world* world, bool ft_world::Asked::*isAnswered) {
  if (const auto s = checked(world); s != FT_OK) return s;
  if (world->asked.*isAnswered) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_world_probe() to be answered before");
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_ask_whom_init(ft_ask_whom* whom, size_t size) {
  return initStruct(__func__, whom, size, "ft_ask_whom", everybody());
}

ft_status ft_question_init(ft_question* question, size_t size) {
  return initStruct(__func__, question, size, "ft_question", defaultQuestion());
}

ft_status ft_flight_init(ft_flight* flight, size_t size) {
  return initStruct(__func__, flight, size, "ft_flight", defaultFlight());
}

ft_status ft_world_probe(ft_world* world, const ft_question* question, int32_t* verdict) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    auto& asked = world->asked;
    if (const auto s = readQuestion(question, asked.question); s != FT_OK) return s;
    const auto done = world->withScratch([&](Scratch& scratch) {
      return askWorld(world->world, asked.question, scratch, asked.next);
    });
    FORETOUCH_CHECK_OR(worldFailure, done);
    std::swap(asked.answer, asked.next);
    asked.hasAnswer = asked.hasUnknown = true;
    asked.unknown = asked.answer.unknown;
    if (verdict != nullptr) *verdict = static_cast<std::int32_t>(asked.answer.verdict());
    return FT_OK;
  });
}

ft_status ft_world_probe_many(ft_world* world, const ft_question* questions, size_t count,
                              ft_probed* probed) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = neededArray(questions, count, kMaxQuestions, "questions"); s != FT_OK) {
      return s;
    }
    if (const auto s = neededArray(probed, count, kMaxQuestions, "probed"); s != FT_OK) return s;
    auto& asked = world->asked;
    if (const auto s = readQuestions(questions, count, asked.questions); s != FT_OK) return s;
    const auto done = world->withScratch([&](Scratch& scratch) {
      return askWorld(world->world, asked.questions, scratch, asked.answers);
    });
    FORETOUCH_CHECK_OR(worldFailure, done);
    asked.answer.hits.clear();
    asked.unknown.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const WorldAnswer& answer = asked.answers[i];
      probed[i] = {static_cast<std::int32_t>(answer.verdict()),
                   static_cast<std::uint32_t>(answer.hits.size()),
                   static_cast<std::uint32_t>(answer.unknown.size()), 0};
      append(answer.hits, asked.answer.hits);
      append(answer.unknown, asked.unknown);
    }
    asked.hasAnswer = asked.hasUnknown = true;
    return FT_OK;
  });
}

ft_status ft_world_hits(const ft_world* world, ft_world_hit* hits, size_t capacity,
                        size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAsked(world, &ft_world::Asked::hasAnswer); s != FT_OK) return s;
    const auto& all = world->asked.answer.hits;
    const auto at = [&](std::size_t i) { return hitOf(all[i]); };
    return writeList("ft_world_hit", "hits", all.size(), at, hits, capacity, required);
  });
}

ft_status ft_world_unknown(const ft_world* world, ft_unknown_body* bodies, size_t capacity,
                           size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAsked(world, &ft_world::Asked::hasUnknown); s != FT_OK) return s;
    const auto& all = world->asked.unknown;
    const auto at = [&](std::size_t i) { return unknownOf(all[i]); };
    return writeList("ft_unknown_body", "bodies", all.size(), at, bodies, capacity, required);
  });
}

ft_status ft_world_fly(ft_world* world, const ft_flight* flight, ft_flight_hit* hit) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(hit, "hit"); s != FT_OK) return s;
    auto& asked = world->asked;
    if (const auto s = readFlight(flight, asked.flight); s != FT_OK) return s;
    const auto done = world->withScratch([&](Scratch& scratch) {
      return askFlight(world->world, asked.flight, scratch, asked.flown);
    });
    FORETOUCH_CHECK_OR(worldFailure, done);
    asked.unknown = asked.flown.unknown;
    asked.hasUnknown = true;
    return writeStruct(hit, "ft_flight_hit", flightHitOf(asked.flown));
  });
}
