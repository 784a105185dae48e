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

using AvatarField = internal::JsonField<Place, Kind>;
constexpr char kThree[] = "an array of 3 numbers", kFour[] = "an array of 4 numbers (w, x, y, z)";
constexpr std::array<AvatarField, 14> kFields = {{
    {Place::File, "format", Kind::Format, "the text \"foretouch-avatar\""},
    {Place::File, "version", Kind::Version, "the number 1, the only version there is"},
    {Place::File, "links", Kind::Links, "an array of links"},
    {Place::Link, "name", Kind::Name, "a name"},
    {Place::Link, "parent", Kind::Parent, "the name of an earlier link, or null for a root"},
    {Place::Link, "offset", Kind::Three, kThree},
    {Place::Link, "rotation", Kind::Four, kFour, false},
    {Place::Link, "lss", Kind::LssList, "an array of LSS"},
    {Place::Link, "mesh", Kind::Mesh, "an object with \"file\" and \"node\"", false},
    {Place::LssEntry, "a", Kind::Three, kThree},
    {Place::LssEntry, "b", Kind::Three, kThree},
    {Place::LssEntry, "radius", Kind::Radius, "a number"},
    {Place::Mesh, "file", Kind::Text, "a text"},
    {Place::Mesh, "node", Kind::Text, "a text"},
}};

/// Fills raw links from the parser's events.
class AvatarSax final : public internal::TableSax<Place, Kind> {
 public:
  AvatarSax(std::string_view text, const std::string& file) : TableSax(text, file, kFields) {}

  [[nodiscard]] Result<Avatar> build();

  bool null() override {
    if (!expects(Kind::Parent)) return unexpected("null");
    joint().parent = kNoParent;
    return valueDone();
  }
  bool string(string_t& text) override;
  bool start_object(std::size_t) override;
  bool start_array(std::size_t) override;
  bool end_array() override;

 private:
  [[nodiscard]] RawJoint& joint() { return raw_.joints.back(); }

  bool number(double value) override;
  bool takeObject() override;
  [[nodiscard]] const char* elementOf(Place place) const override;
  bool parent(const std::string& name);
  bool fail(ErrorCode code, const std::string& message) override;
  [[nodiscard]] Error located(Error error) const;

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
  if (!raw_.joints.empty() && depth() > 2) {  // inside a link
    error.index = static_cast<std::int64_t>(raw_.joints.size()) - 1;
    error.message =
        "link " + std::to_string(error.index) + " " + inQuotes(joint().name) + ": " + error.message;
  }
  return stop(std::move(error));
}

const char* AvatarSax::elementOf(Place place) const {
  if (place == Place::Links) return "an object that is a link";
  return place == Place::LssList ? "an object that is an LSS" : "one avatar object";
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
    (keyAtHand() == "file" ? mesh.file : mesh.node) = text;
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

bool AvatarSax::takeObject() {
  if (place() == Place::Mesh && meshes_.back().file.empty()) {
    return fail(ErrorCode::Empty, "expected the path of a mesh for \"file\", found an empty text");
  }
  if (place() == Place::Link) {
    byName_.emplace(joint().name, static_cast<JointId>(raw_.joints.size()) - 1);
  }
  return true;
}

bool AvatarSax::start_array(std::size_t) {
  if (place() == Place::Numbers) return unexpected("an array in it");
  if (expects(Kind::Links)) return enter(Place::Links);
  if (expects(Kind::LssList)) return enter(Place::LssList);
  if (!expects(Kind::Three) && !expects(Kind::Four)) return unexpected("an array");
  numbers_.clear();
  return enter(Place::Numbers, true);  // the key selects the numbers' destination
}

bool AvatarSax::end_array() {
  if (place() == Place::Numbers) {
    const std::vector<double>& v = numbers_;
    if (v.size() != (expects(Kind::Four) ? 4u : 3u)) return unexpected(fmt::format("{}", v.size()));
    if (expects(Kind::Four)) {
      joint().rotation = Quaternion(v[0], v[1], v[2], v[3]);
    } else {
      const Eigen::Vector3d point(v[0], v[1], v[2]);
      const std::string_view key = keyAtHand();
      if (key == "offset") joint().offset = point;
      if (key == "a") lss_.back().back().a = point;
      if (key == "b") lss_.back().back().b = point;
    }
  }
  return leave();
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
