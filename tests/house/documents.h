// tests/house/documents.h: the Markdown of the house, and what a formatter of code does to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foretouch::house {

/// Every .md that git tracks below `root`; where there is no git (a source package), every one that
/// lies outside of hidden folders, build/ and out/. Sorted.
[[nodiscard]] std::vector<std::filesystem::path> documentsBelow(const std::filesystem::path& root);

/// The same by looking into the folders.
[[nodiscard]] std::vector<std::filesystem::path> documentsOnDisk(const std::filesystem::path& root);

/// Lines that no one writes but a formatter that takes text for code, each with its number and what
/// is wrong with it. Fenced code is left alone, and so is what stands in code spans.
[[nodiscard]] std::vector<std::string> mangledLines(const std::string& markdown);

}  // namespace foretouch::house
