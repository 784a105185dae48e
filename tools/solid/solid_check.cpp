#include "tools/solid/solid_check.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "lss/index.h"
#include "tools/inputs/ignored_pairs.h"
#include "tools/solid/solid_lines.h"
#include "tools/solid/solid_player.h"

namespace foretouch::tools {
namespace {

/// Shares of the tolerance that the file was certified with. Each is a proof by itself: the next
/// ones are for what lies nearer than the ones before.
constexpr double kShares[] = {0.125, 1e-3};

bool mayBeUnproven(const SolidRecord& record) {
  return record.state == SolidState::Placing || record.limit == SolidLimit::Inside;
}

/// Whether one pose is the other, lifted: the same but for the place of its roots.
bool isLifted(const Skeleton& skeleton, const Pose& tracked, const Pose& shown, double lift) {
  constexpr double kRounding = 1e-9;
  Pose put = tracked;
  bool isUp = lift > 0.0;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    if (skeleton.parent(joint) != kNoParent) continue;
    const Eigen::Vector3d by =
        shown.translations[slotOf(joint)] - tracked.translations[slotOf(joint)];
    isUp = isUp && (by - lift * Eigen::Vector3d::UnitY()).norm() < kRounding;
    put.translations[slotOf(joint)] = shown.translations[slotOf(joint)];
  }
  return isUp && areSamePoses(put, shown);
}

std::string meets(const Avatar& avatar, const Scene& scene, const StepContacts& step) {
  const Skeleton& skeleton = avatar.skeleton();
  const LinkContact* worst = nullptr;
  for (const LinkContact& contact : step.links) {
    if (contact.verdict == Verdict::Clear || contact.reason == UndecidedReason::AfterFirst) {
      continue;
    }
    if (worst == nullptr || contact.freeUntil < worst->freeUntil) worst = &contact;
  }
  if (worst != nullptr && worst->triangle >= 0) {
    return fmt::format("{} meets {} (triangle {}) at {:.6g} of it",
                       inQuotes(skeleton.name(worst->link)),
                       inQuotes(scene.objectNames()[slotOf(scene.object(worst->triangle))]),
                       worst->triangle, worst->toi);
  }
  for (const PairContact& pair : step.pairs) {
    if (pair.verdict == Verdict::Clear) continue;
    return fmt::format("{} meets {} at {:.6g} of it", inQuotes(skeleton.name(pair.link)),
                       inQuotes(skeleton.name(pair.other)), pair.toi);
  }
  return "it is not decided";
}

bool isClear(const Query& query, const StepContacts& step) {
  const auto clear = [](const auto& contact) { return contact.verdict == Verdict::Clear; };
  return std::all_of(step.links.begin(), step.links.end(), clear) &&
         std::all_of(step.pairs.begin(), step.pairs.end(), clear) &&
         (!query.options().self || step.arePairsAnswered);
}

}  // namespace

Result<QueryOptions> queryOf(const SolidHeader& header, const Avatar& avatar, const Scene& scene,
                             const std::string& path) {
  QueryOptions query;
  query.passSeparating = true;
  query.scope = header.self.empty() ? Scope::FirstOfAvatar : Scope::EveryLink;
  const auto ignored = parseIgnoredPairs(header.ignore, avatar.skeleton(), scene.objectNames());
  if (!ignored.ok()) return inFile(ignored.error(), path);
  query.ignored = ignored.value();
  if (!header.self.empty()) {
    FORETOUCH_TRY(query.self, parsePairs(header.self, path, avatar));
  }
  return query;
}

Result<SolidCheck> SolidCheck::build(const Avatar& avatar, const Scene& scene,
                                     const QueryOptions& query, double tolerance) {
  std::vector<Query> queries;
  QueryOptions asked = query;
  for (const double share : kShares) {
    asked.tolerance = std::max(kMinTolerance, share * tolerance);
    FORETOUCH_TRY(auto built, Query::build(avatar, scene, asked));
    queries.push_back(std::move(built));
  }
  asked.tolerance = kMinTolerance;
  FORETOUCH_TRY(auto last, Query::build(avatar, scene, asked));
  queries.push_back(std::move(last));
  SolidCheck check(avatar, std::move(queries));
  check.checked_.leastTolerance = check.queries_.front().options().tolerance;
  return check;
}

bool SolidCheck::take(const SolidRecord& record) {
  std::string fault = faultOf(record);
  if (fault.empty()) {
    ++checked_.ticks;
    ++(record.isCertified ? checked_.certified : checked_.notCertified);
    return true;
  }
  checked_.finding = SolidFinding{record.tick, record.line, std::move(fault)};
  return false;
}

/// The fault; empty: none. Takes the tick's shown pose as the last one.
std::string SolidCheck::faultOf(const SolidRecord& record) {
  if (!record.isMarkTrue) return "the line is not the one that was written: its mark is another";
  if (record.tick != checked_.ticks) return fmt::format("expected tick {}", checked_.ticks);
  if (record.tick > 0 && !(record.timeS > lastTimeS_)) return "its time does not ascend";
  lastTimeS_ = record.timeS;
  if (!record.isCertified && !mayBeUnproven(record)) {
    return fmt::format("it is not certified, but {}: only what is placing, or inside, is not",
                       toString(record.state));
  }
  if (record.isCertified && record.state == SolidState::Placing) {
    return "it is certified, although it has no place yet";
  }
  const auto largest = std::max_element(record.deviations.begin(), record.deviations.end());
  if (largest != record.deviations.end() && *largest != record.deviation) {
    return "its deviation is not the largest of its links";
  }
  std::string fault = faultOfBegin(record);
  if (fault.empty()) fault = faultOfWay(record);
  if (!fault.empty()) return fault;
  if (record.state == SolidState::Equal && record.tracked &&
      !isLifted(avatar_.skeleton(), *record.tracked, *shown_, record.lift)) {
    return "it is equal, but what is shown is not what was tracked";
  }
  return "";
}

std::string SolidCheck::faultOfBegin(const SolidRecord& record) const {
  if (record.state == SolidState::Placing) {
    return record.start || !record.way.empty() ? "it has a way, although it has no place yet" : "";
  }
  const bool begins = !shown_ || record.state == SolidState::Snapped;
  const bool mayBegin = begins || wasInside_;
  if (begins && !record.start) return "expected the pose where the curve begins, found none";
  if (!mayBegin && record.start) return "the curve begins anew, although nothing says that it may";
  if (!record.start && !record.way.empty() && record.from != markOfPose(*shown_)) {
    return "its way does not begin at the pose that was shown before, bit for bit";
  }
  return "";
}

std::string SolidCheck::faultOfWay(const SolidRecord& record) {
  if (record.state == SolidState::Placing) {
    shown_.reset();
    return "";
  }
  double lastTime = 0.0;
  for (const double time : record.times) {
    if (!(time > lastTime && time <= 1.0)) return "the times of its way do not ascend to 1";
    lastTime = time;
  }
  Pose from = record.start ? *record.start : *shown_;
  if (record.start) {
    ++checked_.begins;
    const std::string fault = record.isCertified ? faultOfMotion(from, from) : "";
    if (!fault.empty()) return "where the curve begins, " + fault;
  }
  for (std::size_t piece = 0; piece < record.way.size(); ++piece) {
    const Pose& to = record.way[piece];
    const std::string fault = record.isCertified ? faultOfMotion(from, to) : "";
    if (!fault.empty()) return fmt::format("on piece {} of its way {}", piece, fault);
    from = to;
  }
  shown_ = std::move(from);
  wasInside_ = record.limit == SolidLimit::Inside;
  return "";
}

std::string SolidCheck::faultOfMotion(const Pose& from, const Pose& to) {
  const Skeleton& skeleton = avatar_.skeleton();
  const auto first = validatedPose(skeleton, from), last = validatedPose(skeleton, to);
  for (const auto* pose : {&first, &last}) {
    if (!pose->ok()) return "there is no pose: " + pose->error().message;
  }
  motion_.assign(skeleton, first.value(), last.value());
  for (const Query& query : queries_) {
    query.answer(motion_, scratch_, answer_);
    if (!isClear(query, answer_)) continue;
    ++checked_.motions;
    checked_.leastTolerance = std::min(checked_.leastTolerance, query.options().tolerance);
    return "";
  }
  return meets(avatar_, queries_.front().scene(), answer_);
}

}  // namespace foretouch::tools
