#include "tests/middleware/ask/ask_judge.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

using oracle::gapAfter;
using oracle::leastGap;

/// Places of product and judge differ by so much (m) at most, with coordinates of some metres and
/// ways of some hundred: what is nearer to a touch is not judged.
constexpr Real kGuard = 1e-11L;
/// What has no radius touches surely if it still does so when it is smaller by this share, or is so
/// far (m) from edges and ends.
constexpr Real kSmaller = 1e-8L;

std::string said(const WorldHit& hit) {
  std::ostringstream out;
  out.precision(17);
  out << "hit of body " << hit.what.body << " link " << hit.what.link << " lss " << hit.what.lss
      << " triangle " << hit.what.triangle << " at " << hit.distance;
  return out.str();
}

/// The shape began in it.
bool isOfSolid(const WorldHit& hit) {
  return hit.what.lss < 0 && hit.what.triangle < 0;
}

bool isSame(const ContactSide& x, const ContactSide& y) {
  return x.body == y.body && x.link == y.link && x.triangle == y.triangle &&
         (x.triangle >= 0 || x.lss == y.lss);
}

}  // namespace

AskJudge::AskJudge(const WorldQuestion& question, const std::vector<JudgedPart>& parts)
    : question_(question),
      parts_(parts),
      shape_{plain(question.shape.a),
             plain(question.shape.b),
             question.shape.radius,
             plain(question.direction),
             {},
             {},
             {}},
      place_(shape_.a.as<Real>()) {
  if (question.what != AskWhat::Cast) shape_.direction = {};
  smaller_ = shape_;
  std::vector<oracle::Vec3d> corners;
  for (const Eigen::Vector3d& corner : question.hull) {
    corners.push_back(plain(corner));
    place_ =
        place_ + (Real(1) / static_cast<Real>(question.hull.size())) * corners.back().as<Real>();
  }
  if (!corners.empty()) {
    shape_.setHull(corners, 1);
    smaller_.setHull(corners, 1 - kSmaller);
  }
  if (question.solids) findSolids();
}

bool AskJudge::surelyTouches(const JudgedPart& part, Real until) const {
  if (question_.shape.radius + part.part.radius > 0.0) {
    return leastGap(shape_, until, part.part, -kGuard) < -kGuard;
  }
  if (!question_.hull.empty()) {
    return leastGap(smaller_, std::max(Real(0), until - kSmaller), part.part, 0) < 1e-15L;
  }
  const bool isPoint = question_.shape.a == question_.shape.b;
  return isPoint && question_.what == AskWhat::Cast &&
         oracle::surelyCrosses(shape_, until, part.part, kSmaller);
}

bool AskJudge::isAsked(const JudgedPart& part) const {
  const auto is = [&](const AskPart& one) {
    return one.body == part.side.body && (one.link == kEveryLink || one.link == part.side.link) &&
           (one.object == kEveryObject || one.object == part.object);
  };
  const bool isOnly =
      question_.only.empty() || std::any_of(question_.only.begin(), question_.only.end(), is);
  return isOnly && std::none_of(question_.without.begin(), question_.without.end(), is) &&
         (part.side.body != kStillScene || question_.asksStill);
}

const JudgedPart* AskJudge::partOf(const WorldHit& hit) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const JudgedPart& part) {
    return isSame(part.side, hit.what);
  });
  return found == parts_.end() ? nullptr : &*found;
}

void AskJudge::judge(const WorldAnswer& answer, AskTally& tally) const {
  const auto report = [&](const std::string& problem) {
    if (!problem.empty()) tally.problems.push_back(problem);
  };
  report(problemOfOrder(answer));
  judgeSolids(answer, tally);
  std::vector<const JudgedPart*> reported;
  for (const WorldHit& hit : answer.hits) {
    if (isOfSolid(hit)) continue;
    const JudgedPart* const part = partOf(hit);
    if (part == nullptr || !isAsked(*part)) {
      report("a part that was not asked about: " + said(hit));
      continue;
    }
    report(problemOf(hit, *part));
    reported.push_back(part);
    if (question_.what == AskWhat::Cast) {
      tally.widest = std::max(tally.widest, gapAfter(shape(), hit.distance, part->part));
    }
  }
  // What is not reported: free up to the end, or up to the one that is.
  const bool isAny = question_.which == AskWhich::Any && !answer.hits.empty();
  if (isAny) return;
  const bool isFirst = question_.which == AskWhich::Closest && !answer.hits.empty();
  const Real until = isFirst ? static_cast<Real>(answer.hits.front().distance)
                             : static_cast<Real>(question_.reach);
  if (isFirst && until == 0) return;  // nothing is nearer
  for (const JudgedPart& part : parts_) {
    if (!isAsked(part)) continue;
    ++tally.parts;
    if (std::find(reported.begin(), reported.end(), &part) != reported.end()) continue;
    const bool moves = question_.what == AskWhat::Cast;
    const Real beyond = question_.what == AskWhat::Nearest ? until : 0;
    const Real gap = leastGap(shape(), moves ? until : 0, part.part, beyond);
    if (beyond > 0 ? gap >= beyond - kGuard : !surelyTouches(part, moves ? until : 0)) continue;
    std::ostringstream out;
    out.precision(17);
    out << "missed: body " << part.side.body << " link " << part.side.link << " lss "
        << part.side.lss << " triangle " << part.side.triangle << ", gap "
        << static_cast<double>(gap) << " until " << static_cast<double>(until);
    report(out.str());
  }
}

std::string AskJudge::problemOf(const WorldHit& hit, const JudgedPart& part) const {
  const Real distance = hit.distance;
  if (!(hit.distance >= 0.0 && hit.distance <= question_.reach)) return "reach: " + said(hit);
  if (question_.what == AskWhat::Cast) {
    const Real gap = gapAfter(shape(), distance, part.part);
    if (gap > kAskTolerance + kGuard) {
      std::ostringstream out;
      out << "early, or none: " << said(hit) << ", " << static_cast<double>(gap) << " m from it";
      return out.str();
    }
    if (hit.distance > 0.0 && surelyTouches(part, distance)) {
      return "late: " + said(hit);
    }
  } else {
    const Real gap = std::max(Real(0), gapAfter(shape(), 0, part.part));
    if (distance > gap + kGuard) return "too far: " + said(hit);
    if (distance < gap - kAskTolerance) {
      return "too near, of " + std::to_string(static_cast<double>(1e9L * gap)) +
             " nm: " + said(hit);
    }
  }
  return problemOfPlace(hit, part);
}

std::string AskJudge::problemOfPlace(const WorldHit& hit, const JudgedPart& part) const {
  constexpr Real kPlace = 1e-8L;
  const Real height = oracle::heightOver(plain(hit.what.p_W), part.part);
  // A shape that begins inside a capsule: some point of it.
  const bool startsInside = hit.distance == 0.0 && part.part.count == 2;
  if (height > kPlace || (!startsInside && height < -kPlace)) return "point: " + said(hit);
  if (part.part.count == 3) {
    oracle::Vec3r sum;
    Real shares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (hit.weights[i] < 0.0) return "weights: " + said(hit);
      sum = sum + static_cast<Real>(hit.weights[i]) * part.part.corners[i].as<Real>();
      shares += hit.weights[i];
    }
    if (std::abs(shares - 1) > 1e-12L || norm(sum - plain(hit.what.p_W).as<Real>()) > kPlace) {
      return "weights: " + said(hit);
    }
  }
  const double length = hit.nhat_W.norm();
  if (length != 0.0 && std::abs(length - 1.0) > 1e-12) return "normal: " + said(hit);
  // Along it, the gap grows as it should: by the whole way, where they are apart.
  oracle::CastShape away = shape_;
  const oracle::Vec3d step = plain(Eigen::Vector3d(1e-4 * hit.nhat_W));
  const bool isApart = hit.distance > 0.0 && part.part.radius + question_.shape.radius > 1e-3;
  if (!isApart) return "";
  const oracle::Vec3r moved =
      question_.what == AskWhat::Cast
          ? (static_cast<Real>(hit.distance) / norm(away.direction.as<Real>())) *
                away.direction.as<Real>()
          : oracle::Vec3r{};
  away.a = (away.a.as<Real>() + moved + step.as<Real>()).as<double>();
  away.b = (away.b.as<Real>() + moved + step.as<Real>()).as<double>();
  const Real grown = gapAfter(away, 0, part.part) - gapAfter(shape(), hit.distance, part.part);
  return std::abs(grown - 1e-4L) > 1e-9L ? "normal: " + said(hit) : "";
}

std::string AskJudge::problemOfOrder(const WorldAnswer& answer) const {
  const auto isOrdered =
      std::is_sorted(answer.hits.begin(), answer.hits.end(),
                     [](const WorldHit& x, const WorldHit& y) { return x.distance < y.distance; });
  if (!isOrdered) return "hits are not in order";
  for (std::size_t i = 0; i < answer.hits.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool isAgain = answer.hits[i].object == answer.hits[j].object;
      if (isAgain && isSame(answer.hits[i].what, answer.hits[j].what))
        return "twice: " + said(answer.hits[i]);
    }
  }
  if (question_.which != AskWhich::All && answer.hits.size() > 1) return "more than one hit";
  return "";
}

}  // namespace foretouch::test
