#include "tests/fuzz/batch_inputs.h"

#include <string_view>

#include "tests/fuzz/promise.h"
#include "tools/batch/manifest.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::fuzz {

bool feedManifest(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // A pattern over all of the machine takes its time, and finds what no replay of it would find.
  const bool leadsElsewhere = text.find('/') != text.npos && text.find_first_of("*?[") != text.npos;
  if (leadsElsewhere) return false;
  tools::ClipRequest clip;
  tools::WorldRequest world;
  tools::Settings settings;
  addSceneSettings(settings, world);
  addAvatarSetting(settings, clip);
  addMotionSetting(settings, clip, "--motion", "CLIP");
  addRateSetting(settings, clip);
  addClipSettings(settings, clip);
  addQuerySettings(settings, world);
  const auto parsed = tools::parseManifest(text, "input", settings);
  if (!parsed.ok()) {
    checkError(parsed.error(), text);
    return false;
  }
  require(!parsed.value().jobs.empty(), "there is a job");
  require(parsed.value().jobs.size() <= tools::kMaxBatchJobs, "jobs are bounded");
  for (const tools::BatchJob& job : parsed.value().jobs) {
    for (const char* const needed : {"--scene", "--avatar", "--motion"}) {
      require(job.find(needed) != nullptr, "a job has what it needs");
    }
  }
  return true;
}

}  // namespace foretouch::fuzz
