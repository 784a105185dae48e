#include "verify/certificate.h"

#include <algorithm>

#include "verify/text_lines.h"

namespace verify {
namespace {

/// Why nothing is claimed of an edge.
bool isVerdict(std::string_view word) {
  constexpr std::array<std::string_view, 4> kKnown{"contact", "starts_in_contact", "undecided",
                                                   "unproven"};
  return std::find(kKnown.begin(), kKnown.end(), word) != kKnown.end();
}

/// The lines below the first one; what they say goes to the last claims.
class ClaimReader {
 public:
  ClaimReader(int version, std::vector<StepClaim>& claims)
      : isOfEdges_(version == kOfEdges), claims_(claims) {}

  /// Empty, or what is wrong with it.
  std::string read(const TextLines& lines) {
    words_ = lines.words();
    const std::string_view kind = words_[0];
    const std::size_t count = words_.size();
    if (isOfEdges_ && kind == "edge" && (count == 2 || count == 3)) return readStep(lines.line());
    if (!isOfEdges_ && kind == "step" && count == 2) return readStep(lines.line());
    if (kind == "link" && count == 2 && hasClaims()) return readLink(lines.line());
    if (isOfEdges_ && kind == "pair" && count == 3 && hasClaims()) return readPair(lines.line());
    if (kind == "lss" && count == 2 && link_ != nullptr) return readCapsule(lines.line());
    if (kind == "span" && count == 3 && spans_ != nullptr) return readSpan(lines.line());
    if (kind == "plane" && count == 5 && spans_ != nullptr && !spans_->empty()) return readPlane();
    return isOfEdges_ ? "expected edge K or edge K VERDICT, then link L, lss I, pair A B, span "
                        "LEVEL INDEX or plane X Y Z D below it"
                      : "expected step K, then link L, lss I, span LEVEL INDEX or plane X Y Z D "
                        "below it";
  }

 private:
  [[nodiscard]] bool hasClaims() const {
    return !claims_.empty() && claims_.back().verdict.empty();
  }
  [[nodiscard]] bool isCount(std::size_t word, std::size_t& number) const {
    return isWhole(words_[word], std::size_t{0}, kMostLinks, number);
  }

  std::string readStep(long long line) {
    link_ = nullptr;
    spans_ = nullptr;
    StepClaim claim;
    claim.line = line;
    if (!isWhole(words_[1], 0LL, 1LL << 53, claim.step)) {
      return isOfEdges_ ? "expected an edge's number" : "expected a step's number";
    }
    if (words_.size() == 3) {
      if (!isVerdict(words_[2]))
        return "expected contact, starts_in_contact, undecided or unproven";
      claim.verdict = words_[2];
    }
    claims_.push_back(std::move(claim));
    return "";
  }

  std::string readLink(long long line) {
    LinkClaim claim;
    claim.line = line;
    if (!isCount(1, claim.link)) return "expected a link's number";
    claims_.back().links.push_back(std::move(claim));
    link_ = &claims_.back().links.back();
    spans_ = nullptr;
    return "";
  }

  std::string readPair(long long line) {
    PairClaim claim;
    claim.line = line;
    if (!isCount(1, claim.a) || !isCount(2, claim.b)) return "expected the numbers of two links";
    claims_.back().pairs.push_back(std::move(claim));
    link_ = nullptr;
    spans_ = &claims_.back().pairs.back().spans;
    return "";
  }

  std::string readCapsule(long long line) {
    CapsuleClaim claim;
    claim.line = line;
    if (!isCount(1, claim.capsule)) return "expected the number of one of the link's LSS";
    link_->capsules.push_back(std::move(claim));
    spans_ = &link_->capsules.back().spans;
    return "";
  }

  std::string readSpan(long long line) {
    Span claim;
    claim.line = line;
    if (!isWhole(words_[1], 0, kDeepestLevel, claim.level) ||
        !isWhole(words_[2], std::int64_t{0}, (std::int64_t{1} << claim.level) - 1, claim.index)) {
      return "expected a level from 0 to 40 and an index below two to that power";
    }
    spans_->push_back(std::move(claim));
    return "";
  }

  std::string readPlane() {
    std::array<double, 4> numbers{};
    if (!areNumbers(words_, 1, numbers)) return "expected four numbers";
    spans_->back().planes.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
    return "";
  }

  bool isOfEdges_;
  std::vector<StepClaim>& claims_;
  std::vector<std::string_view> words_;
  LinkClaim* link_ = nullptr;           // the last one, if it is open
  std::vector<Span>* spans_ = nullptr;  // those of the last LSS or pair, if it is open
};

}  // namespace

Fault readCertificate(std::string_view text, std::vector<StepClaim>& claims, int version) {
  if (Fault fault = otherLinesIn(text); !fault.what.empty()) return fault;
  TextLines lines(text);
  const std::string first = std::to_string(version);
  const bool hasFirst = lines.next() && lines.words().size() == 2 &&
                        lines.words()[0] == "foretouch-certificate" && lines.words()[1] == first;
  if (!hasFirst) {
    return {lines.line(), "expected the line foretouch-certificate " + first + " first" +
                              (version == kOfEdges ? ", as of edges" : "")};
  }
  ClaimReader reader(version, claims);
  bool isEnded = false;
  while (lines.next()) {
    if (isEnded) return {lines.line(), "expected nothing behind the line end"};
    isEnded = lines.words().size() == 1 && lines.words()[0] == "end";
    if (isEnded) continue;
    std::string what = reader.read(lines);
    if (!what.empty()) return {lines.line(), std::move(what)};
  }
  if (!isEnded) return {lines.line(), "expected the line end last: the text is cut"};
  return {};
}

}  // namespace verify
