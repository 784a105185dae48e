// bindings/c/contact.h: a contact of the library as one of C.
#pragma once

#include "bindings/c/include/foretouch/foretouch.h"
#include "middleware/contact.h"
#include "middleware/scene/scene.h"

namespace foretouch::c {

/// But for its size.
[[nodiscard]] ft_contact contactOf(const LinkContact& contact, const Scene& scene);
/// Of two own links: the other link's triangle is none of the scene's.
[[nodiscard]] ft_contact contactOf(PairContact contact, const Scene& scene);

}  // namespace foretouch::c
