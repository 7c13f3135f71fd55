#include "bulk/lanes_avx2.hpp"

#include "bulk/choose.hpp"

namespace bitshade::bulk_kernels::avx2 {

chosen choose(const plan& p, request r) {
  const chosen narrow = choose_single<lanes32>(p, r);
  return narrow.run ? narrow : choose_double<lanes64>(p, r);
}

chosen choose_native(const encoding& e, const rules& k, request r) { return choose_half<lanes32>(e, k, r); }

}  // namespace bitshade::bulk_kernels::avx2
