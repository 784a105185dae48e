// tests/house/documents.h: the project's Markdown, and the marks that a code formatter leaves in
// it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foretouch::house {

/// Every .md that git tracks below `root`; without git (a source package), every one outside hidden
/// folders, build/ and out/. Sorted.
[[nodiscard]] std::vector<std::filesystem::path> documentsBelow(const std::filesystem::path& root);

/// The same by walking the folders.
[[nodiscard]] std::vector<std::filesystem::path> documentsOnDisk(const std::filesystem::path& root);

/// Lines that only a formatter that mistakes text for code writes, each with its number and fault.
/// Ignores fenced code and code spans.
[[nodiscard]] std::vector<std::string> mangledLines(const std::string& markdown);

}  // namespace foretouch::house
