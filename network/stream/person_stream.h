// network/stream/person_stream.h: what the person of one avatar's stream surely touched, may have
// touched and cannot have touched, step by step, and until when nothing will be touched: within
// bounds on how far they are from a model of their motion (docs/person.md). Pure apart from the
// clock that measures personUs: what it says follows from the steps, the scene and the options
// alone, so that a recorded stream repeats it.
//
// - A step is answered when its poses are known: by MotionModel::CubicLate a pose later, or where a
//   gap or another timeline begins, or the wait for the pose ends (endWait()). So a pose has one
//   message, or two.
// - A bound is about poses at its rate: nothing is claimed of a step that is not so long.
// - A link that a pose does not know is unclaimed in every step whose curve that pose bends. Once
//   it is known again a message of its own says what it touched from the last pose before these
//   steps to the first one behind them, as across lost poses.
// - Across lost poses only LinkBound::speed and error count, at the rate that the lost ones had.
// - `notBeforeUs` never falls while poses go on: what was excluded stays excluded, unless a pose
//   shows that the bound was wrong.
// Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/bounds/bounds_file.h"
#include "middleware/bracket/axis_places.h"
#include "middleware/bracket/bracket.h"
#include "middleware/scene/scene.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"

namespace foretouch {

inline constexpr std::int64_t kMostAheadUs = 10'000'000;
/// Links that are lost since as many different poses are followed; nothing is said of others.
inline constexpr std::size_t kMostLostSince = 6;

struct PersonStreamOptions {
  BoundsFile bounds;
  MotionModel model = MotionModel::ConstantRate;
  std::int64_t aheadUs = 0;  ///< How far to look ahead, at most kMostAheadUs; 0: not at all.
  BracketOptions brackets;
};

class PersonStream {
 public:
  /// `id`: the avatar's number in messages. Errors: as BracketQuery::build() and
  /// BoundsByRate::make(); an `aheadUs` out of range.
  static Result<PersonStream> make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                   const PersonStreamOptions& options);
  PersonStream(PersonStream&&) noexcept = default;
  PersonStream& operator=(PersonStream&&) = delete;

  /// Follows the step of one accepted pose, in the order of acceptance.
  void follow(const StreamStep& step);
  /// The pose that is waited for has not come for long, or never will: says the last step without
  /// it. Says nothing where nothing waits.
  void endWait();
  /// Whether this is what endWait() says now: a recorded stream says when a wait ended.
  [[nodiscard]] bool isEndOfWait(const PersonMessage& message) const;
  /// What the last pose, or the end of a wait, lets be said, but for the stamps of receiving and
  /// sending: one message or two, or none, and those about links that are known again.
  [[nodiscard]] std::size_t numSaid() const { return numSaid_; }
  [[nodiscard]] PersonMessage& said(std::size_t i) { return said_[i]; }
  [[nodiscard]] const PersonMessage& said(std::size_t i) const { return said_[i]; }

  [[nodiscard]] std::int32_t id() const { return id_; }

 private:
  /// A pose of the timeline at hand, and how it was reached.
  struct Kept {
    Pose pose;
    std::int64_t sequence = 0, utimeUs = 0;
    std::vector<std::uint8_t> isUnknown;  ///< Per link: in the step that it ends.
  };
  /// Links that no pose knows since this one, and how many steps ago that was; numLinks 0: none.
  struct LostSince {
    Kept pose;
    std::int64_t steps = 0;
    std::size_t numLinks = 0;
  };
  PersonStream(std::int32_t id, BracketQuery query, const Scene& scene, BoundsByRate bounds,
               const PersonStreamOptions& options);

  [[nodiscard]] static double secondsBetween(const Kept& from, const Kept& to);
  [[nodiscard]] static PosedStep between(const Kept& from, const Kept& to);
  void keep(const StreamStep& step);
  [[nodiscard]] const Kept* back(int i) const;
  [[nodiscard]] bool waits() const;
  const std::vector<std::uint8_t>& unknownIn(std::initializer_list<const Kept*> ends);
  const std::vector<LinkBound>& claimed(double rateHz, const std::vector<std::uint8_t>& isUnknown);
  PersonMessage& begin(const StreamStep& step);
  PersonMessage& begin(const StreamStep& step, StepKind kind, const Kept& from, const Kept& to);
  void sayStep(const StreamStep& step, int newer);
  void sayGap(const StreamStep& step);
  void sayAcross(const StreamStep& step, const Kept& from, const Kept& to, std::int64_t steps,
                 const std::vector<std::uint8_t>& isUnknown, const std::vector<std::uint8_t>* isOf);
  void followLost(const StreamStep& step, const Kept& from, std::int64_t steps);
  void lose(std::size_t link, const Kept& from);
  void sayFound(const StreamStep& step, std::size_t since, const Kept& to);
  void take(const StepBrackets& brackets, PersonMessage& message) const;
  void lookAhead(PersonMessage& message);
  void lower(const LinkBracket& bracket, LinkId link, std::int64_t utimeUs);
  void checkAhead(const StreamStep& step);
  void checkGap(const PosedStep& step, const std::vector<LinkBound>& bounds,
                const std::vector<std::uint8_t>* isOf);
  void addBroken(BrokenBound::Claim claim, LinkId link, double beyond);

  std::int32_t id_ = 0;
  BracketQuery query_;
  Scene scene_;
  BoundsByRate bounds_;
  MotionModel model_;
  std::int64_t aheadUs_ = 0, boundsHash_ = 0;
  double resolution_ = 0.0;
  /// The newest is kept_[(numKept_ - 1) % size].
  std::array<Kept, 4> kept_;
  std::size_t numKept_ = 0;  // since the timeline began, or the last gap
  std::int64_t session_ = 0;
  bool hasEndedWait_ = false;  // the newest step is said already
  std::vector<std::int64_t> notBeforeUs_, nowNotBeforeUs_;
  std::vector<BrokenBound> broken_;  // of the pose at hand
  std::array<LostSince, kMostLostSince> lost_;
  std::vector<std::int8_t> lostSince_;  ///< Per link: its place in lost_, or a mark.
  /// Two steps may end at a pose; after each of them links may be found.
  std::array<PersonMessage, 2 * (1 + kMostLostSince)> said_;
  std::size_t numSaid_ = 0;
  // Scratch.
  Scratch scratch_;
  StepBrackets brackets_;
  std::vector<LinkBound> claimed_;
  std::vector<std::uint8_t> isUnknown_, isFound_, isApart_;
  AxisPlacer placer_;
  AxisPlaces one_, other_;
  std::vector<double> apart_;
  std::vector<double> ahead_;
  std::vector<Pose> aheadPoses_;
};

}  // namespace foretouch
