// assets/near_names.h: existing names near to a misspelt one. Not installed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foretouch {

/// "; did you mean 'LeftHand', 'LeftFoot'?", with at most three names, nearest first, within an
/// edit distance of one and a quarter of the word's length, ignoring case; empty if none is that
/// near. Skips names longer than 64 bytes, so a hostile list costs little.
[[nodiscard]] std::string didYouMean(std::string_view word, const std::vector<std::string>& names);

}  // namespace foretouch
