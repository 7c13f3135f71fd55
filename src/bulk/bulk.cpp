#include "bitshade/arithmetic/bulk.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "bulk/dispatch.hpp"
#include "bulk/float_environment.hpp"
#include "bulk/make_plan.hpp"

namespace bitshade::bulk {
namespace {

using bulk_kernels::chosen;
using bulk_kernels::operation;
using bulk_kernels::plan;
using bulk_kernels::request;
using bulk_kernels::setting;

template <class T>
constexpr char letter_of() {
  if constexpr (std::is_same_v<T, float>) return 'f';
  if constexpr (std::is_same_v<T, double>) return 'd';
  return sizeof(T) == 1 ? 'b' : sizeof(T) == 2 ? 'h' : sizeof(T) == 4 ? 'w' : 'q';
}

/// The definition, one element after the other.
template <operation What, class In, class Out>
void define(const plan& p, const void* source, void* target, std::size_t n, std::size_t first) {
  const In* in = static_cast<const In*>(source);
  Out* out = static_cast<Out*>(target);
  const bool draws = p.direction == rounding::stochastic;
  for (std::size_t j = 0; j < n; ++j) {
    const std::uint64_t random = draws ? rounding_bits(p.seed, p.counter + first + j) : 0;
    if constexpr (What == operation::decode) {
      out[j] = static_cast<Out>(decode(p.format, in[j], p.rule));
    } else if constexpr (What == operation::encode) {
      out[j] = static_cast<Out>(encode(p.format, in[j], p.rule, random));
    } else {
      out[j] = static_cast<Out>(round_to(p.format, in[j], p.rule, random));
    }
  }
}

chosen choose(const plan& p, request r, instruction_set set) {
#if defined(BITSHADE_X86_64)
  switch (set) {
    case instruction_set::avx512: return bulk_kernels::avx512::choose(p, r);
    case instruction_set::avx2: return bulk_kernels::avx2::choose(p, r);
    case instruction_set::baseline: return bulk_kernels::sse2::choose(p, r);
    default: break;
  }
#else
  (void)p, (void)r, (void)set;
#endif
  return {};
}

chosen choose_native(const encoding& e, const rules& k, request r, instruction_set set) {
#if defined(BITSHADE_X86_64)
  if (set == instruction_set::avx512) return bulk_kernels::avx512::choose_native(e, k, r);
  if (set == instruction_set::avx2) return bulk_kernels::avx2::choose_native(e, k, r);
#else
  (void)e, (void)k, (void)r, (void)set;
#endif
  return {};
}

void run_in(setting wanted, bulk_kernels::kernel k, const plan& p, const void* in, void* out, std::size_t n) {
  if (wanted == setting::any) return k(p, in, out, n);
  constexpr float_environment::direction directions[] = {
      float_environment::direction::nearest, float_environment::direction::down, float_environment::direction::up,
      float_environment::direction::toward_zero};
  const float_environment environment(directions[static_cast<int>(wanted)]);
  k(p, in, out, n);
}

template <class In, class Out>
void run_chosen(const chosen& c, const plan& p, const In* in, Out* out, std::size_t n) {
  if (c.finish == nullptr) return run_in(c.wants, c.run, p, in, out, n);
  constexpr std::size_t block = 2048;  // stays in the first-level cache between the two
  plan part = p;
  for (std::size_t j = 0; j < n; j += block) {
    const std::size_t m = std::min(block, n - j);
    run_in(c.wants, c.run, part, in + j, out + j, m);
    run_in(setting::nearest, c.finish, part, out + j, out + j, m);
    advance(part, m);
  }
}

/// One chunk on one thread.
template <operation What, class In, class Out>
void run(const plan& p, const chosen& direct, const In* in, Out* out, std::size_t n, instruction_set set) {
  if (direct.run) return run_chosen(direct, p, in, out, n);
  if constexpr (What == operation::round) {
    // Encode and decode, a block at a time, where both have kernels.
    constexpr std::size_t block = 512;
    const chosen encoder = choose(p, {operation::encode, letter_of<In>(), 'q'}, set);
    const chosen decoder = choose(p, {operation::decode, 'q', letter_of<Out>()}, set);
    if (encoder.run && decoder.run) {
      std::uint64_t codes[block];
      plan part = p;
      for (std::size_t j = 0; j < n; j += block) {
        const std::size_t m = std::min(block, n - j);
        run_chosen(encoder, part, in + j, codes, m);
        run_chosen(decoder, part, codes, out + j, m);
        advance(part, m);
      }
      return;
    }
  }
  const float_environment environment(float_environment::direction::nearest);
  define<What, In, Out>(p, in, out, n, 0);
}

template <operation What, class In, class Out>
void work(const encoding& e, const rules& r, std::span<const In> in, std::span<Out> out, const execution& how) {
  if (in.size() != out.size()) throw std::invalid_argument("bitshade::bulk: the spans differ in size");
  if (!is_valid(e)) throw std::invalid_argument("bitshade::bulk: the encoding is not valid");
  if (r.random_bits < 1 || r.random_bits > 64) {
    throw std::invalid_argument("bitshade::bulk: random_bits must be 1 to 64");
  }
  constexpr int code_bits = 8 * static_cast<int>(What == operation::encode ? sizeof(Out) : sizeof(In));
  if (What != operation::round && e.width > code_bits) {
    throw std::invalid_argument("bitshade::bulk: the encoding is wider than its codes' type");
  }
  const instruction_set set = resolve(how.set);
  constexpr request wanted{What, letter_of<In>(), letter_of<Out>()};
  plan p;
  chosen direct = choose_native(e, r, wanted, set);
  if (!direct.run) {
    make_plan(p, e, r, how.seed, how.first_counter);
    p.define = define<What, In, Out>;
    direct = choose(p, wanted, set);
  }
  in_chunks(in.size(), how, [&](std::size_t begin, std::size_t n) {
    if (r.direction != rounding::stochastic) {
      return run<What>(p, direct, in.data() + begin, out.data() + begin, n, set);
    }
    // Kernels stay within one stream of random bits.
    constexpr std::uint64_t stream = std::uint64_t{1} << rounding_stream::stream_bits;
    for (const std::size_t end = begin + n; begin < end;) {
      plan part = p;
      advance(part, begin);
      const auto m = static_cast<std::size_t>(std::min<std::uint64_t>(end - begin, stream - part.counter % stream));
      run<What>(part, direct, in.data() + begin, out.data() + begin, m, set);
      begin += m;
    }
  });
}

}  // namespace

void round(const encoding& to, const rules& r, std::span<const float> in, std::span<float> out,
           const execution& how) {
  work<operation::round>(to, r, in, out, how);
}
void round(const encoding& to, const rules& r, std::span<const double> in, std::span<double> out,
           const execution& how) {
  work<operation::round>(to, r, in, out, how);
}

void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint8_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint16_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint32_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint8_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint16_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint32_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint64_t> out,
            const execution& how) {
  work<operation::encode>(to, r, in, out, how);
}

void decode(const encoding& from, const rules& r, std::span<const std::uint8_t> in, std::span<float> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint16_t> in, std::span<float> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint32_t> in, std::span<float> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint8_t> in, std::span<double> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint16_t> in, std::span<double> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint32_t> in, std::span<double> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}
void decode(const encoding& from, const rules& r, std::span<const std::uint64_t> in, std::span<double> out,
            const execution& how) {
  work<operation::decode>(from, r, in, out, how);
}

}  // namespace bitshade::bulk
