// judge/judge.cpp: compares each verdict with the proof.
#include "judge/judge.h"

#include <utility>

#include "judge/mesh_prover.h"

namespace foretouch::oracle {

const char* toString(Finding finding) {
  switch (finding) {
    case Finding::Ok: return "ok";
    case Finding::Missed: return "missed";
    case Finding::Late: return "late";
    case Finding::Early: return "early";
    case Finding::WrongStart: return "wrong start";
    case Finding::Inconsistent: return "inconsistent";
    case Finding::Unproved: return "unproved";
  }
  return "?";
}

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::Clear: return "clear";
    case Verdict::Contact: return "contact";
    case Verdict::StartsInContact: return "starts_in_contact";
    case Verdict::Undecided: return "undecided";
  }
  return "?";
}

Judge::Judge(const Scene& scene, const Motion& motion, int link,
             const std::vector<Capsule>& capsules) {
  for (const Capsule& capsule : capsules) {
    add(std::make_unique<CapsuleProver>(scene, motion, link, capsule));
  }
}

Judge::Judge(const Scene& scene, const Motion& motion, int link,
             const std::vector<Triangle>& mesh) {
  add(std::make_unique<MeshProver>(scene, motion, link, mesh));
}

Judge::Judge(const Scene& scene, const Motion& motion, const std::vector<SkinTriangle>& skin) {
  add(std::make_unique<SkinProver>(scene, motion, skin));
}

Judge::Judge(const Motion& motion, std::vector<Hull> one, std::vector<Hull> other,
             std::vector<RadiusSum> sums) {
  add(std::make_unique<PairProver>(motion, std::move(one), std::move(other), std::move(sums)));
}

void Judge::add(std::unique_ptr<MovingSurface> surface) {
  guard_ = std::max(guard_, kWitnessGuard * surface->scale());
  guardInWorld_ = std::max(guardInWorld_, kWitnessGuard * surface->scaleInWorld());
  surfaces_.push_back(std::move(surface));
}

Real Judge::separationAt(Real t, double within) const {
  Real least = within;
  for (const auto& s : surfaces_) {
    least = std::min(least, s->separationAt(t, static_cast<double>(least)));
  }
  return least;
}

Judgement Judge::judgeFree(Real until, Finding ifNot) {
  Judgement judgement;
  for (const auto& surface : surfaces_) {
    const SpanOutcome outcome = surface->prove(0, until);
    judgement.grazing += outcome.grazing;
    judgement.looks += outcome.looks;
    if (outcome.free) continue;
    judgement.finding = outcome.touching ? ifNot : Finding::Unproved;
    judgement.time = outcome.touching.value_or(outcome.freeUntil);
    judgement.separation = outcome.separation;
    return judgement;
  }
  return judgement;
}

Judgement Judge::judgeContact(const Answer& answer, double tolerance) {
  Judgement judgement = judgeFree(answer.toi, Finding::Late);
  if (judgement.finding != Finding::Ok) return judgement;
  const Real most = tolerance + guard_ * (kSoundGuard / kWitnessGuard);
  const Real separation = separationAt(answer.toi, static_cast<double>(2 * most));
  if (separation > most) {
    judgement.finding = Finding::Early;
    judgement.time = answer.toi;
    judgement.separation = separationAt(answer.toi);
  }
  return judgement;
}

Judgement Judge::judgeStart(const Answer&) {
  Judgement judgement;
  judgement.separation = separationAt(0, 2 * static_cast<double>(guard_));
  if (judgement.separation > guard_) {
    judgement.finding = Finding::WrongStart;
    judgement.separation = separationAt(0);
  }
  return judgement;
}

std::string Judge::witnessContradiction(const Answer& a) const {
  int piece = a.capsule;
  std::size_t at = 0;
  while (at < surfaces_.size() && piece >= surfaces_[at]->numPieces()) {
    piece -= surfaces_[at++]->numPieces();
  }
  if (piece < 0 || at == surfaces_.size()) return "capsule index";
  const MovingSurface& surface = *surfaces_[at];
  if (a.triangle < 0 || a.triangle >= surface.numOthers()) return "triangle index";
  const Real radius = surface.radius(piece, a.triangle);
  const Real radiusOfOther = surface.radiusOfOther(piece, a.triangle);
  // True for NaN.
  const auto off = [&](Real value) { return !(std::abs(value) <= guardInWorld_); };

  const Real signedSeparation = static_cast<Real>(a.separation) - a.penetration;
  const Real separation = surface.separationFrom(piece, a.triangle, a.toi);
  if (off(separation - signedSeparation)) return "separation";
  const Vec3r onScene = a.onScene.as<Real>(), onLink = a.onLink.as<Real>();
  const Vec3r n = a.normal.as<Real>();
  // Points without radius that meet have no direction.
  const bool isUndirected = n == Vec3r{} && radius + radiusOfOther == 0 && signedSeparation == 0;
  if (!isUndirected && off(norm(n) - 1)) return "normal's length";
  const Vec3r onOther = onScene - radiusOfOther * n;
  if (off(surface.distanceToOther(a.triangle, onOther, a.toi))) return "point on the scene";
  const Vec3r onAxis = onScene + (radius + signedSeparation) * n;
  if (off(surface.distanceToCore(piece, onAxis, a.toi))) return "normal's direction";
  if (off(norm(onAxis - radius * n - onLink))) return "point on the link";
  return {};
}

std::string Judge::contradiction(const Answer& a) const {
  if (!(a.freeUntil >= 0 && a.freeUntil <= 1)) return "freeUntil outside [0,1]";
  if (a.verdict == Verdict::Undecided) return {};
  if (a.verdict == Verdict::Clear) return a.freeUntil == 1 ? "" : "clear, but freeUntil is not 1";
  if (!(a.toi >= 0 && a.toi <= 1)) return "toi outside [0,1]";
  if (a.freeUntil != a.toi) return "freeUntil is not toi";
  if (!(a.separation >= 0) || !(a.penetration >= 0)) return "negative separation or penetration";
  if (a.verdict == Verdict::StartsInContact && a.toi != 0) return "starts in contact, but toi > 0";
  if (a.verdict == Verdict::Contact && a.penetration != 0) return "contact with penetration";
  return witnessContradiction(a);
}

Judgement Judge::judge(const Answer& answer, double tolerance) {
  Judgement judgement;
  judgement.what = contradiction(answer);
  const bool badTimes =
      !(answer.toi >= 0 && answer.toi <= 1 && answer.freeUntil >= 0 && answer.freeUntil <= 1);
  if (badTimes) {
    judgement.finding = Finding::Inconsistent;
    return judgement;
  }
  Judgement main;
  switch (answer.verdict) {
    case Verdict::Clear: main = judgeFree(1, Finding::Missed); break;
    case Verdict::Contact: main = judgeContact(answer, tolerance); break;
    case Verdict::StartsInContact: main = judgeStart(answer); break;
    case Verdict::Undecided:
      // Free on [0, 0) claims nothing.
      if (answer.freeUntil > 0) main = judgeFree(answer.freeUntil, Finding::Late);
      break;
  }
  main.what = judgement.what;
  if (main.finding == Finding::Ok && !main.what.empty()) main.finding = Finding::Inconsistent;
  return main;
}

// Halving: proves the earlier half first, so each round leaves at most half of the rest.
std::optional<Bracket> Judge::firstContact() {
  constexpr Real kResolution = 1e-9L;
  std::optional<Bracket> first;
  for (const auto& surface : surfaces_) {
    Bracket bracket{0, first ? first->high : 1};
    const SpanOutcome whole = surface->prove(0, bracket.high);
    if (!whole.touching) continue;
    bracket = {whole.freeUntil, *whole.touching};
    while (bracket.high - bracket.low > kResolution) {
      const Real middle = bracket.low + (bracket.high - bracket.low) / 2;
      const SpanOutcome half = surface->prove(bracket.low, middle);
      if (half.touching) {
        bracket = {half.freeUntil, *half.touching};
      } else if (half.free) {
        bracket.low = middle;
      } else {
        break;  // out of looks
      }
    }
    if (!first || bracket.high < first->high) first = bracket;
  }
  return first;
}

}  // namespace foretouch::oracle
