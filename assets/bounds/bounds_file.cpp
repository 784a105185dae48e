#include "assets/bounds/bounds_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_roles.h"
#include "assets/json_writer.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using nlohmann::json;

constexpr char kBoundsFormatName[] = "foretouch-bounds";
constexpr std::array<const char*, 7> kBoundParts = {"head", "trunk", "arm", "hand",
                                                    "leg",  "foot",  "all"};
constexpr std::array<MotionModel, 3> kMotionModels = {MotionModel::ConstantRate, MotionModel::Cubic,
                                                      MotionModel::CubicLate};
/// A rate is another one beyond this share.
constexpr double kSameRate = 0.1;

/// No person is so far (m) from where a tracker or a model has them, so fast (m/s), or quickened so
/// much (m/s^2): such a bound was meant in another unit.
constexpr double kAbsurdM = 10.0, kAbsurdSpeed = 1e3, kAbsurdAcceleration = 1e6;

/// The numbers of a bound, as files name them, and the most that they may be.
struct BoundField {
  const char* key;
  double LinkBound::*place;
  double most;
};
constexpr std::array<BoundField, 7> kBoundFields = {{
    {"error_m", &LinkBound::error, kAbsurdM},
    {"acceleration_m_s2", &LinkBound::acceleration, kAbsurdAcceleration},
    {"follow_floor_m", &LinkBound::followFloor, kAbsurdM},
    {"follow_share", &LinkBound::followShare, 1e9},
    {"gap_speed_m_s", &LinkBound::speed, kAbsurdSpeed},
    {"ahead_speed_m_s", &LinkBound::aheadSpeed, kAbsurdSpeed},
    {"ahead_acceleration_m_s2", &LinkBound::aheadAcceleration, kAbsurdAcceleration},
}};

const char* partOf(internal::BodyRole role) {
  using internal::BodyRole;
  switch (role) {
    case BodyRole::Head: return "head";
    case BodyRole::Root:
    case BodyRole::Pelvis:
    case BodyRole::Torso:
    case BodyRole::Neck: return "trunk";
    case BodyRole::Clavicle:
    case BodyRole::UpperArm:
    case BodyRole::Forearm: return "arm";
    case BodyRole::Hand:
    case BodyRole::Finger: return "hand";
    case BodyRole::Thigh:
    case BodyRole::Shin: return "leg";
    case BodyRole::Foot:
    case BodyRole::Toe: return "foot";
    case BodyRole::Unknown: break;
  }
  return "";
}

/// Refuses repeated keys, of which nlohmann keeps the last, and nesting, of which the format has
/// three levels.
class KeyCheck {
 public:
  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys_.emplace_back();
    if (event == json::parse_event_t::object_end && !keys_.empty()) keys_.pop_back();
    if (depth > 3) problem = "expected at most three levels of brackets";
    if (event == json::parse_event_t::key && !keys_.empty() &&
        !keys_.back().insert(parsed.get<std::string>()).second) {
      problem = "the key " + inQuotes(parsed.get<std::string>()) + " appears twice";
    }
    return true;
  }
  std::string problem;

 private:
  std::vector<std::set<std::string>> keys_;
};

class BoundsReader {
 public:
  explicit BoundsReader(const std::string& file) : file_(file) {}

  Result<BoundsFile> read(std::string_view text) {
    KeyCheck check;
    json parsed;
    try {
      parsed = json::parse(text, [&check](int depth, json::parse_event_t event, json& value) {
        return check(depth, event, value);
      });
    } catch (const json::exception& e) {
      return fail(std::string("expected JSON: ") + e.what());
    }
    if (!check.problem.empty()) return fail(check.problem);
    if (!parsed.is_object()) return fail("expected an object of bounds");
    FORETOUCH_CHECK(checkKeys(parsed, {"format", "version", "name", "source", "bounds"}));
    if (!parsed.contains("format") || parsed["format"] != kBoundsFormatName) {
      return fail("expected \"format\": \"foretouch-bounds\"");
    }
    if (!parsed.contains("version") || parsed["version"] != 1) {
      return fail("expected \"version\": 1, the only version there is");
    }
    BoundsFile file;
    FORETOUCH_CHECK(readText(parsed, "name", file.name));
    FORETOUCH_CHECK(readText(parsed, "source", file.source));
    if (!parsed.contains("bounds") || !parsed["bounds"].is_array() || parsed["bounds"].empty()) {
      return fail("expected \"bounds\": an array of claims, not empty");
    }
    for (const json& entry : parsed["bounds"]) {
      where_ = fmt::format("bounds[{}]: ", file.entries.size());
      FORETOUCH_TRY(auto read, readEntry(entry));
      file.entries.push_back(std::move(read));
    }
    return file;
  }

 private:
  [[nodiscard]] Error fail(const std::string& text) const {
    return Error::in(file_, ErrorCode::Syntax, where_ + text);
  }
  Result<Done> checkKeys(const json& object, const std::vector<std::string>& known) const {
    for (const auto& [key, value] : object.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        return fail("unknown key " + inQuotes(key) + didYouMean(key, known));
      }
    }
    return Done{};
  }
  Result<Done> readText(const json& object, const char* key, std::string& place) const {
    if (!object.contains(key)) return Done{};
    if (!object[key].is_string()) return fail(fmt::format("expected a text for \"{}\"", key));
    place = object[key].get<std::string>();
    return Done{};
  }
  Result<Done> readNumber(const json& object, const char* key, double most, double& place) const {
    if (!object.contains(key)) return Done{};
    const double value = object[key].is_number() ? object[key].get<double>() : -1.0;
    if (!(value >= 0.0 && value <= most)) {
      return fail(fmt::format("expected a number from 0 to {:g} for \"{}\"", most, key));
    }
    place = value;
    return Done{};
  }

  Result<BoundEntry> readEntry(const json& object) const {
    constexpr double kMost = 1e9, kMostCount = 1e15;
    if (!object.is_object()) return fail("expected an object");
    std::vector<std::string> known{"link", "part", "model", "rate_hz", "quantile", "count"};
    for (const BoundField& field : kBoundFields) known.emplace_back(field.key);
    FORETOUCH_CHECK(checkKeys(object, known));
    BoundEntry entry;
    FORETOUCH_CHECK(readText(object, "link", entry.link));
    FORETOUCH_CHECK(readText(object, "part", entry.part));
    if (entry.link.empty() == entry.part.empty()) {
      return fail("expected either \"link\" or \"part\"");
    }
    const std::vector<std::string> parts(kBoundParts.begin(), kBoundParts.end());
    if (!entry.part.empty() && std::find(parts.begin(), parts.end(), entry.part) == parts.end()) {
      return fail("expected head, trunk, arm, hand, leg, foot or all for \"part\", found " +
                  inQuotes(entry.part) + didYouMean(entry.part, parts));
    }
    std::string model;
    FORETOUCH_CHECK(readText(object, "model", model));
    entry.model = motionModelNamed(model);
    if (!model.empty() && !entry.model) {
      return fail("expected constant-rate, cubic or cubic-late for \"model\", found " +
                  inQuotes(model));
    }
    double count = 0.0;
    FORETOUCH_CHECK(readNumber(object, "rate_hz", kMost, entry.rateHz));
    FORETOUCH_CHECK(readNumber(object, "quantile", 1.0, entry.quantile));
    FORETOUCH_CHECK(readNumber(object, "count", kMostCount, count));
    entry.count = static_cast<std::int64_t>(count);
    for (const BoundField& field : kBoundFields) {
      FORETOUCH_CHECK(readNumber(object, field.key, field.most, entry.bound.*field.place));
    }
    FORETOUCH_CHECK(checkReach(entry));
    if (!entry.model &&
        (object.contains("acceleration_m_s2") || object.contains("follow_floor_m"))) {
      return fail("expected \"model\": that of which \"acceleration_m_s2\" bounds the difference");
    }
    if (object.contains("follow_floor_m") != object.contains("follow_share")) {
      return fail("expected \"follow_floor_m\" and \"follow_share\" together");
    }
    return entry;
  }

  /// In a step of the entry's rate.
  [[nodiscard]] Result<Done> checkReach(const BoundEntry& entry) const {
    const double most = 0.125 * entry.bound.acceleration / (entry.rateHz * entry.rateHz);
    if (entry.rateHz == 0.0 || !std::isfinite(most) || most <= kAbsurdM) return Done{};
    return fail(
        fmt::format("expected an \"acceleration_m_s2\" that keeps a person within {:g} m of "
                    "the model at {:g} Hz, found {:.3g} m",
                    kAbsurdM, entry.rateHz, most));
  }

  const std::string& file_;
  std::string where_;
};

bool isAbout(const BoundEntry& entry, MotionModel model, double rateHz) {
  const bool isRate = entry.rateHz == 0.0 || std::abs(entry.rateHz / rateHz - 1.0) <= kSameRate;
  return isRate && (!entry.model || *entry.model == model);
}

/// 0: by name; 1: by part; 2: for all; 3: it is about another link.
int rankOf(const BoundEntry& entry, const std::string& link, const std::string& part) {
  if (entry.link == link) return 0;
  if (!entry.part.empty() && entry.part == part) return 1;
  return entry.part == "all" ? 2 : 3;
}

/// For each of kBoundFields, the rank of the entry that it is from.
using Ranks = std::array<int, kBoundFields.size()>;

bool isSet(const LinkBound& bound, const BoundField& field) {
  if (field.place == &LinkBound::followShare) return std::isfinite(bound.followFloor);
  return bound.*field.place != LinkBound{}.*field.place;
}

/// Takes the entry's numbers that no entry of the same or a better rank gave; true: it took any.
bool take(const LinkBound& said, int rank, Ranks& ranks, LinkBound& bound) {
  bool isAny = false;
  for (std::size_t i = 0; i < kBoundFields.size(); ++i) {
    if (rank >= ranks[i] || !isSet(said, kBoundFields[i])) continue;
    ranks[i] = rank;
    bound.*kBoundFields[i].place = said.*kBoundFields[i].place;
    isAny = true;
  }
  return isAny;
}

std::string formatEntry(const BoundEntry& entry) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  if (!entry.link.empty()) out.field("link", entry.link);
  if (!entry.part.empty()) out.field("part", entry.part);
  if (entry.model) out.field("model", toString(*entry.model));
  if (entry.rateHz > 0.0) out.field("rate_hz", entry.rateHz);
  for (const BoundField& field : kBoundFields) {
    if (isSet(entry.bound, field)) out.field(field.key, entry.bound.*field.place);
  }
  if (entry.count > 0) {
    out.field("quantile", entry.quantile);
    out.field("count", entry.count);
  }
  out.endObject();
  return text;
}

/// The models and rates that there are, for an error.
std::string kindsOf(const BoundsFile& file) {
  std::set<std::string> kinds;
  for (const BoundEntry& entry : file.entries) {
    kinds.insert(std::string(entry.model ? toString(*entry.model) : "any model") +
                 (entry.rateHz > 0.0 ? fmt::format(" at {:g} Hz", entry.rateHz) : " at any rate"));
  }
  std::string text;
  for (const std::string& kind : kinds) text += (text.empty() ? "" : ", ") + kind;
  return text;
}

}  // namespace

std::optional<MotionModel> motionModelNamed(std::string_view word) {
  for (const MotionModel model : kMotionModels) {
    if (word == toString(model)) return model;
  }
  return std::nullopt;
}

std::vector<std::string> boundParts(const Skeleton& skeleton) {
  std::vector<std::string> parts;
  for (const internal::BodyRole role : internal::bodyRoles(skeleton))
    parts.emplace_back(partOf(role));
  return parts;
}

Result<BoundsFile> parseBounds(std::string_view text, const std::string& name) {
  if (text.size() > kMaxBoundsFileBytes) {
    return Error::in(name, ErrorCode::LimitExceeded,
                     fmt::format("expected at most {} bytes", kMaxBoundsFileBytes));
  }
  return BoundsReader(name).read(text);
}

Result<BoundsFile> readBoundsFile(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxBoundsFileBytes));
  return parseBounds(text, path);
}

std::string formatBounds(const BoundsFile& file) {
  std::string entries;
  for (const BoundEntry& entry : file.entries) {
    entries += (entries.empty() ? "\n  " : ",\n  ") + formatEntry(entry);
  }
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("format", kBoundsFormatName);
  out.field("version", 1);
  if (!file.name.empty()) out.field("name", file.name);
  if (!file.source.empty()) out.field("source", file.source);
  out.rawField("bounds", "[" + entries + "\n]");
  out.endObject();
  return text + "\n";
}

Result<Done> writeBoundsFile(const BoundsFile& bounds, const std::string& path) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(formatBounds(bounds));
  return file.commit();
}

Result<LinkBounds> boundsOf(const BoundsFile& file, const Skeleton& skeleton, MotionModel model,
                            double rateHz) {
  const std::vector<std::string> parts = boundParts(skeleton);
  std::vector<std::string> names;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    names.push_back(skeleton.name(joint));
  }
  LinkBounds bounds{std::vector<LinkBound>(names.size()),
                    std::vector<std::int32_t>(names.size(), -1)};
  std::vector<Ranks> ranks(names.size(), Ranks{3, 3, 3, 3, 3, 3, 3});
  bool isAny = false;
  for (std::size_t i = 0; i < file.entries.size(); ++i) {
    const BoundEntry& entry = file.entries[i];
    if (!entry.link.empty() && !skeleton.find(entry.link)) {
      return Error::of(ErrorCode::UnknownName,
                       fmt::format("bounds[{}]: expected a link of the avatar, found {}{}", i,
                                   inQuotes(entry.link), didYouMean(entry.link, names)));
    }
    if (!isAbout(entry, model, rateHz)) continue;
    isAny = true;
    for (std::size_t link = 0; link < names.size(); ++link) {
      const int rank = rankOf(entry, names[link], parts[link]);
      if (take(entry.bound, rank, ranks[link], bounds.bounds[link])) {
        bounds.entryOf[link] = static_cast<std::int32_t>(i);
      }
    }
  }
  if (!isAny) {
    return Error::of(ErrorCode::Mismatch, fmt::format("expected bounds for {} at {:g} Hz, found {}",
                                                      toString(model), rateHz, kindsOf(file)));
  }
  return bounds;
}

Result<BoundsByRate> BoundsByRate::make(BoundsFile file, const Skeleton& skeleton,
                                        MotionModel model) {
  const auto isOfModel = [model](const BoundEntry& entry) {
    return !entry.model || *entry.model == model;
  };
  const auto some = std::find_if(file.entries.begin(), file.entries.end(), isOfModel);
  if (some == file.entries.end()) {
    return Error::of(ErrorCode::Mismatch, fmt::format("expected bounds for {}, found {}",
                                                      toString(model), kindsOf(file)));
  }
  constexpr double kAnyRateHz = 30.0;
  const double rateHz = some->rateHz > 0.0 ? some->rateHz : kAnyRateHz;
  FORETOUCH_CHECK(boundsOf(file, skeleton, model, rateHz));
  return BoundsByRate(std::move(file), skeleton, model);
}

const std::vector<LinkBound>& BoundsByRate::at(double rateHz) {
  nowCounts_.clear();
  for (const BoundEntry& entry : file_.entries) {
    nowCounts_.push_back(isAbout(entry, model_, rateHz) ? 1 : 0);
  }
  if (!bounds_.empty() && nowCounts_ == counts_) return bounds_;
  std::swap(counts_, nowCounts_);
  auto found = boundsOf(file_, skeleton_, model_, rateHz);
  bounds_.assign(countOf(skeleton_.numJoints()), LinkBound{});
  if (found.ok()) bounds_ = std::move(found.value().bounds);
  return bounds_;
}

}  // namespace foretouch
