#include "tools/arguments.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

Error refusal(const std::string& option, const std::string& expected, const std::string& found) {
  return {ErrorCode::OutOfRange, option, -1, -1,
          "expected " + expected + ", found " + inQuotes(found)};
}

/// True if `text` as a whole is a number that fits and is finite.
template <typename Number>
bool readAll(const std::string& text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end && std::isfinite(static_cast<double>(number));
}

}  // namespace

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

Result<double> parseNumber(const std::string& option, const std::string& text) {
  double number = 0.0;
  if (readAll(text, number)) return number;
  return refusal(option, "a finite number", text);
}

Result<double> parsePositive(const std::string& option, const std::string& text) {
  double number = 0.0;
  if (readAll(text, number) && number > 0.0) return number;
  return refusal(option, "a finite number greater than 0", text);
}

Result<double> parseTolerance(const std::string& option, const std::string& text) {
  double number = 0.0;
  if (readAll(text, number) && number >= kMinTolerance && number <= kMaxTolerance) return number;
  return refusal(option, "1e-9 to 1e7 metres", text);
}

Result<int> parseCount(const std::string& option, const std::string& text, int most) {
  int number = 0;
  if (readAll(text, number) && number >= 1 && number <= most) return number;
  return refusal(option, "a whole number from 1 to " + std::to_string(most), text);
}

Result<int> parseThreads(const std::string& option, const std::string& text) {
  return parseCount(option, text, kMaxThreads);
}

Result<std::size_t> parseReportTriangles(const std::string& option, const std::string& text) {
  FORETOUCH_TRY(const auto count, parseCount(option, text, kMostReportTriangles));
  return countOf(count);
}

Result<Placement> parsePlacement(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = splitAtCommas(text);
  double numbers[4] = {0.0, 0.0, 0.0, 0.0};
  bool good = parts.size() == 3 || parts.size() == 4;
  for (std::size_t i = 0; good && i < parts.size(); ++i) good = readAll(parts[i], numbers[i]);
  Placement placement;
  placement.origin = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  placement.yawDeg = numbers[3];
  if (good && placement.origin.cwiseAbs().maxCoeff() <= kMaxCoordinate) return placement;
  return refusal(option, "x,y,z or x,y,z,yaw: finite metres within 1e7, and degrees", text);
}

Result<UpAxis> parseUpAxis(const std::string& option, const std::string& text) {
  if (text == "y") return UpAxis::Y;
  if (text == "z") return UpAxis::Z;
  return refusal(option, "y or z", text);
}

Result<Scope> parseScope(const std::string& option, const std::string& text) {
  if (text == "links") return Scope::EveryLink;
  if (text == "avatar") return Scope::FirstOfAvatar;
  return refusal(option, "links or avatar", text);
}

Result<Fidelity> parseFidelity(const std::string& option, const std::string& text) {
  for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    if (text == toString(fidelity)) return fidelity;
  }
  return refusal(option, "link, exact or skinned", text);
}

Result<Done> checkIsNoInput(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code missing;
    if (!input.empty() && std::filesystem::equivalent(output, input, missing)) {
      return Error::in(output, ErrorCode::FileUnwritable,
                       "is an input as well; expected another file to write");
    }
  }
  return Done{};
}

}  // namespace foretouch::tools
