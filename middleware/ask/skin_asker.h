// middleware/ask/skin_asker.h: a skin at one instant: which triangles a shape comes to. By boxes
// around what the links have of it, then by balls around clusters of triangles and around their
// parts; only triangles of parts that it comes to are posed. Proof: ask.md 9. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "middleware/ask/ask_filter.h"
#include "middleware/ask/asked_shape.h"
#include "middleware/ask/hit_list.h"
#include "middleware/ask/instant_bodies.h"
#include "middleware/ask/piece_asker.h"
#include "middleware/depth/body_places.h"
#include "middleware/surface/blend_table.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// What questions keep of skins.
struct SkinMemory {
  struct Near {
    double bound;
    LinkId link;
    std::int32_t blend;  ///< A cluster, or a part.
  };
  std::array<std::vector<double>, 3> lower, upper;  // of links, then of clusters
  std::vector<double> bounds;
  std::vector<LinkId> links, bare;  // that the shape comes to: with triangles, and without
  std::vector<Near> clusters, parts;
};

/// Asks one question about one body. Refers to all that it is given.
class SkinAsker {
 public:
  /// `kind` has a skin; `shape`: in W.
  SkinAsker(const BodyKind& kind, const AskedShape& shape, const AskFilter& filter, bool isAssumed,
            HitList& hits, SkinMemory& memory);

  /// Some of its triangles are asked about, wherever they are.
  [[nodiscard]] bool takesTriangles(BodyId body) const;
  /// Finds the links whose surface the shape may come to, by the boxes of `pieces`; every link if
  /// that is null. False: none.
  [[nodiscard]] bool findLinks(BodyId body, const PieceBoxes* pieces);
  /// Asks the triangles of these links; `side`: the body's.
  void askTriangles(ContactSide side, const std::vector<LinkPlace>& places);
  /// Those of these links that have no triangles of the skin.
  [[nodiscard]] const std::vector<LinkId>& bareLinks() const { return memory_.bare; }

 private:
  void takeRounding(const std::vector<LinkPlace>& places);
  void clearBoxes();
  void addBall(const BlendedLss& blend, const std::vector<LinkPlace>& places);
  void findBounds(const Eigen::Vector3d& origin, double extent);
  void askPart(ContactSide& side, std::int32_t part, const std::vector<LinkPlace>& places,
               PieceAsker& asker);
  [[nodiscard]] double limit() const;

  const BodyKind& kind_;
  const SkinParts& skin_;
  const BlendTable& blends_;
  AskedShape shape_;
  const AskFilter& filter_;
  bool isAssumed_;
  HitList& hits_;
  SkinMemory& memory_;
};

}  // namespace foretouch::internal
