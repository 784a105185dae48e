// bindings/c/contact.h: a contact of the library as one of C.
#pragma once

#include "bindings/c/include/foretouch/foretouch.h"
#include "middleware/contact.h"
#include "middleware/scene/scene.h"

namespace foretouch::c {

/// Fills all but the size.
[[nodiscard]] ft_contact contactOf(const LinkContact& contact, const Scene& scene);
/// For two own links: the other link's triangle is not one of the scene's.
[[nodiscard]] ft_contact contactOf(PairContact contact, const Scene& scene);

}  // namespace foretouch::c
