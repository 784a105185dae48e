#include "tests/tools/repair/clip_oracle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "judge/distance.h"

namespace foretouch::test {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

template <typename Turn>
Turn product(const Turn& p, const Turn& q) {
  return {
      p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
      p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}

template <typename Turn>
Vec3d turned(const Turn& q, const Vec3d& v) {
  const Turn turn = product(product(q, Turn{0, v.x, v.y, v.z}), Turn{q.w, -q.x, -q.y, -q.z});
  return {turn.x, turn.y, turn.z};
}

/// On the shorter arc, at a constant rate.
template <typename Turn>
Turn between(const Turn& p, Turn q, double share) {
  double dot = p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z;
  if (dot < 0.0) q = {-q.w, -q.x, -q.y, -q.z}, dot = -dot;
  const double angle = std::acos(std::min(1.0, dot)), sine = std::sin(angle);
  const double a = sine > 1e-9 ? std::sin((1.0 - share) * angle) / sine : 1.0 - share;
  const double b = sine > 1e-9 ? std::sin(share * angle) / sine : share;
  return {a * p.w + b * q.w, a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z};
}

void overLooks(const OracleClip& clip, const std::function<void(double)>& look) {
  const auto last = static_cast<double>(clip.frames() - 1);
  for (int i = 0; i <= static_cast<int>(last) * kOracleLooks; ++i) {
    look(std::min(last, static_cast<double>(i) / kOracleLooks));
  }
}

double segmentDistance(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  // By looks along one of them: each nearest place is a minimum of a convex function.
  double low = 0.0, high = 1.0;
  const auto at = [&](double share) {
    return oracle::pointSegmentDistance(a + share * (b - a), c, d);
  };
  for (int i = 0; i < 60; ++i) {
    const double one = low + (high - low) / 3.0, other = high - (high - low) / 3.0;
    at(one) < at(other) ? high = other : low = one;
  }
  return at(0.5 * (low + high));
}

}  // namespace

OracleClip::OracleClip(const std::string& bvh) {
  std::istringstream in(bvh);
  std::vector<int> open;
  std::size_t columns = 0;
  bool isEnd = false;
  for (std::string word; in >> word && word != "MOTION";) {
    if (word == "ROOT" || word == "JOINT") {
      std::string name;
      in >> name;
      number_[name] = static_cast<int>(joints_.size());
      names_.push_back(name);
      joints_.emplace_back();
      joints_.back().parent = open.empty() ? -1 : open.back();
    } else if (word == "End") {
      isEnd = true;
    } else if (word == "{") {
      open.push_back(isEnd ? -2 : static_cast<int>(joints_.size()) - 1);
    } else if (word == "}") {
      open.pop_back();
      isEnd = false;
    } else if (word == "OFFSET" && !isEnd) {
      Vec3d& offset = joints_.back().offset;
      in >> offset.x >> offset.y >> offset.z;
    } else if (word == "CHANNELS") {
      std::size_t count = 0;
      in >> count;
      joints_.back().first = columns;
      joints_.back().channels.resize(count);
      for (std::string& channel : joints_.back().channels) in >> channel;
      columns += count;
    }
  }
  std::string word;
  while (in >> word && word != "Time:") {
  }
  in >> frameTimeS_;
  std::vector<double> row(columns);
  while (in >> row[0]) {
    for (std::size_t i = 1; i < columns; ++i) in >> row[i];
    rows_.push_back(row);
  }
}

OracleClip OracleClip::cut(std::size_t first, std::size_t last) const {
  OracleClip part = *this;
  const auto begin = rows_.begin();
  part.rows_.assign(begin + static_cast<std::ptrdiff_t>(first),
                    begin + static_cast<std::ptrdiff_t>(last + 1));
  return part;
}

OracleClip::Turn OracleClip::turnAt(const Joint& joint, std::size_t frame) const {
  Turn turn;
  for (std::size_t i = 0; i < joint.channels.size(); ++i) {
    const std::string& channel = joint.channels[i];
    if (channel.find("rotation") == std::string::npos) continue;
    const double half = 0.5 * kRadians * rows_[frame][joint.first + i];
    Turn about{std::cos(half), 0, 0, 0};
    (channel[0] == 'X' ? about.x : channel[0] == 'Y' ? about.y : about.z) = std::sin(half);
    turn = product(turn, about);
  }
  return turn;
}

Vec3d OracleClip::placeAt(const Joint& joint, std::size_t frame) const {
  Vec3d place = joint.offset;
  for (std::size_t i = 0; i < joint.channels.size(); ++i) {
    const std::string& channel = joint.channels[i];
    if (channel.find("position") == std::string::npos) continue;
    place[static_cast<std::size_t>(channel[0] - 'X')] = rows_[frame][joint.first + i];
  }
  return place;
}

Vec3d OracleClip::pointAt(const std::string& joint, const Vec3d& p_L, double at) const {
  const auto frame = std::min(static_cast<std::size_t>(at), frames() - 1);
  const std::size_t next = std::min(frame + 1, frames() - 1);
  const double share = at - static_cast<double>(frame);
  Vec3d p = p_L;
  for (int j = number_.at(joint); j >= 0; j = joints_[static_cast<std::size_t>(j)].parent) {
    const Joint& of = joints_[static_cast<std::size_t>(j)];
    const Turn turn = between(turnAt(of, frame), turnAt(of, next), share);
    p = turned(turn, p) + placeAt(of, frame) + share * (placeAt(of, next) - placeAt(of, frame));
  }
  return p;
}

double OracleClip::turnFrom(const OracleClip& other, const std::string& joint,
                            std::size_t frame) const {
  const Joint& of = joints_[static_cast<std::size_t>(number_.at(joint))];
  const Turn a = turnAt(of, frame), b = other.turnAt(of, frame);
  const Turn way = product(Turn{a.w, -a.x, -a.y, -a.z}, b);
  const double sine = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
  return 2.0 * std::atan2(sine, std::abs(way.w)) / kRadians;
}

double leastHeight(const OracleClip& clip, const OracleCapsule& capsule, const OracleFloor& floor) {
  double least = 1e9;
  overLooks(clip, [&](double at) {
    for (const Vec3d& end : {capsule.a, capsule.b}) {
      const Vec3d p = clip.pointAt(capsule.joint, end, at) - floor.point;
      least = std::min(least, oracle::dot(p, floor.normal) - capsule.radius);
    }
  });
  return least;
}

double leastDistance(const OracleClip& clip, const OracleCapsule& one, const OracleCapsule& other) {
  double least = 1e9;
  overLooks(clip, [&](double at) {
    const double apart = segmentDistance(
        clip.pointAt(one.joint, one.a, at), clip.pointAt(one.joint, one.b, at),
        clip.pointAt(other.joint, other.a, at), clip.pointAt(other.joint, other.b, at));
    least = std::min(least, apart - one.radius - other.radius);
  });
  return least;
}

double leastDistance(const OracleClip& clip, const OracleCapsule& capsule,
                     const oracle::Triangle& triangle) {
  double least = 1e9;
  overLooks(clip, [&](double at) {
    const Vec3d a = clip.pointAt(capsule.joint, capsule.a, at);
    const Vec3d b = clip.pointAt(capsule.joint, capsule.b, at);
    least = std::min(least, oracle::closestPoints(a, b, triangle).distance - capsule.radius);
  });
  return least;
}

double farthestSlide(const OracleClip& clip, const OracleCapsule& capsule, double beginS,
                     double endS) {
  const Vec3d from = clip.pointAt(capsule.joint, capsule.a, beginS / clip.frameTimeS());
  double farthest = 0.0;
  for (double at = beginS / clip.frameTimeS(); at <= endS / clip.frameTimeS(); at += 0.25) {
    const Vec3d now = clip.pointAt(capsule.joint, capsule.a, at);
    farthest = std::max(farthest, std::hypot(now.x - from.x, now.z - from.z));
  }
  return farthest;
}

double OracleChange::mean() const {
  double sum = 0.0;
  for (const double move : moves) sum += move;
  return moves.empty() ? 0.0 : sum / static_cast<double>(moves.size());
}

OracleChange changeBetween(const OracleClip& before, const OracleClip& after, double unit) {
  OracleChange change;
  for (const std::string& joint : before.joints()) {
    std::array<std::vector<Vec3d>, 2> ways;
    for (std::size_t frame = 0; frame < before.frames(); ++frame) {
      ways[0].push_back(before.pointAt(joint, {}, static_cast<double>(frame)));
      ways[1].push_back(after.pointAt(joint, {}, static_cast<double>(frame)));
      change.moves.push_back(unit * oracle::norm(ways[1].back() - ways[0].back()));
      change.turns.push_back(before.turnFrom(after, joint, frame));
    }
    for (std::size_t i = 3; i < before.frames(); ++i) {
      const auto third = [i](const std::vector<Vec3d>& way) {
        return oracle::norm(way[i] - way[i - 3] + 3.0 * (way[i - 2] - way[i - 1]));
      };
      change.jerkBefore += third(ways[0]);
      change.jerkAfter += third(ways[1]);
    }
  }
  std::sort(change.moves.begin(), change.moves.end());
  std::sort(change.turns.begin(), change.turns.end());
  return change;
}

}  // namespace foretouch::test
