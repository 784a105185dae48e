// tests/support/oracle_wide.h: thirty-four digits, for what long double cannot tell.
#pragma once

#include <boost/multiprecision/float128.hpp>

namespace foretouch::oracle {

using Wide = boost::multiprecision::float128;

}  // namespace foretouch::oracle
