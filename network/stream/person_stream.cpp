#include "network/stream/person_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/bracket/brackets_of.h"
#include "network/wire/hashed_bytes.h"

namespace foretouch {
namespace {

using PersonClock = std::chrono::steady_clock;

constexpr double kPersonUsPerS = 1e6;
constexpr std::int64_t kNotClaimed = -1;
/// Places may differ by as much more (m) before a bound is broken: poses are rounded on their way.
constexpr double kPlaceRounding = 1e-6;
/// A t, times the microseconds that it is of, may be rounded up by less than this share.
constexpr double kBelow = 1.0 - 1e-12;
/// As many pieces as a question about what comes may have.
constexpr std::size_t kMostAheadPieces = 4096;
/// In place of where a link is lost since.
constexpr std::int8_t kIsKnown = -1, kNotFollowed = -2;

std::int64_t hashOf(const BoundsFile& bounds) {
  HashedBytes bytes;
  bytes.add(formatBounds(bounds));
  return bytes.hash();
}

double rateOf(std::int64_t fromUs, std::int64_t toUs, std::int64_t steps) {
  return static_cast<double>(steps) * kPersonUsPerS / static_cast<double>(toUs - fromUs);
}

bool isTold(const LinkBracket& bracket) {
  return bracket.verdict == BracketVerdict::Possible || bracket.verdict == BracketVerdict::Certain;
}

/// As kMostCountedLost: a sender may lie about its numbers.
std::int64_t stepsAcross(const StreamStep& step) {
  return std::clamp<std::int64_t>(step.lost, 0, kMostCountedLost) + 1;
}

}  // namespace

PersonStream::PersonStream(std::int32_t id, BracketQuery query, const Scene& scene,
                           BoundsByRate bounds, const PersonStreamOptions& options)
    : id_(id),
      query_(std::move(query)),
      scene_(scene),
      bounds_(std::move(bounds)),
      model_(options.model),
      aheadUs_(options.aheadUs),
      boundsHash_(hashOf(options.bounds)),
      resolution_(options.brackets.resolution),
      placer_(query_.avatar()) {}

Result<PersonStream> PersonStream::make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                        const PersonStreamOptions& options) {
  if (options.aheadUs < 0 || options.aheadUs > kMostAheadUs) {
    return Error::in("ahead", ErrorCode::OutOfRange,
                     "expected 0 to " + std::to_string(kMostAheadUs) + " us, found " +
                         std::to_string(options.aheadUs));
  }
  FORETOUCH_TRY(auto query, BracketQuery::build(avatar, scene, options.brackets));
  FORETOUCH_TRY(auto bounds, BoundsByRate::make(options.bounds, avatar.skeleton(), options.model));
  return PersonStream(id, std::move(query), scene, std::move(bounds), options);
}

double PersonStream::secondsBetween(const Kept& from, const Kept& to) {
  return static_cast<double>(to.utimeUs - from.utimeUs) / kPersonUsPerS;
}

PosedStep PersonStream::between(const Kept& from, const Kept& to) {
  PosedStep step;
  step.from = &from.pose;
  step.to = &to.pose;
  step.seconds = secondsBetween(from, to);
  return step;
}

/// A pose that is kept, by its age; 0: the newest.
const PersonStream::Kept* PersonStream::back(int i) const {
  const auto older = countOf(i);
  return older < std::min(numKept_, kept_.size()) ? &kept_[(numKept_ - 1 - older) % kept_.size()]
                                                  : nullptr;
}

void PersonStream::keep(const StreamStep& step) {
  Kept& kept = kept_[numKept_ % kept_.size()];
  kept.pose = *step.to;
  kept.sequence = step.sequenceTo;
  kept.utimeUs = step.utimeToUs;
  kept.isUnknown.clear();
  for (const UndecidedReason reason : *step.unknown) {
    kept.isUnknown.push_back(reason == UndecidedReason::None ? 0 : 1);
  }
  ++numKept_;
}

void PersonStream::follow(const StreamStep& step) {
  const bool isWaiting = waits();
  std::size_t own = 0;  // the message about the pose itself: what is found again comes after it
  numSaid_ = 0;
  broken_.clear();
  hasEndedWait_ = false;
  session_ = step.session;
  if (step.kind == StepKind::Consecutive && numKept_ > 0) {
    checkAhead(step);
    keep(step);
    if (model_ != MotionModel::CubicLate) {
      sayStep(step, 0);
    } else if (isWaiting) {
      sayStep(step, 1);
    }
  } else {
    // What was waited for does not come.
    if (isWaiting) sayStep(step, 0);
    keep(step);
    own = numSaid_;
    if (step.kind == StepKind::AcrossGap && numKept_ > 1) sayGap(step);
    std::swap(kept_[0], kept_[(numKept_ - 1) % kept_.size()]);
    numKept_ = 1;
    notBeforeUs_.clear();
    if (step.kind == StepKind::First) {
      lostSince_.clear();
      for (LostSince& lost : lost_) lost.numLinks = 0;
      begin(step);
    }
  }
  if (numSaid_ == own) begin(step);
  said_[own].broken = broken_;
  lookAhead(said_[own]);
}

/// Whether it waits for the pose after the newest step.
bool PersonStream::waits() const {
  return model_ == MotionModel::CubicLate && numKept_ > 1 && !hasEndedWait_;
}

void PersonStream::endWait() {
  numSaid_ = 0;
  if (!waits()) return;
  broken_.clear();
  StreamStep step;
  step.session = session_;
  step.sequenceTo = back(0)->sequence;
  step.utimeToUs = back(0)->utimeUs;
  sayStep(step, 0);
  said_[0].broken = broken_;
  hasEndedWait_ = true;
}

bool PersonStream::isEndOfWait(const PersonMessage& message) const {
  return waits() && message.kind == StepKind::Consecutive && message.session == session_ &&
         message.sequence == back(0)->sequence && message.sequenceTo == message.sequence;
}

PersonMessage& PersonStream::begin(const StreamStep& step) {
  const auto numLinks = countOf(query_.avatar().numLinks());
  PersonMessage& message = said_[numSaid_++];
  message.avatar = id_;
  message.session = step.session;
  message.sequence = step.sequenceTo;
  message.utimeUs = step.utimeToUs;
  message.model = model_;
  message.boundsHash = boundsHash_;
  message.resolution = resolution_;
  message.kind = StepKind::First;
  message.sequenceFrom = message.sequenceTo = step.sequenceTo;
  message.utimeFromUs = message.utimeToUs = step.utimeToUs;
  message.verdicts.assign(numLinks, BracketVerdict::Unclaimed);
  message.notBeforeUs.assign(numLinks, kNotClaimed);
  message.aheadUs = 0;
  message.brackets.clear();
  message.bracketsLeftOut = 0;
  message.broken.clear();
  message.personUs = 0.0;
  return message;
}

PersonMessage& PersonStream::begin(const StreamStep& step, StepKind kind, const Kept& from,
                                   const Kept& to) {
  PersonMessage& message = begin(step);
  message.kind = kind;
  message.sequenceFrom = from.sequence;
  message.sequenceTo = to.sequence;
  message.utimeFromUs = from.utimeUs;
  message.utimeToUs = to.utimeUs;
  return message;
}

/// Per link, whether one of these poses does not know it.
const std::vector<std::uint8_t>& PersonStream::unknownIn(std::initializer_list<const Kept*> ends) {
  isUnknown_.assign(countOf(query_.avatar().numLinks()), 0);
  for (const Kept* const end : ends) {
    for (std::size_t link = 0; end != nullptr && link < isUnknown_.size(); ++link) {
      isUnknown_[link] |= end->isUnknown[link];
    }
  }
  return isUnknown_;
}

/// The bounds at a rate, but for links that are unknown.
const std::vector<LinkBound>& PersonStream::claimed(double rateHz,
                                                    const std::vector<std::uint8_t>& isUnknown) {
  claimed_ = bounds_.at(rateHz);
  for (std::size_t link = 0; link < claimed_.size(); ++link) {
    if (isUnknown[link] != 0) claimed_[link] = LinkBound{};
  }
  return claimed_;
}

/// The step that ends `newer` poses before the newest one.
void PersonStream::sayStep(const StreamStep& step, int newer) {
  const PersonClock::time_point start = PersonClock::now();
  const Kept &to = *back(newer), &from = *back(newer + 1);
  const Kept* const before = back(newer + 2);
  const Kept* const after = newer > 0 ? back(newer - 1) : nullptr;
  PosedStep posed = between(from, to);
  if (before != nullptr) {
    posed.before = &before->pose;
    posed.secondsBefore = secondsBetween(*before, from);
  }
  if (after != nullptr) {
    posed.after = &after->pose;
    posed.secondsAfter = secondsBetween(to, *after);
  }
  const auto& bounds = claimed(rateOf(from.utimeUs, to.utimeUs, 1),
                               unknownIn({&to, before == nullptr ? nullptr : &from, after}));
  PersonMessage& message = begin(step, StepKind::Consecutive, from, to);
  if (query_.answer(posed, model_, bounds, scratch_, brackets_).ok()) take(brackets_, message);
  message.personUs = std::chrono::duration<double, std::micro>(PersonClock::now() - start).count();
  followLost(step, from, 1);
}

void PersonStream::sayGap(const StreamStep& step) {
  const Kept &from = *back(1), &to = *back(0);
  sayAcross(step, from, to, stepsAcross(step), unknownIn({&to}), nullptr);
  followLost(step, from, stepsAcross(step));
}

/// What may have happened across poses that are missing, for all links or for some.
void PersonStream::sayAcross(const StreamStep& step, const Kept& from, const Kept& to,
                             std::int64_t steps, const std::vector<std::uint8_t>& isUnknown,
                             const std::vector<std::uint8_t>* isOf) {
  const PersonClock::time_point start = PersonClock::now();
  PosedStep posed = between(from, to);
  if (to.sequence >= kFirstUncounted) posed.seconds += kUncountedClockUs / kPersonUsPerS;
  const auto& bounds = claimed(rateOf(from.utimeUs, to.utimeUs, steps), isUnknown);
  if (to.sequence >= kFirstUntimed) claimed_.assign(claimed_.size(), LinkBound{});
  checkGap(posed, bounds, isOf);
  PersonMessage& message = begin(step, StepKind::AcrossGap, from, to);
  if (query_.answerGap(posed, bounds, scratch_, brackets_).ok()) {
    if (isOf != nullptr) {
      keepBracketsOf([&](LinkId link) { return (*isOf)[slotOf(link)] != 0; }, brackets_);
    }
    take(brackets_, message);
  }
  message.personUs = std::chrono::duration<double, std::micro>(PersonClock::now() - start).count();
}

/// After a step that begins at `from` and does not know isUnknown_: which links are lost since
/// when, and what those touched that are known again.
void PersonStream::followLost(const StreamStep& step, const Kept& from, std::int64_t steps) {
  lostSince_.resize(isUnknown_.size(), kIsKnown);
  for (std::size_t since = 0; since < lost_.size(); ++since) {
    if (lost_[since].numLinks > 0) sayFound(step, since, from);
  }
  for (std::size_t link = 0; link < isUnknown_.size(); ++link) {
    if (isUnknown_[link] == 0) {
      lostSince_[link] = kIsKnown;
    } else if (lostSince_[link] == kIsKnown) {
      lose(link, from);
    }
  }
  for (LostSince& lost : lost_) lost.steps += steps;
}

void PersonStream::lose(std::size_t link, const Kept& from) {
  lostSince_[link] = kNotFollowed;
  if (from.isUnknown[link] != 0) return;
  auto place = std::find_if(lost_.begin(), lost_.end(), [&](const LostSince& lost) {
    return lost.numLinks > 0 && lost.steps == 0;
  });
  if (place == lost_.end()) {
    place = std::find_if(lost_.begin(), lost_.end(),
                         [](const LostSince& lost) { return lost.numLinks == 0; });
    if (place == lost_.end()) return;
    place->pose = from;
    place->steps = 0;
  }
  ++place->numLinks;
  lostSince_[link] = static_cast<std::int8_t>(place - lost_.begin());
}

/// About the links that are lost since then and known from `to` on.
void PersonStream::sayFound(const StreamStep& step, std::size_t since, const Kept& to) {
  LostSince& lost = lost_[since];
  isFound_.assign(isUnknown_.size(), 0);
  isApart_ = isUnknown_;
  std::size_t found = 0;
  for (std::size_t link = 0; link < isFound_.size(); ++link) {
    isApart_[link] |= lost.pose.isUnknown[link];
    const bool isFound = lostSince_[link] == static_cast<int>(since) && isUnknown_[link] == 0;
    isFound_[link] = isFound ? 1 : 0;
    found += isFound ? 1 : 0;
  }
  lost.numLinks -= found;
  if (found == 0) return;
  const std::size_t before = numSaid_;
  sayAcross(step, lost.pose, to, lost.steps, isApart_, &isFound_);
  const PersonMessage& message = said_[before];
  const bool isClaimed = std::any_of(message.verdicts.begin(), message.verdicts.end(),
                                     [](auto v) { return v != BracketVerdict::Unclaimed; });
  if (!isClaimed && message.brackets.empty()) numSaid_ = before;
}

void PersonStream::take(const StepBrackets& brackets, PersonMessage& message) const {
  const Skeleton& skeleton = query_.avatar().skeleton();
  for (const std::vector<LinkBracket>* const list : {&brackets.links, &brackets.pairs}) {
    for (const LinkBracket& bracket : *list) {
      if (bracket.other == kNoParent) message.verdicts[slotOf(bracket.link)] = bracket.verdict;
      if (!isTold(bracket)) continue;
      if (message.brackets.size() == kMaxPersonBrackets) {
        ++message.bracketsLeftOut;
        continue;
      }
      ToldBracket& told = message.brackets.emplace_back();
      told.bracket = bracket;
      told.linkName = skeleton.name(bracket.link);
      if (bracket.other != kNoParent) told.otherName = skeleton.name(bracket.other);
      if (bracket.triangle >= 0) {
        told.otherName = scene_.objectNames()[slotOf(scene_.object(bracket.triangle))];
      }
    }
  }
}

/// From the last step on, if there is one.
void PersonStream::lookAhead(PersonMessage& message) {
  const Kept* const from = back(1);
  if (aheadUs_ == 0 || from == nullptr) return;
  const PersonClock::time_point start = PersonClock::now();
  const Kept& to = *back(0);
  message.aheadUs = aheadUs_;
  const PosedStep posed = between(*from, to);
  const auto& bounds = claimed(rateOf(from->utimeUs, to.utimeUs, 1), to.isUnknown);
  const double horizonS = static_cast<double>(aheadUs_) / kPersonUsPerS;
  nowNotBeforeUs_.assign(message.verdicts.size(), kNotClaimed);
  if (query_.lookAhead(posed, horizonS, bounds, scratch_, brackets_).ok()) {
    for (const LinkBracket& bracket : brackets_.links) {
      if (bracket.verdict == BracketVerdict::Unclaimed) continue;
      nowNotBeforeUs_[slotOf(bracket.link)] = to.utimeUs + aheadUs_;
      lower(bracket, bracket.link, to.utimeUs);
    }
    for (const LinkBracket& pair : brackets_.pairs) {
      lower(pair, pair.link, to.utimeUs);
      lower(pair, pair.other, to.utimeUs);
    }
  }
  // What was excluded before is excluded still.
  for (std::size_t i = 0; i < notBeforeUs_.size(); ++i) {
    if (nowNotBeforeUs_[i] == kNotClaimed) continue;
    nowNotBeforeUs_[i] = std::max(nowNotBeforeUs_[i], notBeforeUs_[i]);
  }
  std::swap(notBeforeUs_, nowNotBeforeUs_);
  message.notBeforeUs = notBeforeUs_;
  message.personUs += std::chrono::duration<double, std::micro>(PersonClock::now() - start).count();
}

void PersonStream::lower(const LinkBracket& bracket, LinkId link, std::int64_t utimeUs) {
  std::int64_t& notBefore = nowNotBeforeUs_[slotOf(link)];
  if (bracket.verdict == BracketVerdict::Excluded || notBefore == kNotClaimed) return;
  const double us = bracket.possibleFrom * static_cast<double>(aheadUs_) * kBelow;
  const bool isClaimed = bracket.verdict != BracketVerdict::Unclaimed;
  const std::int64_t from = utimeUs + static_cast<std::int64_t>(std::floor(us));
  notBefore = isClaimed ? std::min(notBefore, from) : kNotClaimed;
}

void PersonStream::addBroken(BrokenBound::Claim claim, LinkId link, double beyond) {
  if (query_.avatar().lss(link).empty() || !(beyond > kPlaceRounding)) return;
  broken_.push_back({link, claim, beyond});
  if (!notBeforeUs_.empty()) notBeforeUs_[slotOf(link)] = kNotClaimed;
}

/// Whether the next pose is where the last one let it be.
void PersonStream::checkAhead(const StreamStep& step) {
  const Kept* const from = back(1);
  if (aheadUs_ == 0 || from == nullptr) return;
  const Kept& to = *back(0);
  const PosedStep posed = between(*from, to);
  const double s = static_cast<double>(step.utimeToUs - to.utimeUs) / kPersonUsPerS;
  if (!ModelMotion::goOn(posed, s, kMostAheadPieces, ahead_, aheadPoses_)) return;
  placer_.place(aheadPoses_.back(), one_);
  placer_.place(*step.to, other_);
  placer_.differences(one_, other_, apart_);
  const auto& bounds = claimed(rateOf(from->utimeUs, to.utimeUs, 1), to.isUnknown);
  for (LinkId link = 0; link < query_.avatar().numLinks(); ++link) {
    const LinkBound& bound = bounds[slotOf(link)];
    const bool isKnown = (*step.unknown)[slotOf(link)] == UndecidedReason::None;
    const double most =
        2.0 * bound.error + s * (bound.aheadSpeed + 0.5 * s * bound.aheadAcceleration);
    if (isKnown) addBroken(BrokenBound::Claim::Ahead, link, apart_[slotOf(link)] - most);
  }
}

/// Whether the person can have come so far.
void PersonStream::checkGap(const PosedStep& step, const std::vector<LinkBound>& bounds,
                            const std::vector<std::uint8_t>* isOf) {
  placer_.place(*step.from, one_);
  placer_.place(*step.to, other_);
  placer_.differences(one_, other_, apart_);
  for (LinkId link = 0; link < query_.avatar().numLinks(); ++link) {
    const LinkBound& bound = bounds[slotOf(link)];
    if (isOf != nullptr && (*isOf)[slotOf(link)] == 0) continue;
    const double most = 2.0 * bound.error + step.seconds * bound.speed;
    addBroken(BrokenBound::Claim::InGap, link, apart_[slotOf(link)] - most);
  }
}

}  // namespace foretouch
