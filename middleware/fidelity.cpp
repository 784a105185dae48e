#include "middleware/fidelity.h"

namespace foretouch {

const char* toString(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Link: return "link";
    case Fidelity::Exact: return "exact";
    case Fidelity::Skinned: return "skinned";
    case Fidelity::Limb: return "limb";
    case Fidelity::Avatar: return "avatar";
    case Fidelity::Ellipsoid: return "ellipsoid";
  }
  return "link";
}

}  // namespace foretouch
