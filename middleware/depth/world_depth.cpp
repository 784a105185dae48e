#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/depth/body_places.h"
#include "middleware/depth/depth.h"
#include "middleware/world/world_parts.h"

namespace foretouch {

namespace {

using internal::LinkPlace;
using internal::PlaceKnown;
using internal::WorldParts;

/// What questions about depths in a world keep.
struct WorldDepthMemory : internal::ScratchPart {
  static constexpr internal::ScratchKind kKind = internal::ScratchKind::WorldDepth;

  internal::BodyPlaces bodies;
  std::vector<LinkPlace> places;
  std::vector<Lss> moved, others;
  std::vector<ContactSide> sidesOfMoved, sidesOfOthers;
};

std::string nameOf(BodyId body) {
  return "body " + std::to_string(body);
}

/// One of the two that are asked.
struct Asked {
  BodyId body;
  LinkId link;
};

Result<Done> checked(const WorldParts& world, const Asked& asked) {
  if (asked.body == kStillScene) {
    if (world.still) return Done{};
    return Error::of(ErrorCode::Empty, "expected a world with a scene that stands still");
  }
  if (asked.body < 0 || slotOf(asked.body) >= world.bodies.size()) {
    return Error::at(asked.body, ErrorCode::UnknownName,
                     "expected one of the world's " + std::to_string(world.bodies.size()) +
                         " bodies, found " + nameOf(asked.body));
  }
  if (world.body(asked.body).options.surface) {
    return Error::at(asked.body, ErrorCode::Mismatch,
                     nameOf(asked.body) +
                         " touches by its triangles; expected one that touches by "
                         "its LSS, to say how deep it is");
  }
  const std::int32_t links = world.kindOf(asked.body).skeleton.numJoints();
  if (asked.link == kEveryLink || (asked.link >= 0 && asked.link < links)) return Done{};
  return Error::at(asked.link, ErrorCode::UnknownName,
                   nameOf(asked.body) + ": expected one of its " + std::to_string(links) +
                       " links, found " + std::to_string(asked.link));
}

/// Whether it is made of LSS.
bool hasLss(const WorldParts& world, const Asked& asked) {
  return asked.body != kStillScene && world.kindOf(asked.body).avatar.has_value();
}

Result<Done> checked(const WorldParts& world, const Asked& a, const Asked& b) {
  FORETOUCH_CHECK(checked(world, a));
  FORETOUCH_CHECK(checked(world, b));
  if (a.body == kStillScene) {
    return Error::of(ErrorCode::Mismatch, "expected a body to be moved, found the scene");
  }
  const bool isSame = a.link == kEveryLink || b.link == kEveryLink || a.link == b.link;
  if (a.body == b.body && isSame) {
    return Error::at(a.body, ErrorCode::Mismatch,
                     nameOf(a.body) + ": expected two different links, of one body");
  }
  if (hasLss(world, a) || hasLss(world, b)) return Done{};
  return Error::at(a.body, ErrorCode::Mismatch,
                   nameOf(a.body) + ": expected one of the two to be made of LSS");
}

class Question {
 public:
  Question(const WorldParts& world, const WorldTime& time, Scratch& scratch)
      : world_(world), time_(time), scratch_(scratch), memory_(scratch.of<WorldDepthMemory>()) {}

  Result<WorldDepth> ask(const Asked& a, const Asked& b) {
    // What is made of LSS is moved; out of another, either may be.
    const bool isTurned = !hasLss(world_, a);
    FORETOUCH_TRY(WorldDepth answer, isTurned ? outOf(b, a) : outOf(a, b));
    answer.isAssumed = isAssumed_;
    if (!isTurned) return answer;
    std::swap(answer.a, answer.b);
    answer.depth.wayOut = -answer.depth.wayOut;
    std::swap(answer.depth.deepestMoved, answer.depth.deepestOther);
    return answer;
  }

 private:
  Result<WorldDepth> outOf(const Asked& moved, const Asked& other) {
    FORETOUCH_CHECK(place(moved, memory_.moved, memory_.sidesOfMoved));
    WorldDepth answer;
    answer.a.body = moved.body;
    answer.b.body = other.body;
    answer.a.link = moved.link == kEveryLink ? 0 : moved.link;
    answer.b.link = other.link == kEveryLink ? 0 : other.link;
    if (other.body == kStillScene) {
      answer.depth = depthIn(memory_.moved, *world_.still, scratch_, rounding_);
    } else if (hasLss(world_, other)) {
      FORETOUCH_CHECK(place(other, memory_.others, memory_.sidesOfOthers));
      answer.depth = depthAmong(memory_.moved, memory_.others, scratch_, rounding_);
    } else {
      FORETOUCH_TRY(answer.depth, inMesh(other.body));
    }
    if (answer.depth.deepestMoved < 0) return answer;
    answer.a = memory_.sidesOfMoved[slotOf(answer.depth.deepestMoved)];
    if (hasLss(world_, other)) {
      answer.b = memory_.sidesOfOthers[slotOf(answer.depth.deepestOther)];
    } else {
      answer.b.triangle = answer.depth.deepestOther;
    }
    return answer;
  }

  /// The depth in the mesh's frame, turned back.
  Result<Depth> inMesh(BodyId mesh) {
    FORETOUCH_CHECK(placesOf(mesh));
    const LinkPlace frame = memory_.places.front();
    const Scene& scene = *world_.kindOf(mesh).mesh;
    double reach = world_.kindOf(mesh).rho;
    for (Lss& lss : memory_.moved) {
      double ofOne = rounding_;
      lss = internal::seenFrom(frame, lss, ofOne);
      most_ = std::max(most_, ofOne);
      reach = std::max({reach, lss.a.norm() + lss.radius, lss.b.norm() + lss.radius});
    }
    // The way is turned back by a rotation that is known to ofTurn: ways up to this long stay
    // proven.
    const double longest = 4.0 * reach + 1.0;
    const double perMetre = frame.ofTurn + MotionBounds::kPointRounding;
    Depth depth = depthIn(memory_.moved, scene, scratch_,
                          (most_ + perMetre * longest) * internal::kInflation);
    depth.wayOut = frame.R_WL * depth.wayOut;
    const double length = depth.wayOut.norm() * internal::kInflation;
    if (depth.isCertified && length <= longest) {
      depth.upper = std::max(depth.upper, length);
      return depth;
    }
    depth.isCertified = false;
    depth.upper = std::numeric_limits<double>::infinity();
    depth.wayOut.setZero();
    return depth;
  }

  Result<Done> placesOf(BodyId body) {
    const PlaceKnown how = memory_.bodies.at(world_, body, time_, memory_.places);
    isAssumed_ = isAssumed_ || how == PlaceKnown::Assumed;
    if (how == PlaceKnown::Known || how == PlaceKnown::Assumed) return Done{};
    return Error::at(body, ErrorCode::OutOfRange,
                     nameOf(body) + (how == PlaceKnown::Silent ? " is silent" : " is not there") +
                         " at " + std::to_string(time_.us) + " us");
  }

  Result<Done> place(const Asked& asked, std::vector<Lss>& lss, std::vector<ContactSide>& sides) {
    FORETOUCH_CHECK(placesOf(asked.body));
    const Avatar& avatar = *world_.kindOf(asked.body).avatar;
    lss.clear();
    sides.clear();
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      if (asked.link != kEveryLink && asked.link != link) continue;
      for (const Lss& one : avatar.lss(link)) {
        lss.push_back(internal::placed(one, memory_.places[slotOf(link)], rounding_));
        ContactSide side;
        side.body = asked.body;
        side.link = link;
        side.lss = static_cast<std::int32_t>(&one - avatar.lss(link).data());
        sides.push_back(side);
      }
    }
    return Done{};
  }

  const WorldParts& world_;
  const WorldTime& time_;
  Scratch& scratch_;
  WorldDepthMemory& memory_;
  double rounding_ = 0.0;  // that of LSS in W
  double most_ = 0.0;      // that of those seen from a mesh
  bool isAssumed_ = false;
};

}  // namespace

Result<WorldDepth> World::depth(const WorldTime& time, const DepthQuestion& question,
                                Scratch& scratch) const {
  if (!(time.fraction >= 0.0 && time.fraction < 1.0)) {
    return Error::of(ErrorCode::OutOfRange, "expected a fraction of a microsecond in [0, 1)");
  }
  const Asked a{question.a, question.linkOfA}, b{question.b, question.linkOfB};
  FORETOUCH_CHECK(checked(parts(), a, b));
  return Question(parts(), time, scratch).ask(a, b);
}

}  // namespace foretouch
