#include "tests/world_fuzz/fuzz_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/judged.h"
#include "lss/index.h"

namespace foretouch::test {
namespace {

using oracle::OracleEpisode;
using oracle::OraclePart;
using oracle::OraclePlace;
using oracle::Real;
using tools::plain;

constexpr double kFarthest = 9.9e6;  // metres; the format's end is 1e7

class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : random_(seed) {}

  FuzzWorld draw() {
    drawScale();
    drawCuts();
    const int bodies = 2 + random_.below(4), triggers = random_.below(3);
    for (int i = 0; i < bodies + triggers; ++i) drawBody(i, i >= bodies);
    world_.areApart = random_.chance(0.1);
    for (FuzzBody& body : world_.bodies) {
      if (body.isTrigger && random_.chance(0.3)) body.watches = random_.below(bodies);
    }
    std::vector<int> rank(world_.bodies.size());
    std::iota(rank.begin(), rank.end(), 0);
    for (int i = 0; i < world_.numSegments(); ++i) {
      if (i == 0 || random_.chance(0.6)) shuffle(rank, random_);
      world_.ranks.push_back(rank);
      drawSegment(i);
    }
    return std::move(world_);
  }

 private:
  void drawScale();
  void drawCuts();
  void drawBody(int number, bool isTrigger);
  void drawSegment(int i);
  bool drawCarrier(int body, int i, std::size_t inRank, FuzzSegment& now);
  bool hangsOn(int body, int other);
  bool isSilent(int body);
  void drawBegin(int body, int i, FuzzSegment& now);
  void drawPoses(int body, int i, FuzzSegment& now);
  void addTruth(int body, int i);
  OraclePlace somewhere(int carrier);
  OraclePlace next(const OraclePlace& from, int carrier);
  FuzzBody& bodyOf(int body) { return world_.bodies[static_cast<std::size_t>(body)]; }
  oracle::OracleBody& truthOf(int body) {
    return world_.truth.bodies[static_cast<std::size_t>(body)];
  }
  [[nodiscard]] Real after(std::int64_t us) const {
    return static_cast<Real>(us - world_.cuts.front());
  }

  Random random_;
  FuzzWorld world_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
};

void Drawing::drawScale() {
  world_.size = random_.chance(0.5) ? random_.uniform(0.1, 1.0) : random_.magnitude(1e-6, 6e5);
  const double finest = std::max(1e-8, 1e-4 * world_.size);
  world_.tolerance = random_.magnitude(finest, std::max(2e-8, 0.1 * world_.size));
  const double farthest = kFarthest - 15.0 * world_.size;
  if (random_.chance(0.3) && farthest > 1.0) {
    const double away = random_.magnitude(1.0, farthest);
    center_ = away * random_.direction();
  }
  world_.reach = center_.norm() + 30.0 * world_.size;
}

/// A microsecond apart, a frame, or a second; from zero, before it, or today.
void Drawing::drawCuts() {
  constexpr std::int64_t kBegins[] = {0, -5'000'000, 1'700'000'000'000'000};
  std::int64_t us = kBegins[random_.below(3)];
  if (random_.chance(0.3)) us += random_.below(1000);
  const int segments = 1 + random_.below(5);
  world_.cuts.push_back(us);
  for (int i = 0; i < segments; ++i) {
    us += random_.chance(0.2) ? 1 + random_.below(3)
                              : static_cast<std::int64_t>(random_.magnitude(5.0, 1e6));
    world_.cuts.push_back(us);
  }
}

void Drawing::drawBody(int number, bool isTrigger) {
  FuzzBody body;
  body.name = std::string(1, static_cast<char>('a' + (number * 5 + 3) % 8));
  body.isTrigger = isTrigger;
  body.stands = number > 0 && random_.chance(0.3);  // somebody has poses: they begin time
  body.isBox = random_.chance(0.25);
  body.group = random_.chance(0.5) ? "one" : "other";
  if (isTrigger) body.whenSilent = "hold-still";
  const double size = world_.size;
  if (body.isBox) {
    body.half = size * random_.uniform(0.2, 0.6);
  } else {
    const int count = isTrigger ? 1 : 1 + random_.below(2);
    for (int i = 0; i < count; ++i) {
      OraclePart part;
      if (i > 0 || (!isTrigger && random_.chance(0.5))) {
        part.corners[0] = plain(random_.inBox(0.5 * size));
        part.corners[1] = plain(random_.inBox(0.5 * size));
      }
      part.corners[2] = part.corners[1];
      part.radius = size * random_.uniform(0.05, 0.5);
      body.parts.push_back(part);
    }
  }
  oracle::OracleBody truth;
  truth.parents = {-1};
  truth.parts = body.parts;
  if (body.isBox) {
    const auto corner = [&](int bits) {
      const double h = body.half;
      return oracle::Vec3d{(bits & 1) != 0 ? h : -h, (bits & 2) != 0 ? h : -h,
                           (bits & 4) != 0 ? h : -h};
    };
    constexpr int kSides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (const auto& s : kSides) {
      truth.parts.push_back({0, 3, {corner(s[0]), corner(s[1]), corner(s[2])}, 0.0});
      truth.parts.push_back({0, 3, {corner(s[0]), corner(s[2]), corner(s[3])}, 0.0});
    }
  }
  body.place = somewhere(-1);
  world_.bodies.push_back(std::move(body));
  world_.truth.bodies.push_back(std::move(truth));
}

OraclePlace Drawing::somewhere(int carrier) {
  Quaternion rotation = Quaternion::Identity();
  if (random_.chance(0.8)) rotation = random_.rotation();
  const Eigen::Vector3d offset = random_.inBox(1.2 * world_.size);
  return {plain(rotation), plain(carrier < 0 ? Eigen::Vector3d(center_ + offset) : offset)};
}

/// Where it is told next: turned by less than half a turn; sometimes it stays.
OraclePlace Drawing::next(const OraclePlace& from, int carrier) {
  if (random_.chance(0.1)) return from;
  const auto& r = from.rotation;
  const Quaternion turn = random_.turn(random_.uniform(0.0, 2.5));
  OraclePlace place = somewhere(carrier);
  if (random_.chance(0.7)) {
    place.rotation = plain((Quaternion(r[0], r[1], r[2], r[3]) * turn).normalized());
  } else {
    place.rotation = r;
  }
  return place;
}

void Drawing::drawSegment(int i) {
  const std::vector<int>& rank = world_.ranks.back();
  for (std::size_t inRank = 0; inRank < rank.size(); ++inRank) {
    const int number = rank[inRank];
    FuzzBody& body = bodyOf(number);
    FuzzSegment now;
    const FuzzSegment* const before = i > 0 ? &body.segments.back() : nullptr;
    if (body.silentFrom >= 0) {  // as it was: it is told nothing more
      now.carrier = before->carrier;
      now.moves = before->moves;
    } else if (!drawCarrier(number, i, inRank, now)) {
      now = {};
      now.isThere = false;
    }
    body.segments.push_back(now);
    if (now.isThere && body.silentFrom < 0) {
      drawBegin(number, i, body.segments.back());
      drawPoses(number, i, body.segments.back());
    }
    if (now.isThere) addTruth(number, i);
  }
}

bool Drawing::hangsOn(int body, int other) {
  for (; body >= 0;
       body = bodyOf(body).segments.empty() ? -1 : bodyOf(body).segments.back().carrier) {
    if (body == other) return true;
  }
  return false;
}

/// It, or who carries it.
bool Drawing::isSilent(int body) {
  for (; body >= 0;
       body = bodyOf(body).segments.empty() ? -1 : bodyOf(body).segments.back().carrier) {
    if (bodyOf(body).silentFrom >= 0) return true;
  }
  return false;
}

/// False: it is not there yet.
bool Drawing::drawCarrier(int number, int i, std::size_t inRank, FuzzSegment& now) {
  const FuzzBody& body = bodyOf(number);
  const FuzzSegment* const before = i > 0 ? &body.segments.back() : nullptr;
  const bool wasThere = body.stands || (before != nullptr && before->isThere);
  if (!wasThere && i + 1 < world_.numSegments() && random_.chance(0.2)) return false;
  std::vector<int> carriers;
  for (std::size_t other = 0; other < inRank; ++other) {
    const int carrier = world_.ranks.back()[other];
    const auto& told = truthOf(carrier).episodes;
    const bool isThere = !told.empty() && told.front().beginUs <= world_.cuts[slotOf(i)];
    if (isThere && !hangsOn(carrier, number)) carriers.push_back(carrier);
  }
  if (before != nullptr && before->carrier >= 0 && isSilent(before->carrier)) {
    now.carrier = before->carrier;
    now.moves = before->moves;
    return true;
  }
  const auto mayCarry = [&](int carrier) {
    return std::find(carriers.begin(), carriers.end(), carrier) != carriers.end();
  };
  if (before != nullptr && mayCarry(before->carrier) && random_.chance(0.4)) {
    now.carrier = before->carrier;  // goes on
  } else {
    // Nobody is taken by who is silent.
    carriers.erase(
        std::remove_if(carriers.begin(), carriers.end(), [&](int one) { return isSilent(one); }),
        carriers.end());
    if (!carriers.empty() && random_.chance(0.55)) {
      now.carrier =
          carriers[static_cast<std::size_t>(random_.below(static_cast<int>(carriers.size())))];
    }
  }
  now.moves = now.carrier >= 0 && random_.chance(0.35);
  return true;
}

void Drawing::drawBegin(int number, int i, FuzzSegment& now) {
  const FuzzBody& body = bodyOf(number);
  const bool wasThere = i > 0 && body.segments[static_cast<std::size_t>(i) - 1].isThere;
  if (wasThere && body.segments[static_cast<std::size_t>(i) - 1].carrier == now.carrier) {
    now.moves = body.segments[static_cast<std::size_t>(i) - 1].moves;
    return;
  }
  now.place = wasThere || now.carrier >= 0 ? somewhere(now.carrier) : body.place;
  if (!wasThere && now.carrier < 0) return;  // its first pose, or it stands
  // A pose of the instant is in the frame before it, but of who was held, or not there.
  const bool mayBePosed = !body.stands && (!wasThere || body.isHeld(i - 1));
  const bool mayStay = body.stands || wasThere;
  now.begin = mayStay && random_.chance(0.5) ? FuzzBegin::Stays : FuzzBegin::Said;
  // Who is told no pose at all stands, and is there before.
  const bool mustBePosed = !body.stands && !wasThere && !now.moves;
  if (mustBePosed || (mayBePosed && random_.chance(0.3))) now.begin = FuzzBegin::Posed;
}

/// At the segment's end, and perhaps at some instants before it.
void Drawing::drawPoses(int number, int i, FuzzSegment& now) {
  FuzzBody& body = bodyOf(number);
  const auto at = static_cast<std::size_t>(i);
  const std::int64_t fromUs = world_.cuts[at], toUs = world_.cuts[at + 1];
  const bool wasThere = i > 0 && body.segments[at - 1].isThere;
  const bool isFirst = !wasThere && now.carrier < 0;
  if (now.begin == FuzzBegin::Posed) {
    now.times.push_back(fromUs);
    now.poses.push_back(now.place);
  }
  if (body.stands || (now.carrier >= 0 && !now.moves)) return;
  if (isFirst && i == 0 && random_.chance(0.2) && toUs - fromUs > 2) {
    // Later than all others: a microsecond, or anywhere.
    now.times.push_back(fromUs + 1 + random_.below(static_cast<int>(toUs - fromUs - 1)));
    now.poses.push_back(now.place);
  } else if (isFirst) {
    now.times.push_back(fromUs);
    now.poses.push_back(now.place);
  }
  // A silent one is told none any more; who waits for it would end the world too early to change.
  const bool isLast = i + 1 == world_.numSegments();
  const bool mayFall = i > 0 && now.begin == FuzzBegin::GoesOn && wasThere && !isFirst;
  if (mayFall && random_.chance(0.12)) {
    body.silentFrom = i;
    if (!body.isTrigger) body.whenSilent = random_.chance(0.5) ? "hold-still" : "undecided";
    return;
  }
  std::vector<std::int64_t> times{toUs};
  for (int more = random_.below(3); more > 0; --more) {
    const std::int64_t us =
        fromUs + 1 + random_.below(static_cast<int>(std::max<std::int64_t>(1, toUs - fromUs - 1)));
    if (us < toUs) times.push_back(us);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  // Ends the world, but not before it has begun: of that nobody could be told.
  const bool mayEnd = isLast && random_.chance(0.1) && times.size() > 1;
  if (mayEnd && (now.times.empty() || times[times.size() - 2] > now.times.back())) times.pop_back();
  OraclePlace last = now.place;
  if (wasThere && now.begin == FuzzBegin::GoesOn)
    last = truthOf(number).episodes.back().poses.back()[0];
  for (const std::int64_t us : times) {
    if (!now.times.empty() && us <= now.times.back()) continue;
    last = next(last, now.carrier);
    now.times.push_back(us);
    now.poses.push_back(last);
  }
}

void Drawing::addTruth(int number, int i) {
  FuzzBody& body = bodyOf(number);
  const FuzzSegment& now = body.segments[static_cast<std::size_t>(i)];
  auto& episodes = truthOf(number).episodes;
  const std::int64_t beginUs = world_.cuts[static_cast<std::size_t>(i)];
  const bool goesOn = now.begin == FuzzBegin::GoesOn && !episodes.empty();
  if (!goesOn) {
    OraclePlace place = now.begin == FuzzBegin::GoesOn ? body.place : now.place;
    if (now.begin == FuzzBegin::Stays) {
      using Frame = oracle::MovingFrame<Real>;
      // In front of the first instant it is where it stands.
      Frame before;
      const auto& r = body.place.rotation;
      before.q = {Real(r[0]), Real(r[1]), Real(r[2]), Real(r[3])};
      before.p = body.place.translation.as<Real>();
      const std::int64_t base = world_.cuts.front();
      if (!episodes.empty()) {
        before = world_.truth.frameAt(number, 0, base, after(beginUs), true);
      }
      Frame in;
      if (now.carrier >= 0) in = world_.truth.frameAt(now.carrier, 0, base, after(beginUs), false);
      const auto back = conjugate(in.q);
      const auto q = back * before.q;
      place.rotation = {double(q.w), double(q.x), double(q.y), double(q.z)};
      place.translation = rotate(back, before.p - in.p).as<double>();
    }
    const bool isLate = now.begin == FuzzBegin::GoesOn && !now.times.empty();
    const std::int64_t firstUs = isLate ? now.times.front() : beginUs;
    episodes.push_back({firstUs, now.carrier, 0, {firstUs}, {{place}}});
  }
  for (std::size_t k = 0; k < now.times.size(); ++k) {
    OracleEpisode& episode = episodes.back();
    if (now.times[k] <= episode.times.back()) continue;
    episode.times.push_back(now.times[k]);
    episode.poses.push_back({now.poses[k]});
  }
}

}  // namespace

FuzzWorld drawFuzzWorld(std::uint64_t seed) {
  return Drawing(seed).draw();
}

}  // namespace foretouch::test
