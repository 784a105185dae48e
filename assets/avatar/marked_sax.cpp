#include "assets/avatar/marked_sax.h"

#include <algorithm>
#include <utility>

#include "articulated/quoted.h"

namespace foretouch::internal {

using nlohmann::json;

bool MarkedSax::parse() {
  const MarkingIterator begin{text_.data(), &mark_}, end{text_.data() + text_.size(), &mark_};
  return json::sax_parse(begin, end, this);
}

// A number ends with the byte after it, which the parser has then already taken; every other token
// ends with a byte that is not a line break. So the last byte taken never counts.
std::int64_t MarkedSax::line() const {
  const char* last = mark_ == text_.data() ? mark_ : mark_ - 1;
  return 1 + std::count(text_.data(), last, '\n');
}

bool MarkedSax::stop(Error error) {
  error_ = std::move(error);
  return false;
}

bool MarkedSax::parse_error(std::size_t, const std::string& token, const json::exception& e) {
  constexpr int kNumberOverflow = 406;
  constexpr std::size_t kShown = 32;
  const std::string_view tail =
      std::string_view(token).substr(token.size() - std::min(token.size(), kShown));
  if (e.id == kNumberOverflow) {
    return fail(ErrorCode::NonFinite,
                "the number " + inQuotes(tail) + " is too large for a double");
  }
  // Only the end of the library's text is useful here, and free of the file's content.
  const std::string_view what = e.what();
  const std::size_t expected = what.rfind("; expected ");
  return fail(ErrorCode::Syntax,
              "broken JSON at " + inQuotes(tail) +
                  (expected == what.npos ? std::string() : std::string(what.substr(expected))));
}

}  // namespace foretouch::internal
