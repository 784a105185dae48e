#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/marked_sax.h"
#include "assets/json_writer.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

constexpr char kPairsFormatName[] = "foretouch-pairs";
constexpr double kPairsFormatVersion = 1.0;
constexpr std::array<PairReason, 4> kLeftOutReasons{PairReason::Adjacent, PairReason::RestOverlap,
                                                    PairReason::Always, PairReason::User};

/// Objects and arrays of the format; the parser is always in exactly one.
enum class PairsPlace { Outside, File, LeftOut, Pair, Radii, Radius };

/// The value that may follow a key.
enum class PairsKind { Format, Version, LeftOut, Radii, Link, Reason, Index, Metres };

using PairsField = internal::JsonField<PairsPlace, PairsKind>;
constexpr char kLinkName[] = "the name of a link", kLssNumber[] = "the number of an LSS, from 0";
constexpr std::array<PairsField, 12> kPairsFields = {{
    {PairsPlace::File, "format", PairsKind::Format, "the text \"foretouch-pairs\""},
    {PairsPlace::File, "version", PairsKind::Version, "the number 1, the only version there is"},
    {PairsPlace::File, "left_out", PairsKind::LeftOut, "an array of pairs"},
    {PairsPlace::File, "radii", PairsKind::Radii, "an array of radii", false},
    {PairsPlace::Pair, "a", PairsKind::Link, kLinkName},
    {PairsPlace::Pair, "b", PairsKind::Link, kLinkName},
    {PairsPlace::Pair, "reason", PairsKind::Reason,
     R"("adjacent", "rest-overlap", "always" or "user")"},
    {PairsPlace::Radius, "a", PairsKind::Link, kLinkName},
    {PairsPlace::Radius, "lss_a", PairsKind::Index, kLssNumber},
    {PairsPlace::Radius, "b", PairsKind::Link, kLinkName},
    {PairsPlace::Radius, "lss_b", PairsKind::Index, kLssNumber},
    {PairsPlace::Radius, "radius", PairsKind::Metres, "a number of metres"},
}};

/// Fills the pairs from the parser's events.
class PairsSax final : public internal::TableSax<PairsPlace, PairsKind> {
 public:
  PairsSax(std::string_view text, const std::string& file, const Avatar& avatar)
      : TableSax(text, file, kPairsFields), avatar_(avatar), reasons_(avatar) {
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      byName_.emplace(avatar.skeleton().name(link), link);
    }
  }

  [[nodiscard]] Result<PairRules> build();

  bool string(string_t& text) override;
  bool start_object(std::size_t) override;
  bool start_array(std::size_t) override;

 private:
  [[nodiscard]] std::string nameOf(LinkId link) const {
    return inQuotes(avatar_.skeleton().name(link));
  }

  bool number(double value) override;
  bool takeObject() override;
  [[nodiscard]] const char* elementOf(PairsPlace place) const override;
  bool linkName(const std::string& name);
  bool reason(const std::string& word);
  bool endPair();
  bool fail(ErrorCode code, const std::string& message) override;

  const Avatar& avatar_;
  PairReasonCheck reasons_;
  std::unordered_map<std::string, LinkId> byName_;

  PairRadius at_;  // the pair or radius at hand
  PairReason reason_ = PairReason::User;

  std::vector<LeftOutPair> leftOut_;
  std::unordered_set<std::uint64_t> listed_;
  std::vector<PairRadius> radii_;
  std::vector<std::int64_t> radiusLines_;
};

bool PairsSax::fail(ErrorCode code, const std::string& message) {
  std::string where;
  if (place() == PairsPlace::Pair) where = fmt::format("left_out[{}]: ", leftOut_.size());
  if (place() == PairsPlace::Radius) where = fmt::format("radii[{}]: ", radii_.size());
  return stop(Error::inLine(file(), line(), code, where + message));
}

const char* PairsSax::elementOf(PairsPlace place) const {
  if (place == PairsPlace::LeftOut) return R"(an object with "a", "b" and "reason")";
  return place == PairsPlace::Radii ? "an object that is a radius" : "one object of pair rules";
}

bool PairsSax::number(double value) {
  if (expects(PairsKind::Metres)) {
    at_.radius = value;
  } else if (expects(PairsKind::Index)) {
    if (!(value >= 0.0 && value < static_cast<double>(kMaxLssPerLink)) ||
        value != std::floor(value)) {
      return unexpected(fmt::format("{}", value));
    }
    const auto index = static_cast<std::int32_t>(value);
    (keyAtHand() == "lss_a" ? at_.lssA : at_.lssB) = index;
  } else if (!expects(PairsKind::Version)) {
    return unexpected("a number");
  } else if (value != kPairsFormatVersion) {
    return unexpected(fmt::format("{}", value));
  }
  return valueDone();
}

bool PairsSax::string(string_t& text) {
  if (expects(PairsKind::Link)) return linkName(text);
  if (expects(PairsKind::Reason)) return reason(text);
  if (!expects(PairsKind::Format)) return unexpected("a text");
  if (text != kPairsFormatName) return unexpected(inQuotes(text));
  return valueDone();
}

bool PairsSax::linkName(const std::string& name) {
  const auto found = byName_.find(name);
  if (found == byName_.end()) {
    std::vector<std::string> names;
    for (const auto& [known, unused] : byName_) names.push_back(known);
    return fail(ErrorCode::UnknownName, "expected a link of the avatar for \"" +
                                            std::string(keyAtHand()) + "\", found " +
                                            inQuotes(name) + didYouMean(name, names));
  }
  if (avatar_.lss(found->second).empty()) {
    return fail(ErrorCode::Mismatch, "expected a link with LSS for \"" + std::string(keyAtHand()) +
                                         "\"; " + inQuotes(name) +
                                         " of this avatar has none, so no pair of it is asked");
  }
  (keyAtHand() == "a" ? at_.a : at_.b) = found->second;
  return valueDone();
}

bool PairsSax::reason(const std::string& word) {
  for (const PairReason known : kLeftOutReasons) {
    if (word != toString(known)) continue;
    reason_ = known;
    return valueDone();
  }
  std::vector<std::string> words;
  for (const PairReason known : kLeftOutReasons) words.emplace_back(toString(known));
  return unexpected(inQuotes(word) + didYouMean(word, words));
}

bool PairsSax::start_object(std::size_t) {
  at_ = {};
  if (place() == PairsPlace::Outside) return enter(PairsPlace::File);
  if (place() == PairsPlace::LeftOut) return enter(PairsPlace::Pair);
  if (place() == PairsPlace::Radii) return enter(PairsPlace::Radius);
  return unexpected("an object");
}

bool PairsSax::takeObject() {
  if (place() == PairsPlace::Pair) return endPair();
  if (place() == PairsPlace::Radius) {
    radii_.push_back(at_);
    radiusLines_.push_back(line());
  }
  return true;
}

bool PairsSax::endPair() {
  if (at_.a == at_.b) {
    return fail(ErrorCode::OutOfRange,
                "expected two different links, found " + nameOf(at_.a) + " twice");
  }
  const LeftOutPair pair{std::min(at_.a, at_.b), std::max(at_.a, at_.b), reason_};
  const std::string both = nameOf(at_.a) + " and " + nameOf(at_.b);
  if (!listed_.insert(std::uint64_t{slotOf(pair.a)} << 32 | slotOf(pair.b)).second) {
    return fail(ErrorCode::DuplicateName, "expected each pair once, found " + both + " again");
  }
  if (!reasons_.isTrue(pair)) {
    return fail(ErrorCode::Mismatch,
                std::string("found the reason \"") + toString(reason_) + "\", but " + both +
                    (reason_ == PairReason::Adjacent ? " are not adjacent in this avatar"
                                                     : " do not overlap at rest in this avatar") +
                    "; is it the avatar that the file was made for?");
  }
  leftOut_.push_back(pair);
  return true;
}

bool PairsSax::start_array(std::size_t) {
  if (expects(PairsKind::LeftOut)) return enter(PairsPlace::LeftOut);
  if (expects(PairsKind::Radii)) return enter(PairsPlace::Radii);
  return unexpected("an array");
}

Result<PairRules> PairsSax::build() {
  auto rules = PairRules::leavingOut(avatar_, std::move(leftOut_), std::move(radii_));
  if (rules.ok()) return rules;
  Error error = rules.error();
  if (error.file == "radii" && error.index >= 0) {
    error.line = radiusLines_[slotOf(error.index)];
    error.message = fmt::format("radii[{}]: {}", error.index, error.message);
  }
  error.index = -1;
  error.file = file();
  return error;
}

}  // namespace

Result<PairRules> parsePairs(std::string_view json, const std::string& name, const Avatar& avatar) {
  if (json.size() > kMaxPairsFileBytes) {
    return Error::in(name, ErrorCode::LimitExceeded,
                     fmt::format("expected at most {} bytes", kMaxPairsFileBytes));
  }
  try {
    PairsSax sax(json, name, avatar);
    if (!sax.parse()) return sax.error();
    return sax.build();
  } catch (const std::bad_alloc&) {
    return Error::in(name, ErrorCode::LimitExceeded, "does not fit into memory");
  }
}

Result<PairRules> readPairsFile(const std::string& path, const Avatar& avatar) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxPairsFileBytes));
  return parsePairs(text, path, avatar);
}

std::string formatPairs(const PairRules& rules, const Avatar& avatar) {
  FORETOUCH_ASSERT(rules.avatarIdentity() == avatar.identity());
  const auto name = [&](LinkId link) { return jsonString(avatar.skeleton().name(link)); };
  std::string pairs;
  for (const LeftOutPair& pair : rules.leftOut()) {
    if (avatar.lss(pair.a).empty() || avatar.lss(pair.b).empty()) continue;
    pairs +=
        fmt::format("{}\n  {{\"a\": {}, \"b\": {}, \"reason\": \"{}\"}}", pairs.empty() ? "" : ",",
                    name(pair.a), name(pair.b), toString(pair.reason));
  }
  std::string radii;
  for (const PairRadius& own : rules.radii()) {
    radii += fmt::format(
        "{}\n  {{\"a\": {}, \"lss_a\": {}, \"b\": {}, \"lss_b\": {}, \"radius\": {}}}",
        radii.empty() ? "" : ",", name(own.a), own.lssA, name(own.b), own.lssB, own.radius);
  }
  std::string text = "{\"format\": \"foretouch-pairs\", \"version\": 1,\n \"left_out\": [" + pairs +
                     (pairs.empty() ? "]" : "\n ]");
  if (!radii.empty()) text += ",\n \"radii\": [" + radii + "\n ]";
  return text + "}\n";
}

Result<Done> writePairsFile(const PairRules& rules, const Avatar& avatar, const std::string& path) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(formatPairs(rules, avatar));
  return file.commit();
}

}  // namespace foretouch
