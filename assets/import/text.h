// assets/import/text.h: makes text from model files and from the importer safe to show. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foretouch::internal {

/// Well-formed UTF-8 of at most `limitBytes`, cut between characters. Control characters (C0, DEL,
/// C1) become spaces, so that no text of a file can control a terminal; invalid UTF-8 becomes
/// U+FFFD; drops spaces at both ends.
[[nodiscard]] std::string readableText(std::string_view text, std::size_t limitBytes);

/// A name of the file for a message: readable, at most 120 bytes of it, in single quotes.
[[nodiscard]] std::string quotedName(std::string_view name);

/// What a file's report says of points and lines, and of faces with vertex indices out of range,
/// where there are any.
[[nodiscard]] std::vector<std::string> skippedNotes(std::uint64_t primitives, std::uint64_t faces);

/// ".glb" of "a/B.GLB".
[[nodiscard]] std::string lowerExtensionOf(const std::string& path);

}  // namespace foretouch::internal
