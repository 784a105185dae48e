// tools/audit/audit_json.h: what checks find, as fields of JSON (docs/formats.md, "Checks as
// JSON").
#pragma once

#include "articulated/avatar.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/scene_import.h"
#include "assets/json_writer.h"
#include "middleware/scene/scene.h"
#include "tools/audit/audits.h"

namespace foretouch::tools {

void writeFields(const AvatarAudit& audit, JsonWriter& out);
void writeFields(const SceneAudit& audit, JsonWriter& out);
void writeFields(const SceneImportReport& report, JsonWriter& out);

/// All objects of the scene, in its order, with their triangles.
void writeObjects(const Scene& scene, JsonWriter& out);
/// All links, in the avatar's order: name, parent, LSS, the file and node of a mesh.
void writeLinks(const Avatar& avatar, JsonWriter& out);
/// How a clip's joints match an avatar's.
void writeMatch(const JointMatch& match, JsonWriter& out);

}  // namespace foretouch::tools
