#include "bulk/choose.hpp"
#include "bulk/lanes_sse2.hpp"

namespace bitshade::bulk_kernels::sse2 {

chosen choose(const plan& p, request r) { return choose_single<lanes32>(p, r); }

}  // namespace bitshade::bulk_kernels::sse2
