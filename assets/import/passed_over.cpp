#include "assets/import/passed_over.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "assets/import/text.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

/// More than any reader here could take for its memory.
constexpr std::size_t kMostBytes = std::size_t{4} << 30;

struct Word {
  std::string_view word, note;
};

std::string_view firstWordOf(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  return line.substr(begin, std::min(line.find_first_of(" \t\r", begin), line.size()) - begin);
}

/// Calls take(line) for each.
template <typename Take>
void forEachLine(std::string_view text, const Take& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!take(text.substr(0, end))) return;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string counted(std::size_t count, std::string_view word, std::string_view note) {
  return std::to_string(count) + " times " + inQuotes(word) + ": " + std::string(note);
}

// The statements of "Object Files (.obj)", Wavefront, appendix B1, that make or cut surfaces and
// curves, or read other files. Those that colour, name or smooth are left out on purpose.
constexpr char kFreeForm[] = "free-form curves and surfaces are left out";
constexpr char kOldForm[] = "patches of the format's old versions are left out";
constexpr char kOtherFile[] = "other files are not read";
constexpr std::array<Word, 10> kOfObj{{{"curv", kFreeForm},
                                       {"curv2", kFreeForm},
                                       {"surf", kFreeForm},
                                       {"bsp", kOldForm},
                                       {"bzp", kOldForm},
                                       {"cdc", kOldForm},
                                       {"cdp", kOldForm},
                                       {"res", kOldForm},
                                       {"call", kOtherFile},
                                       {"csh", kOtherFile}}};

/// assimp reads a statement where a line begins, drops a vertex of which a number begins with its
/// point, and takes 0x1 for 0: each moves or loses surfaces without a word.
void refuseLostGeometry(std::string_view line, std::string_view word, std::size_t number) {
  const auto refused = [&](const std::string& expected) {
    refuseAt("line " + std::to_string(number), expected);
  };
  if (word.data() != line.data()) {
    refused("expected " + inQuotes(word) + " where the line begins: behind blanks it is lost");
  }
  if (word != "v") return;
  const std::string_view numbers = line.substr(0, line.find('#'));
  for (std::size_t i = word.size(); i < numbers.size(); ++i) {
    const bool isFirst = numbers[i - 1] == ' ' || numbers[i - 1] == '\t';
    if (numbers[i] == '.' && isFirst) refused("expected a digit in front of the point of a number");
    if (numbers[i] == 'x' || numbers[i] == 'X') refused("expected decimal numbers");
  }
}

std::vector<std::string> passedOverInObj(std::string_view text) {
  std::array<std::size_t, kOfObj.size()> counts{};
  std::size_t number = 0;
  if (constexpr std::string_view kMark = "\xEF\xBB\xBF"; text.substr(0, kMark.size()) == kMark) {
    refuseAt("line 1", "expected no byte order mark: the line behind it is lost");
  }
  forEachLine(text, [&](std::string_view line) {
    const std::string_view word = firstWordOf(line);
    ++number;
    if (word == "v" || word == "f") refuseLostGeometry(line, word, number);
    if (word.empty() || word == "v" || word == "f") return true;  // nearly all of them
    for (std::size_t i = 0; i < kOfObj.size(); ++i) counts[i] += word == kOfObj[i].word;
    return true;
  });
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < kOfObj.size(); ++i) {
    if (counts[i] > 0) notes.push_back(counted(counts[i], kOfObj[i].word, kOfObj[i].note));
  }
  return notes;
}

/// A header names its elements: "element vertex 8". assimp takes rows of others for vertices and
/// faces unless they come behind both.
std::vector<std::string> passedOverInPly(std::string_view text) {
  std::vector<std::string> notes;
  std::size_t line = 0;
  bool hasFaces = false;
  forEachLine(text, [&](std::string_view header) {
    ++line;
    const std::string_view word = firstWordOf(header);
    if (word == "end_header") return false;
    if (word != "element") return true;
    header.remove_prefix(static_cast<std::size_t>(word.data() - header.data()) + word.size());
    const std::string_view name = firstWordOf(header);
    if (name == "tristrips") {
      refuseAt("line " + std::to_string(line),
               "expected faces one by one (element face), found strips of triangles, of which the "
               "reader would lose some");
    }
    hasFaces = hasFaces || name == "face";
    if (name != "vertex" && name != "face" && !hasFaces) {
      refuseAt("line " + std::to_string(line),
               "expected the elements vertex and face first, found " + inQuotes(name) +
                   ", whose rows the reader would take for theirs");
    }
    if (name != "vertex" && name != "face" && name != "material") {
      notes.push_back("elements " + inQuotes(name) + " are left out");
    }
    return true;
  });
  return notes;
}

/// For every word, the number of times that the text has it.
template <std::size_t N>
std::vector<std::string> wordsIn(std::string_view text, const std::array<Word, N>& words) {
  std::vector<std::string> notes;
  for (const auto& [word, note] : words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string_view::npos;
         at = text.find(word, at + word.size())) {
      ++count;
    }
    if (count > 0) notes.push_back(counted(count, word, note));
  }
  return notes;
}

// "COLLADA - Digital Asset Schema Release 1.5.0": geometry that is not a mesh, and interpolations
// that are not straight lines.
constexpr char kNoMesh[] = "geometry that is no mesh is left out";
constexpr char kStraight[] = "keys of curves are joined by straight lines";
constexpr std::array<Word, 5> kOfCollada{{{"<spline", kNoMesh},
                                          {"<convex_mesh", kNoMesh},
                                          {"<brep", kNoMesh},
                                          {"<nurbs", kNoMesh},
                                          {"<morph", "morph targets are not applied"}}};
constexpr std::array<Word, 4> kOfColladaAnimations{{{"BEZIER", kStraight},
                                                    {"HERMITE", kStraight},
                                                    {"BSPLINE", kStraight},
                                                    {"CARDINAL", kStraight}}};

// Types of FBX geometry other than "Mesh" and "Shape", as files in text and in binary have them.
constexpr std::array<Word, 3> kOfFbx{
    {{"NurbsSurface", kNoMesh}, {"NurbsCurve", kNoMesh}, {"PatchDimensions", kNoMesh}}};

/// A little-endian number of an array in a binary file.
std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i > 0 && at + i <= bytes.size(); --i) {
    word = word << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return word;
}

/// The flags of a curve's first keys, behind the name of that property. Text: ": *1 { a: 264 }".
/// Binary: the letter i, a count, an encoding (0: plain), a size, the numbers. 0: none to be seen.
std::uint32_t curveFlags(std::string_view behind) {
  if (!behind.empty() && behind.front() == 'i') {
    constexpr std::size_t kEncoding = 5, kNumbers = 13;
    return wordAt(behind, kEncoding) == 0 ? wordAt(behind, kNumbers) : 0;
  }
  std::uint32_t flags = 0;
  const std::size_t list = std::min(behind.substr(0, 64).find("a:"), behind.size());
  const std::size_t digit = std::min(behind.find_first_of("0123456789", list), behind.size());
  std::from_chars(behind.data() + digit, behind.data() + behind.size(), flags);
  return flags;
}

std::size_t cubicCurvesOfFbx(std::string_view text) {
  constexpr std::string_view kFlags = "KeyAttrFlags";
  constexpr std::uint32_t kCubic = 8;
  std::size_t count = 0;
  for (std::size_t at = text.find(kFlags); at != std::string_view::npos;
       at = text.find(kFlags, at + kFlags.size())) {
    count += (curveFlags(text.substr(at + kFlags.size())) & kCubic) != 0;
  }
  return count;
}

std::vector<std::string> passedOverInFbx(std::string_view text, bool readsAnimations) {
  std::vector<std::string> notes = wordsIn(text, kOfFbx);
  const std::size_t cubic = readsAnimations ? cubicCurvesOfFbx(text) : 0;
  if (cubic > 0) {
    notes.push_back("the cubic keys of " + std::to_string(cubic) +
                    " animation curves are joined by straight lines: bake them where keys are far "
                    "apart");
  }
  return notes;
}

}  // namespace

std::vector<std::string> passedOver(const std::string& path, bool readsAnimations) {
  const std::string extension = lowerExtensionOf(path);
  const bool isObj = extension == ".obj", isPly = extension == ".ply";
  const bool isCollada = extension == ".dae", isFbx = extension == ".fbx";
  if (!isObj && !isPly && !isCollada && !isFbx) return {};
  const auto text = readWholeFile(path, kMostBytes);
  if (!text.ok()) return {};
  if (isObj) return passedOverInObj(text.value());
  if (isPly) return passedOverInPly(text.value());
  if (isFbx) return passedOverInFbx(text.value(), readsAnimations);
  std::vector<std::string> notes = wordsIn(text.value(), kOfCollada);
  if (!readsAnimations) return notes;
  for (std::string& note : wordsIn(text.value(), kOfColladaAnimations)) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace foretouch::internal
