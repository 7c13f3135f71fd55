#include "texture/dispatch.hpp"

#include "bulk/dispatch.hpp"

namespace bitshade::bulk {

const texture_kernels::kernels* kernels_of(instruction_set set) {
  switch (resolve(set)) {
#if defined(BITSHADE_X86_64)
    case instruction_set::baseline:
      return &texture_kernels::sse2::all;
    case instruction_set::avx2:
      return &texture_kernels::avx2::all;
    case instruction_set::avx512:
      return &texture_kernels::avx512::all;
#endif
    default:
      return nullptr;
  }
}

bool is_plain_half(const texel_code& code) {
  const rules& r = code.rule;
  return code.format == binary16::value && r.direction == rounding::nearest_even &&
         r.overflow == overflow::ieee && r.subnormal == subnormals::preserve &&
         r.nan == nan_payload::keep;
}

bool is_plain_unorm16(const texel_code& code) {
  return code.format == unorm16::value && code.rule.direction == rounding::nearest_even &&
         code.rule.norm == norm_decode{};
}

}  // namespace bitshade::bulk
