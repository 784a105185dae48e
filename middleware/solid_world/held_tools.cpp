#include "middleware/solid_world/held_tools.h"

#include <utility>

#include "articulated/try.h"
#include "lss/lss_cover.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

/// LSS of a mesh in a hand: a chair takes some.
constexpr int kMostOfMesh = 8;

bool isSame(const Lss& x, const Lss& y) {
  return x.a == y.a && x.b == y.b && x.radius == y.radius;
}

/// The body's links in the frame of the link that carries it.
void placeInHand(const WorldParts& world, BodyId body, std::int64_t us,
                 std::vector<LinkState>& states) {
  const Episode& episode = *world.body(body).episodeAt(us);
  placeLinks(world.kindOf(body).skeleton, *episode.track.pieceAt(us).from, states);
}

void moveInto(const LinkState& frame, std::vector<LinkState>& states) {
  for (LinkState& state : states) {
    state.p_WL = frame.pointAt(state.p_WL);
    state.R_WL = frame.R_WL * state.R_WL;
  }
}

}  // namespace

bool HeldTool::operator==(const HeldTool& other) const {
  if (body != other.body || link != other.link || lss.size() != other.lss.size()) return false;
  for (std::size_t i = 0; i < lss.size(); ++i) {
    if (!isSame(lss[i], other.lss[i])) return false;
  }
  return true;
}

Holder holderOf(const WorldParts& world, const std::vector<std::uint8_t>& isSolid, BodyId body,
                std::int64_t us) {
  Holder holder;
  for (BodyId at = body;;) {
    const Episode* const episode = world.body(at).episodeAt(us);
    if (episode == nullptr || !episode->carrier) return {};
    holder.isHeldFast = holder.isHeldFast && episode->isHeldFast();
    at = episode->carrier->body;
    if (isSolid[slotOf(at)] == 0) continue;
    holder.body = at;
    holder.link = episode->carrier->link;
    return holder;
  }
}

const std::vector<Lss>& MeshCovers::of(std::int32_t kind, const Scene& mesh) {
  if (ofKind_.size() <= slotOf(kind)) ofKind_.resize(slotOf(kind) + 1);
  std::vector<Lss>& cover = ofKind_[slotOf(kind)];
  if (!cover.empty()) return cover;
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < mesh.numTriangles(); ++i) {
    const Triangle& triangle = mesh.triangle(static_cast<TriangleId>(i));
    if (isFinite(triangle)) triangles.push_back(triangle);
  }
  cover = coverTriangles(triangles, kMostOfMesh);
  return cover;
}

HeldTool toolOf(const WorldParts& world, const std::vector<std::uint8_t>& isSolid, BodyId body,
                std::int64_t us, MeshCovers& covers) {
  HeldTool tool;
  tool.body = body;
  std::vector<LinkState> states, above;
  placeInHand(world, body, us, states);
  const Carrier* carrier = &*world.body(body).episodeAt(us)->carrier;
  while (isSolid[slotOf(carrier->body)] == 0) {
    placeInHand(world, carrier->body, us, above);
    moveInto(above[slotOf(carrier->link)], states);
    carrier = &*world.body(carrier->body).episodeAt(us)->carrier;
  }
  tool.link = carrier->link;
  const BodyKind& kind = world.kindOf(body);
  for (std::size_t link = 0; link < states.size(); ++link) {
    const std::vector<Lss>& own =
        kind.mesh ? covers.of(world.body(body).kind, *kind.mesh) : kind.volumes[link];
    for (const Lss& lss : own) {
      tool.lss.push_back({states[link].pointAt(lss.a), states[link].pointAt(lss.b), lss.radius});
    }
  }
  return tool;
}

Result<Equipped> equipped(const Avatar& avatar, const SolidOptions& options,
                          const std::vector<HeldTool>& tools) {
  if (tools.empty()) return Equipped{avatar, options};
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) lss.push_back(avatar.lss(link));
  for (const HeldTool& tool : tools) {
    std::vector<Lss>& own = lss[slotOf(tool.link)];
    own.insert(own.end(), tool.lss.begin(), tool.lss.end());
  }
  FORETOUCH_TRY(Avatar whole, Avatar::build(avatar.skeleton(), std::move(lss)));
  Equipped result{std::move(whole), options};
  if (options.self) {
    std::vector<LeftOutPair> leftOut = options.self->leftOut();
    for (const HeldTool& tool : tools) {
      if (!avatar.lss(tool.link).empty()) continue;
      // A link without a surface of its own has no rules: its tool is asked about nothing near.
      for (LinkId other = 0; other < avatar.numLinks(); ++other) {
        if (other == tool.link || result.avatar.lss(other).empty()) continue;
        leftOut.push_back(
            {std::min(other, tool.link), std::max(other, tool.link), PairReason::User});
      }
    }
    FORETOUCH_TRY(result.options.self,
                  PairRules::leavingOut(result.avatar, std::move(leftOut), options.self->radii()));
  }
  return result;
}

}  // namespace foretouch::internal
