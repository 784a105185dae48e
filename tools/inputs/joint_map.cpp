#include "tools/inputs/joint_map.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "assets/avatar/humanoid_clip.h"
#include "assets/text_file.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

/// Ends the parse at the first event out of place, so nesting never grows.
class JointMapSax final : public nlohmann::json_sax<json> {
 public:
  JointMapSax(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  [[nodiscard]] const Error& error() const { return *error_; }
  [[nodiscard]] JointNameMap take() { return std::move(names_); }

  bool null() override { return unexpected("null"); }
  bool boolean(bool) override { return unexpected("true or false"); }
  bool number_integer(number_integer_t) override { return unexpected("a number"); }
  bool number_unsigned(number_unsigned_t) override { return unexpected("a number"); }
  bool number_float(number_float_t, const string_t&) override { return unexpected("a number"); }
  bool binary(binary_t&) override { return unexpected("binary data"); }
  bool start_array(std::size_t) override { return unexpected("an array"); }
  bool end_array() override { return true; }

  bool start_object(std::size_t) override {
    if (open_) return unexpected("an object");
    open_ = true;
    return true;
  }
  bool end_object() override { return true; }
  bool key(string_t& key) override {
    key_ = key;
    if (names_.count(key) == 0) return true;
    return fail(ErrorCode::DuplicateName, -1, "the joint " + inQuotes(key) + " appears twice");
  }
  bool string(string_t& text) override {
    if (!open_) return unexpected("a text");
    names_.emplace(key_, text);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const json::exception&) override {
    // The parser has taken the offending byte, which may be the line break itself.
    const std::size_t before = std::min(text_.size(), position > 0 ? position - 1 : 0);
    const auto line = 1 + std::count(text_.begin(), text_.begin() + before, '\n');
    return fail(ErrorCode::Syntax, line, "broken JSON; " + expectation());
  }

 private:
  static std::string expectation() {
    return R"(expected one object of texts: {"avatar joint": "clip joint", ...})";
  }
  bool unexpected(const std::string& found) {
    const std::string where = open_ ? " for " + inQuotes(key_) : "";
    return fail(ErrorCode::Syntax, -1, expectation() + ", found " + found + where);
  }
  bool fail(ErrorCode code, std::int64_t line, const std::string& message) {
    error_ = Error::inLine(file_, line, code, message);
    return false;
  }

  std::string_view text_;
  const std::string& file_;
  bool open_ = false;
  std::string key_;
  JointNameMap names_;
  std::optional<Error> error_;
};

}  // namespace

Result<JointNameMap> parseJointMap(std::string_view json, const std::string& name) {
  JointMapSax sax(json, name);
  if (!nlohmann::json::sax_parse(json, &sax)) return sax.error();
  return sax.take();
}

Result<JointNameMap> readJointMapFile(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxJointMapBytes));
  return parseJointMap(text, path);
}

Result<JointMatch> matchWithMap(const Skeleton& avatar, const Skeleton& clip,
                                const std::string& mapPath, const std::string& motionPath) {
  JointNameMap names;
  if (!mapPath.empty()) {
    FORETOUCH_TRY(names, readJointMapFile(mapPath));
  }
  auto match = matchJoints(avatar, clip, names);
  if (match.ok()) return match;
  const bool isOfMap = match.error().code == ErrorCode::UnknownName;
  return inFile(match.error(), isOfMap ? mapPath : motionPath);
}

Result<bool> followByParts(const Skeleton& avatar, const std::string& mapPath,
                           const std::string& motionPath, Clip& clip) {
  if (!mapPath.empty()) return false;
  FORETOUCH_TRY(auto followed, inFile(humanoidClip(avatar, clip), motionPath));
  if (!followed) return false;
  clip = *std::move(followed);
  return true;
}

}  // namespace foretouch::tools
