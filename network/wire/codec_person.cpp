#include <algorithm>
#include <cmath>
#include <cstddef>
#include <foretouch/person_t.hpp>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(MotionModel::ConstantRate) == person_t::CONSTANT_RATE);
static_assert(static_cast<int>(MotionModel::Cubic) == person_t::CUBIC);
static_assert(static_cast<int>(MotionModel::CubicLate) == person_t::CUBIC_LATE);
static_assert(static_cast<int>(BracketVerdict::Unclaimed) == person_t::UNCLAIMED);
static_assert(static_cast<int>(BracketVerdict::Excluded) == person_t::EXCLUDED);
static_assert(static_cast<int>(BracketVerdict::Possible) == person_t::POSSIBLE);
static_assert(static_cast<int>(BracketVerdict::Certain) == person_t::CERTAIN);
static_assert(static_cast<int>(BrokenBound::Claim::InGap) == person_t::BROKEN_IN_GAP);
static_assert(static_cast<int>(BrokenBound::Claim::Ahead) == person_t::BROKEN_AHEAD);
constexpr auto kLastPersonKind = static_cast<std::int8_t>(StepKind::AcrossGap);
// The largest message fits.
static_assert(kMaxPersonBrackets * (kMaxNameBytes + kMaxTextBytes + 2 * 5 + 3 * 4 + 1 + 5 * 8) +
                  kMaxListed * (1 + 8 + 4 + 1 + 8) + 1024 <=
              kMaxMessageBytes);

Reject checkPersonHead(const person_t& wire) {
  if (!inRange({wire.session, wire.sequence, wire.utime, wire.sequence_from, wire.sequence_to,
                wire.utime_from, wire.utime_to, wire.ahead_us, wire.brackets_left_out,
                wire.receive_utime, wire.send_utime}) ||
      wire.sequence_from > wire.sequence_to || wire.utime_from > wire.utime_to) {
    return Reject::OutOfRange;
  }
  if (!allFinite({wire.resolution, wire.person_us})) return Reject::NonFinite;
  const bool isKnown = wire.kind >= 0 && wire.kind <= kLastPersonKind && wire.between >= 0 &&
                       wire.between <= person_t::CUBIC_LATE && wire.resolution >= 0.0 &&
                       wire.person_us >= 0.0;
  if (!isKnown) return Reject::OutOfRange;
  return countOf(wire.num_brackets) <= kMaxPersonBrackets ? Reject::None : Reject::Limit;
}

void readPersonHead(const person_t& wire, PersonMessage& message) {
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.model = static_cast<MotionModel>(wire.between);
  message.boundsHash = wire.bounds_hash;
  message.resolution = wire.resolution;
  message.kind = static_cast<StepKind>(wire.kind);
  message.sequenceFrom = wire.sequence_from;
  message.sequenceTo = wire.sequence_to;
  message.utimeFromUs = wire.utime_from;
  message.utimeToUs = wire.utime_to;
  message.aheadUs = wire.ahead_us;
  message.bracketsLeftOut = wire.brackets_left_out;
  message.receiveUtimeUs = wire.receive_utime;
  message.sendUtimeUs = wire.send_utime;
  message.personUs = wire.person_us;
}

Reject readLinks(const person_t& wire, PersonMessage& message) {
  const std::size_t n = countOf(wire.num_links);
  message.verdicts.resize(n);
  // Of no links the decoder leaves the array of the message before.
  message.notBeforeUs.assign(wire.not_before.begin(), wire.not_before.begin() + wire.num_links);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t notBefore = wire.not_before[i];
    if (wire.verdicts[i] > person_t::CERTAIN || notBefore < -1 || notBefore > kMaxWireInteger) {
      return Reject::OutOfRange;
    }
    message.verdicts[i] = static_cast<BracketVerdict>(wire.verdicts[i]);
  }
  return Reject::None;
}

bool isFraction(double t) {
  return t >= 0.0 && t <= 1.0;
}

Reject checkBracket(const LinkBracket& bracket, std::int32_t numLinks) {
  const bool isOwn = bracket.other != kNoParent;
  const bool hasOther = bracket.other >= 0 && bracket.other < numLinks;
  if (bracket.link < 0 || bracket.link >= numLinks || bracket.triangle < -1 ||
      (isOwn && (!hasOther || bracket.other == bracket.link || bracket.triangle >= 0))) {
    return Reject::BadIndex;
  }
  if (!allFinite({bracket.possibleFrom, bracket.possibleUntil, bracket.certainFrom,
                  bracket.certainUntil, bracket.growth})) {
    return Reject::NonFinite;
  }
  const bool isKnown =
      bracket.verdict == BracketVerdict::Possible || bracket.verdict == BracketVerdict::Certain;
  const bool isInside = isFraction(bracket.possibleFrom) && isFraction(bracket.possibleUntil) &&
                        isFraction(bracket.certainFrom) && isFraction(bracket.certainUntil) &&
                        bracket.growth >= 0.0;
  return isKnown && isInside ? Reject::None : Reject::OutOfRange;
}

Reject readBrackets(const person_t& wire, PersonMessage& message) {
  message.brackets.resize(countOf(wire.num_brackets));
  for (std::size_t i = 0; i < message.brackets.size(); ++i) {
    ToldBracket& told = message.brackets[i];
    told.bracket.link = wire.links[i];
    told.bracket.other = wire.others[i];
    told.bracket.triangle = wire.triangles[i];
    told.bracket.verdict = static_cast<BracketVerdict>(wire.claims[i]);
    told.bracket.possibleFrom = wire.possible_from[i];
    told.bracket.possibleUntil = wire.possible_until[i];
    told.bracket.certainFrom = wire.certain_from[i];
    told.bracket.certainUntil = wire.certain_until[i];
    told.bracket.growth = wire.growth[i];
    told.linkName = wire.link_names[i];
    told.otherName = wire.objects[i];
    const Reject reject = checkBracket(told.bracket, wire.num_links);
    if (reject != Reject::None) return reject;
    if (nameProblem(told.linkName)) return Reject::BadName;
  }
  return Reject::None;
}

Reject readBroken(const person_t& wire, PersonMessage& message) {
  message.broken.resize(countOf(wire.num_broken));
  for (std::size_t i = 0; i < message.broken.size(); ++i) {
    if (wire.broken_links[i] < 0 || wire.broken_links[i] >= wire.num_links) return Reject::BadIndex;
    if (!std::isfinite(wire.beyond[i])) return Reject::NonFinite;
    if (wire.broken_claims[i] > person_t::BROKEN_AHEAD || wire.beyond[i] < 0.0) {
      return Reject::OutOfRange;
    }
    message.broken[i] = {wire.broken_links[i],
                         static_cast<BrokenBound::Claim>(wire.broken_claims[i]), wire.beyond[i]};
  }
  return Reject::None;
}

void writePersonHead(const PersonMessage& message, person_t& wire) {
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.between = static_cast<std::int8_t>(message.model);
  wire.bounds_hash = message.boundsHash;
  wire.resolution = message.resolution;
  wire.kind = static_cast<std::int8_t>(message.kind);
  wire.sequence_from = message.sequenceFrom;
  wire.sequence_to = message.sequenceTo;
  wire.utime_from = message.utimeFromUs;
  wire.utime_to = message.utimeToUs;
  wire.ahead_us = message.aheadUs;
  wire.brackets_left_out = message.bracketsLeftOut;
  wire.receive_utime = message.receiveUtimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.person_us = message.personUs;
}

void writeLinks(const PersonMessage& message, person_t& wire) {
  const std::size_t n = message.verdicts.size();
  FORETOUCH_ASSERT(n == message.notBeforeUs.size());
  wire.num_links = static_cast<std::int32_t>(n);
  wire.verdicts.resize(n);
  wire.not_before = message.notBeforeUs;
  for (std::size_t i = 0; i < n; ++i) {
    wire.verdicts[i] = static_cast<std::uint8_t>(message.verdicts[i]);
  }
}

void writeBrackets(const PersonMessage& message, person_t& wire) {
  const std::size_t n = message.brackets.size();
  FORETOUCH_ASSERT(n <= kMaxPersonBrackets);
  wire.num_brackets = static_cast<std::int32_t>(n);
  for (auto* const part : {&wire.links, &wire.triangles, &wire.others}) part->resize(n);
  for (auto* const part : {&wire.possible_from, &wire.possible_until, &wire.certain_from,
                           &wire.certain_until, &wire.growth}) {
    part->resize(n);
  }
  wire.claims.resize(n);
  wire.link_names.resize(n);
  wire.objects.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const ToldBracket& told = message.brackets[i];
    wire.links[i] = told.bracket.link;
    wire.others[i] = told.bracket.other;
    wire.triangles[i] = told.bracket.triangle;
    wire.claims[i] = static_cast<std::uint8_t>(told.bracket.verdict);
    wire.possible_from[i] = told.bracket.possibleFrom;
    wire.possible_until[i] = told.bracket.possibleUntil;
    wire.certain_from[i] = told.bracket.certainFrom;
    wire.certain_until[i] = told.bracket.certainUntil;
    wire.growth[i] = told.bracket.growth;
    wire.link_names[i] = told.linkName;
    wire.objects[i] = told.otherName;
  }
}

void writeBroken(const PersonMessage& message, person_t& wire) {
  const std::size_t n = message.broken.size();
  wire.num_broken = static_cast<std::int32_t>(n);
  wire.broken_links.resize(n);
  wire.broken_claims.resize(n);
  wire.beyond.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    wire.broken_links[i] = message.broken[i].link;
    wire.broken_claims[i] = static_cast<std::uint8_t>(message.broken[i].claim);
    wire.beyond[i] = message.broken[i].beyond;
  }
}

/// Keeps its memory: every pose has one.
person_t& personScratch() {
  static thread_local person_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, PersonMessage& message) {
  person_t& wire = personScratch();
  Reject reject = fromBytes(PayloadType::Person, payload, wire);
  if (reject == Reject::None) reject = checkPersonHead(wire);
  if (reject != Reject::None) return reject;
  readPersonHead(wire, message);
  reject = readLinks(wire, message);
  if (reject == Reject::None) reject = readBrackets(wire, message);
  if (reject == Reject::None) reject = readBroken(wire, message);
  return reject;
}

void encode(const PersonMessage& message, Bytes& payload) {
  person_t& wire = personScratch();
  writePersonHead(message, wire);
  writeLinks(message, wire);
  writeBrackets(message, wire);
  writeBroken(message, wire);
  toBytes(PayloadType::Person, wire, payload);
}

}  // namespace foretouch
