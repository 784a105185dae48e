// middleware/query/query_scratch.h: memory that queries keep from one to the next.
#pragma once

#include <memory>

namespace foretouch {

namespace internal {
struct ScratchParts;
}

/// Scratch memory that queries reuse; one per thread.
class QueryScratch {
 public:
  QueryScratch();
  ~QueryScratch();
  QueryScratch(QueryScratch&&) noexcept;
  QueryScratch& operator=(QueryScratch&&) noexcept;

  /// For the query's own sources.
  [[nodiscard]] internal::ScratchParts& parts() { return *parts_; }

 private:
  std::unique_ptr<internal::ScratchParts> parts_;
};

}  // namespace foretouch
