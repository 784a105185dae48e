#include <cstddef>
#include <foretouch/person_t.hpp>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"

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

using wire::field;
using wire::in;

constexpr auto kPersonHead = std::make_tuple(
    field(&PersonMessage::avatar, &person_t::avatar, wire::kAny),
    field(&PersonMessage::session, &person_t::session, wire::kWhole),
    field(&PersonMessage::sequence, &person_t::sequence, wire::kWhole),
    field(&PersonMessage::utimeUs, &person_t::utime, wire::kWhole),
    field(&PersonMessage::model, &person_t::between, wire::codeBelow(person_t::CUBIC_LATE + 1)),
    field(&PersonMessage::boundsHash, &person_t::bounds_hash, wire::kAny),
    field(&PersonMessage::resolution, &person_t::resolution, wire::kNotNegative),
    field(&PersonMessage::kind, &person_t::kind, wire::codeBelow(kNumStepKinds)),
    field(&PersonMessage::sequenceFrom, &person_t::sequence_from, wire::kWhole),
    field(&PersonMessage::sequenceTo, &person_t::sequence_to, wire::kWhole),
    field(&PersonMessage::utimeFromUs, &person_t::utime_from, wire::kWhole),
    field(&PersonMessage::utimeToUs, &person_t::utime_to, wire::kWhole),
    field(&PersonMessage::aheadUs, &person_t::ahead_us, wire::kWhole),
    field(&PersonMessage::bracketsLeftOut, &person_t::brackets_left_out, wire::kWhole),
    field(&PersonMessage::receiveUtimeUs, &person_t::receive_utime, wire::kWhole),
    field(&PersonMessage::sendUtimeUs, &person_t::send_utime, wire::kWhole),
    field(&PersonMessage::personUs, &person_t::person_us, wire::kNotNegative));

constexpr auto kBracket = std::make_tuple(
    field(in(&ToldBracket::bracket, &LinkBracket::link), &person_t::links, wire::kAny),
    field(in(&ToldBracket::bracket, &LinkBracket::other), &person_t::others, wire::kAny),
    field(in(&ToldBracket::bracket, &LinkBracket::triangle), &person_t::triangles,
          wire::indexFrom(-1)),
    field(in(&ToldBracket::bracket, &LinkBracket::verdict), &person_t::claims,
          wire::Whole{person_t::POSSIBLE, person_t::CERTAIN}),
    field(in(&ToldBracket::bracket, &LinkBracket::possibleFrom), &person_t::possible_from,
          wire::kFraction),
    field(in(&ToldBracket::bracket, &LinkBracket::possibleUntil), &person_t::possible_until,
          wire::kFraction),
    field(in(&ToldBracket::bracket, &LinkBracket::certainFrom), &person_t::certain_from,
          wire::kFraction),
    field(in(&ToldBracket::bracket, &LinkBracket::certainUntil), &person_t::certain_until,
          wire::kFraction),
    field(in(&ToldBracket::bracket, &LinkBracket::growth), &person_t::growth, wire::kNotNegative),
    field(&ToldBracket::linkName, &person_t::link_names, wire::kJointName),
    field(&ToldBracket::otherName, &person_t::objects, wire::kAny));

constexpr auto kBroken =
    std::make_tuple(field(&BrokenBound::link, &person_t::broken_links, wire::indexFrom(0)),
                    field(&BrokenBound::claim, &person_t::broken_claims,
                          wire::codeBelow(person_t::BROKEN_AHEAD + 1)),
                    field(&BrokenBound::beyond, &person_t::beyond, wire::kNotNegative));

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
  // Of no links the decoder leaves the array of the message before.
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
  if (reject == Reject::None) reject = wire::read(wire, kPersonHead, message);
  if (reject == Reject::None) reject = checkSteps(wire);
  if (reject == Reject::None) reject = readLinks(wire, message);
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, kBracket, &person_t::num_brackets, message.brackets,
                          [&](const ToldBracket& told, std::size_t) {
                            return checkBracket(told.bracket, wire.num_links);
                          });
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, kBroken, &person_t::num_broken, message.broken,
                        [&](const BrokenBound& broken, std::size_t) {
                          return broken.link < wire.num_links ? Reject::None : Reject::BadIndex;
                        });
}

void encode(const PersonMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.brackets.size() <= kMaxPersonBrackets);
  auto& wire = wire::scratch<person_t>();
  wire::write(message, kPersonHead, wire);
  writeLinks(message, wire);
  wire::writeRows(message.brackets, kBracket, &person_t::num_brackets, wire);
  wire::writeRows(message.broken, kBroken, &person_t::num_broken, wire);
  toBytes(PayloadType::Person, wire, payload);
}

}  // namespace foretouch
