#include "bench/person/person_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bench/machine.h"
#include "bench/person/bounded_person.h"
#include "bench/person/bracket_judge.h"
#include "lss/index.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

class Trial {
 public:
  Trial(const SolidStage& stage, const SolidActor& actor, const Placement& place,
        const PersonTrial& trial)
      : trial_(trial), avatar_(actor.avatar), person_(stage, actor, place, trial) {
    BracketOptions options;
    QueryOptions plain;
    if (trial.asksOwnLinks) {
      auto rules = PairRules::derive(avatar_);
      if (rules.ok()) {
        pairs_ = askedPairs(avatar_, rules.value());
        options.self = plain.self = std::move(rules).value();
      }
    }
    query_ = BracketQuery::build(avatar_, stage.scene, options).value();
    plain_ = Query::build(avatar_, stage.scene, plain).value();
  }

  PersonTally run() {
    time();
    for (const HeldBackStep& step : person_.steps()) judgeStep(step);
    return std::move(tally_);
  }

 private:
  void ask(const HeldBackStep& step) {
    (void)query_->answer(person_.posed(step), trial_.model, person_.bounds(), scratch_, brackets_);
  }

  void askPlainly(const HeldBackStep& step) {
    motion_.assign(avatar_.skeleton(), person_.frames()[step.from], person_.frames()[step.to]);
    plain_->answer(motion_, scratch_, contacts_);
  }

  /// All steps in order, twice; the second time counts.
  void time() {
    const std::vector<HeldBackStep> steps = person_.steps();
    for (const bool counts : {false, true}) {
      const ThreadStopwatch brackets;
      for (const HeldBackStep& step : steps) ask(step);
      if (counts) tally_.bracketUs += brackets.us();
      const ThreadStopwatch plain;
      for (const HeldBackStep& step : steps) askPlainly(step);
      if (counts) tally_.plainUs += plain.us();
    }
    tally_.steps += steps.size();
  }

  void judgeStep(const HeldBackStep& step) {
    ask(step);
    tally_.pieces += static_cast<std::uint64_t>(brackets_.pieces);
    truths_.resize(countOf(person_.looks()) + 1);
    for (int i = 0; i <= person_.looks(); ++i) {
      truths_[slotOf(i)] = person_.held().truthAt(step, static_cast<double>(i) / person_.looks());
    }
    if (trial_.asksOwnLinks) {
      for (const std::array<int, 2>& pair : pairs_) {
        LinkBracket bracket;
        bracket.verdict = BracketVerdict::Excluded;
        for (const LinkBracket& one : brackets_.pairs) {
          if (one.link == pair[0] && one.other == pair[1]) bracket = one;
        }
        judgeBracket(step, bracket, pair[0], pair[1]);
      }
      return;
    }
    askPlainly(step);
    person_.growths(step, growths_);
    for (const LinkBracket& bracket : brackets_.links) {
      if (avatar_.lss(bracket.link).empty()) continue;
      const bool hasTouched = judgeBracket(step, bracket, bracket.link, -1);
      const Verdict plain = contacts_.links[slotOf(bracket.link)].verdict;
      tally_.missedBetween += hasTouched && plain == Verdict::Clear ? 1 : 0;
      tally_.inventedBetween += !hasTouched && plain != Verdict::Clear ? 1 : 0;
    }
  }

  [[nodiscard]] double separation(const std::vector<HeldBack::Axis>& axes, int link, int other) {
    return other < 0 ? person_.held().fromScene(axes, link, 1e-3)
                     : person_.held().fromLink(axes, link, other);
  }

  bool judgeBracket(const HeldBackStep& step, const LinkBracket& bracket, int link, int other) {
    JudgedSides sides{
        fmt::format("link {} {} step {}", link, other, step.from), person_.stepS(), person_.looks(),
        [&](int i) { return separation(truths_[slotOf(i)], link, other); },
        [&](double t) { return separation(person_.held().truthAt(step, t), link, other); }};
    if (other < 0) {
      sides.growthAt = [&](double t) {
        return person_.bounds()[slotOf(link)].error + 4.0 * growths_[slotOf(link)] * t * (1.0 - t);
      };
      sides.modelApartAt = [&](double t) {
        return person_.held().fromScene(person_.held().modelAt(step, trial_.model, t), link,
                                        sides.growthAt(t) + 1e-3);
      };
    }
    return foretouch::tools::judge(bracket, sides, tally_);
  }

  const PersonTrial& trial_;
  const Avatar& avatar_;
  BoundedPerson person_;
  std::vector<std::array<int, 2>> pairs_;
  std::optional<BracketQuery> query_;
  std::optional<Query> plain_;
  Scratch scratch_;
  StepBrackets brackets_;
  StepContacts contacts_;
  ChainMotion motion_;
  std::vector<std::vector<HeldBack::Axis>> truths_;  // of the step at hand, and
  std::vector<double> growths_;                      // the same, per link
  PersonTally tally_;
};

}  // namespace

PersonTally judgePerson(const SolidStage& stage, const SolidActor& actor, const Placement& place,
                        const PersonTrial& trial) {
  return Trial(stage, actor, place, trial).run();
}

}  // namespace foretouch::tools
