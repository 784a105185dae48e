#include "middleware/query/query_scratch.h"

#include "middleware/query/scratch_parts.h"

namespace foretouch {

QueryScratch::QueryScratch() : parts_(std::make_unique<internal::ScratchParts>()) {}
QueryScratch::~QueryScratch() = default;
QueryScratch::QueryScratch(QueryScratch&&) noexcept = default;
QueryScratch& QueryScratch::operator=(QueryScratch&&) noexcept = default;

}  // namespace foretouch
