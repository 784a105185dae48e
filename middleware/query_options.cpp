#include "middleware/query_options.h"

namespace foretouch {

const char* toString(Scope scope) {
  switch (scope) {
    case Scope::EveryLink: return "links";
    case Scope::FirstOfAvatar: return "avatar";
    case Scope::EveryObject: return "objects";
  }
  return "links";
}

}  // namespace foretouch
