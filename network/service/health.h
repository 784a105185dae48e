// network/service/health.h: how a service is, for what watches over it. Not installed.
#pragma once

#include <string>

namespace foretouch {

struct ServiceHealth {
  bool isWell = true;   ///< It can answer, and what comes is accepted.
  std::string text;     ///< "ok" and the time of the last pose, or what is wrong; lines. Those that
                        ///< begin "degraded:" report a log that misses events, "refused:" bodies
                        ///< of which no pose is accepted; they harm no other answer.
  bool isAlive = true;  ///< It can answer: what a watchdog asks. No sender can make this false.
};

}  // namespace foretouch
