// tests/support/environment.h: variables of the environment.
#pragma once

#include <stdlib.h>
#include <string>

namespace foretouch::test {

inline void setVariable(const char* name, const std::string& value) {
#ifdef _WIN32
  ::_putenv_s(name, value.c_str());
#else
  ::setenv(name, value.c_str(), 1);
#endif
}

inline void unsetVariable(const char* name) {
#ifdef _WIN32
  ::_putenv_s(name, "");
#else
  ::unsetenv(name);
#endif
}

}  // namespace foretouch::test
