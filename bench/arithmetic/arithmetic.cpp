// Emulated half in loops against F16C by hand, _Float16 and native binary32. Compiled as a whole for one instruction
// set, as a consumer's program is: bench_arithmetic_avx2 and bench_arithmetic_avx512.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/arithmetic/pack.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "peers/peers.hpp"
#include "raw/loops.hpp"
#include "support/inputs.hpp"
#include "support/table.hpp"

#if defined(__AVX512F__)
namespace raw = raw_avx512;
#else
namespace raw = raw_avx2;
#endif

namespace {

using namespace bitshade;
using floats = pack<float>;
using half = real<binary16>;
/// Several registers a number: the conversions' latency is hidden by the other registers' work.
template <int Registers>
using registers = pack<float, Registers * floats::lanes>;
using wide = registers<4>;  // what emulated formats are fastest in
constexpr std::size_t n = 2048;  // at four bytes a number, two operands and a result fit the first level
constexpr std::size_t lanes = floats::lanes;

std::uint16_t half_bits(double x) { return static_cast<std::uint16_t>(encode(binary16::value, x)); }

/// The same numbers as codes and as carried reals: [1/2, 1) and [1, 2), so that no operation overflows.
struct operands {
  bench::shared<std::uint16_t> a, b, c, out;
  bench::shared<half> ra, rb, rc, rout;
  operands() {
    a = bench::make_array<std::uint16_t>(n), b = bench::make_array<std::uint16_t>(n);
    c = bench::make_array<std::uint16_t>(n), out = bench::make_array<std::uint16_t>(n);
    ra = bench::make_array<half>(n), rb = bench::make_array<half>(n), rc = bench::make_array<half>(n);
    rout = bench::make_array<half>(n);
    for (std::size_t j = 0; j < n; ++j) {
      const auto uniform = [&](std::uint64_t key) { return static_cast<double>(random_bits(key, j) >> 11) * 0x1p-53; };
      a->data[j] = half_bits(0.5 + 0.5 * uniform(1)), b->data[j] = half_bits(1 + uniform(2));
      // Small addends: where the product is a tie of half's, an fma that rounds twice loses them.
      c->data[j] = static_cast<std::uint16_t>((random_bits(3, j) & 0x8000) | 1);
      ra->data[j] = half::from_bits(a->data[j]), rb->data[j] = half::from_bits(b->data[j]);
      rc->data[j] = half::from_bits(c->data[j]);
    }
  }
};

using definition = std::uint64_t (*)(std::uint64_t a, std::uint64_t b, std::uint64_t c);
const encoding f16 = binary16::value;
std::uint64_t define_add(std::uint64_t a, std::uint64_t b, std::uint64_t) { return add(f16, a, b, {}); }
std::uint64_t define_mul(std::uint64_t a, std::uint64_t b, std::uint64_t) { return multiply(f16, a, b, {}); }
std::uint64_t define_div(std::uint64_t a, std::uint64_t b, std::uint64_t) { return divide(f16, a, b, {}); }
std::uint64_t define_sqrt(std::uint64_t a, std::uint64_t, std::uint64_t) { return square_root(f16, a, {}); }
std::uint64_t define_fma(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return fused_multiply_add(f16, a, b, c, {});
}

/// Compares all results with the integer definition.
std::string check(const operands& o, definition define, const std::function<std::uint16_t(std::size_t)>& got) {
  for (std::size_t j = 0; j < n; ++j) {
    const auto expected = static_cast<std::uint16_t>(define(o.a->data[j], o.b->data[j], o.c->data[j]));
    if (got(j) == expected) continue;
    char text[120];
    std::snprintf(text, sizeof text, "0x%04x 0x%04x 0x%04x gave 0x%04x instead of 0x%04x", o.a->data[j], o.b->data[j],
                  o.c->data[j], got(j), expected);
    return text;
  }
  return {};
}

template <class F>
void each_pack(const operands& o, F f) {
  const half *a = o.ra->data, *b = o.rb->data, *c = o.rc->data;
  half* out = o.rout->data;
  for (std::size_t j = 0; j < n; j += wide::lanes) {
    store_pack(f(load_pack<wide>(a + j), load_pack<wide>(b + j), load_pack<wide>(c + j)), out + j);
  }
}
template <class F>
void each_scalar(const operands& o, F f) {
  const half *a = o.ra->data, *b = o.rb->data, *c = o.rc->data;
  half* out = o.rout->data;
  for (std::size_t j = 0; j < n; ++j) out[j] = f(a[j], b[j], c[j]);
}

void arrays(bench::table& table) {
  const auto o = std::make_shared<operands>();
  using loop = void (*)(const std::uint16_t*, const std::uint16_t*, std::uint16_t*, std::size_t);
  const auto codes = [=](std::size_t j) { return o->out->data[j]; };
  const auto reals = [=](std::size_t j) { return o->rout->data[j].bits(); };
  const auto group = [&](const char* name, definition define, loop by_hand, loop compiler, auto f) {
    const std::string title = std::string("half ") + name + ", 2048 elements";
    const auto add = [&](const char* row, std::function<void()> work, auto result, const char* base, double limit) {
      table.add({title, row, n, work, [=] { work(); return check(*o, define, result); }, base, limit});
    };
    add("F16C by hand, half storage", [=] { by_hand(o->a->data, o->b->data, o->out->data, n); }, codes, "", 0);
    add("_Float16", [=] { compiler(o->a->data, o->b->data, o->out->data, n); }, codes, "F16C by hand, half storage", 0);
    add("real<binary16> over packs", [=] { each_pack(*o, f); }, reals, "F16C by hand, half storage", 1.3);
    add("real<binary16>, scalar", [=] { each_scalar(*o, f); }, reals, "_Float16", 1.1);
  };
  group("a + b", define_add, raw::half_add, peers::float16_add, [](auto a, auto b, auto) { return a + b; });
  group("a * b", define_mul, raw::half_mul, peers::float16_mul, [](auto a, auto b, auto) { return a * b; });
  group("a / b", define_div, raw::half_div, peers::float16_div, [](auto a, auto b, auto) { return a / b; });
  group("sqrt a", define_sqrt, raw::half_sqrt, peers::float16_sqrt, [](auto a, auto, auto) { return sqrt(a); });

  const std::string title = "half fma(a, b, c), 2048 elements";
  const auto wrong = [=] { raw::half_fma_twice(o->a->data, o->b->data, o->c->data, o->out->data, n); };
  wrong();
  std::size_t errors = 0;
  for (std::size_t j = 0; j < n; ++j) {
    errors += o->out->data[j] != define_fma(o->a->data[j], o->b->data[j], o->c->data[j]) ? 1 : 0;
  }
  const std::string name = "F16C + FMA, rounds twice: " + std::to_string(errors) + " wrong";
  table.add({title, name, n, wrong, {}, {}, 0});
  const auto work = [=] { each_pack(*o, [](auto a, auto b, auto c) { return fma(a, b, c); }); };
  table.add({title, "real<binary16> over packs", n, work, [=] { work(); return check(*o, define_fma, reals); }, name, 4});
  const auto bulk_work = [=] { bulk::fma(o->a->span(), o->b->span(), o->c->span(), o->out->span()); };
  table.add({title, "bulk::fma, half storage", n, bulk_work,
             [=] { bulk_work(); return check(*o, define_fma, codes); }, name, 4});
}

/// One sample of a moment map: four texels (M1, M2), filtered as texture/bilinear.hpp does it, to light.
///
/// Operation by operation, not moment by moment: a rounding's result is long in coming, and four chains of them are under
/// way at once. Numbered, since g++ keeps arrays of packs of several registers in memory.
template <class T>
T evaluate(const T (&m1)[4], const T (&m2)[4], const T& fx, const T& fy, const T& t, const T& floor) {
  const T dx0 = m1[1] - m1[0], dx1 = m2[1] - m2[0], dx2 = m1[3] - m1[2], dx3 = m2[3] - m2[2];
  const T px0 = fx * dx0, px1 = fx * dx1, px2 = fx * dx2, px3 = fx * dx3;
  const T upper1 = m1[0] + px0, upper2 = m2[0] + px1, lower1 = m1[2] + px2, lower2 = m2[2] + px3;
  const T dy1 = lower1 - upper1, dy2 = lower2 - upper2;
  const T py1 = fy * dy1, py2 = fy * dy2;
  const T mean = upper1 + py1, square = upper2 + py2;
  return chebyshev(mean_and_variance(mean, square), t, floor);
}

constexpr std::size_t samples = 1024;  // eleven inputs and one output of 4 KiB

/// Eleven rows of inputs: four M1, four M2, the two weights, the receiver.
template <class Scalar>
struct sample_rows {
  bench::shared<Scalar> row[11], out = bench::make_array<Scalar>(samples);
  sample_rows() {
    for (int k = 0; k < 11; ++k) row[k] = bench::make_array<Scalar>(samples);
    for (std::size_t j = 0; j < samples; ++j) {
      for (int k = 0; k < 11; ++k) {
        const double u = static_cast<double>(random_bits(static_cast<std::uint64_t>(k), j) >> 11) * 0x1p-53;
        row[k]->data[j] = Scalar(static_cast<float>(u));
      }
      for (int k = 0; k < 4; ++k) row[4 + k]->data[j] = row[k]->data[j] * row[k]->data[j];
    }
  }
  std::array<const Scalar*, 11> pointers() const {
    std::array<const Scalar*, 11> all;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = row[k]->data;
    return all;
  }
};

template <class T, class Load>
T sample(std::size_t j, Load load) {
  const T m1[] = {load(0, j), load(1, j), load(2, j), load(3, j)};
  const T m2[] = {load(4, j), load(5, j), load(6, j), load(7, j)};
  return evaluate(m1, m2, load(8, j), load(9, j), load(10, j), T(0x1p-10f));
}

void one_sample(bench::table& table) {
  const std::string group = "one sample: bilinear, Chebyshev";
  const auto plain = std::make_shared<sample_rows<float>>();
  const auto reals = std::make_shared<sample_rows<real<binary32>>>();
  const auto halves = std::make_shared<sample_rows<half>>();
  const auto over_floats = [=] {
    const auto rows = plain->pointers();
    float* out = plain->out->data;
    for (std::size_t j = 0; j < samples; j += lanes) {
      sample<floats>(j, [&](int k, std::size_t at) { return floats::load(rows[static_cast<std::size_t>(k)] + at); })
          .store(out + j);
    }
  };
  // Flattened: a call in the loop would pass its packs through memory.
  const auto over = [](const auto& rows, auto carrier) __attribute__((flatten)) {
    using P = decltype(carrier);
    using T = decltype(load_pack<P>(rows->out->data));
    const auto in = rows->pointers();
    auto* out = rows->out->data;
    for (std::size_t j = 0; j < samples; j += P::lanes) {
      store_pack(sample<T>(j, [&](int k, std::size_t at) { return load_pack<P>(in[static_cast<std::size_t>(k)] + at); }),
                 out + j);
    }
  };
  const auto agree = [](const auto& rows) {
    using T = std::remove_reference_t<decltype(rows->out->data[0])>;
    for (std::size_t j = 0; j < samples; ++j) {
      const T expected = sample<T>(j, [&](int k, std::size_t at) { return rows->row[k]->data[at]; });
      if (!(expected == rows->out->data[j])) return "sample " + std::to_string(j) + " differs from the scalar";
    }
    return std::string();
  };
  table.add({group, "binary32, pack<float>", samples, over_floats, [=] { over_floats(); return agree(plain); }, {}, 0});
  const auto native = [=] { over(reals, floats()); };
  table.add({group, "real<binary32>: native", samples, native, [=] { native(); return agree(reals); },
             "binary32, pack<float>", 1.02});
  const auto single = [=] { over(halves, floats()); };
  table.add({group, "real<binary16>, one register", samples, single, [=] { single(); return agree(halves); },
             "binary32, pack<float>", 0});
  const auto four = [=] { over(halves, wide()); };
  table.add({group, "real<binary16>, four registers", samples, four, [=] { four(); return agree(halves); },
             "binary32, pack<float>", 3});
  const auto two = [=] { over(halves, registers<2>()); };
  table.add({group, "real<binary16>, two registers", samples, two, [=] { two(); return agree(halves); },
             "binary32, pack<float>", 3});
}

}  // namespace

int main(int argc, char** argv) {
  bench::table table;
  arrays(table);
  one_sample(table);
  return table.run(argc, argv);
}
