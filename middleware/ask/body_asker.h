// middleware/ask/body_asker.h: asks the static scene, and the bodies whose boxes a shape comes to,
// the nearest first. Not installed.
#pragma once

#include <vector>

#include "middleware/ask/ask_filter.h"
#include "middleware/ask/asked_shape.h"
#include "middleware/ask/hit_list.h"
#include "middleware/ask/instant_bodies.h"
#include "middleware/ask/moving_body.h"
#include "middleware/ask/piece_asker.h"
#include "middleware/ask/skin_asker.h"
#include "middleware/exact/closed_mesh.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// What questions keep.
struct AskMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Ask;

  struct NearBody {
    double bound;
    BodyId body;
  };
  InstantBodies bodies;
  ConvexShape hull, seen;      // of the question, in W; and in the frame of a body or link
  std::vector<double> bounds;  // of bodies, and of one's LSS
  std::vector<NearBody> near;
  ObjectsAround around;
  SkinMemory skin;
  // For flights.
  struct LaterPart {
    double us;           // from when on it is to be looked at
    std::int32_t child;  // a node of a hierarchy, or ~ a triangle
  };
  MovingBody moving;
  WorldAnswer ofStill;
  std::vector<LaterPart> parts;
};

/// Asks one question. Refers to all that it is given.
class BodyAsker {
 public:
  /// `open`: if solids are asked about, objects without an inside are added to it.
  BodyAsker(const WorldParts& world, const AskFilter& filter, const AskedShape& shape,
            AskMemory& memory, HitList& hits, std::vector<UnknownBody>* open)
      : world_(world), filter_(filter), shape_(shape), memory_(memory), hits_(hits), open_(open) {}

  void askStill(const Scene& scene);
  /// Asks the bodies at the instants to which they were brought.
  void askBodies();

 private:
  void askBody(const AskMemory::NearBody& near);
  void askMesh(BodyId body, const AskedShape& shape);
  void askLinks(BodyId body, const PieceBoxes* pieces, const AskedShape& shape);
  void askSkin(BodyId body, const PieceBoxes* pieces, const AskedShape& shape);
  void askLink(const ContactSide& side, const LinkPlace& place, const AskedShape& shape);
  /// Asks solid objects around the shape's place, of a scene or mesh, or of a link with triangles.
  /// `shape`: as seen from their frame.
  void askSolids(const SceneParts& scene, BodyId body, const AskedShape& shape);
  /// The same for a link's own surface, if it has one.
  void askSolidsOf(const ContactSide& side, const AskedShape& shape);
  void askSolids(const LinkSurface& surface, const ContactSide& side, const AskedShape& shape);
  void addSolid(const ContactSide& side, ObjectId object);
  [[nodiscard]] bool isAssumed(BodyId body) const {
    return memory_.bodies.known(body) == PlaceKnown::Assumed;
  }

  const WorldParts& world_;
  const AskFilter& filter_;
  const AskedShape& shape_;
  AskMemory& memory_;
  HitList& hits_;
  std::vector<UnknownBody>* open_;
};

}  // namespace foretouch::internal
