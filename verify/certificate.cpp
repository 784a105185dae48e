#include "verify/certificate.h"

#include "verify/text_lines.h"

namespace verify {
namespace {

/// One line below the first one; what it says goes to the last claims.
std::string readLine(const TextLines& lines, std::vector<StepClaim>& claims) {
  const auto& words = lines.words();
  const std::string_view kind = words[0];
  StepClaim* const step = claims.empty() ? nullptr : &claims.back();
  LinkClaim* const link = step == nullptr || step->links.empty() ? nullptr : &step->links.back();
  CapsuleClaim* const capsule =
      link == nullptr || link->capsules.empty() ? nullptr : &link->capsules.back();
  Span* const span =
      capsule == nullptr || capsule->spans.empty() ? nullptr : &capsule->spans.back();
  if (kind == "step" && words.size() == 2) {
    StepClaim claim;
    claim.line = lines.line();
    if (!isWhole(words[1], 0LL, 1LL << 53, claim.step)) return "expected a step's number";
    claims.push_back(std::move(claim));
  } else if (kind == "link" && words.size() == 2 && step != nullptr) {
    LinkClaim claim;
    claim.line = lines.line();
    if (!isWhole(words[1], std::size_t{0}, kMostLinks, claim.link))
      return "expected a link's number";
    step->links.push_back(std::move(claim));
  } else if (kind == "lss" && words.size() == 2 && link != nullptr) {
    CapsuleClaim claim;
    claim.line = lines.line();
    if (!isWhole(words[1], std::size_t{0}, kMostLinks, claim.capsule)) {
      return "expected the number of one of the link's LSS";
    }
    link->capsules.push_back(std::move(claim));
  } else if (kind == "span" && words.size() == 3 && capsule != nullptr) {
    Span claim;
    claim.line = lines.line();
    if (!isWhole(words[1], 0, kDeepestLevel, claim.level) ||
        !isWhole(words[2], std::int64_t{0}, (std::int64_t{1} << claim.level) - 1, claim.index)) {
      return "expected a level from 0 to 40 and an index below two to that power";
    }
    capsule->spans.push_back(std::move(claim));
  } else if (kind == "plane" && words.size() == 5 && span != nullptr) {
    std::array<double, 4> numbers{};
    if (!areNumbers(words, 1, numbers)) return "expected four numbers";
    span->planes.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  } else {
    return "expected step K, then link L, lss I, span LEVEL INDEX or plane X Y Z D below it";
  }
  return "";
}

}  // namespace

Fault readCertificate(std::string_view text, std::vector<StepClaim>& claims) {
  if (Fault fault = otherLinesIn(text); !fault.what.empty()) return fault;
  TextLines lines(text);
  const bool hasFirst = lines.next() && lines.words().size() == 2 &&
                        lines.words()[0] == "foretouch-certificate" && lines.words()[1] == "1";
  if (!hasFirst) return {lines.line(), "expected the line foretouch-certificate 1 first"};
  bool isEnded = false;
  while (lines.next()) {
    if (isEnded) return {lines.line(), "expected nothing behind the line end"};
    isEnded = lines.words().size() == 1 && lines.words()[0] == "end";
    if (isEnded) continue;
    std::string what = readLine(lines, claims);
    if (!what.empty()) return {lines.line(), std::move(what)};
  }
  if (!isEnded) return {lines.line(), "expected the line end last: the text is cut"};
  return {};
}

}  // namespace verify
