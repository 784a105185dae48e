// Flights through random worlds, whose first hits the judge's own world finds: the shape is one
// more body of it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "tests/middleware/ask/ask_campaign.h"
#include "tests/middleware/ask/asked_world.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using oracle::OracleOutcome;

/// Below it (m), whether two touch is rounding; and so long (us) is no time.
constexpr Real kTouchGuard = 1e-10L, kTimeGuard = 1e-5L;
constexpr int kSamples = 60;

class FlightJudge {
 public:
  FlightJudge(const AskedWorld& world, AskedWorld& both, const FlightQuestion& question)
      : world_(world), question_(question), judge_(both.both().oracle) {
    OracleBody flown;
    flown.parents = {-1};
    flown.parts = {{0,
                    2,
                    {plain(question.shape.a), plain(question.shape.b), plain(question.shape.b)},
                    question.shape.radius}};
    shape_ = oracle::CastShape{plain(question.shape.a), plain(question.shape.b),
                               question.shape.radius, plain(question.way)};
    if (!question.hull.empty()) {
      std::vector<oracle::Vec3d> corners;
      for (const Vector3d& corner : question.hull) corners.push_back(plain(corner));
      shape_.setHull(corners, 1);
      // Its surface, which is far smaller than what it could be within.
      flown.parts.clear();
      for (const auto& v : shape_.outer) {
        oracle::OraclePart part{0, 3, {}, question.shape.radius};
        for (std::size_t i = 0; i < 3; ++i) {
          part.corners[i] = (v[i] + shape_.a.as<Real>()).as<double>();
        }
        flown.parts.push_back(part);
      }
    }
    OracleEpisode episode{question.fromUs, -1, 0, {question.fromUs, question.toUs}, {}};
    episode.poses = {{OraclePlace{}}, {OraclePlace{}}};
    episode.poses.back().front().translation = plain(question.way);
    flown.episodes = {episode};
    judge_.bodies.push_back(flown);
    flown_ = static_cast<int>(judge_.bodies.size()) - 1;
  }

  void judge(const FlightAnswer& answer, AskTally& tally) {
    const Real end = static_cast<Real>(question_.toUs - question_.fromUs);
    Real until = end;
    if (answer.first) {
      const FlightHit& first = *answer.first;
      until = static_cast<Real>(first.time.us - question_.fromUs) +
              static_cast<Real>(first.time.fraction);
      judgeHit(first, until, tally);
    }
    judgeStill(until, answer.first.has_value(), tally);
    for (BodyId body = 0; body < world_.numBodies(); ++body) {
      for (LinkId link = 0; isAsked(body) && link < world_.linksOf(body); ++link) {
        if (isAsked(body, link)) judgeLink(body, link, until, tally);
      }
    }
  }

 private:
  [[nodiscard]] bool isAsked(BodyId body, LinkId link = kEveryLink) const {
    const auto is = [&](const AskPart& part) {
      return part.body == body && (part.link == kEveryLink || part.link == link);
    };
    return isInGroups(question_, world_.options(body).group) &&
           std::none_of(question_.without.begin(), question_.without.end(), is);
  }

  /// Where the shape and the link are free, as far as the judge can see.
  void judgeLink(BodyId body, LinkId link, Real until, AskTally& tally) {
    // Whole microseconds in which it is known; from the flight's begin.
    for (std::int64_t us = question_.fromUs; us < question_.toUs;) {
      const std::int64_t next = nextKnown(body, us);
      if (next > us) {
        judgeSpan(body, link, us, next, until, tally);
        us = next;
      } else {
        us += 500;
      }
    }
  }

  /// Known from an instant until at most some milliseconds later; the instant itself: not known.
  [[nodiscard]] std::int64_t nextKnown(BodyId body, std::int64_t us) const {
    const auto isKnown = [&](std::int64_t at, double fraction) {
      const auto why = world_.whyUnknown(body, {at, fraction});
      return !why || why == AskUnknown::Assumed;
    };
    std::int64_t end = std::min(question_.toUs, us + 4'000);
    for (; end > us; end -= 500) {
      if (isKnown(us, 0.5) && isKnown(end, 0.0) && !changesWithin(body, us, end)) return end;
    }
    return us;
  }
  [[nodiscard]] bool changesWithin(BodyId body, std::int64_t us, std::int64_t end) const {
    const auto& episodes = judge_.bodies[slotOf(body)].episodes;
    return std::any_of(episodes.begin(), episodes.end(), [&](const OracleEpisode& episode) {
      return episode.beginUs > us && episode.beginUs <= end;
    });
  }

  void judgeSpan(BodyId body, LinkId link, std::int64_t fromUs, std::int64_t toUs, Real until,
                 AskTally& tally) {
    const Real offset = static_cast<Real>(fromUs - question_.fromUs);
    if (offset > until || !hasParts(body, link)) return;
    ++tally.parts;
    const auto tell = [&](Real us) {
      std::ostringstream out;
      out.precision(12);
      out << "body " << body << " link " << link << " touches at " << static_cast<double>(us)
          << " us, reported free until " << static_cast<double>(until);
      tally.problems.push_back(out.str());
    };
    const bool isBefore = offset < until - kTimeGuard;
    // What comes to be in the midst of a hull touches it, and not its surface.
    if (isBefore && gapAt(body, link, offset, 0, false) < -kTouchGuard) return tell(offset);
    const auto touch = judge_.firstTouch(flown_, 0, body, link, fromUs, toUs);
    if (touch.outcome != OracleOutcome::Touch) return;
    if (offset + touch.time >= until - kTimeGuard) return;
    // Within the judge's nanometre; do they go on to touch before that?
    const Real last = std::min(until - offset, static_cast<Real>(toUs - fromUs));
    for (int i = 0; i <= kSamples; ++i) {
      const Real us = touch.time + (last - touch.time) * i / kSamples;
      if (gapAt(body, link, offset + us, 0, false) <= -kTouchGuard)
        return tell(offset + touch.time);
    }
  }

  [[nodiscard]] bool hasParts(BodyId body, LinkId link) const {
    const auto& parts = judge_.bodies[slotOf(body)].parts;
    return std::any_of(parts.begin(), parts.end(),
                       [&](const OraclePart& part) { return part.link == link; });
  }

  /// Of the shape and a link, so long after the flight's begin; below 0 also inside of a hull.
  /// Farther than `beyond`: at least that.
  [[nodiscard]] Real gapAt(BodyId body, LinkId link, Real us, Real beyond, bool isFromLeft) const {
    const auto frame = judge_.frameAt(body, link, question_.fromUs, us, isFromLeft);
    const oracle::Vec3r flown = shareAt(us) * shape_.direction.as<Real>();
    oracle::CastShape shape = shape_;
    shape.direction = {};
    for (oracle::Vec3d* p : {&shape.a, &shape.b}) *p = (p->as<Real>() + flown).as<double>();
    Real least = beyond;
    for (OraclePart part : judge_.bodies[slotOf(body)].parts) {
      if (part.link != link) continue;
      for (oracle::Vec3d& p : part.corners) p = frame.at(p.as<Real>()).as<double>();
      least = std::min(least, oracle::leastGap(shape, 0, part, least));
    }
    return least;
  }
  [[nodiscard]] Real shareAt(Real us) const {
    return us / static_cast<Real>(question_.toUs - question_.fromUs);
  }

  void judgeHit(const FlightHit& first, Real us, AskTally& tally) {
    const ContactSide& what = first.hit.what;
    if (what.body == kStillScene) return;
    if (!isAsked(what.body, what.link)) tally.problems.emplace_back("not asked about");
    // Where it changes who carries it, it has two places.
    constexpr Real kFar = 0.1L;
    const Real gap = std::min(gapAt(what.body, what.link, us, kFar, true),
                              gapAt(what.body, what.link, us, kFar, false));
    tally.widest = std::max(tally.widest, gap);
    // The instant is rounded down by a part of a nanosecond.
    if (gap > kAskTolerance + 1e-9L) {
      std::ostringstream out;
      out << "early: body " << what.body << " link " << what.link << " is "
          << static_cast<double>(gap) << " m away at " << static_cast<double>(us) << " us";
      tally.problems.push_back(out.str());
    }
  }

  void judgeStill(Real until, bool hasHit, AskTally& tally) {
    if (!world_.still() || !question_.asksStill) return;
    const auto isOut = [](const AskPart& part) { return part.body == kStillScene; };
    if (std::any_of(question_.without.begin(), question_.without.end(), isOut)) return;
    const oracle::CastShape& shape = shape_;
    const Real length = question_.way.norm();
    const Real share = shareAt(until);
    for (std::size_t i = 0; i < world_.still()->numTriangles(); ++i) {
      const oracle::OraclePart part{
          0, 3, plain(world_.still()->triangle(static_cast<TriangleId>(i))), 0.0};
      ++tally.parts;
      const Real least = oracle::leastGap(shape, length * share, part, 0);
      if (least < -kTouchGuard && (hasHit ? share > 0 : true) &&
          oracle::leastGap(shape, length * share * (1 - 1e-9L), part, 0) < -kTouchGuard) {
        tally.problems.emplace_back("goes through triangle " + std::to_string(i));
      }
    }
  }

  const AskedWorld& world_;
  const FlightQuestion& question_;
  OracleWorld judge_;
  oracle::CastShape shape_;
  int flown_ = 0;
};

FlightQuestion randomFlight(const AskedWorld& world, Random& random) {
  FlightQuestion flight;
  flight.fromUs = -5'000 + random.below(100'000);
  flight.toUs = flight.fromUs + 1'000 + random.below(60'000);
  WorldQuestion then;
  then.time = {(flight.fromUs + flight.toUs) / 2, 0.0};
  const Vector3d at = aimed(world.partsAt(then), random);
  flight.way = random.chance(0.1) ? Vector3d(Vector3d::Zero()) : random.arrow(0.05, 4.0);
  const Vector3d axis = random.chance(0.4) ? Vector3d(Vector3d::Zero()) : random.arrow(0.0, 0.5);
  flight.shape.a = at - random.uniform(0.2, 0.8) * flight.way;
  flight.shape.b = flight.shape.a + axis;
  flight.shape.radius = random.chance(0.2) ? 0.0 : random.magnitude(1e-3, 0.1);
  if (random.chance(0.3)) {
    flight.shape.b = flight.shape.a;
    flight.hull = boxCorners(random.inBox(0.06).cwiseAbs(), random.rotation());
    flight.shape.radius = random.magnitude(1e-3, 0.05);
  }
  flight.asksStill = random.chance(0.5);
  if (random.chance(0.3)) flight.groups = static_cast<std::uint32_t>(random.below(16));
  if (random.chance(0.4)) {
    const BodyId body = random.below(world.numBodies());
    flight.without.push_back(
        {body, random.chance(0.5) ? kEveryLink : random.below(world.linksOf(body))});
  }
  return flight;
}

}  // namespace

AskTally judgeFlights(std::uint64_t seed, int count,
                      const std::function<void(FlightQuestion&)>& tamper) {
  Random random(seed);
  AskTally tally;
  AskedWorld world(random, false);
  Scratch scratch;
  FlightAnswer answer;
  for (int i = 0; i < count; ++i) {
    const FlightQuestion flight = randomFlight(world, random);
    FlightQuestion asked = flight;
    if (tamper) tamper(asked);
    const std::string whose = "seed " + std::to_string(seed) + ", flight " + std::to_string(i);
    const auto done = askFlight(world.both().world, asked, scratch, answer);
    if (!done.ok()) {
      tally.problems.push_back(whose + ": " + describe(done.error()));
      continue;
    }
    const std::size_t before = tally.problems.size();
    const bool isResolved =
        std::none_of(answer.unknown.begin(), answer.unknown.end(),
                     [](const UnknownBody& body) { return body.why == AskUnknown::Unresolved; });
    if (isResolved) FlightJudge(world, world, flight).judge(answer, tally);
    tally.filtered += !isResolved;
    tally.name(before, whose);
    ++tally.questions["flight"];
    if (!answer.first) continue;
    ++tally.hits["flight"];
    const ContactSide& what = answer.first->hit.what;
    ++(what.triangle >= 0 ? tally.ofTriangles : tally.ofLss);
    tally.ofCarried += what.body >= 0 && world.isCarried(what.body);
    tally.starts += answer.first->hit.distance == 0.0;
  }
  return tally;
}

}  // namespace foretouch::test
