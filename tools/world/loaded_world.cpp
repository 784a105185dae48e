#include "tools/world/loaded_world.h"

#include "lss/index.h"

namespace foretouch::tools {

std::vector<const BodyStretches*> LoadedWorld::stretches() const {
  std::vector<const BodyStretches*> all;
  for (const LoadedBody& body : bodies) all.push_back(&body.stretches);
  return all;
}

std::string LoadedWorld::linkNameOf(BodyId body, LinkId link) const {
  const Skeleton& skeleton = bodies[slotOf(body)].shape.skeleton;
  return skeleton.numJoints() == 1 ? "" : skeleton.name(link);
}

std::string LoadedWorld::labelOf(BodyId body, LinkId link) const {
  const std::string name = linkNameOf(body, link);
  return name.empty() ? nameOf(body) : nameOf(body) + ": " + name;
}

}  // namespace foretouch::tools
