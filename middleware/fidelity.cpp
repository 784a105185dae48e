#include "middleware/query_options.h"

namespace foretouch {

const char* toString(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Link: return "link";
    case Fidelity::Exact: return "exact";
    case Fidelity::Skinned: return "skinned";
  }
  return "link";
}

std::string whyFidelityIsGone(const std::string& name) {
  if (name != "limb" && name != "avatar" && name != "ellipsoid") return "";
  return name +
         " is gone: a volume around several links was slower and coarser than the links' own in "
         "every row measured (docs/trade.md); use link";
}

}  // namespace foretouch
