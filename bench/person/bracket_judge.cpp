#include "bench/person/bracket_judge.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "bench/person/held_back.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kMostFindings = 10;

void find(std::string text, PersonTally& tally) {
  if (tally.findings.size() < kMostFindings) tally.findings.push_back(std::move(text));
}

bool excludes(const LinkBracket& bracket, double t) {
  return bracket.verdict == BracketVerdict::Excluded ||
         (bracket.verdict != BracketVerdict::Unclaimed &&
          (t < bracket.possibleFrom || t > bracket.possibleUntil));
}

/// Instants of a passage that the judge looks at: thin links are on a surface for a short time.
constexpr int kPassageLooks = 2000;

void checkPassage(const LinkBracket& bracket, const JudgedSides& sides, PersonTally& tally) {
  ++tally.passed;
  const double span = bracket.certainFrom - bracket.certainUntil;
  for (int i = 0; i <= kPassageLooks; ++i) {
    const double t = bracket.certainUntil + span * i / kPassageLooks;
    if (sides.apartAt(t) <= kJudgeRounding) return;
  }
  ++tally.lied;
  find(fmt::format("lied: {} passed from {:.6f} to {:.6f}", sides.name, bracket.certainUntil,
                   bracket.certainFrom),
       tally);
}

void checkCertain(const LinkBracket& bracket, const JudgedSides& sides, PersonTally& tally) {
  if (bracket.certainUntil < bracket.certainFrom) return checkPassage(bracket, sides, tally);
  for (const double t : {bracket.certainFrom, bracket.certainUntil}) {
    const double apart = sides.apartAt(t);
    if (!(apart > kJudgeRounding)) continue;
    ++tally.lied;
    find(fmt::format("lied: {} at {:.6f}, {:.3g} m apart", sides.name, t, apart), tally);
  }
}

/// The first instant of [from, to] at which the model is within `share` growths of the other side;
/// `to` if there is none at the looks.
double firstWithin(const JudgedSides& sides, double share, double from, double to) {
  constexpr int kLooks = 64, kHalvings = 20;
  const auto isWithin = [&](double t) {
    return sides.modelApartAt(t) <= share * sides.growthAt(t);
  };
  double before = from;
  for (int i = 0; i <= kLooks; ++i) {
    double t = from + (to - from) * i / kLooks;
    if (!isWithin(t)) {
      before = t;
      continue;
    }
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (before + t);
      (isWithin(middle) ? t : before) = middle;
    }
    return t;
  }
  return to;
}

/// No person within the bounds touches before its begin, and there are two within them, one of whom
/// touches a plane there, and the other not until its end.
void measureWidth(const LinkBracket& bracket, const JudgedSides& sides, PersonTally& tally) {
  const double ms = 1e3 * sides.seconds * (bracket.certainFrom - bracket.possibleFrom);
  tally.widthsMs.push_back(ms);
  if (!sides.modelApartAt || bracket.certainUntil < bracket.certainFrom) return;
  const double begin = firstWithin(sides, 1.0, bracket.possibleFrom, bracket.certainFrom);
  const double end = firstWithin(sides, -1.0, begin, bracket.certainFrom);
  const double leastMs = 1e3 * sides.seconds * (end - begin);
  const double way = sides.modelApartAt(begin) - sides.modelApartAt(end);
  const double approach = leastMs > 0.0 ? 1e3 * way / leastMs : 0.0;
  tally.widths.push_back({approach, ms, leastMs, 1e3 * sides.growthAt(begin)});
}

}  // namespace

bool judge(const LinkBracket& bracket, const JudgedSides& sides, PersonTally& tally) {
  ++tally.intervals;
  std::uint64_t* const counts[] = {&tally.unclaimed, &tally.excluded, &tally.possible,
                                   &tally.certain};
  ++*counts[static_cast<std::size_t>(bracket.verdict)];
  tally.growthsMm.push_back(1e3 * bracket.growth);
  bool hasTouched = false, touchesFirst = false, touchesLast = false, isMissed = false;
  for (int i = 0; i <= sides.looks; ++i) {
    if (!(sides.apartAtLook(i) < -kJudgeRounding)) continue;
    hasTouched = true;
    touchesFirst = touchesFirst || i == 0;
    touchesLast = touchesLast || i == sides.looks;
    const double t = static_cast<double>(i) / sides.looks;
    if (isMissed || !excludes(bracket, t)) continue;
    isMissed = true;
    ++tally.missed;
    find(fmt::format("missed: {} at {:.6f}", sides.name, t), tally);
  }
  if (bracket.verdict == BracketVerdict::Certain) checkCertain(bracket, sides, tally);
  if (!hasTouched || touchesFirst) return hasTouched;
  ++tally.fresh;
  if (!touchesLast) ++tally.missedByPoses;
  if (bracket.verdict != BracketVerdict::Certain) return true;
  ++tally.freshCertain;
  measureWidth(bracket, sides, tally);
  return true;
}

}  // namespace foretouch::tools
