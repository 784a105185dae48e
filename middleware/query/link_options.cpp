#include "middleware/query/link_options.h"

#include "lss/index.h"

namespace foretouch::internal {

const LinkSurface* surfaceOf(const QueryOptions& options, LinkId link) {
  if (fidelityOf(options, link) != Fidelity::Exact) return nullptr;
  return options.surface->parts().links[slotOf(link)].get();
}

const SkinParts* skinOf(const QueryOptions& options, LinkId link) {
  if (options.fidelity != Fidelity::Skinned) return nullptr;
  const SkinParts& parts = options.skin->parts();
  return parts.numTriangles(link) > 0 ? &parts : nullptr;
}

}  // namespace foretouch::internal
