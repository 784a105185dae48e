// judge/judge.h: decides whether an answer about one step keeps the promise: of one link and a
// scene, or of two links of one body.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/capsule_prover.h"
#include "judge/pair_prover.h"
#include "judge/skin_prover.h"

namespace foretouch::oracle {

enum class Verdict { Clear, Contact, StartsInContact, Undecided };

/// The answer, in the oracle's own types. For two links, the other one takes the scene's place: its
/// piece that of the triangle, and the normal points from it to the first.
struct Answer {
  Verdict verdict = Verdict::Clear;
  double toi = 1.0, freeUntil = 1.0;
  double separation = 0.0, penetration = 0.0;
  int triangle = -1;  ///< In the scene handed to the judge.
  int capsule = -1;   ///< In the list handed to the judge; for a mesh, its triangle.
  Vec3d onScene, onLink, normal;
};

enum class Finding {
  Ok,
  Missed,        ///< Clear, but there is contact.
  Late,          ///< Contact before toi, or before freeUntil.
  Early,         ///< At toi the scene is farther than the tolerance.
  WrongStart,    ///< StartsInContact, but nothing touches at t = 0.
  Inconsistent,  ///< Times, separation, points or normal contradict the verdict or each other.
  Unproved,      ///< The oracle ran out of budget: it shows neither right nor wrong.
};
const char* toString(Finding finding);
const char* toString(Verdict verdict);

struct Judgement {
  Finding finding = Finding::Ok;
  Real time = 0, separation = 0;  ///< The time at which the promise breaks, and the true separation
                                  ///< then.
  std::string what;               ///< For Inconsistent: which part.
  std::uint64_t grazing = 0, looks = 0;
};

/// Allowed error of an answer's start and its witness points, as a share of the scale: the product
/// computes these in doubles with a stated rounding of about 1e-13 m at body scale. Neither toi,
/// nor the separation there, nor any claim of freedom gets this allowance (kSoundGuard).
inline constexpr Real kWitnessGuard = 1e-12L;

struct Bracket {
  Real low = 0, high = 0;
};

/// Keeps references: the scene and the motion outlive it.
class Judge {
 public:
  Judge(const Scene& scene, const Motion& motion, int link, const std::vector<Capsule>& capsules);
  /// The link's surface is `mesh`, triangles in the link's frame.
  Judge(const Scene& scene, const Motion& motion, int link, const std::vector<Triangle>& mesh);
  /// The link's surface is part of a skin.
  Judge(const Scene& scene, const Motion& motion, const std::vector<SkinTriangle>& skin);
  /// Two links, each made of hulls (at least one, all of one link).
  Judge(const Motion& motion, std::vector<Hull> one, std::vector<Hull> other,
        std::vector<RadiusSum> sums = {});

  [[nodiscard]] Judgement judge(const Answer& answer, double tolerance);

  /// The true first instant with separation <= 0, to within 1e-9 in t; nothing if there is none.
  /// A touch that goes no deeper than the sound guard does not count.
  [[nodiscard]] std::optional<Bracket> firstContact();

  /// The least over the link's surface and the other side; `within` if nothing is nearer.
  [[nodiscard]] Real separationAt(Real t, double within = Box::kEmpty) const;

 private:
  [[nodiscard]] Judgement judgeClear();
  [[nodiscard]] Judgement judgeContact(const Answer& answer, double tolerance);
  [[nodiscard]] Judgement judgeStart(const Answer& answer);
  [[nodiscard]] Judgement judgeFree(Real until, Finding ifNot);
  [[nodiscard]] std::string contradiction(const Answer& answer) const;
  [[nodiscard]] std::string witnessContradiction(const Answer& answer) const;

  void add(std::unique_ptr<MovingSurface> surface);

  std::vector<std::unique_ptr<MovingSurface>> surfaces_;
  Real guard_ = 0, guardInWorld_ = 0;  ///< For starts; for witnesses.
};

}  // namespace foretouch::oracle
