#include "tools/solid/solid_reader.h"

#include <cmath>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "assets/text_file.h"
#include "network/wire/message_fields.h"
#include "tools/settings/file_mark.h"
#include "tools/solid/solid_lines.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

/// json copies and prints itself recursively, and a file must not use up the machine's stack. The
/// format nests five deep.
constexpr int kMostNesting = 32;

bool nestsTooDeep(std::string_view text) {
  int depth = 0;
  bool isInText = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') isInText = !isInText;
    if (isInText) {
      if (c == '\\') ++i;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMostNesting) return true;
  }
  return false;
}

/// Discarded, which is not an object, if it is not JSON that we read.
json parsedLine(std::string_view line) {
  if (nestsTooDeep(line)) return json(json::value_t::discarded);
  return json::parse(line, nullptr, false);
}

/// The fields of one object; the first fault is kept, and later ones change nothing.
class SolidFields {
 public:
  SolidFields(const json& object, std::string name) : object_(object), name_(std::move(name)) {}

  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] bool has(const char* field) const { return object_.contains(field); }

  void text(const char* field, std::string& place) {
    if (const json* const value = find(field, &json::is_string, "a text")) {
      place = value->get<std::string>();
    }
  }
  void number(const char* field, double& place) {
    const json* const value = find(field, &json::is_number, "a number");
    if (value == nullptr) return;
    place = value->get<double>();
    if (!std::isfinite(place)) fail(field, "a finite number");
  }
  void whole(const char* field, std::int64_t& place) {
    const json* const value = find(field, &json::is_number_integer, "a whole number");
    if (value != nullptr) place = value->get<std::int64_t>();
  }
  void flag(const char* field, bool& place) {
    if (const json* const value = find(field, &json::is_boolean, "true or false")) {
      place = value->get<bool>();
    }
  }
  /// One of `count` words, each that of its number.
  template <typename Word>
  void word(const char* field, std::uint8_t count, Word& place) {
    std::string found;
    text(field, found);
    if (!fault_.empty()) return;
    for (std::uint8_t i = 0; i < count; ++i) {
      if (found == toString(static_cast<Word>(i))) {
        place = static_cast<Word>(i);
        return;
      }
    }
    fail(field, "another word");
  }
  /// All of a list.
  template <typename Record, typename List>
  void listed(Record& record, const List& list) {
    const auto read = [&](const auto& field) {
      auto& place = wire::at(record, field.member);
      using Value = std::decay_t<decltype(place)>;
      if constexpr (std::is_enum_v<Value>) {
        word(field.name, static_cast<std::uint8_t>(field.rule.most + 1), place);
      } else if constexpr (std::is_same_v<Value, bool>) {
        flag(field.name, place);
      } else {
        number(field.name, place);
      }
    };
    std::apply([&](const auto&... each) { (read(each), ...); }, list);
  }
  void texts(const char* field, std::vector<std::string>& place) {
    for (const json& item : list(field)) {
      if (!item.is_string()) return fail(field, "texts");
      place.push_back(item.get<std::string>());
    }
  }
  void numbers(const char* field, std::vector<double>& place) {
    for (const json& item : list(field)) {
      if (!item.is_number() || !std::isfinite(item.get<double>())) return fail(field, "numbers");
      place.push_back(item.get<double>());
    }
  }
  /// Empty if there is no such list.
  [[nodiscard]] const json& list(const char* field) {
    static const json kNone = json::array();
    const json* const value = find(field, &json::is_array, "a list");
    return value == nullptr ? kNone : *value;
  }
  [[nodiscard]] const json& object(const char* field) {
    static const json kNone = json::object();
    const json* const value = find(field, &json::is_object, "an object");
    return value == nullptr ? kNone : *value;
  }

  /// "way[2]: rotations: expected a list".
  void fail(const char* field, const char* expected) {
    if (!fault_.empty()) return;
    fault_ = fmt::format("{}{}: expected {}", name_, field, expected);
  }
  void take(const SolidFields& part) {
    if (fault_.empty()) fault_ = part.fault_;
  }

 private:
  const json* find(const char* field, bool (json::*isRight)() const noexcept,
                   const char* expected) {
    const auto found = object_.find(field);
    if (found != object_.end() && ((*found).*isRight)()) return &*found;
    fail(field, expected);
    return nullptr;
  }

  const json& object_;
  std::string name_, fault_;
};

/// Rows of `width` finite numbers, `count` of them.
bool readRows(const json& rows, std::size_t count, std::size_t width, std::vector<double>& place) {
  if (rows.size() != count) return false;
  place.clear();
  for (const json& row : rows) {
    if (!row.is_array() || row.size() != width) return false;
    for (const json& x : row) {
      if (!x.is_number() || !std::isfinite(x.get<double>())) return false;
      place.push_back(x.get<double>());
    }
  }
  return true;
}

Pose readPose(SolidFields& fields, std::size_t joints) {
  Pose pose;
  std::vector<double> x;
  if (!readRows(fields.list("rotations"), joints, 4, x)) {
    fields.fail("rotations", "four numbers per link of the header");
    return pose;
  }
  for (std::size_t j = 0; j < joints; ++j) {
    pose.rotations.emplace_back(x[4 * j], x[4 * j + 1], x[4 * j + 2], x[4 * j + 3]);
  }
  if (!readRows(fields.list("translations"), joints, 3, x)) {
    fields.fail("translations", "three numbers per link of the header");
    return pose;
  }
  for (std::size_t j = 0; j < joints; ++j) {
    pose.translations.emplace_back(x[3 * j], x[3 * j + 1], x[3 * j + 2]);
  }
  return pose;
}

void readOptionalPose(const char* name, SolidFields& fields, std::size_t joints,
                      std::optional<Pose>& place) {
  if (!fields.has(name)) return;
  SolidFields part(fields.object(name), std::string(name) + ": ");
  place = readPose(part, joints);
  fields.take(part);
}

void readWay(SolidFields& fields, std::size_t joints, SolidRecord& record) {
  for (const json& item : fields.list("way")) {
    if (!item.is_object()) return fields.fail("way", "objects");
    SolidFields part(item, fmt::format("way[{}]: ", record.way.size()));
    double t = 0.0;
    part.number("t", t);
    record.way.push_back(readPose(part, joints));
    record.times.push_back(t);
    fields.take(part);
    if (!fields.fault().empty()) return;
  }
}

SolidRecord readRecord(SolidFields& fields, std::size_t joints) {
  SolidRecord record;
  fields.whole("tick", record.tick);
  fields.number("t", record.timeS);
  fields.listed(record, wire::shownState<SolidRecord>());
  fields.listed(record, wire::shownLengths<SolidRecord>());
  fields.numbers("deviations", record.deviations);
  readOptionalPose("start", fields, joints, record.start);
  if (fields.has("from")) fields.text("from", record.from);
  readWay(fields, joints, record);
  readOptionalPose("tracked", fields, joints, record.tracked);
  return record;
}

SolidHeader readHeader(SolidFields& fields) {
  SolidHeader header;
  std::string up;
  fields.text("scene", header.scene);
  fields.text("scene_mark", header.sceneMark);
  fields.text("avatar", header.avatar);
  fields.text("avatar_mark", header.avatarMark);
  fields.number("scene_scale", header.sceneScale);
  if (!(header.sceneScale > 0.0)) fields.fail("scene_scale", "a number above 0");
  fields.text("up", up);
  if (up != "y" && up != "z") fields.fail("up", "\"y\" or \"z\"");
  header.sceneUp = up == "z" ? UpAxis::Z : UpAxis::Y;
  fields.texts("ignore", header.ignore);
  fields.texts("links", header.links);
  fields.whole("ticks", header.ticks);
  if (header.links.empty() || header.links.size() > std::size_t{kMaxJoints}) {
    fields.fail("links", "1 to 4096 names");
  }
  SolidFields options(fields.object("options"), "options: ");
  options.number("tolerance", header.tolerance);
  fields.take(options);
  if (fields.has("self")) header.self = fields.object("self").dump();
  return header;
}

}  // namespace

Result<SolidReader> SolidReader::open(const std::string& path) {
  SolidReader reader(path);
  if (!reader.file_) return Error::in(path, ErrorCode::FileNotFound, "cannot be opened");
  std::string line;
  FORETOUCH_CHECK(reader.readLine(line));
  const json parsed = parsedLine(line);
  const bool isOurs = parsed.is_object() && parsed.value("format", json()) == kSolidFormat;
  if (!isOurs) {
    return Error{ErrorCode::Syntax, path, 1, -1,
                 fmt::format("expected shown poses, whose first line has \"format\":\"{}\"; "
                             "`foretouch replay --solid` writes them",
                             kSolidFormat)};
  }
  const json version = parsed.value("version", json());
  if (version != kSolidVersion) {
    return Error{ErrorCode::Mismatch, path, 1, -1,
                 fmt::format("expected version {}, found {}", kSolidVersion,
                             version.is_number() ? version.dump() : inQuotes(version.dump()))};
  }
  SolidFields fields(parsed, "");
  reader.header_ = readHeader(fields);
  if (!fields.fault().empty()) return Error{ErrorCode::Syntax, path, 1, -1, fields.fault()};
  reader.isHeaderMarkTrue_ = reader.takeMark(line);
  return reader;
}

/// False at the end of the file.
Result<bool> SolidReader::readLine(std::string& line) {
  line.clear();
  std::streambuf& bytes = *file_.rdbuf();
  constexpr auto kEnd = std::char_traits<char>::eof();
  int byte = bytes.sbumpc();
  if (byte == kEnd) return false;
  ++line_;
  for (; byte != kEnd && byte != '\n'; byte = bytes.sbumpc()) {
    if (line.size() == kMaxSolidLineBytes) {
      return Error{ErrorCode::LimitExceeded, path_, line_, -1,
                   fmt::format("expected a line of at most {} bytes", kMaxSolidLineBytes)};
    }
    line += static_cast<char>(byte);
  }
  return true;
}

/// Whether the line ends with the mark of all before it; that mark counts for the next line.
bool SolidReader::takeMark(const std::string& line) {
  constexpr std::string_view kBegin = ",\"mark\":\"", kAfter = "\"}";
  constexpr std::size_t kDigits = 16;
  const std::size_t tail = kBegin.size() + kDigits + kAfter.size();
  if (line.size() < tail) return false;
  const std::string_view all = line;
  const std::string_view open = all.substr(0, line.size() - tail);
  mark_ = markOfText(open, mark_);
  return all.substr(open.size()) == std::string(kBegin) + mark_ + std::string(kAfter);
}

Result<std::optional<SolidRecord>> SolidReader::next() {
  std::string line;
  FORETOUCH_TRY(const bool isThere, readLine(line));
  if (!isThere) return std::optional<SolidRecord>();
  const json parsed = parsedLine(line);
  if (!parsed.is_object()) {
    return Error{ErrorCode::Syntax, path_, line_, -1,
                 fmt::format("expected one object of JSON, nested at most {} deep", kMostNesting)};
  }
  if (parsed.contains("summary")) {
    isComplete_ = takeMark(line) && file_.rdbuf()->sgetc() == std::char_traits<char>::eof();
    return std::optional<SolidRecord>();
  }
  SolidFields fields(parsed, "");
  SolidRecord record = readRecord(fields, header_.links.size());
  if (!fields.fault().empty()) return Error{ErrorCode::Syntax, path_, line_, -1, fields.fault()};
  record.line = line_;
  record.isMarkTrue = takeMark(line);
  return std::optional<SolidRecord>(std::move(record));
}

}  // namespace foretouch::tools
