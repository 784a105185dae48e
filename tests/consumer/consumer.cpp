#include <cstdio>
#include <foretouch/middleware/query/query.h>

// In the sources headers are "lss/...": a name for one folder of one project, not for an include
// path.
#if __has_include("lss/lss.h") || __has_include("middleware/query/query.h")
#error "expected only foretouch/ in the include path"
#endif

using namespace foretouch;

int main() {
  // A forearm of 30 cm swings a quarter turn about the elbow, towards a pole's edge.
  RawSkeleton bones;
  bones.joints.push_back({"forearm", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const Lss forearm{{0, 0, 0}, {0.3, 0, 0}, 0.04};  // metres, in the link's frame
  const Avatar avatar = Avatar::build(Skeleton::build(bones).value(), {{forearm}}).value();
  const Scene scene =
      Scene::build({{{{{{0.2, 0, -0.2}, {0.2, 2, -0.2}, {0.4, 1, -0.4}}}}}, {0}, {"pole"}}).value();
  const Pose from = restPose(avatar.skeleton());
  Pose to = from;
  to.rotations[0] = Eigen::AngleAxisd(1.5708, Eigen::Vector3d::UnitY());

  const ChainMotion motion(avatar.skeleton(), from, to);
  const LinkContact contact = firstContacts(avatar, motion, scene).value().links[0];
  std::printf("%s at t = %.4f, %.2f mm from %s\n", toString(contact.verdict), contact.toi,
              1000 * contact.separation,
              scene.objectNames()[scene.object(contact.triangle)].c_str());
  return contact.verdict == Verdict::Contact && contact.toi > 0.3 && contact.toi < 0.5 ? 0 : 1;
}
