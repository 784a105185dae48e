// tools/settling.h: option values settled one after another, the first error kept.
#pragma once

#include <optional>

#include "articulated/result.h"

namespace foretouch::tools {

/// Takes parsed values apart from errors, keeping the first error.
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
