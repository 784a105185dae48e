// network/log/event_log_reader_access.h: a reader of bytes that are no file, for tests and fuzzing.
#pragma once

#include <memory>
#include <string>

#include "network/log/event_log_window.h"

namespace foretouch {

struct EventLogReaderAccess {
  /// `name` stands for the path in errors.
  static Result<EventLogReader> open(std::unique_ptr<LogBytes> bytes, const std::string& name,
                                     const LogReadOptions& options = {});
};

}  // namespace foretouch
