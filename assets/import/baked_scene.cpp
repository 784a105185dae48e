#include "assets/import/baked_scene.h"

#define XXH_INLINE_ALL
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>
#include <xxhash.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/import/protocol.h"
#include "assets/import/text.h"
#include "assets/system_files.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "middleware/scene/scene_image.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'F', 'T', 'S', 'C', 'E', 'N', 'E', '\n'};
/// The version of the arrays as they lie in memory: one more whenever a struct below changes, or
/// what the tree means.
constexpr std::uint32_t kLayout = 1;
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::uint64_t kAlignment = 64;
constexpr std::uint64_t kMostTextBytes = std::uint64_t{1} << 32;
static_assert(sizeof(Triangle) == 72 && sizeof(BvhNode) == 256 && sizeof(BvhLeaf) == 320 &&
              sizeof(Cluster) == 16 && sizeof(double) == 8);

/// Numbers of 8 bytes each, so that it has no gaps.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t byteOrder = kByteOrder, layout = kLayout;
  std::uint64_t check = 0;  ///< XXH3 of all that follows.
  std::uint64_t bytes = 0;  ///< The file's size.
  std::uint64_t triangles = 0, nodes = 0, leaves = 0, objects = 0, notes = 0, textBytes = 0;
  double origin[3] = {}, vertexRounding = 0.0;
  std::uint64_t audit[4] = {};
  double boxMin[3] = {}, boxMax[3] = {}, shortestEdge = 0.0, longestEdge = 0.0;
  std::uint64_t report[5] = {};
  double metresPerUnit = 1.0, declaredMetres = 0.0;  ///< 0: the source declares none.
  std::uint64_t isZUp = 0, declaredUp = 0;           ///< 0: none; 1: y; 2: z.
  std::uint64_t isOfFormat = 0, isUnitAsked = 0, isUpAsked = 0;
  std::uint64_t sourceBytes = 0, sourceMark = 0;
};
static_assert(sizeof(Header) % 8 == 0);
constexpr std::size_t kChecked = offsetof(Header, bytes);

/// Where each array begins. All of the file's counts are within their limits.
struct Places {
  std::uint64_t texts = sizeof(Header), triangles, nodes, leaves, clusters, objects, edges, corners,
                end;

  explicit Places(const Header& header) {
    const auto after = [](std::uint64_t place, std::uint64_t bytes) {
      return (place + bytes + kAlignment - 1) / kAlignment * kAlignment;
    };
    triangles = after(texts, header.textBytes);
    nodes = after(triangles, header.triangles * sizeof(Triangle));
    leaves = after(nodes, header.nodes * sizeof(BvhNode));
    clusters = after(leaves, header.leaves * sizeof(BvhLeaf));
    objects = after(clusters, header.leaves * sizeof(Cluster));
    edges = after(objects, header.triangles * sizeof(ObjectId));
    corners = after(edges, header.triangles * sizeof(std::uint16_t));
    end = corners + header.triangles;
  }
};

Error damaged(const std::string& path, const std::string& why) {
  return Error::in(path, ErrorCode::Syntax,
                   "expected a baked scene: " + why + "; bake it anew (foretouch scene bake)");
}

struct FileMark {
  std::uint64_t bytes = 0, mark = 0;
};

/// Nothing if it cannot be read.
std::optional<FileMark> markOf(const std::string& path) {
  const FileDescriptor file(openToRead(path));
  const FileState state = stateOf(file.get());
  if (file.get() < 0 || state.kind != FileKind::Regular) return std::nullopt;
  const auto content = contentOf(file.get(), state.bytes);
  if (content == nullptr && state.bytes > 0) return std::nullopt;
  return FileMark{state.bytes, XXH3_64bits(content.get(), state.bytes)};
}

/// A count, where memory may have 32 bits. What it counts is in memory.
std::size_t counted(std::uint64_t count) {
  return static_cast<std::size_t>(count);
}

/// A baked file in memory.
struct Baked {
  std::shared_ptr<const char> content;
  Header header;
  std::vector<std::string> texts;  ///< The source's name, objects' names, notes.

  template <typename T>
  [[nodiscard]] FrozenArray<T> array(std::uint64_t place, std::uint64_t count) const {
    return {reinterpret_cast<const T*>(content.get() + place), counted(count), content};
  }
};

/// Counts that a file can hold, and no sum of which overflows.
bool areWithinLimits(const Header& header) {
  return header.triangles <= kMaxTriangles && header.nodes <= kMaxTriangles &&
         header.leaves <= kMaxTriangles && header.objects <= kMaxTriangles &&
         header.notes <= kMaxTriangles && header.textBytes <= kMostTextBytes;
}

/// Each after its length, in four bytes.
std::optional<std::vector<std::string>> textsIn(std::string_view bytes, std::uint64_t count) {
  std::vector<std::string> texts;
  while (texts.size() < count) {
    std::uint32_t length = 0;
    if (bytes.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, bytes.data(), sizeof length);
    bytes.remove_prefix(sizeof length);
    if (bytes.size() < length || !isUtf8(bytes.substr(0, length))) return std::nullopt;
    texts.push_back(readableText(std::string(bytes.substr(0, length)), length));
    bytes.remove_prefix(length);
  }
  return bytes.empty() ? std::optional(std::move(texts)) : std::nullopt;
}

Result<Baked> opened(const std::string& path) {
  const FileDescriptor file(openToRead(path));
  const FileState state = stateOf(file.get());
  Baked baked;
  if (file.get() < 0 || state.bytes < sizeof(Header)) return damaged(path, "it is too short");
  baked.content = contentOf(file.get(), state.bytes);
  if (baked.content == nullptr) {
    return Error::in(path, ErrorCode::FileUnreadable,
                     std::string("reading failed: ") + std::strerror(errno));
  }
  Header& header = baked.header;
  std::memcpy(&header, baked.content.get(), sizeof header);
  if (header.byteOrder != kByteOrder || header.layout != kLayout) {
    return damaged(path, "it is of another version of Foretouch, or of another machine");
  }
  if (header.bytes != state.bytes || !areWithinLimits(header) || Places(header).end != state.bytes)
    return damaged(path, "its size is not what it says");
  if (XXH3_64bits(baked.content.get() + kChecked, state.bytes - kChecked) != header.check) {
    return damaged(path, "its check sum is wrong");
  }
  if (!(header.metresPerUnit > 0.0) || !std::isfinite(header.metresPerUnit)) {
    return damaged(path, "its unit is no length");
  }
  auto texts = textsIn({baked.content.get() + sizeof(Header), counted(header.textBytes)},
                       1 + header.objects + header.notes);
  if (!texts) return damaged(path, "its names cannot be read");
  baked.texts = std::move(*texts);
  return baked;
}

FileFrame frameOf(const Header& header) {
  FileFrame frame;
  if (header.declaredMetres > 0.0) frame.declared.metresPerUnit = header.declaredMetres;
  if (header.declaredUp != 0) frame.declared.up = header.declaredUp == 2 ? UpAxis::Z : UpAxis::Y;
  frame.declared.isOfFormat = header.isOfFormat != 0;
  frame.metresPerUnit = header.metresPerUnit;
  frame.up = header.isZUp != 0 ? UpAxis::Z : UpAxis::Y;
  frame.isUnitAsked = header.isUnitAsked != 0;
  frame.isUpAsked = header.isUpAsked != 0;
  return frame;
}

SceneImportReport reportOf(const Baked& baked) {
  const auto& numbers = baked.header.report;
  return {counted(numbers[0]),
          counted(numbers[1]),
          counted(numbers[2]),
          counted(numbers[3]),
          counted(numbers[4]),
          {baked.texts.end() - static_cast<std::ptrdiff_t>(baked.header.notes), baked.texts.end()}};
}

/// It stands for a file of a model, read in one way.
Result<Done> checkAsked(const std::string& path, const Baked& baked,
                        const SceneImportOptions& options) {
  const FileFrame frame = frameOf(baked.header);
  const auto told = [&](const std::string& found) {
    return Error::in(path, ErrorCode::Mismatch,
                     "was baked with " + inDigits(frame.metresPerUnit, 17) + " m per unit and " +
                         (frame.up == UpAxis::Z ? "z" : "y") + " up; expected the same, found " +
                         found);
  };
  if (options.scale && *options.scale != frame.metresPerUnit) {
    return told(inDigits(*options.scale, 17) + " m per unit");
  }
  if (options.up && *options.up != frame.up) return told(*options.up == UpAxis::Z ? "z" : "y");
  return Done{};
}

/// The source may be gone; if it is there, it is what was baked. Its content is read only where it
/// was written later than the baked file.
Result<Done> checkSource(const std::string& path, const Baked& baked) {
  const std::string& name = baked.texts.front();
  const fs::path beside = fs::path(path).parent_path() / fs::u8path(name).filename();
  std::error_code unknown;
  const auto bytes = fs::file_size(beside, unknown);
  if (unknown) return Done{};
  const Error stale = Error::in(path, ErrorCode::Mismatch,
                                "was baked from " + inQuotes(name) +
                                    ", which has changed since; bake it anew (foretouch scene "
                                    "bake)");
  if (bytes != baked.header.sourceBytes) return stale;
  const auto then = fs::last_write_time(path, unknown);
  const auto now = fs::last_write_time(beside, unknown);
  if (unknown || now <= then) return Done{};
  const auto mark = markOf(beside.string());
  return mark && mark->mark == baked.header.sourceMark ? Result<Done>(Done{}) : stale;
}

Result<Baked> openedAs(const std::string& path, const SceneImportOptions& options) {
  FORETOUCH_TRY(auto baked, opened(path));
  FORETOUCH_CHECK(checkAsked(path, baked, options));
  FORETOUCH_CHECK(checkSource(path, baked));
  return baked;
}

std::vector<std::string> objectsOf(const Baked& baked) {
  const auto first = baked.texts.begin() + 1;
  return {first, first + static_cast<std::ptrdiff_t>(baked.header.objects)};
}

Eigen::Vector3d vectorOf(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

SceneAudit auditOf(const Header& header) {
  const auto& counts = header.audit;
  return {counted(counts[0]),  counted(counts[1]),      counted(counts[2]),
          counted(counts[3]),  vectorOf(header.boxMin), vectorOf(header.boxMax),
          header.shortestEdge, header.longestEdge};
}

/// In which order a triangle's vertices came: the first's place among the sorted ones, and three
/// times that of the second.
std::uint8_t orderOf(const Triangle& came, const Triangle& sorted) {
  std::array<std::uint8_t, 3> place{};
  std::array<bool, 3> isTaken{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::uint8_t at = 0; at < 3; ++at) {
      const bool isIt =
          !isTaken[at] && std::memcmp(came.vertices[k].data(), sorted.vertices[at].data(), 24) == 0;
      if (!isIt) continue;
      isTaken[at] = true;
      place[k] = at;
      break;
    }
  }
  return static_cast<std::uint8_t>(place[0] + 3 * place[1]);
}

void append(std::string& texts, const std::string& text) {
  const auto length = static_cast<std::uint32_t>(text.size());
  texts.append(reinterpret_cast<const char*>(&length), sizeof length);
  texts += text;
}

/// The arrays in the order of Places, with zeros up to each place.
class Pieces {
 public:
  void add(const void* data, std::uint64_t bytes) {
    static constexpr std::array<char, kAlignment> kZeros{};
    if (const std::uint64_t over = size_ % kAlignment; over != 0 && !pieces_.empty()) {
      push({kZeros.data(), counted(kAlignment - over)});
    }
    push({static_cast<const char*>(data), counted(bytes)});
  }
  template <typename Array>
  void add(const Array& array) {
    add(array.data(), array.size() * sizeof(*array.data()));
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::vector<std::string_view>& all() const { return pieces_; }

 private:
  void push(std::string_view piece) {
    pieces_.push_back(piece);
    size_ += piece.size();
  }
  std::vector<std::string_view> pieces_;
  std::uint64_t size_ = sizeof(Header);
};

std::uint64_t checkOf(const Header& header, const Pieces& pieces) {
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  XXH3_64bits_update(&state, reinterpret_cast<const char*>(&header) + kChecked,
                     sizeof header - kChecked);
  for (const std::string_view piece : pieces.all()) {
    XXH3_64bits_update(&state, piece.data(), piece.size());
  }
  return XXH3_64bits_digest(&state);
}

Header headerOf(const ImportedScene& imported, const SceneParts& parts) {
  Header header;
  const FlatBvh::Arrays& tree = parts.bvh.arrays();
  header.triangles = parts.triangles.size();
  header.nodes = tree.nodes.size();
  header.leaves = tree.leaves.size();
  header.objects = parts.objectNames.size();
  header.notes = imported.report.notes.size();
  header.vertexRounding = tree.vertexRounding;
  const SceneAudit& audit = parts.audit;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    header.origin[axis] = parts.origin[i];
    header.boxMin[axis] = audit.boxMin[i];
    header.boxMax[axis] = audit.boxMax[i];
  }
  const std::array<std::size_t, 4> counts{audit.triangles, audit.droppedNonFinite, audit.zeroArea,
                                          audit.duplicates};
  std::copy(counts.begin(), counts.end(), header.audit);
  header.shortestEdge = audit.shortestEdge;
  header.longestEdge = audit.longestEdge;
  const SceneImportReport& report = imported.report;
  const std::array<std::size_t, 5> numbers{report.nodes, report.meshInstances, report.uniqueMeshes,
                                           report.skippedPrimitives, report.skippedFaces};
  std::copy(numbers.begin(), numbers.end(), header.report);
  const FileFrame& frame = imported.frame;
  header.metresPerUnit = frame.metresPerUnit;
  header.declaredMetres = frame.declared.metresPerUnit.value_or(0.0);
  header.isZUp = frame.up == UpAxis::Z ? 1 : 0;
  if (frame.declared.up) header.declaredUp = *frame.declared.up == UpAxis::Z ? 2 : 1;
  header.isOfFormat = frame.declared.isOfFormat ? 1 : 0;
  header.isUnitAsked = frame.isUnitAsked ? 1 : 0;
  header.isUpAsked = frame.isUpAsked ? 1 : 0;
  return header;
}

}  // namespace

bool isBaked(const std::string& path) {
  const FileDescriptor file(openToRead(path));
  std::array<char, 8> found{};
  return file.get() >= 0 && stateOf(file.get()).kind == FileKind::Regular &&
         readSome(file.get(), found.data(), found.size()) == 8 && found == kMagic;
}

Result<LoadedScene> readBaked(const std::string& path, const SceneImportOptions& options) {
  FORETOUCH_TRY(const auto baked, openedAs(path, options));
  const Header& header = baked.header;
  const Places places(header);
  auto parts = std::make_shared<SceneParts>();
  parts->triangles = baked.array<Triangle>(places.triangles, header.triangles);
  parts->objectOf = baked.array<ObjectId>(places.objects, header.triangles);
  parts->objectNames = objectsOf(baked);
  parts->audit = auditOf(header);
  parts->origin = vectorOf(header.origin);
  parts->bvh =
      FlatBvh({baked.array<BvhNode>(places.nodes, header.nodes),
               baked.array<BvhLeaf>(places.leaves, header.leaves),
               baked.array<Cluster>(places.clusters, header.leaves), header.vertexRounding},
              parts->origin);
  parts->takeFlatEdges(FlatEdges(baked.array<std::uint16_t>(places.edges, header.triangles)));
  FORETOUCH_TRY(auto scene, inFile(sceneOf(std::move(parts)), path));
  return LoadedScene{std::move(scene), reportOf(baked), frameOf(header)};
}

Result<ImportedScene> importBaked(const std::string& path, const SceneImportOptions& options) {
  FORETOUCH_TRY(const auto baked, openedAs(path, options));
  const Header& header = baked.header;
  const Places places(header);
  const auto sorted = baked.array<Triangle>(places.triangles, header.triangles);
  const auto objects = baked.array<ObjectId>(places.objects, header.triangles);
  const auto orders = baked.array<std::uint8_t>(places.corners, header.triangles);
  ImportedScene imported{{}, reportOf(baked), frameOf(header)};
  imported.scene.objectNames = objectsOf(baked);
  imported.scene.objectOf.assign(objects.begin(), objects.end());
  imported.scene.triangles.resize(header.triangles);
  for (std::size_t i = 0; i < header.triangles; ++i) {
    const std::size_t first = orders[i] % 3U, second = orders[i] / 3U;
    if (second > 2 || first == second) return damaged(path, "a triangle has no order of vertices");
    const auto& v = sorted[i].vertices;
    imported.scene.triangles[i].vertices = {v[first], v[second], v[3 - first - second]};
  }
  return imported;
}

Result<Done> writeBaked(const std::string& path, const std::string& source,
                        const ImportedScene& imported, const Scene& scene) {
  const SceneParts& parts = scene.parts();
  const auto mark = markOf(source);
  if (!mark) return Error::in(source, ErrorCode::FileUnreadable, "cannot be read");
  std::string texts;
  append(texts, readableText(fs::path(source).filename().u8string(), kMaxObjectNameBytes));
  for (const std::string& name : parts.objectNames) append(texts, name);
  for (const std::string& note : imported.report.notes) append(texts, note);
  std::vector<std::uint8_t> orders;
  orders.reserve(parts.triangles.size());
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    orders.push_back(orderOf(imported.scene.triangles[i], parts.triangles[i]));
  }
  const FlatBvh::Arrays& tree = parts.bvh.arrays();
  Pieces pieces;
  pieces.add(texts);
  pieces.add(parts.triangles);
  pieces.add(tree.nodes);
  pieces.add(tree.leaves);
  pieces.add(tree.clusters);
  pieces.add(parts.objectOf);
  pieces.add(parts.flatEdges().bits());
  pieces.add(orders);
  Header header = headerOf(imported, parts);
  header.textBytes = texts.size();
  header.bytes = pieces.size();
  header.sourceBytes = mark->bytes;
  header.sourceMark = mark->mark;
  header.check = checkOf(header, pieces);
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write({reinterpret_cast<const char*>(&header), sizeof header});
  for (const std::string_view piece : pieces.all()) file.write(piece);
  return file.commit();
}

}  // namespace foretouch::internal
