#include "assets/import/protocol.h"

#include <algorithm>
#include <utility>

#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

enum SceneFrame : std::uint32_t { kSceneTotals = 1, kSceneObject, kSceneTriangles, kSceneNote = 7 };

using TriangleBytes = std::array<double, 9>;
constexpr std::size_t kTriangleBytes = sizeof(TriangleBytes);
constexpr std::size_t kTrianglesPerFrame = 8192;
static_assert(kTrianglesPerFrame * kTriangleBytes <= kMaxImportFrameBytes);

}  // namespace

void ImportWriter::totals(const ImportTotals& totals) {
  frame(kSceneTotals, bytesOf(totals));
}

void ImportWriter::note(std::string_view text) {
  frame(kSceneNote, text.substr(0, kMaxImportNoteBytes));
}

void ImportWriter::object(std::string_view name, std::uint64_t triangles) {
  flushTriangles();
  std::string payload(bytesOf(triangles));
  payload += name;
  frame(kSceneObject, payload);
}

void ImportWriter::triangle(const std::array<Eigen::Vector3d, 3>& vertices) {
  TriangleBytes numbers;
  for (std::size_t i = 0; i < 9; ++i) {
    numbers[i] = vertices[i / 3][static_cast<Eigen::Index>(i % 3)];
  }
  pending_ += bytesOf(numbers);
  ++triangles_;
  if (pending_.size() == kTrianglesPerFrame * kTriangleBytes) flushTriangles();
}

void ImportWriter::flushTriangles() {
  if (!pending_.empty()) frame(kSceneTriangles, pending_);
  pending_.clear();
}

bool ImportWriter::finish() {
  flushTriangles();
  return end(triangles_);
}

void ImportReader::parseFrame(std::uint32_t type, std::string_view payload) {
  if ((type == kSceneTotals) == haveTotals_) {
    return breakOff(haveTotals_ ? "totals twice" : "a frame before the totals");
  }
  switch (type) {
    case kSceneTotals: return parseTotals(payload);
    case kSceneNote: return parseNote(payload);
    case kSceneObject: return parseObject(payload);
    case kSceneTriangles: return parseTriangles(payload);
    default: return breakOff("a frame of unknown type " + std::to_string(type));
  }
}

void ImportReader::parseTotals(std::string_view payload) {
  if (payload.size() != sizeof(ImportTotals)) return breakOff("totals of a wrong size");
  totals_ = valueIn<ImportTotals>(payload);
  if (totals_.triangles > kMaxTriangles || totals_.objects > kMaxImportObjects) {
    return breakOff("totals beyond the limits");
  }
  haveTotals_ = true;
  SceneImportReport& report = scene_.report;
  report.nodes = totals_.nodes;
  report.meshInstances = totals_.meshInstances;
  report.uniqueMeshes = totals_.uniqueMeshes;
  report.skippedPrimitives = totals_.skippedPrimitives;
  report.skippedFaces = totals_.skippedFaces;
}

void ImportReader::parseNote(std::string_view payload) {
  std::vector<std::string>& notes = scene_.report.notes;
  if (!scene_.scene.objectNames.empty() || notes.size() == kMaxImportNotes) {
    return breakOff("a note out of place");
  }
  notes.push_back(readableText(payload, kMaxImportNoteBytes));
}

void ImportReader::parseObject(std::string_view payload) {
  if (payload.size() < sizeof(std::uint64_t)) return breakOff("an object of a wrong size");
  if (leftInObject_ != 0) return breakOff("an object that lacks triangles");
  const auto count = valueIn<std::uint64_t>(payload);
  const std::string_view name = payload.substr(sizeof count);
  std::vector<std::string>& names = scene_.scene.objectNames;
  if (count == 0 || count > totals_.triangles - claimedTriangles_ ||
      names.size() >= totals_.objects) {
    return breakOff("more objects or triangles than the totals said");
  }
  names.push_back(readableText(name, kMaxObjectNameBytes));
  nameBytes_ += names.back().size();
  if (nameBytes_ > kMaxImportNameBytes) return breakOff("names beyond the limit");
  claimedTriangles_ += count;
  leftInObject_ = count;
}

void ImportReader::parseTriangles(std::string_view payload) {
  const std::size_t count = payload.size() / kTriangleBytes;
  if (payload.size() % kTriangleBytes != 0) return breakOff("triangles of a wrong size");
  if (count > leftInObject_) return breakOff("more triangles than their object said");
  makeRoomFor(count);
  RawScene& scene = scene_.scene;
  const auto object = static_cast<ObjectId>(scene.objectNames.size()) - 1;
  for (; !payload.empty(); payload.remove_prefix(kTriangleBytes)) {
    const auto numbers = valueIn<TriangleBytes>(payload);
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.vertices[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
    }
    scene.triangles.push_back(triangle);
    scene.objectOf.push_back(object);
  }
  leftInObject_ -= count;
}

/// Doubles like a vector would, but never past the promised total: a full scene ends up without
/// slack, and a false total reserves at most twice the bytes received.
void ImportReader::makeRoomFor(std::size_t triangles) {
  RawScene& scene = scene_.scene;
  const std::size_t needed = scene.triangles.size() + triangles;
  if (needed <= scene.triangles.capacity()) return;
  const std::size_t room = std::min(countOf(totals_.triangles), 2 * needed);
  scene.triangles.reserve(room);
  scene.objectOf.reserve(room);
}

bool ImportReader::isWhole(std::uint64_t count) const {
  const std::size_t received = scene_.scene.triangles.size();
  return haveTotals_ && leftInObject_ == 0 && received == totals_.triangles && received == count &&
         scene_.scene.objectNames.size() == totals_.objects;
}

}  // namespace foretouch::internal
