// tests/middleware/ask/ask_judge.h: holds one answer against all parts of a world, one by one.
#pragma once

#include <string>
#include <vector>

#include "tests/middleware/ask/ask_campaign.h"

namespace foretouch::test {

/// Refers to both.
class AskJudge {
 public:
  AskJudge(const WorldQuestion& question, const std::vector<JudgedPart>& parts);

  /// Appends what is wrong with the hits to the tally's problems.
  void judge(const WorldAnswer& answer, AskTally& tally) const;
  /// Of what has no inside, beside `others`.
  void judgeUnknown(const WorldAnswer& answer, std::vector<UnknownBody> others,
                    AskTally& tally) const;

 private:
  [[nodiscard]] bool isAsked(const JudgedPart& part) const;
  [[nodiscard]] const JudgedPart* partOf(const WorldHit& hit) const;
  [[nodiscard]] std::string problemOf(const WorldHit& hit, const JudgedPart& part) const;
  [[nodiscard]] std::string problemOfPlace(const WorldHit& hit, const JudgedPart& part) const;
  [[nodiscard]] std::string problemOfOrder(const WorldAnswer& answer) const;
  [[nodiscard]] const oracle::CastShape& shape() const { return shape_; }
  /// Free of the part up to there? Where nothing has a thickness, by what is clearly no touch of
  /// rounding.
  [[nodiscard]] bool surelyTouches(const JudgedPart& part, Real until) const;
  void judgeSolids(const WorldAnswer& answer, AskTally& tally) const;

  /// A mesh's object, or a link's triangles, as one surface.
  struct Solid {
    BodyId body = kStillScene;
    LinkId link = 0;
    ObjectId object = kEveryObject;
    std::vector<oracle::Corners<Real>> surface;
    Real boxGap = 0;  ///< How far the place is outside of the surface's box; below 0: inside.
    bool isOfSkin = false, isClosed = false, isInside = false;
  };
  void findSolids();
  /// The place is so near to it that either answer is right.
  [[nodiscard]] bool isAtSurface(const Solid& solid) const;

  const WorldQuestion& question_;
  const std::vector<JudgedPart>& parts_;
  oracle::CastShape shape_, smaller_;
  oracle::Vec3r place_;
  std::vector<Solid> solids_;
};

}  // namespace foretouch::test
