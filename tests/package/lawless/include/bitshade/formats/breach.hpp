// A header that breaks the include law, so that the test of the law is seen to fail.
#pragma once
#include "bitshade/shadow/chebyshev.hpp"
