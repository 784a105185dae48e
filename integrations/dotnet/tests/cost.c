/* cost.c: the loop of Cost.cs in C, for the same process: what the border between the two costs. */
#include <foretouch/foretouch.h>

/* Steps through `frames` poses, one after the other in memory, and reads the contacts of each; returns how
 * many these are, or -1. */
__attribute__((visibility("default"))) int64_t cost_loop(ft_query* query, const double* rotations,
                                                         const double* translations, size_t joints,
                                                         size_t frames) {
  static ft_contact contacts[256];
  int64_t found = 0;
  size_t i, count;
  for (i = 0; i < frames; ++i) {
    const ft_pose pose = {sizeof pose, (uint32_t)joints, rotations + 4 * joints * i, translations + 3 * joints * i};
    if (ft_query_step(query, NULL, &pose) != FT_OK) return -1;
    contacts[0].size = sizeof contacts[0];
    if (ft_query_contacts(query, contacts, 256, &count) != FT_OK) return -1;
    found += (int64_t)count;
  }
  return found;
}
