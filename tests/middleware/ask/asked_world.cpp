#include "tests/middleware/ask/asked_world.h"

#include <algorithm>
#include <array>

#include "tests/support/judged.h"
#include "tests/support/own_surface.h"

namespace foretouch::test {

using Eigen::Vector3d;

namespace {

WorldTime timeOf(const WorldQuestion& question, BodyId body) {
  for (const AskInstant& instant : question.instants) {
    if (instant.body == body) return instant.time;
  }
  return question.time;
}

}  // namespace

std::optional<AskUnknown> AskedWorld::whyUnknown(BodyId body, const WorldTime& time) const {
  const std::vector<OracleEpisode>& episodes = bodyOf(body).episodes;
  if (time.us < episodes.front().beginUs) return AskUnknown::NotThere;
  std::size_t e = 0;
  while (e + 1 < episodes.size() && episodes[e + 1].beginUs <= time.us) ++e;
  const OracleEpisode& episode = episodes[e];
  if (episode.carrier >= 0) return whyUnknown(episode.carrier, time);  // held fast
  const WorldTime last{episode.times.back(), 0.0};
  if (!(last < time)) return std::nullopt;
  return options_[slotOf(body)].whenSilent == WhenSilent::HoldStill ? AskUnknown::Assumed
                                                                    : AskUnknown::Silent;
}

bool isInGroups(const AskWhom& whom, BodyGroup group) {
  return (whom.groups >> static_cast<unsigned>(group) & 1U) != 0;
}

std::vector<UnknownBody> AskedWorld::unknownAt(const WorldQuestion& question) const {
  std::vector<UnknownBody> unknown;
  for (BodyId body = 0; body < numBodies(); ++body) {
    if (!isInGroups(question, options_[slotOf(body)].group)) continue;
    const bool isOut =
        std::any_of(question.without.begin(), question.without.end(), [&](const AskPart& part) {
          return part.body == body && part.link == kEveryLink && part.object == kEveryObject;
        });
    const bool isIn = question.only.empty() ||
                      std::any_of(question.only.begin(), question.only.end(),
                                  [&](const AskPart& part) { return part.body == body; });
    if (isOut || !isIn) continue;
    const auto why = whyUnknown(body, timeOf(question, body));
    if (why) unknown.push_back({body, *why, kEveryObject});
  }
  return unknown;
}

std::vector<JudgedPart> AskedWorld::partsAt(const WorldQuestion& question) const {
  std::vector<JudgedPart> all;
  for (std::size_t i = 0; still_ && i < still_->numTriangles(); ++i) {
    const auto id = static_cast<TriangleId>(i);
    JudgedPart part;
    part.side.triangle = id;
    part.object = still_->object(id);
    part.part = {0, 3, plain(still_->triangle(id)), 0.0};
    all.push_back(part);
  }
  for (BodyId body = 0; body < numBodies(); ++body) {
    if (!isInGroups(question, options_[slotOf(body)].group)) continue;
    const WorldTime time = timeOf(question, body);
    const auto why = whyUnknown(body, time);
    if (why && why != AskUnknown::Assumed) continue;
    const Real us = static_cast<Real>(time.us) + static_cast<Real>(time.fraction);
    if (hasSkin(body)) {
      appendSkin(body, us, all);
    } else {
      appendParts(body, both_.oracle.partsAt(body, -1, 0, us), all);
    }
  }
  return all;
}

RandomSkin AskedWorld::skinOf(const Avatar& avatar, Random& random) {
  const Pose rest = restPose(avatar.skeleton());
  const ChainMotion motion(avatar.skeleton(), rest, rest);
  RandomSkin made =
      randomSkin(avatar, motion, random, 1 + random.below(random.chance(0.2) ? 90 : 9));
  std::size_t kept = 0, first = 0;
  for (std::size_t& count : made.counts) {
    const std::size_t own = count;
    if (kept > 0 && random.chance(0.2)) count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      made.skin.triangles[kept++] = made.skin.triangles[first + i];
    }
    first += own;
  }
  made.skin.triangles.resize(kept);
  return made;
}

void AskedWorld::appendSkin(BodyId body, Real us, std::vector<JudgedPart>& all) const {
  const RandomSkin& skin = *skins_[slotOf(body)];
  const Avatar& avatar = *avatars_[slotOf(body)];
  std::vector<oracle::MovingFrame<Real>> frames;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    frames.push_back(both_.oracle.frameAt(body, link, 0, us, false));
  }
  JudgedPart judged;
  judged.side.body = body;
  judged.isOfSkin = true;
  std::size_t triangle = 0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    judged.side.link = link;
    for (std::size_t i = 0; i < skin.counts[slotOf(link)]; ++i) {
      judged.side.triangle = static_cast<TriangleId>(i);
      judged.part = {link, 3, {}, 0.0};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        oracle::Vec3r sum;
        const auto vertex = slotOf(skin.skin.triangles[triangle][corner]);
        for (const SkinInfluence& share : skin.skin.vertices[vertex]) {
          sum = sum + static_cast<Real>(share.weight) *
                          frames[slotOf(share.link)].at(plain(share.p_L).as<Real>());
        }
        judged.part.corners[corner] = sum.as<double>();
      }
      all.push_back(judged);
      ++triangle;
    }
    const bool isBare = skin.counts[slotOf(link)] == 0;
    if (isBare) appendParts(body, both_.oracle.partsAt(body, link, 0, us), all);
  }
}

void AskedWorld::addClosed(RawScene& raw, Random& random, double size) {
  const Vector3d centre = random.inBox(0.5 * size);
  const auto object = static_cast<ObjectId>(raw.objectNames.size());
  raw.objectNames.emplace_back("solid");
  const bool isHollow = random.chance(0.3), isOpen = random.chance(0.2);
  std::array<double, 6> lengths{};
  for (double& length : lengths) length = size * random.uniform(0.2, 1.0);
  for (int shell = isHollow ? 1 : 0; shell >= 0; --shell) {
    for (unsigned face = isOpen ? 1 : 0; face < 8; ++face) {
      Triangle triangle;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const bool isUp = (face >> axis & 1U) != 0;
        const double length = lengths[2 * axis + (isUp ? 1 : 0)] * (shell == 1 ? 0.4 : 1.0);
        triangle.vertices[axis] = centre;
        triangle.vertices[axis][axis] += isUp ? length : -length;
      }
      raw.triangles.push_back(triangle);
      raw.objectOf.push_back(object);
    }
  }
}

/// In the order in which the judge was told of them: of each link LSS, then triangles.
void AskedWorld::appendParts(BodyId body, const std::vector<oracle::OraclePart>& parts,
                             std::vector<JudgedPart>& all) const {
  int link = -1;
  std::vector<std::int32_t> standing;  // LSS of the link that are their own surface
  std::size_t lss = 0;
  TriangleId triangle = 0;
  for (const oracle::OraclePart& part : parts) {
    if (part.link != link) {
      link = part.link;
      lss = 0;
      triangle = 0;
      standing.clear();
      if (!meshes_[slotOf(body)]) {
        const Avatar& avatar = *avatars_[slotOf(body)];
        for (std::size_t i = 0; i < avatar.lss(link).size(); ++i) {
          const auto& surface = surfaces_[slotOf(body)];
          const bool stands =
              !surface || standsForItself(avatar.lss(link)[i], surface->triangles(link));
          if (stands) standing.push_back(static_cast<std::int32_t>(i));
        }
      }
    }
    JudgedPart judged;
    judged.side.body = body;
    judged.side.link = link;
    judged.part = part;
    if (part.count == 3) {
      judged.side.triangle = triangle++;
      const auto& mesh = meshes_[slotOf(body)];
      if (mesh) judged.object = mesh->object(judged.side.triangle);
    } else {
      judged.side.lss = standing[lss++];
    }
    all.push_back(judged);
  }
}

Vector3d aimed(const std::vector<JudgedPart>& parts, Random& random) {
  if (parts.empty() || random.chance(0.15)) return random.inBox(1.5);
  const auto& part = parts[slotOf(random.below(static_cast<int>(parts.size())))].part;
  double weights[3] = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
  if (random.chance(0.2)) weights[0] = 0.0;  // an edge
  if (random.chance(0.1)) weights[1] = 0.0;  // and a corner
  const double sum = weights[0] + weights[1] + weights[2];
  Vector3d p = Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) p += weights[i] / sum * tools::rich(part.corners[i]);
  if (random.chance(0.3)) p += random.magnitude(1e-12, 0.2) * random.direction();
  // So that it grazes.
  if (random.chance(0.2)) p += part.radius * random.direction();
  return p;
}

}  // namespace foretouch::test
