// assets/import/failure.h: how an import ends without an answer. In foretouch-import only. Not
// installed.
#pragma once

#include <string>

#include "assets/import/stream.h"

namespace foretouch::internal {

/// Ends an import with a message to the parent.
struct Failure {
  ImportFailure kind;
  std::string text;
};
[[noreturn]] inline void refuse(const std::string& text) {
  throw Failure{ImportFailure::Refused, text};
}

/// `place`: in the file, as Faults (assets/import/faults.h) names it.
[[noreturn]] inline void refuseAt(const std::string& place, const std::string& what) {
  refuse(place + ": " + what);
}

}  // namespace foretouch::internal
