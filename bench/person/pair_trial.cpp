#include "bench/person/pair_trial.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/machine.h"
#include "bench/person/bounded_person.h"
#include "bench/person/bracket_judge.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// Shorter parts (s) of two steps are rounding.
constexpr double kShortest = 1e-9;

/// The part of two steps in which both go on.
struct Overlap {
  HeldBackStep one, other;
  double beginS = 0.0, endS = 0.0;
};

class PairTrial {
 public:
  PairTrial(const SolidStage& stage, const PersonOfPair& one, const PersonOfPair& other)
      : trials_{one.trial, other.trial},
        one_(stage, one.actor, one.place, trials_[0]),
        other_(stage, other.actor, other.place, trials_[1]),
        avatars_{&one.actor.avatar, &other.actor.avatar},
        query_(PairBracketQuery::build(*avatars_[0], *avatars_[1], {}).value()) {}

  PersonTally run() {
    const std::vector<Overlap> overlaps = overlapping();
    for (const bool counts : {false, true}) {
      const ThreadStopwatch watch;
      for (const Overlap& overlap : overlaps) ask(overlap);
      if (counts) tally_.bracketUs += watch.us();
    }
    tally_.steps += overlaps.size();
    for (const Overlap& overlap : overlaps) judgeOverlap(overlap);
    return std::move(tally_);
  }

 private:
  /// Both lists are in order of time.
  [[nodiscard]] std::vector<Overlap> overlapping() {
    std::vector<Overlap> overlaps;
    for (const HeldBackStep& one : one_.steps()) {
      for (const HeldBackStep& other : other_.steps()) {
        const double begin = std::max(one_.beginOf(one), other_.beginOf(other));
        const double end =
            std::min(one_.beginOf(one) + one_.stepS(), other_.beginOf(other) + other_.stepS());
        if (end - begin > kShortest) overlaps.push_back({one, other, begin, end});
      }
    }
    return overlaps;
  }

  static double partAt(const BoundedPerson& person, const HeldBackStep& step, double s) {
    return std::clamp((s - person.beginOf(step)) / person.stepS(), 0.0, 1.0);
  }
  static PersonStep stepOf(const BoundedPerson& person, const PersonTrial& trial,
                           const HeldBackStep& step, const Overlap& overlap) {
    return {person.posed(step), trial.model, &person.bounds(), partAt(person, step, overlap.beginS),
            partAt(person, step, overlap.endS)};
  }

  void ask(const Overlap& overlap) {
    (void)query_.answer(stepOf(one_, trials_[0], overlap.one, overlap),
                        stepOf(other_, trials_[1], overlap.other, overlap), scratch_, brackets_);
  }

  using Axes = std::vector<HeldBack::Axis>;
  [[nodiscard]] Axes axesAt(BoundedPerson& person, const HeldBackStep& step, double s) {
    return person.held().truthAt(step, partAt(person, step, s));
  }
  struct Look {
    Axes one, other;
    std::vector<oracle::Box> boxes, otherBoxes;
  };
  [[nodiscard]] Look lookAt(const Overlap& overlap, double t) {
    const double s = overlap.beginS + t * (overlap.endS - overlap.beginS);
    return {axesAt(one_, overlap.one, s), axesAt(other_, overlap.other, s), {}, {}};
  }

  void judgeOverlap(const Overlap& overlap) {
    ask(overlap);
    tally_.pieces += static_cast<std::uint64_t>(brackets_.pieces);
    const int looks = std::max(one_.looks(), other_.looks());
    looks_.clear();
    for (int i = 0; i <= looks; ++i) {
      looks_.push_back(lookAt(overlap, static_cast<double>(i) / looks));
      Look& look = looks_.back();
      for (LinkId link = 0; link < avatars_[0]->numLinks(); ++link) {
        look.boxes.push_back(one_.held().boxOf(look.one, link));
      }
      for (LinkId link = 0; link < avatars_[1]->numLinks(); ++link) {
        look.otherBoxes.push_back(other_.held().boxOf(look.other, link));
      }
    }
    for (LinkId link = 0; link < avatars_[0]->numLinks(); ++link) {
      for (LinkId other = 0; other < avatars_[1]->numLinks(); ++other) {
        if (avatars_[0]->lss(link).empty() || avatars_[1]->lss(other).empty()) continue;
        judgePair(overlap, looks, link, other);
      }
    }
  }

  void judgePair(const Overlap& overlap, int looks, LinkId link, LinkId other) {
    LinkBracket bracket;
    bracket.verdict = BracketVerdict::Excluded;
    for (const LinkBracket& one : brackets_.pairs) {
      if (one.link == link && one.other == other) bracket = one;
    }
    const auto apart = [&](const Look& look) {
      return one_.held().fromLinkOf(other_.held(), look.one, link, look.other, other);
    };
    const JudgedSides sides{
        fmt::format("link {} and {} of the other, at {:.4f} s", link, other, overlap.beginS),
        overlap.endS - overlap.beginS, looks,
        [&](int i) {
          const Look& look = looks_[slotOf(i)];
          const bool areNear = look.boxes[slotOf(link)].meets(look.otherBoxes[slotOf(other)]);
          return areNear ? apart(look) : 1.0;
        },
        [&](double t) { return apart(lookAt(overlap, t)); }};
    judge(bracket, sides, tally_);
  }

  const PersonTrial trials_[2];
  BoundedPerson one_, other_;
  const Avatar* avatars_[2];
  PairBracketQuery query_;
  Scratch scratch_;
  StepBrackets brackets_;
  std::vector<Look> looks_;  // of the overlap at hand
  PersonTally tally_;
};

}  // namespace

PersonTally judgePersons(const SolidStage& stage, const PersonOfPair& one,
                         const PersonOfPair& other) {
  return PairTrial(stage, one, other).run();
}

}  // namespace foretouch::tools
