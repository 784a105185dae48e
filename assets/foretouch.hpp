// foretouch/foretouch.hpp: what most programs need, in one line: files in, first contacts out. A
// program that reads no files links foretouch::middleware and calls nothing of assets/; one that
// does links foretouch::assets. (foretouch/foretouch.h, beside it, is the C interface.)
#pragma once

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/pose.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_avatar.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/clip/clip_file.h"
#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "assets/mesh/link_mesh.h"
#include "assets/model/model_avatar.h"
#include "assets/model/model_clip.h"
#include "middleware/object_policies.h"
#include "middleware/query/near_features.h"
#include "middleware/query/query.h"
#include "middleware/query/query_pool.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_avatar.h"
#include "middleware/surface/avatar_surface.h"
