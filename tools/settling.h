// tools/settling.h: stores parsed option values one by one and keeps the first error.
#pragma once

#include <optional>

#include "articulated/result.h"

namespace foretouch::tools {

/// Separates parsed values from errors; keeps the first error.
class Settling {
 public:
  template <typename T>
  void into(T& place, const Result<T>& parsed) {
    if (parsed.ok()) place = parsed.value();
    require(parsed);
  }
  template <typename T>
  void require(const Result<T>& parsed) {
    if (!parsed.ok() && !error_) error_ = parsed.error();
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace foretouch::tools
