#include "tests/assets/fbx_writer.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace foretouch::test {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kTicksPerS = 46186158000.0;
constexpr std::array<const char*, 3> kAxes{"X", "Y", "Z"};

std::string vectorProperty(const char* name, const char* type, const char* label, const char* flags,
                           const Vector3d& v) {
  return fmt::format("\t\t\tP: \"{}\", \"{}\", \"{}\", \"{}\",{},{},{}\n", name, type, label, flags,
                     v.x(), v.y(), v.z());
}

std::string modelText(const FbxNode& node, int id) {
  std::string text = fmt::format(
      "\tModel: {}, \"Model::{}\", \"{}\" {{\n\t\tVersion: 232\n\t\tProperties70:  {{\n", id,
      node.name,
      node.hasMesh            ? "Mesh"
      : node.onlooker.empty() ? "LimbNode"
                              : node.onlooker);
  const auto pivot = [&text](const char* name, const Vector3d& v) {
    if (!v.isZero()) text += vectorProperty(name, "Vector3D", "Vector", "", v);
  };
  text += fmt::format("\t\t\tP: \"RotationOrder\", \"enum\", \"\", \"\",{}\n", node.rotationOrder);
  text += "\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",1\n";
  pivot("RotationOffset", node.rotationOffset);
  pivot("RotationPivot", node.rotationPivot);
  pivot("ScalingOffset", node.scalingOffset);
  pivot("ScalingPivot", node.scalingPivot);
  pivot("PreRotation", node.preRotation);
  pivot("PostRotation", node.postRotation);
  text += vectorProperty("Lcl Translation", "Lcl Translation", "", "A", node.translation);
  text += vectorProperty("Lcl Rotation", "Lcl Rotation", "", "A", node.rotation);
  text += vectorProperty("Lcl Scaling", "Lcl Scaling", "", "A", node.scaling);
  return text + "\t\t}\n\t\tShading: T\n\t\tCulling: \"CullingOff\"\n\t}\n";
}

std::string curveText(const FbxCurve& curve, int id) {
  std::string times, values;
  for (const auto& [timeS, value] : curve) {
    times += fmt::format("{}{:.0f}", times.empty() ? "" : ",", timeS * kTicksPerS);
    values += fmt::format("{}{}", values.empty() ? "" : ",", value);
  }
  const std::size_t n = curve.size();
  return fmt::format(
      "\tAnimationCurve: {}, \"AnimCurve::\", \"\" {{\n\t\tDefault: 0\n\t\tKeyVer: 4008\n"
      "\t\tKeyTime: *{} {{\n\t\t\ta: {}\n\t\t}}\n\t\tKeyValueFloat: *{} {{\n\t\t\ta: {}\n\t\t}}\n"
      "\t\tKeyAttrFlags: *1 {{\n\t\t\ta: 4\n\t\t}}\n"
      "\t\tKeyAttrDataFloat: *4 {{\n\t\t\ta: 0,0,0,0\n\t\t}}\n"
      "\t\tKeyAttrRefCount: *1 {{\n\t\t\ta: {}\n\t\t}}\n\t}}\n",
      id, n, times, n, values, n);
}

std::string geometryText(int id) {
  return fmt::format(
      "\tGeometry: {}, \"Geometry::\", \"Mesh\" {{\n\t\tVertices: *9 {{\n\t\t\ta: "
      "0,0,0,1,0,0,0,2,0\n\t\t}}\n\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: 0,1,-3\n\t\t}}\n"
      "\t\tGeometryVersion: 124\n\t}}\n",
      id);
}

/// Objects and their connections, numbered as they come.
class Objects {
 public:
  explicit Objects(const FbxFile& file) {
    for (const FbxNode& node : file.nodes) addNode(node);
    for (std::size_t i = 0; i < file.nodes.size(); ++i) addCurvesOf(file.nodes[i], models_[i]);
    if (layer_ != 0) addStack(file);
  }
  [[nodiscard]] std::string text() const {
    return "Objects:  {\n" + objects_ + "}\nConnections:  {\n" + connections_ + "}\n";
  }

 private:
  void addNode(const FbxNode& node) {
    const int id = next_++;
    models_.push_back(id);
    objects_ += modelText(node, id);
    connect(id, node.parent < 0 ? 0 : models_[static_cast<std::size_t>(node.parent)]);
    if (!node.onlooker.empty()) {
      objects_ += fmt::format(
          "\tNodeAttribute: {}, \"NodeAttribute::\", \"{}\" {{\n\t\tTypeFlags: \"{}\"\n"
          "\t\tProperties70:  {{\n\t\t}}\n\t}}\n",
          next_, node.onlooker, node.onlooker);
      connect(next_++, id);
    }
    if (!node.hasMesh) return;
    objects_ += geometryText(next_);
    connect(next_++, id);
  }
  void addCurvesOf(const FbxNode& node, int model) {
    addCurves(node.translations, "T", "Lcl Translation", node.translation, model);
    addCurves(node.rotations, "R", "Lcl Rotation", node.rotation, model);
    addCurves(node.scalings, "S", "Lcl Scaling", node.scaling, model);
  }
  void addCurves(const FbxCurves& curves, const char* name, const char* property,
                 const Vector3d& usual, int model) {
    if (curves[0].empty() && curves[1].empty() && curves[2].empty()) return;
    if (layer_ == 0) layer_ = next_++;
    const int node = next_++;
    objects_ += fmt::format(
        "\tAnimationCurveNode: {}, \"AnimCurveNode::{}\", \"\" {{\n\t\tProperties70:  {{\n", node,
        name);
    for (Eigen::Index i = 0; i < 3; ++i) {
      objects_ += fmt::format("\t\t\tP: \"d|{}\", \"Number\", \"\", \"A\",{}\n",
                              kAxes[static_cast<std::size_t>(i)], usual[i]);
    }
    objects_ += "\t\t}\n\t}\n";
    connect(node, layer_);
    connect(node, model, property);
    for (std::size_t i = 0; i < 3; ++i) {
      if (curves[i].empty()) continue;
      objects_ += curveText(curves[i], next_);
      connect(next_++, node, std::string("d|") + kAxes[i]);
    }
  }
  void addStack(const FbxFile& file) {
    objects_ += fmt::format("\tAnimationLayer: {}, \"AnimLayer::Base\", \"\" {{\n\t}}\n", layer_);
    const int stack = next_++;
    objects_ += fmt::format("\tAnimationStack: {}, \"AnimStack::Take\", \"\" {{\n", stack);
    if (file.startS != 0.0 || file.stopS != 0.0) {
      objects_ += fmt::format(
          "\t\tProperties70:  {{\n\t\t\tP: \"LocalStart\", \"KTime\", \"Time\", \"\",{:.0f}\n"
          "\t\t\tP: \"LocalStop\", \"KTime\", \"Time\", \"\",{:.0f}\n\t\t}}\n",
          file.startS * kTicksPerS, file.stopS * kTicksPerS);
    }
    objects_ += "\t}\n";
    connect(layer_, stack);
  }
  void connect(int child, int parent, const std::string& property = "") {
    connections_ += property.empty()
                        ? fmt::format("\tC: \"OO\",{},{}\n", child, parent)
                        : fmt::format("\tC: \"OP\",{},{}, \"{}\"\n", child, parent, property);
  }

  std::string objects_, connections_;
  std::vector<int> models_;
  int next_ = 1000, layer_ = 0;
};

double valueAt(const FbxCurve& curve, double timeS) {
  if (timeS <= curve.front().first) return curve.front().second;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto& [t0, v0] = curve[i - 1];
    const auto& [t1, v1] = curve[i];
    if (timeS <= t1) return v0 + (v1 - v0) * (timeS - t0) / (t1 - t0);
  }
  return curve.back().second;
}

/// R = R_last * R_middle * R_first.
Affine3d euler(const Vector3d& degrees, int order) {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
  Affine3d turn = Affine3d::Identity();
  for (const int axis : kOrders[static_cast<std::size_t>(order)]) {
    turn = AngleAxisd(degrees[axis] * (M_PI / 180.0), Vector3d::Unit(axis)) * turn;
  }
  return turn;
}

/// World = T * Roff * Rp * Rpre * R * Rpost^-1 * Rp^-1 * Soff * Sp * S * Sp^-1.
Affine3d frameOf(const FbxNode& node, const Vector3d& t, const Vector3d& r, const Vector3d& s) {
  const auto at = [](const Vector3d& v) { return Affine3d(Eigen::Translation3d(v)); };
  return at(t) * at(node.rotationOffset) * at(node.rotationPivot) * euler(node.preRotation, 0) *
         euler(r, node.rotationOrder) * euler(node.postRotation, 0).inverse() *
         at(-node.rotationPivot) * at(node.scalingOffset) * at(node.scalingPivot) *
         Affine3d(Eigen::Scaling(s)) * at(-node.scalingPivot);
}

}  // namespace

std::string FbxFile::text() const {
  return fmt::format(
             "; FBX 7.4.0 project file\nFBXHeaderExtension:  {{\n\tFBXHeaderVersion: 1003\n"
             "\tFBXVersion: 7400\n}}\nGlobalSettings:  {{\n\tVersion: 1000\n\tProperties70:  {{\n"
             "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",{}\n"
             "\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",1\n"
             "\t\tP: \"FrontAxis\", \"int\", \"Integer\", \"\",{}\n"
             "\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",{}\n"
             "\t\tP: \"CoordAxis\", \"int\", \"Integer\", \"\",0\n"
             "\t\tP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",1\n"
             "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n\t}}\n}}\n",
             upAxis, upAxis == 2 ? 1 : 2, upAxis == 2 ? -1 : 1, unitScaleFactor) +
         Objects(*this).text();
}

std::vector<Affine3d> FbxFile::frames() const {
  std::vector<Affine3d> frames;
  for (const FbxNode& node : nodes) {
    const Affine3d own = frameOf(node, node.translation, node.rotation, node.scaling);
    frames.push_back(node.parent < 0 ? own : frames[static_cast<std::size_t>(node.parent)] * own);
  }
  return frames;
}

std::vector<Affine3d> FbxFile::framesAt(double timeS) const {
  FbxFile still = *this;
  for (FbxNode& node : still.nodes) {
    for (const auto& [curves, value] :
         {std::pair(&node.translations, &node.translation),
          std::pair(&node.rotations, &node.rotation), std::pair(&node.scalings, &node.scaling)}) {
      for (std::size_t i = 0; i < 3; ++i) {
        const FbxCurve& curve = (*curves)[i];
        if (!curve.empty()) (*value)[static_cast<Eigen::Index>(i)] = valueAt(curve, timeS);
      }
    }
  }
  return still.frames();
}

}  // namespace foretouch::test
