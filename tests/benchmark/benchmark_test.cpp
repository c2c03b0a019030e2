// The benchmark's data and arithmetic. Nothing here is timed.
#include <gtest/gtest.h>

#include "measure.hpp"
