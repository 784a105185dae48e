#include "middleware/query_options.h"

namespace foretouch {

const char* toString(LeafMethod method) {
  switch (method) {
    case LeafMethod::Advancement: return "advancement";
    case LeafMethod::Cubics: return "cubics";
  }
  return "advancement";
}

const char* toString(Backtracking backtracking) {
  switch (backtracking) {
    case Backtracking::Lanes: return "lanes";
    case Backtracking::Scalar: return "scalar";
  }
  return "lanes";
}

const char* toString(Scope scope) {
  switch (scope) {
    case Scope::EveryLink: return "links";
    case Scope::FirstOfAvatar: return "avatar";
  }
  return "links";
}

const char* toString(Descent descent) {
  switch (descent) {
    case Descent::Straight: return "straight";
    case Descent::ByNeed: return "by-need";
  }
  return "straight";
}

}  // namespace foretouch
