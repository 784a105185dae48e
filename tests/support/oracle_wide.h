// tests/support/oracle_wide.h: fifty digits, for what long double cannot tell.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace foretouch::oracle {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

}  // namespace foretouch::oracle
