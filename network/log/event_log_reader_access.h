// network/log/event_log_reader_access.h: a reader of bytes in memory, for tests and fuzzing.
#pragma once

#include <memory>
#include <string>

#include "network/log/event_log_window.h"

namespace foretouch {

struct EventLogReaderAccess {
  /// Errors name `name` as the path.
  static Result<EventLogReader> open(std::unique_ptr<LogBytes> bytes, const std::string& name,
                                     const LogReadOptions& options = {});
};

}  // namespace foretouch
