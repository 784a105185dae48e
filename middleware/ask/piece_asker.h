// middleware/ask/piece_asker.h: asks LSS and triangles that rest in one frame, one after the other,
// and says what it finds in W. Not installed.
#pragma once

#include <algorithm>

#include "middleware/ask/ask_filter.h"
#include "middleware/ask/asked_shape.h"
#include "middleware/ask/hit_list.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/surface/link_surface.h"

namespace foretouch::internal {

/// Where a shape met a piece: all that does not depend on whose it is, in their frame.
[[nodiscard]] WorldHit hitOf(const AskedShape& shape, const Hull& piece, double radius,
                             const Meeting& meeting);

/// Sets whose it is; its place stays. Number by number: where a place is written after a copy of
/// all, the compiler of WebAssembly loses two of its coordinates.
void takeOwner(const ContactSide& side, WorldHit& hit);

/// Refers to all that it is given.
class PieceAsker {
 public:
  /// `shape`: in the frame of the pieces; `frame`: where that is in W.
  PieceAsker(const AskFilter& filter, const AskedShape& shape, const LinkPlace& frame,
             bool isAssumed, HitList& hits)
      : filter_(filter), shape_(shape), frame_(frame), isAssumed_(isAssumed), hits_(hits) {}

  [[nodiscard]] const AskedShape& shape() const { return shape_; }
  /// How far the shape may go on from here, or be away; below zero: nothing more is asked for.
  [[nodiscard]] double limit() const {
    return std::min(shape_.reach, hits_.limit() - shape_.moved);
  }

  void askLss(const Lss& lss, const ContactSide& side);
  void askTriangle(const Triangle& triangle, const ContactSide& side, ObjectId object);

 private:
  void add(const Meeting& meeting, const Hull& piece, double radius, const ContactSide& side,
           ObjectId object);

  const AskFilter& filter_;
  AskedShape shape_;
  const LinkPlace& frame_;
  bool isAssumed_;
  HitList& hits_;
};

/// All triangles of a scene, or of a mesh, the nearest parts first; `side` names whose they are.
void askScene(const SceneParts& scene, const ContactSide& side, PieceAsker& asker);
/// The triangles of a link's LSS `side.lss`.
void askSurface(const LinkSurface& surface, const ContactSide& side, PieceAsker& asker);

}  // namespace foretouch::internal
