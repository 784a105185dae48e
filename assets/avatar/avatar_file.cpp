#include "assets/avatar/avatar_file.h"

#include <array>
#include <cstddef>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/marked_sax.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

constexpr char kFormatName[] = "foretouch-avatar";
constexpr double kFormatVersion = 1.0;

/// Objects and arrays of the format; the parser is always in exactly one.
enum class Place { Outside, File, Links, Link, LssList, LssEntry, Mesh, Numbers };

/// The value that may follow a key.
enum class Kind { Format, Version, Links, Name, Parent, Three, Four, LssList, Mesh, Text, Radius };

struct Field {
  Place place;
  const char* key;
  Kind kind;
  bool required;
};

constexpr std::array<Field, 14> kFields = {{
    {Place::File, "format", Kind::Format, true},
    {Place::File, "version", Kind::Version, true},
    {Place::File, "links", Kind::Links, true},
    {Place::Link, "name", Kind::Name, true},
    {Place::Link, "parent", Kind::Parent, true},
    {Place::Link, "offset", Kind::Three, true},
    {Place::Link, "rotation", Kind::Four, false},
    {Place::Link, "lss", Kind::LssList, true},
    {Place::Link, "mesh", Kind::Mesh, false},
    {Place::LssEntry, "a", Kind::Three, true},
    {Place::LssEntry, "b", Kind::Three, true},
    {Place::LssEntry, "radius", Kind::Radius, true},
    {Place::Mesh, "file", Kind::Text, true},
    {Place::Mesh, "node", Kind::Text, true},
}};

const char* expectation(Kind kind) {
  switch (kind) {
    case Kind::Format: return "the text \"foretouch-avatar\"";
    case Kind::Version: return "the number 1, the only version there is";
    case Kind::Links: return "an array of links";
    case Kind::Name: return "a name";
    case Kind::Parent: return "the name of an earlier link, or null for a root";
    case Kind::Three: return "an array of 3 numbers";
    case Kind::Four: return "an array of 4 numbers (w, x, y, z)";
    case Kind::LssList: return "an array of LSS";
    case Kind::Mesh: return "an object with \"file\" and \"node\"";
    case Kind::Text: return "a text";
    case Kind::Radius: return "a number";
  }
  return "";
}

/// Fills raw links from the parser's events.
class AvatarSax final : public internal::MarkedSax {
 public:
  using MarkedSax::MarkedSax;

  [[nodiscard]] Result<Avatar> build();

  bool null() override {
    if (!expects(Kind::Parent)) return unexpected("null");
    joint().parent = kNoParent;
    return valueDone();
  }
  bool boolean(bool) override { return unexpected("true or false"); }
  bool number_integer(number_integer_t v) override { return number(static_cast<double>(v)); }
  bool number_unsigned(number_unsigned_t v) override { return number(static_cast<double>(v)); }
  bool number_float(number_float_t v, const string_t&) override { return number(v); }
  bool string(string_t& text) override;
  bool binary(binary_t&) override { return unexpected("binary data"); }  // not in JSON text
  bool start_object(std::size_t) override;
  bool key(string_t& key) override;
  bool end_object() override;
  bool start_array(std::size_t) override;
  bool end_array() override;

 private:
  [[nodiscard]] Place place() const { return places_.empty() ? Place::Outside : places_.back(); }
  [[nodiscard]] bool expects(Kind kind) const { return field_ != nullptr && field_->kind == kind; }
  [[nodiscard]] RawJoint& joint() { return raw_.joints.back(); }

  bool number(double value);
  bool parent(const std::string& name);
  bool enter(Place place);
  bool valueDone() {
    field_ = nullptr;
    return true;
  }
  bool fail(ErrorCode code, const std::string& message) override;
  bool unexpected(const std::string& found);
  [[nodiscard]] Error located(Error error) const;

  std::vector<Place> places_;
  std::vector<unsigned> seen_;  // per open object: which of kFields it has had
  const Field* field_ = nullptr;
  std::vector<double> numbers_;

  RawSkeleton raw_;
  std::vector<std::vector<Lss>> lss_;
  std::vector<MeshReference> meshes_;
  std::vector<std::int64_t> lines_;  // per link: where it starts
  std::unordered_map<std::string, JointId> byName_;
};

bool AvatarSax::fail(ErrorCode code, const std::string& message) {
  Error error;
  error.code = code;
  error.file = file();
  error.line = line();
  error.message = message;
  if (!raw_.joints.empty() && places_.size() > 2) {  // inside a link
    error.index = static_cast<std::int64_t>(raw_.joints.size()) - 1;
    error.message =
        "link " + std::to_string(error.index) + " " + inQuotes(joint().name) + ": " + error.message;
  }
  return stop(std::move(error));
}

bool AvatarSax::unexpected(const std::string& found) {
  std::string expected = "one avatar object";
  if (field_ != nullptr) {
    expected = std::string(expectation(field_->kind)) + " for \"" + field_->key + "\"";
  } else if (place() == Place::Links) {
    expected = "an object that is a link";
  } else if (place() == Place::LssList) {
    expected = "an object that is an LSS";
  }
  return fail(ErrorCode::Syntax, "expected " + expected + ", found " + found);
}

bool AvatarSax::number(double value) {
  if (place() == Place::Numbers) {
    const std::size_t count = expects(Kind::Four) ? 4 : 3;
    if (numbers_.size() == count) return unexpected("more");
    numbers_.push_back(value);
    return true;
  }
  if (expects(Kind::Radius)) {
    lss_.back().back().radius = value;
  } else if (!expects(Kind::Version)) {
    return unexpected("a number");
  } else if (value != kFormatVersion) {
    return unexpected(fmt::format("{}", value));
  }
  return valueDone();
}

bool AvatarSax::string(string_t& text) {
  if (place() == Place::Numbers) return unexpected("a text");
  if (expects(Kind::Format)) {
    if (text != kFormatName) return unexpected(inQuotes(text));
  } else if (expects(Kind::Name)) {
    joint().name = text;
  } else if (expects(Kind::Parent)) {
    return parent(text);
  } else if (expects(Kind::Text)) {
    MeshReference& mesh = meshes_.back();
    (std::string_view(field_->key) == "file" ? mesh.file : mesh.node) = text;
  } else {
    return unexpected("a text");
  }
  return valueDone();
}

bool AvatarSax::parent(const std::string& name) {
  const auto found = byName_.find(name);
  if (found == byName_.end()) {
    return fail(ErrorCode::BadHierarchy, "its parent " + inQuotes(name) +
                                             " is no earlier link; parents come before children");
  }
  joint().parent = found->second;
  return valueDone();
}

bool AvatarSax::enter(Place next) {
  places_.push_back(next);
  field_ = nullptr;
  if (next == Place::File || next == Place::Link || next == Place::LssEntry ||
      next == Place::Mesh) {
    seen_.push_back(0);
  }
  return true;
}

bool AvatarSax::start_object(std::size_t) {
  if (place() == Place::Outside) return enter(Place::File);
  if (place() == Place::Links) {
    if (raw_.joints.size() == countOf(kMaxJoints)) {
      return fail(ErrorCode::LimitExceeded, fmt::format("expected at most {} links", kMaxJoints));
    }
    raw_.joints.emplace_back();
    lss_.emplace_back();
    meshes_.emplace_back();
    lines_.push_back(line());
    return enter(Place::Link);
  }
  if (place() == Place::LssList) {
    if (lss_.back().size() == kMaxLssPerLink) {
      return fail(ErrorCode::LimitExceeded, fmt::format("expected at most {} LSS", kMaxLssPerLink));
    }
    lss_.back().emplace_back();
    return enter(Place::LssEntry);
  }
  if (expects(Kind::Mesh)) return enter(Place::Mesh);
  return unexpected("an object");
}

bool AvatarSax::key(string_t& key) {
  std::string known;
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (kFields[i].place != place()) continue;
    known += (known.empty() ? "" : ", ") + std::string(kFields[i].key);
    if (key != kFields[i].key) continue;
    const unsigned bit = 1u << i;
    if ((seen_.back() & bit) != 0) {
      return fail(ErrorCode::DuplicateName, "the key " + inQuotes(key) + " appears twice");
    }
    seen_.back() |= bit;
    field_ = &kFields[i];
    return true;
  }
  return fail(ErrorCode::UnknownName,
              "unknown key " + inQuotes(key) + "; expected one of " + known);
}

bool AvatarSax::end_object() {
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (kFields[i].place != place() || !kFields[i].required) continue;
    if ((seen_.back() & (1u << i)) == 0) {
      return fail(ErrorCode::Syntax, fmt::format("the key '{}' is missing", kFields[i].key));
    }
  }
  if (place() == Place::Mesh && meshes_.back().file.empty()) {
    return fail(ErrorCode::Empty, "expected the path of a mesh for \"file\", found an empty text");
  }
  if (place() == Place::Link) {
    byName_.emplace(joint().name, static_cast<JointId>(raw_.joints.size()) - 1);
  }
  places_.pop_back();
  seen_.pop_back();
  return valueDone();
}

bool AvatarSax::start_array(std::size_t) {
  if (place() == Place::Numbers) return unexpected("an array in it");
  if (expects(Kind::Links)) return enter(Place::Links);
  if (expects(Kind::LssList)) return enter(Place::LssList);
  if (!expects(Kind::Three) && !expects(Kind::Four)) return unexpected("an array");
  numbers_.clear();
  places_.push_back(Place::Numbers);  // the field stays: it selects the numbers' destination
  return true;
}

bool AvatarSax::end_array() {
  if (place() == Place::Numbers) {
    const std::vector<double>& v = numbers_;
    if (v.size() != (expects(Kind::Four) ? 4u : 3u)) return unexpected(fmt::format("{}", v.size()));
    if (expects(Kind::Four)) {
      joint().rotation = Quaternion(v[0], v[1], v[2], v[3]);
    } else {
      const Eigen::Vector3d point(v[0], v[1], v[2]);
      const std::string_view key = field_->key;
      if (key == "offset") joint().offset = point;
      if (key == "a") lss_.back().back().a = point;
      if (key == "b") lss_.back().back().b = point;
    }
  }
  places_.pop_back();
  return valueDone();
}

Error AvatarSax::located(Error error) const {
  error.file = file();
  if (error.index >= 0 && slotOf(error.index) < lines_.size()) {
    error.line = lines_[slotOf(error.index)];
  }
  return error;
}

Result<Avatar> AvatarSax::build() {
  auto skeleton = Skeleton::build(raw_);
  if (!skeleton.ok()) return located(skeleton.error());
  auto avatar = Avatar::build(std::move(skeleton).value(), std::move(lss_), std::move(meshes_));
  if (!avatar.ok()) return located(avatar.error());
  return avatar;
}

}  // namespace

Result<Avatar> parseAvatar(std::string_view json, const std::string& name) {
  if (json.size() > kMaxAvatarFileBytes) {
    return Error::in(name, ErrorCode::LimitExceeded,
                     fmt::format("expected at most {} bytes", kMaxAvatarFileBytes));
  }
  try {
    AvatarSax sax(json, name);
    if (!sax.parse()) return sax.error();
    return sax.build();
  } catch (const std::bad_alloc&) {
    return Error::in(name, ErrorCode::LimitExceeded, "does not fit into memory");
  }
}

Result<Avatar> readAvatarFile(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxAvatarFileBytes));
  return parseAvatar(text, path);
}

Result<Done> writeAvatarFile(const Avatar& avatar, const std::string& path) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(formatAvatar(avatar));
  return file.commit();
}

}  // namespace foretouch
