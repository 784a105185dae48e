#include "assets/import/assimp.h"
#include "assets/import/model.h"

namespace foretouch::internal {

Model readMjcf(const ModelQuestion& /*question*/) {
  throw Failure{ImportFailure::Refused,
                "it is a MuJoCo model (MJCF), and this foretouch-import is built without libmujoco "
                "(FORETOUCH_MUJOCO)"};
}

}  // namespace foretouch::internal
