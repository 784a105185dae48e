#include "tests/fuzz/text_inputs.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "assets/model/joint_table.h"
#include "network/wire/wire.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/promise.h"
#include "tools/feet/npz_file.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/npz_arrays.h"
#include "tools/inputs/npz_motion.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/project_file.h"
#include "tools/settings/serve_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::fuzz {
namespace {

std::string textIn(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

bool keepsPromises(const Result<internal::JointTable>& table) {
  if (!table.ok()) {
    checkReason(table.error());
    return false;
  }
  const internal::JointTable& read = table.value();
  require(read.rows.size() >= 2 && read.lines.size() == read.rows.size(), "every row has a line");
  require(std::isfinite(read.frameTimeS) && read.frameTimeS > 0.0, "time goes on");
  require(read.roots.empty() || read.roots.size() == read.rows.size(), "every row has a root");
  for (const RigidPose& root : read.roots) {
    require(root.translation.allFinite() && std::abs(root.rotation.norm() - 1.0) < 1e-9,
            "a root is a rigid pose");
  }
  require(
      std::set<std::string>(read.joints.begin(), read.joints.end()).size() == read.joints.size(),
      "names differ");
  for (const std::vector<double>& row : read.rows) {
    require(row.size() == read.joints.size(), "every joint has a value");
    for (const double value : row) require(std::isfinite(value), "values are finite");
  }
  return true;
}

/// The same arrays in a file that the program writes itself, but for those that nobody could read.
std::string rewritten(const std::string& bytes) {
  const auto arrays = tools::NpzArrays::of(bytes).value();
  tools::NpzFile file;
  for (const std::string& name : arrays.names()) {
    const auto content = arrays.content(name);
    if (content.ok()) file.addContent(name, content.value());
  }
  return file.bytes();
}

}  // namespace

bool feedJointTable(const std::uint8_t* data, std::size_t size) {
  return keepsPromises(internal::parseJointTable(textIn(data, size)));
}

bool feedNpz(const std::uint8_t* data, std::size_t size) {
  JointTableOptions options;
  options.quaternion = QuaternionOrder::Xyzw;
  const std::string bytes = textIn(data, size);
  const auto table = tools::tableFromNpz(bytes, options);
  if (!keepsPromises(table)) return false;
  const auto again = tools::tableFromNpz(rewritten(bytes), options);
  require(again.ok(), "what is written is read");
  require(again.value().joints == table.value().joints && again.value().rows == table.value().rows,
          "and says the same");
  return true;
}

bool feedJointMap(const std::uint8_t* data, std::size_t size) {
  const auto map = tools::parseJointMap(textIn(data, size), "input");
  if (map.ok()) return true;
  checkReason(map.error());
  require(map.error().file == "input", "an error names its file");
  return false;
}

bool feedUrl(const std::uint8_t* data, std::size_t size) {
  const std::string text = textIn(data, size);
  const auto url = parseUdpmUrl(text);
  if (url.ok()) {
    require(!url.value().group.empty() && url.value().port != 0, "a URL leads somewhere");
    require(url.value().ttl >= 0 && url.value().ttl <= 255, "its reach is one");
  } else {
    checkReason(url.error());
  }
  const auto address = tools::parseHttpAddress("--http", text);
  if (!address.ok()) checkReason(address.error());
  const auto network = parseNetwork(text);
  if (!network.ok()) checkReason(network.error());
  const auto view = tools::parseViewAddress("--view", text);
  require(address.ok() || !view.ok(), "an address of the page is one of HTTP");
  return url.ok() || address.ok();
}

bool feedProject(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  tools::WorldRequest world;
  tools::Settings settings;
  tools::addSceneSettings(settings, world);
  const auto taken =
      tools::takeFromProject(file.path(), settings, [](const tools::Setting&) { return false; });
  if (taken.ok()) return true;
  checkReason(taken.error());
  return false;
}

}  // namespace foretouch::fuzz
