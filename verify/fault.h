// verify/fault.h: what is wrong with a text.
#pragma once

#include <string>

namespace verify {

/// `what` is empty where nothing is.
struct Fault {
  long long line = 0;
  std::string what;
};

}  // namespace verify
