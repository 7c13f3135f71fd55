#include "bulk/half_arithmetic.hpp"

#include <stdexcept>

#include "bitshade/arithmetic/operations.hpp"
#include "bulk/dispatch.hpp"
#include "bulk/float_environment.hpp"

namespace bitshade::bulk {
namespace {

using bulk_kernels::half_operands;
using bulk_kernels::half_operation;

/// The definition, in integers.
std::uint16_t define(half_operation what, std::uint16_t a, std::uint16_t b, std::uint16_t c) {
  constexpr encoding e = binary16::value;
  const auto code = [](std::uint64_t bits) { return static_cast<std::uint16_t>(bits); };
  switch (what) {
    case half_operation::add: return code(bitshade::add(e, a, b, {}));
    case half_operation::subtract: return code(bitshade::subtract(e, a, b, {}));
    case half_operation::multiply: return code(bitshade::multiply(e, a, b, {}));
    case half_operation::divide: return code(bitshade::divide(e, a, b, {}));
    case half_operation::sqrt: return code(square_root(e, a, {}));
    case half_operation::fma: return code(fused_multiply_add(e, a, b, c, {}));
  }
  return 0;
}

void work(half_operation what, half_codes a, half_codes b, half_codes c, std::span<std::uint16_t> out,
          const execution& how) {
  if (a.size() != out.size() || b.size() != out.size() || c.size() != out.size()) {
    throw std::invalid_argument("bitshade::bulk: the spans differ in size");
  }
  const instruction_set set = resolve(how.set);
  in_chunks(out.size(), how, [=](std::size_t begin, std::size_t n) {
    const half_operands o{a.data() + begin, b.data() + begin, c.data() + begin, out.data() + begin};
    const float_environment environment(what == half_operation::fma ? float_environment::direction::toward_zero
                                                                    : float_environment::direction::nearest);
#if defined(BITSHADE_X86_64)
    if (set == instruction_set::avx512) return bulk_kernels::avx512::half_arithmetic(what, o, n);
    if (set == instruction_set::avx2) return bulk_kernels::avx2::half_arithmetic(what, o, n);
#else
    (void)set;
#endif
    for (std::size_t j = 0; j < n; ++j) o.out[j] = define(what, o.a[j], o.b[j], o.c[j]);
  });
}

}  // namespace

void add(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::add, a, b, a, out, how);
}
void subtract(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::subtract, a, b, a, out, how);
}
void multiply(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::multiply, a, b, a, out, how);
}
void divide(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::divide, a, b, a, out, how);
}
void sqrt(half_codes a, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::sqrt, a, a, a, out, how);
}
void fma(half_codes a, half_codes b, half_codes c, std::span<std::uint16_t> out, const execution& how) {
  work(half_operation::fma, a, b, c, out, how);
}

}  // namespace bitshade::bulk
