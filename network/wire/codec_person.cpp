#include <cstddef>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

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
// The largest message fits.
static_assert(kMaxPersonBrackets * (kMaxNameBytes + kMaxTextBytes + 2 * 5 + 3 * 4 + 1 + 5 * 8) +
                  kMaxListed * (1 + 8 + 4 + 1 + 8) + 1024 <=
              kMaxMessageBytes);

constexpr auto kPerson =
    std::tuple_cat(wire::kPersonKey, wire::kPersonOptions, wire::kPersonStep, wire::kPersonAhead,
                   wire::kPersonLeftOut, wire::kPersonStamps);
constexpr auto kBracket = std::tuple_cat(wire::kBracketSides, wire::kBracketPossible,
                                         wire::kBracketCertain, wire::kBracketGrowth);

Reject checkSteps(const person_t& wire) {
  if (wire.sequence_from > wire.sequence_to || wire.utime_from > wire.utime_to) {
    return Reject::OutOfRange;
  }
  return countOf(wire.num_brackets) <= kMaxPersonBrackets ? Reject::None : Reject::Limit;
}

Reject readLinks(const person_t& wire, PersonMessage& message) {
  constexpr wire::Whole kNotBefore{-1};
  const std::size_t n = countOf(wire.num_links);
  message.verdicts.resize(n);
  // For no links, the decoder leaves the array of the message before.
  message.notBeforeUs.assign(wire.not_before.begin(), wire.not_before.begin() + wire.num_links);
  for (std::size_t i = 0; i < n; ++i) {
    const Reject reject = kNotBefore(wire.not_before[i]);
    if (reject != Reject::None || wire.verdicts[i] > person_t::CERTAIN) return Reject::OutOfRange;
    message.verdicts[i] = static_cast<BracketVerdict>(wire.verdicts[i]);
  }
  return Reject::None;
}

/// With the scene, or with an own link.
Reject checkBracket(const LinkBracket& bracket, std::int32_t numLinks) {
  const bool isOwn = bracket.other != kNoParent;
  const bool hasOther = bracket.other >= 0 && bracket.other < numLinks;
  const bool isWrong = bracket.link < 0 || bracket.link >= numLinks ||
                       (isOwn && (!hasOther || bracket.other == bracket.link)) ||
                       (isOwn && bracket.triangle >= 0);
  return isWrong ? Reject::BadIndex : Reject::None;
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

}  // namespace

Reject decode(ByteView payload, PersonMessage& message) {
  auto& wire = wire::scratch<person_t>();
  Reject reject = fromBytes(PayloadType::Person, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kPerson, message);
  if (reject == Reject::None) reject = checkSteps(wire);
  if (reject == Reject::None) reject = readLinks(wire, message);
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, kBracket, &person_t::num_brackets, message.brackets,
                          [&](const ToldBracket& told, std::size_t) {
                            return checkBracket(told.bracket, wire.num_links);
                          });
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, wire::kBroken, &person_t::num_broken, message.broken,
                        [&](const BrokenBound& broken, std::size_t) {
                          return broken.link < wire.num_links ? Reject::None : Reject::BadIndex;
                        });
}

void encode(const PersonMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.brackets.size() <= kMaxPersonBrackets);
  auto& wire = wire::scratch<person_t>();
  wire::write(message, kPerson, wire);
  writeLinks(message, wire);
  wire::writeRows(message.brackets, kBracket, &person_t::num_brackets, wire);
  wire::writeRows(message.broken, wire::kBroken, &person_t::num_broken, wire);
  toBytes(PayloadType::Person, wire, payload);
}

}  // namespace foretouch
