#include "bulk/half_arithmetic.hpp"

#include "bulk/lanes_avx2.hpp"

namespace bitshade::bulk_kernels::avx2 {

void half_arithmetic(half_operation what, const half_operands& o, std::size_t n) { half_loops<lanes32>(what, o, n); }

}  // namespace bitshade::bulk_kernels::avx2
