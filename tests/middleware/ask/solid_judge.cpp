// The part of the judge that knows which points are inside of what is closed.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

#include "tests/middleware/ask/ask_judge.h"

namespace foretouch::test {
namespace {

/// Nearer to a surface (m), either answer is right.
constexpr Real kAtSurface = 1e-9L;

auto keyOf(const UnknownBody& x) {
  return std::make_tuple(x.body, x.why, x.object);
}

/// Every edge an even number of times.
bool closes(const std::vector<oracle::Corners<Real>>& surface) {
  using Place = std::array<Real, 3>;
  std::map<std::array<Place, 2>, int> edges;
  for (const oracle::Corners<Real>& v : surface) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &p = v[i], &q = v[(i + 1) % 3];
      std::array<Place, 2> edge{Place{p.x, p.y, p.z}, Place{q.x, q.y, q.z}};
      if (edge[0] == edge[1]) continue;
      if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
      ++edges[edge];
    }
  }
  return std::all_of(edges.begin(), edges.end(),
                     [](const auto& edge) { return edge.second % 2 == 0; });
}

/// In a tetrahedron of corners, of which the first one is enough for all that is between them; of
/// many triangles nobody looks.
bool isBetween(const oracle::Vec3r& p, const std::vector<oracle::Corners<Real>>& surface) {
  constexpr std::size_t kMostTriangles = 16;
  if (surface.size() > kMostTriangles) return false;
  std::vector<oracle::Vec3r> corners;
  std::vector<oracle::Vec3d> inDoubles;
  for (const auto& v : surface) {
    for (const oracle::Vec3r& corner : v) {
      if (std::find(corners.begin(), corners.end(), corner) != corners.end()) continue;
      corners.push_back(corner);
      inDoubles.push_back(corner.as<double>());
    }
  }
  if (oracle::isClearlyOutside(p.as<double>(), inDoubles)) return false;
  const std::size_t count = corners.size();
  for (std::size_t i = 1; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      for (std::size_t k = j + 1; k < count; ++k) {
        if (oracle::isIn(p, {corners[0], corners[i], corners[j], corners[k]})) return true;
      }
    }
  }
  return false;
}

}  // namespace

void AskJudge::findSolids() {
  std::map<std::tuple<BodyId, LinkId, ObjectId>, Solid> solids;
  for (const JudgedPart& part : parts_) {
    if (part.part.count != 3 || !isAsked(part)) continue;
    const LinkId link = part.side.body == kStillScene ? 0 : part.side.link;
    Solid& solid = solids[{part.side.body, link, part.object}];
    solid.body = part.side.body;
    solid.link = link;
    solid.object = part.object;
    solid.isOfSkin = part.isOfSkin;
    const auto& v = part.part.corners;
    solid.surface.push_back({v[0].as<Real>(), v[1].as<Real>(), v[2].as<Real>()});
  }
  for (auto& [key, solid] : solids) {
    constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
    std::array<Real, 3> low{kInfinity, kInfinity, kInfinity};
    std::array<Real, 3> high{-kInfinity, -kInfinity, -kInfinity};
    for (const auto& v : solid.surface) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const auto& corner : v) {
          low[axis] = std::min(low[axis], corner[axis]);
          high[axis] = std::max(high[axis], corner[axis]);
        }
      }
    }
    solid.boxGap = -kInfinity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      solid.boxGap = std::max({solid.boxGap, low[axis] - place_[axis], place_[axis] - high[axis]});
    }
    solid.isClosed = !solid.isOfSkin && closes(solid.surface);
    solid.isInside = solid.isClosed && solid.boxGap < 0 && oracle::isInside(place_, solid.surface);
    solids_.push_back(solid);
  }
}

bool AskJudge::isAtSurface(const Solid& solid) const {
  return std::any_of(solid.surface.begin(), solid.surface.end(), [&](const auto& v) {
    return oracle::closestPoints(place_, place_, v).distance < kAtSurface;
  });
}

void AskJudge::judgeSolids(const WorldAnswer& answer, AskTally& tally) const {
  const auto report = [&](const char* what, BodyId body, ObjectId object) {
    std::ostringstream out;
    out << what << ": object " << object << " of body " << body;
    tally.problems.push_back(out.str());
  };
  for (const WorldHit& hit : answer.hits) {
    if (hit.what.lss >= 0 || hit.what.triangle >= 0) continue;
    const auto solid = std::find_if(solids_.begin(), solids_.end(), [&](const Solid& one) {
      return one.body == hit.what.body && one.link == hit.what.link && one.object == hit.object;
    });
    const bool isThere = solid != solids_.end() && solid->isClosed &&
                         (solid->isInside || isAtSurface(*solid)) && hit.distance == 0.0;
    if (!isThere) report("not inside", hit.what.body, hit.object);
  }
  const bool isComplete = question_.which == AskWhich::All;
  const bool isAtStart = !answer.hits.empty() && answer.hits.front().distance == 0.0;
  if (!isComplete && (isAtStart || (question_.which == AskWhich::Any && !answer.hits.empty()))) {
    return;
  }
  for (const Solid& solid : solids_) {
    if (!solid.isInside) continue;
    const bool isTold =
        std::any_of(answer.hits.begin(), answer.hits.end(), [&](const WorldHit& hit) {
          return hit.what.lss < 0 && hit.what.triangle < 0 && hit.what.body == solid.body &&
                 hit.what.link == solid.link && hit.object == solid.object;
        });
    if (!isTold && !isAtSurface(solid)) report("missed inside", solid.body, solid.object);
  }
}

void AskJudge::judgeUnknown(const WorldAnswer& answer, std::vector<UnknownBody> others,
                            AskTally& tally) const {
  // Some hit is enough: nobody looks further.
  if (question_.which == AskWhich::Any && !answer.hits.empty() && question_.solids) return;
  std::vector<UnknownBody> told = answer.unknown;
  for (const Solid& solid : solids_) {
    if (solid.isClosed) continue;
    const UnknownBody open{solid.body, AskUnknown::Open, solid.object};
    const auto isIt = [&](const UnknownBody& x) { return keyOf(x) == keyOf(open); };
    const bool isTold = std::any_of(answer.unknown.begin(), answer.unknown.end(), isIt);
    if (isTold) ++tally.open;
    if (solid.body == kStillScene) {
      if (std::abs(solid.boxGap) <= kAtSurface) return;  // either is right
      if (solid.boxGap < 0) others.push_back(open);
      continue;
    }
    // Of what moves it is the box in its own frame, which is around all means of corners.
    if (!isTold && solid.boxGap < 0 && isBetween(place_, solid.surface)) {
      tally.problems.emplace_back("missed that an object is open");
    }
    told.erase(std::remove_if(told.begin(), told.end(), isIt), told.end());
  }
  std::sort(others.begin(), others.end(),
            [](const UnknownBody& x, const UnknownBody& y) { return keyOf(x) < keyOf(y); });
  const bool isSame =
      std::equal(others.begin(), others.end(), told.begin(), told.end(),
                 [](const UnknownBody& x, const UnknownBody& y) { return keyOf(x) == keyOf(y); });
  if (!isSame) {
    std::ostringstream out;
    out << "what is unknown differs:";
    for (const UnknownBody& x : told) {
      out << " told " << x.body << '/' << static_cast<int>(x.why) << '/' << x.object;
    }
    for (const UnknownBody& x : others) {
      out << " known " << x.body << '/' << static_cast<int>(x.why) << '/' << x.object;
    }
    tally.problems.push_back(out.str());
  }
}

}  // namespace foretouch::test
