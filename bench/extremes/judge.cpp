#include "bench/extremes/judge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"

namespace foretouch::tools::extremes {
namespace {

constexpr double kUlp = 0x1p-52;
/// Share of the extent: the least gap that fifty digits distinguish from touching.
constexpr double kTouchingShare = 1e-40;
/// Tolerance of a contact's normal as a unit vector.
constexpr double kUnitSlack = 1e-9;
constexpr std::size_t kMostFindings = 12;

bool isBit(const oracle::HullWorld& a, const oracle::HullWorld& b) {
  return a.joints == b.joints && a.triangles == b.triangles;
}

/// An impossible value in the answer; empty: none.
std::string malformation(const LinkContact& c, double tolerance, Scope scope) {
  const bool isTouch = c.verdict == Verdict::Contact || c.verdict == Verdict::StartsInContact;
  for (const double number :
       {c.toi, c.freeUntil, c.separation, c.penetration, c.p_WScene.sum(), c.p_WLink.sum(),
        c.nhat_SL_W.sum(), c.p_WScene.norm(), c.p_WLink.norm()}) {
    if (!std::isfinite(number)) return "a number that is not finite";
  }
  if (!(c.freeUntil >= 0.0 && c.freeUntil <= 1.0)) return "freedom beyond [0,1]";
  if (isTouch && c.toi != c.freeUntil) return "a contact apart from its freedom";
  if (c.verdict == Verdict::Clear && c.freeUntil != 1.0) return "clear, but not until 1";
  if (!(c.separation >= 0.0 && c.separation <= tolerance)) return "a separation beyond [0,eps]";
  if (!(c.penetration >= 0.0)) return "a negative penetration";
  if (isTouch && c.triangle < 0) return "no triangle";
  // What meets in a point, without radii, has no direction, and then none is reported.
  const bool mayHaveNone = c.verdict == Verdict::StartsInContact && c.nhat_SL_W.isZero(0.0);
  if (isTouch && !mayHaveNone && std::abs(c.nhat_SL_W.norm() - 1.0) > kUnitSlack) {
    return "no unit normal";
  }
  if (c.verdict == Verdict::StartsInContact && c.toi != 0.0) return "a start that is none";
  const bool mayBeAfterFirst = scope == Scope::FirstOfAvatar;
  if (c.verdict == Verdict::Undecided && c.reason != UndecidedReason::Resolution &&
      !(mayBeAfterFirst && c.reason == UndecidedReason::AfterFirst)) {
    return "undecided for no reason that it was given";
  }
  return "";
}

class Judge {
 public:
  Judge(const ExtremeCase& extreme, const Asked& asked, Tally& tally)
      : extreme_(extreme), asked_(asked), tally_(tally) {}

  std::vector<Finding> run() {
    for (const Answer& answer : asked_.answers) lookAt(answer);
    for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact}) {
      const bool isOne = isBit(asked_.world[0], asked_.world[1]);
      truth(
          fidelity, [&](const Answer& a) { return isOne || !a.isFlushed; }, asked_.world[0]);
      if (!isOne)
        truth(
            fidelity, [&](const Answer& a) { return a.isFlushed; }, asked_.world[1]);
    }
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.fault < b.fault; });
    return std::move(findings_);
  }

  void report(Fault fault, const std::string& what) {
    ++tally_.faults[slotOf(fault)];
    if (findings_.size() < kMostFindings) {
      findings_.push_back(
          {fault, fmt::format("{} seed {} ({}): {}: {}", extreme_.family, extreme_.seed,
                              extreme_.member, toString(fault), what)});
    }
  }

  std::vector<Finding> findings_;

 private:
  static std::string name(const Answer& answer, const LinkContact& contact) {
    return fmt::format("{}: link {} {} at {:.17g}", answer.way, contact.link,
                       toString(contact.verdict), contact.freeUntil);
  }

  /// The checks that need no oracle.
  void lookAt(const Answer& answer) {
    ++tally_.queries;
    const auto work = workOf(answer.step.counters);
    tally_.work.offer(static_cast<double>(work), extreme_.seed);
    if (work > kMostWork) report(Fault::Overworked, fmt::format("{}: {}", answer.way, work));
    for (const LinkContact& contact : answer.step.links) {
      const std::string problem = malformation(contact, extreme_.tolerance, answer.scope);
      if (!problem.empty()) {
        report(Fault::Malformed, fmt::format("{}: {}", name(answer, contact), problem));
      }
      switch (contact.verdict) {
        case Verdict::Contact: ++tally_.contacts; break;
        case Verdict::StartsInContact: ++tally_.starts; break;
        case Verdict::Clear: ++tally_.clear; break;
        case Verdict::Undecided: ++tally_.undecided; break;
      }
    }
  }

  template <typename IsMeant>
  void truth(Fidelity fidelity, const IsMeant& isMeant, const oracle::HullWorld& given) {
    std::vector<const Answer*> answers;
    for (const Answer& answer : asked_.answers) {
      if (answer.fidelity == fidelity && isMeant(answer)) answers.push_back(&answer);
    }
    if (answers.empty()) return;
    oracle::HullWorld world = given;
    world.hulls = hullsOf(extreme_, fidelity);
    const oracle::HullOracle truth(std::move(world));
    std::vector<double> until(answers.front()->step.links.size(), 0.0);
    for (const Answer* answer : answers) {
      for (const LinkContact& contact : answer->step.links) {
        double& last = until[slotOf(contact.link)];
        last = std::max(last, std::isfinite(contact.freeUntil) ? contact.freeUntil : 1.0);
      }
    }
    const std::vector<oracle::FreedomProof> proofs = truth.proveFree(until);
    separations_.clear();
    for (const Answer* answer : answers) {
      for (const LinkContact& contact : answer->step.links) {
        soundness(*answer, contact, proofs[slotOf(contact.link)]);
        tightness(*answer, contact, truth);
      }
    }
  }

  void soundness(const Answer& answer, const LinkContact& contact,
                 const oracle::FreedomProof& proof) {
    if (contact.freeUntil == 0.0 && contact.verdict != Verdict::Clear) return;
    if (proof.freedom == oracle::Freedom::Open) report(Fault::Open, name(answer, contact));
    const bool isClaimed = contact.verdict == Verdict::Clear ? proof.touchesAt <= 1.0
                                                             : proof.touchesAt < contact.freeUntil;
    if (proof.freedom == oracle::Freedom::Touches && isClaimed) {
      report(Fault::Late,
             fmt::format("{}, touches at {:.17g}", name(answer, contact), proof.touchesAt));
    }
    if (std::isfinite(proof.least) && proof.least < 1e299) {
      tally_.lateness.offer(-proof.least / extreme_.tolerance, extreme_.seed);
    }
    const bool isLast = contact.link + 1 == static_cast<LinkId>(answer.step.links.size());
    if (extreme_.fall && isLast && answer.fidelity == Fidelity::Link) {
      const Fall& fall = *extreme_.fall;
      if (contact.verdict == Verdict::Clear ||
          oracle::isAfterFall(contact.freeUntil, fall.high, fall.low, fall.radius)) {
        report(Fault::Late, name(answer, contact) + ", later than its closed form");
      }
    }
  }

  void tightness(const Answer& answer, const LinkContact& contact,
                 const oracle::HullOracle& truth) {
    const double ulp = kUlp * truth.extent(contact.link);
    const double allowed = roundingsAt(truth.depth(contact.link));
    if (contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::Resolution) {
      const double share = extreme_.tolerance / (4.0 / 3.0 * allowed * ulp);
      tally_.unresolved.offer(share, extreme_.seed);
      if (share > 1.0) {
        report(Fault::Needless,
               fmt::format("{}, tolerance {:g}", name(answer, contact), extreme_.tolerance));
      }
    }
    if (contact.verdict != Verdict::Contact && contact.verdict != Verdict::StartsInContact) return;
    const double separation = separationAt(truth, contact);
    if (contact.verdict == Verdict::StartsInContact) {
      tally_.start.offer(separation / ulp, extreme_.seed);
      tally_.startShare.offer(separation / (allowed * ulp), extreme_.seed);
      if (separation > allowed * ulp) {
        report(Fault::Loose,
               fmt::format("{}, {:g} m from touching", name(answer, contact), separation));
      }
      return;
    }
    tally_.tightness.offer(separation / extreme_.tolerance, extreme_.seed);
    tally_.excess.offer((separation - extreme_.tolerance) / ulp, extreme_.seed);
    if (separation < -kTouchingShare * truth.extent(contact.link)) {
      report(Fault::Late,
             fmt::format("{}, penetrates by {:g} m", name(answer, contact), -separation));
    }
    if (separation > extreme_.tolerance) {
      report(Fault::Loose, fmt::format("{}, separation {:.17g}, tolerance {:.17g}",
                                       name(answer, contact), separation, extreme_.tolerance));
    }
  }

  double separationAt(const oracle::HullOracle& truth, const LinkContact& contact) {
    const auto key = std::make_pair(contact.link, contact.toi);
    const auto known = separations_.find(key);
    if (known != separations_.end()) return known->second;
    const auto separation = static_cast<double>(truth.separationAt(contact.link, contact.toi));
    separations_.emplace(key, separation);
    return separation;
  }

  const ExtremeCase& extreme_;
  const Asked& asked_;
  Tally& tally_;
  std::map<std::pair<LinkId, double>, double> separations_;  // the current oracle's
};

}  // namespace

const char* toString(Fault fault) {
  switch (fault) {
    case Fault::None: return "none";
    case Fault::Late: return "late";
    case Fault::Malformed: return "malformed";
    case Fault::Accepted: return "accepted";
    case Fault::Overworked: return "overworked";
    case Fault::Loose: return "loose";
    case Fault::Needless: return "needless";
    case Fault::Open: return "open";
  }
  return "none";
}

bool isFailure(Fault fault) {
  return fault != Fault::None && fault != Fault::Open;
}

double roundingsAt(int depth) {
  return 400.0 + 300.0 * depth;
}

std::vector<Finding> judge(const ExtremeCase& extreme, Tally& tally) {
  const Asked asked = ask(extreme);
  ++tally.cases;
  Judge judge(extreme, asked, tally);
  if (!asked.isRefusedAlike) {
    judge.report(Fault::Malformed, "refused in one of two modes: " + describe(*asked.refusal));
  } else if (asked.refusal) {
    ++tally.refused;
    const bool isClear = !asked.refusal->message.empty();
    if (extreme.isLegal) judge.report(Fault::Malformed, "refused: " + describe(*asked.refusal));
    if (!isClear) judge.report(Fault::Malformed, "refused without a word");
    return std::move(judge.findings_);
  }
  if (!extreme.isLegal) {
    judge.report(Fault::Accepted, "answered");
    return std::move(judge.findings_);
  }
  return judge.run();
}

}  // namespace foretouch::tools::extremes
