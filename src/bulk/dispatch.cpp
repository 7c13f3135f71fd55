#include "bulk/dispatch.hpp"

#include <stdexcept>

#if defined(BITSHADE_X86_64)
#include <cpuid.h>
#endif

namespace bitshade::bulk {

#if defined(BITSHADE_X86_64)
namespace {

/// CPUID leaf 1: clang 16's __builtin_cpu_supports does not know F16C by name. Asked once: on a virtual machine the
/// instruction traps, which takes as long as rounding thousands of numbers.
bool has_f16c() {
  static const bool found = [] {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
  }();
  return found;
}

}  // namespace
#endif

bool has(instruction_set set) {
  switch (set) {
    case instruction_set::best:
    case instruction_set::scalar: return true;
#if defined(BITSHADE_X86_64)
    case instruction_set::baseline: return true;
    case instruction_set::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && has_f16c();
    case instruction_set::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("fma") && has_f16c();
#else
    default: return false;
#endif
  }
  return false;
}

instruction_set resolve(instruction_set set) {
  if (!has(set)) throw std::invalid_argument("bitshade::bulk: this processor lacks that instruction set");
  if (set != instruction_set::best) return set;
  static const instruction_set widest = has(instruction_set::avx512)     ? instruction_set::avx512
                                        : has(instruction_set::avx2)     ? instruction_set::avx2
                                        : has(instruction_set::baseline) ? instruction_set::baseline
                                                                         : instruction_set::scalar;
  return widest;
}

}  // namespace bitshade::bulk
