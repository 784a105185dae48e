// judge/hull.h: a convex part of a link, the judge's unit of surface.
#pragma once

#include "judge/vector.h"

namespace foretouch::oracle {

/// A convex part fixed in a link: the hull of two or three points, grown by a radius.
struct Hull {
  int link = 0;
  int count = 2;
  Triangle points;
  double radius = 0.0;
};

}  // namespace foretouch::oracle
