// tools/arguments.h: option values as typed in, checked. Errors name the option, what was expected
// and what was found.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/scene_import.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

/// Most scene triangles that a user may request in a report.
inline constexpr int kMostReportTriangles = 10'000'000;

/// Most threads: a larger number is a typing error.
inline constexpr int kMaxThreads = 256;

/// "a,,b" has three parts, the second of them empty.
[[nodiscard]] std::vector<std::string> splitAtCommas(const std::string& text);

/// A finite decimal number and nothing else: no "nan", "inf", hexadecimal, unit or space.
[[nodiscard]] Result<double> parseNumber(const std::string& option, const std::string& text);
/// The same, greater than zero.
[[nodiscard]] Result<double> parsePositive(const std::string& option, const std::string& text);
/// Metres, kMinTolerance to kMaxTolerance.
[[nodiscard]] Result<double> parseTolerance(const std::string& option, const std::string& text);
/// A whole number from 1 to `most`.
[[nodiscard]] Result<int> parseCount(const std::string& option, const std::string& text, int most);
/// The same, to kMaxThreads.
[[nodiscard]] Result<int> parseThreads(const std::string& option, const std::string& text);
/// Scene triangles in a report: a whole number from 1 to 10,000,000.
[[nodiscard]] Result<std::size_t> parseReportTriangles(const std::string& option,
                                                       const std::string& text);
/// "x,y,z" or "x,y,z,yaw": metres within kMaxCoordinate, and degrees.
[[nodiscard]] Result<Placement> parsePlacement(const std::string& option, const std::string& text);
/// "y" or "z".
[[nodiscard]] Result<UpAxis> parseUpAxis(const std::string& option, const std::string& text);
[[nodiscard]] Result<Scope> parseScope(const std::string& option, const std::string& text);
[[nodiscard]] Result<Fidelity> parseFidelity(const std::string& option, const std::string& text);

/// Refuses an output file that is one of the inputs. Skips empty paths.
[[nodiscard]] Result<Done> checkIsNoInput(const std::string& output,
                                          const std::vector<std::string>& inputs);

}  // namespace foretouch::tools
