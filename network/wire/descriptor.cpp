#include "network/wire/descriptor.h"

#include <unistd.h>

namespace foretouch {

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

}  // namespace foretouch
