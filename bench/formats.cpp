// Bulk conversion against the raw loops, a memory copy and other people's halves.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "peers/peers.hpp"
#include "raw/loops.hpp"
#include "support/inputs.hpp"
#include "support/table.hpp"

namespace {

using namespace bitshade;
using bulk::instruction_set;

constexpr std::size_t in_cache = 16384;  // 64 KiB in, 64 KiB out: the second level
constexpr std::size_t in_memory = std::size_t{1} << 24;

using shared = bench::shared<float>;

double uniform(std::uint64_t counter) { return static_cast<double>(random_bits(1, counter) >> 11) * 0x1p-53; }

/// [0, 1), as depths are.
shared unit_inputs(std::size_t n) {
  auto a = bench::make_array<float>(n);
  for (std::size_t j = 0; j < n; ++j) a->data[j] = static_cast<float>(uniform(j));
  return a;
}
/// Every exponent of a format, two below its subnormals and two above its largest, both signs.
shared range_inputs(const encoding& e, std::size_t n) {
  auto a = bench::make_array<float>(n);
  const bool binary = e.kind == family::binary;
  const int low = binary ? std::max(min_ulp_exponent(e) - 2, -149) : -20, high = binary ? std::min(bias(e) + 2, 127) : 2;
  for (std::size_t j = 0; j < n; ++j) {
    const int exponent = low + static_cast<int>(random_bits(2, j) % static_cast<std::uint64_t>(high - low + 1));
    const double sign = random_bits(3, j) & 1 ? -1 : 1;
    a->data[j] = static_cast<float>(sign * std::ldexp(1 + uniform(j), exponent));
  }
  return a;
}

std::string difference(const float* in, const float* got, std::size_t n, const encoding& e, const rules& r) {
  for (std::size_t j = 0; j < n; ++j) {
    const float expected = static_cast<float>(round_to(e, in[j], r, rounding_bits(0, j)));
    if (std::bit_cast<std::uint32_t>(got[j]) == std::bit_cast<std::uint32_t>(expected)) continue;
    char text[120];
    std::snprintf(text, sizeof text, "%a gave %a instead of %a", double{in[j]}, double{got[j]}, double{expected});
    return text;
  }
  return {};
}

const char* name_of_set(instruction_set s) { return s == instruction_set::avx512 ? "AVX-512" : s == instruction_set::avx2 ? "AVX2" : "SSE2"; }

struct maker {
  bench::table& table;
  // One for all rows: where it lies in the caches is worth several hundredths.
  shared cache_out = bench::make_array<float>(in_cache), memory_out = bench::make_array<float>(in_memory);

  shared output(std::size_t n) const { return n == in_cache ? cache_out : memory_out; }

  void peer(const std::string& group, const std::string& name, peers::rounder f, const shared& in, const encoding* e,
            std::size_t checked, const std::string& base = {}) const {
    const auto out = output(in->size);
    bench::row r{group, name, in->size, [=] { f(in->data, out->data, in->size); }, {}, base, 0};
    if (e) r.check = [=] {
      f(in->data, out->data, in->size);
      return difference(in->data, out->data, checked, *e, {});
    };
    table.add(std::move(r));
  }

  void ours(const std::string& group, const std::string& name, const encoding& e, const rules& r, instruction_set set,
            const shared& in, const std::string& base, double limit) const {
    if (!bulk::has(set)) return;
    const auto out = output(in->size);
    const auto work = [=] { bulk::round(e, r, in->span(), out->span(), {.set = set}); };
    table.add({group, name + ", " + name_of_set(set), in->size, work,
               [=] { work(); return difference(in->data, out->data, std::min(in->size, in_cache), e, r); }, base,
               limit});
  }
};

void copy(const float* in, float* out, std::size_t n) { std::memcpy(out, in, 4 * n); }

}  // namespace

int main(int argc, char** argv) {
  bench::table table;
  const maker make{table};
  const encoding half = binary16::value;
  const bool avx512 = bulk::has(instruction_set::avx512), avx2 = bulk::has(instruction_set::avx2);

  const auto limits = [&](const std::string& group, const shared& in, const encoding* e) {
    make.peer(group, "copy", copy, in, nullptr, 0);
    if (avx2) make.peer(group, "raw F16C loop", raw_avx2::half_round, in, e, in_cache);
    if (avx512) make.peer(group, "raw AVX-512 loop", raw_avx512::half_round, in, e, in_cache);
  };
  const auto sets = {instruction_set::avx512, instruction_set::avx2, instruction_set::baseline};

  for (const bool whole : {false, true}) {
    const auto in = whole ? range_inputs(half, in_cache) : unit_inputs(in_cache);
    const std::string group = whole ? "half, whole range, in cache" : "half, [0,1), in cache";
    limits(group, in, &half);
    make.ours(group, "bitshade", half, {}, instruction_set::avx512, in, "raw AVX-512 loop", 1.05);
    make.ours(group, "bitshade", half, {}, instruction_set::avx2, in, "raw F16C loop", 1.05);
    make.ours(group, "bitshade", half, {}, instruction_set::baseline, in, "raw F16C loop", 0);
    if (avx2) {
      make.peer(group, "_Float16", peers::float16_round, in, &half, in_cache, "raw F16C loop");
      make.peer(group, "Eigen::half", peers::eigen_round, in, &half, in_cache, "raw F16C loop");
      make.peer(group, "Imath half", peers::imath_round, in, &half, in_cache, "raw F16C loop");
    }
    make.peer(group, "Boost cpp_bin_float<11>, wide exponent", peers::boost_round, in, nullptr, 0, "raw F16C loop");
    make.peer(group, "MPFR", peers::by_mpfr_round, in, &half, in_cache, "raw F16C loop");
  }

  const char* names[] = {"bfloat16", "fp8_e5m2", "fp8_e4m3", "e5m7", "e3m12", "e7m8", "e9m6", "e11m4",
                         "unorm8", "unorm16", "snorm16", "fixed4.12"};
  for (const bool whole : {false, true}) {
    const std::string group = whole ? "other formats, whole range, in cache" : "other formats, [0,1), in cache";
    limits(group, unit_inputs(in_cache), nullptr);
    for (const char* name : names) {
      const encoding e = *parse_encoding(name);
      const auto in = whole ? range_inputs(e, in_cache) : unit_inputs(in_cache);
      for (const auto set : sets) {
        make.ours(group, name, e, {}, set, in, "raw F16C loop",
                  set == instruction_set::avx512 ? 1.4 : set == instruction_set::avx2 ? 2 : 0);
      }
    }
  }

  const struct { const char* name; rounding direction; } directions[] = {
      {"away", rounding::nearest_away}, {"zero", rounding::toward_zero}, {"up", rounding::up},
      {"down", rounding::down}, {"odd", rounding::to_odd}, {"stochastic", rounding::stochastic}};
  for (const bool whole : {false, true}) {
    const std::string group = whole ? "directed, whole range, in cache" : "directed, [0,1), in cache";
    limits(group, unit_inputs(in_cache), nullptr);
    for (const char* name : {"binary16", "bfloat16", "fp8_e4m3", "e9m6", "unorm16", "snorm16"}) {
      for (const auto& d : directions) {
        const encoding e = *parse_encoding(name);
        const auto in = whole ? range_inputs(e, in_cache) : unit_inputs(in_cache);
        for (const auto set : {instruction_set::avx512, instruction_set::avx2}) {
          make.ours(group, std::string(name) + " " + d.name, e, {.direction = d.direction}, set, in, "raw F16C loop", 4);
        }
      }
    }
  }

  {
    const std::string group = "unorm16 exact, in cache";
    const auto in = unit_inputs(in_cache);
    if (avx512) make.peer(group, "rounds twice, AVX-512", raw_avx512::unorm16_twice, in, nullptr, 0);
    if (avx2) make.peer(group, "rounds twice, AVX2", raw_avx2::unorm16_twice, in, nullptr, 0);
    make.ours(group, "bitshade", unorm16::value, {}, instruction_set::avx512, in, "rounds twice, AVX-512", 1.2);
    make.ours(group, "bitshade", unorm16::value, {}, instruction_set::avx2, in, "rounds twice, AVX2", 1.2);
  }

  {
    const std::string group = "2^24 elements";
    const auto in = unit_inputs(in_memory);
    limits(group, in, &half);
    for (const char* name : {"binary16", "bfloat16", "fp8_e4m3", "e5m7", "e9m6", "unorm16", "snorm16", "fixed4.12"}) {
      for (const auto set : {instruction_set::avx512, instruction_set::avx2}) {
        make.ours(group, name, *parse_encoding(name), {}, set, in, "copy", 1.25);
      }
    }
  }
  return table.run(argc, argv);
}
