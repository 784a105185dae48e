#include "middleware/triggers/triggers.h"

#include <gtest/gtest.h>
