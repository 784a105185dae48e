#include "assets/import/model_records.h"
#include "assets/import/model_stream.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {
namespace {

std::string_view cut(std::string_view name) {
  return name.substr(0, kMaxModelNameBytes);
}

}  // namespace

std::string ModelSize::excess() const {
  const auto check = [](std::uint64_t count, std::uint64_t limit, const char* what) {
    return count <= limit ? "" : "more than " + std::to_string(limit) + " " + what;
  };
  constexpr std::uint64_t kMillion = std::uint64_t{1} << 20;
  for (const std::string& found :
       {check(nodes, kMaxModelNodes, "nodes"), check(lss, 65536, "spheres and capsules"),
        check(meshes, kMillion, "meshes"), check(vertices, 3 * kMaxTriangles, "vertices"),
        check(triangles, kMaxTriangles, "triangles"), check(bones, kMillion, "bones"),
        check(weights, 128 * kMillion, "bone weights"), check(animations, 65536, "animations"),
        check(tracks, kMillion, "animation tracks"), check(keys, 64 * kMillion, "animation keys"),
        check(nameBytes, kMaxImportNameBytes, "bytes of names"),
        check(notes, kMaxModelNotes, "notes"),
        check(mimics, kMaxModelNodes, "joints that follow another")}) {
    if (!found.empty()) return found;
  }
  return "";
}

void ModelWriter::countedFrame(std::uint32_t type, std::string_view payload) {
  frame(type, payload);
  ++frames_;
}

template <typename Record, typename Items, typename Pack>
void ModelWriter::writeAll(std::uint32_t type, const Items& items, Pack pack) {
  constexpr std::size_t kFullFrame = kMaxImportFrameBytes / 2;
  std::string payload;
  for (const auto& item : items) {
    const Record record = pack(item);
    payload += bytesOf(record);
    if (payload.size() < kFullFrame) continue;
    countedFrame(type, payload);
    payload.clear();
  }
  if (!payload.empty()) countedFrame(type, payload);
}

void ModelWriter::writeNode(const ModelNode& node) {
  const std::string_view name = cut(node.name);
  const NodeHead head{recordOf(node.toParent),
                      recordOf(node.axis),
                      node.lowerLimit,
                      node.upperLimit,
                      node.parent,
                      static_cast<std::uint32_t>(node.joint),
                      static_cast<std::uint32_t>(node.lss.size()),
                      static_cast<std::uint32_t>(name.size()),
                      node.isOnlooker ? 1u : 0u,
                      node.fileNode};
  std::string payload(bytesOf(head));
  for (const Lss& lss : node.lss) payload += bytesOf(recordOf(lss));
  payload += name;
  payload += cut(node.jointName);
  countedFrame(kNode, payload);
}

void ModelWriter::writeMesh(const ModelMesh& mesh) {
  std::string payload(
      bytesOf(MeshHead{mesh.vertices.size(), mesh.triangles.size(), mesh.bones.size(), mesh.node}));
  payload += cut(mesh.name);
  countedFrame(kMesh, payload);
  writeAll<VectorRecord>(kVertices, mesh.vertices, [](const auto& v) { return recordOf(v); });
  writeAll<TriangleRecord>(kTriangles, mesh.triangles, [](const auto& t) { return t; });
  for (const ModelBone& bone : mesh.bones) {
    payload = bytesOf(BoneHead{recordOf(bone.meshToBone), bone.weights.size(), bone.node});
    payload += cut(bone.name);
    countedFrame(kBone, payload);
    writeAll<WeightRecord>(kWeights, bone.weights, [](const auto& w) {
      return WeightRecord{w.weight, w.vertex};
    });
  }
}

void ModelWriter::writeTrack(const ModelTrack& track) {
  countedFrame(kTrack, bytesOf(TrackHead{track.positions.size(), track.scales.size(),
                                         track.rotations.size(), track.positionTangents.size(),
                                         track.rotationTangents.size(), track.node}));
  const auto packVector = [](const ModelTrack::VectorKey& key) { return recordOf(key); };
  writeAll<VectorKeyRecord>(kPositions, track.positions, packVector);
  writeAll<VectorKeyRecord>(kScales, track.scales, packVector);
  writeAll<RotationKeyRecord>(kRotations, track.rotations, [](const auto& key) {
    const Quaternion& q = key.value;
    return RotationKeyRecord{key.timeS, q.w(), q.x(), q.y(), q.z()};
  });
  const auto packTangents = [](const auto& tangents) { return recordOf(tangents); };
  writeAll<TangentRecord<3>>(kPositionTangents, track.positionTangents, packTangents);
  writeAll<TangentRecord<4>>(kRotationTangents, track.rotationTangents, packTangents);
}

bool ModelWriter::write(const Model& model) {
  for (const ModelNode& node : model.nodes) writeNode(node);
  for (const ModelMimic& m : model.mimics) {
    countedFrame(kMimic, bytesOf(MimicRecord{m.factor, m.offset, m.node, m.leader}));
  }
  for (const ModelMesh& mesh : model.meshes) writeMesh(mesh);
  for (const ModelAnimation& animation : model.animations) {
    std::string payload(bytesOf(AnimationHead{animation.durationS, animation.tracks.size()}));
    payload += cut(animation.name);
    countedFrame(kAnimation, payload);
    for (const ModelTrack& track : animation.tracks) writeTrack(track);
  }
  for (const std::string& note : model.notes) {
    countedFrame(kNote, std::string_view(note).substr(0, kMaxModelNoteBytes));
  }
  return end(frames_);
}

}  // namespace foretouch::internal
