// tests/bindings/same_answers.h: expects C's answers to be those of C++, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <foretouch/foretouch.h>
#include <vector>

#include "middleware/query/query.h"

namespace foretouch::test {

/// Unknown depths are 0 in C++, and NaN in C.
void expectSameDepth(double c, bool startsInside, double cxx);
void expectSameVector(const double (&c)[3], const Eigen::Vector3d& cxx);
void expectSame(const ft_contact& c, const LinkContact& cxx, const Scene& scene);
void expectSame(const ft_contact_details& c, const ContactDetails& cxx);

/// Every contact of every link with every object; how many there are.
std::size_t expectSameObjects(const ft_query* query, const StepContacts& step, const Scene& scene,
                              Scope scope);
/// Those of a list, each at its place; how many have details.
int expectSameDetails(ft_query* query, std::int32_t list, const std::vector<LinkContact>& contacts,
                      const Query& question, const ChainMotion& motion);
/// The pose at one t.
void expectSamePose(ft_query* query, const ChainMotion& motion, double t);

}  // namespace foretouch::test
