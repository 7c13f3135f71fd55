// Mip chains and summed-area tables.
#include "bitshade/texture/sat.hpp"
#include "texture/passes.hpp"

namespace bench {
namespace {

template <class T>
using chain = std::shared_ptr<std::vector<image<T>>>;
template <class T>
chain<T> chain_of(const image<T>& base) {
  auto levels = std::make_shared<std::vector<image<T>>>(1, base);
  while (levels->back().width > 1) {
    const auto& last = levels->back();
    levels->push_back(image<T>(last.width / 2, last.height / 2, last.channels));
  }
  return levels;
}
}  // namespace

/// An element is a value copied: what is read and what is written count half each.
void add_mips(table& table, int channels) {
  const std::string group = "mip chain of 2048^2 x " + std::to_string(channels);
  add_copies(table, group, channels);
  const image<float> base = moments(size, size, channels);
  const auto levels = chain_of(base);
  double moved = 0;
  for (std::size_t l = 1; l < levels->size(); ++l)
    moved += 0.5 * static_cast<double>((*levels)[l - 1].texels.size() + (*levels)[l].texels.size());
  const auto work = [=](int threads) { bulk::fill_mips(*levels, mip_filter::box, on(threads)); };
  add_pass(
      table, group, "binary32", moved, work,
      [=] {
        work(2);
        const auto expected = mip_chain<float>(base, mip_filter::box, [](std::span<float>) {});
        for (std::size_t l = 1; l < expected.size(); ++l)
          if (const auto wrong = difference((*levels)[l], expected[l]); !wrong.empty())
            return wrong;
        return std::string();
      },
      32, native_limit);
  for (const storage& s : storages) {
    const auto codes = chain_of(coded(s.code, base));
    const auto pass = [=](int threads) {
      bulk::fill_mips(s.code, *codes, mip_filter::box, on(threads));
    };
    add_pass(
        table, group, s.name, moved, pass,
        [=] {
          pass(2);
          const auto expected = mip_chain<float>(
              decoded(s.code, codes->front()), mip_filter::box,
              [&](std::span<float> row) { bulk::round(s.code.format, s.code.rule, row, row); });
          for (std::size_t l = 1; l < expected.size(); ++l)
            if (const auto wrong = difference((*codes)[l], coded(s.code, expected[l]));
                !wrong.empty())
              return wrong;
          return std::string();
        },
        16, stored_limit);
  }
}

/// Sums in 32 bits. An element is a binary32 value copied; 16-bit texels in and 32-bit sums out are
/// three quarters of one.
void add_tables(table& table, int channels) {
  const std::string group = "summed-area table, 2048^2 x " + std::to_string(channels);
  add_copies(table, group, channels);
  const auto in = std::make_shared<image<float>>(moments(size, size, channels));
  const auto out = make_image<float>(size, size, channels);
  const auto whole = static_cast<double>(in->texels.size());
  const auto running = [](auto values) {
    return make_sat(std::move(values), sat_order::running, sat_offset::none, [](auto) {}).sums;
  };
  const auto work = [=](int threads) { bulk::sum_area(*in, *out, on(threads)); };
  add_pass(
      table, group, "binary32", whole, work,
      [=] {
        work(2);
        return difference(*out, running(*in));
      },
      32, native_limit);
  const auto half = std::make_shared<image<std::uint16_t>>(coded(storages[0].code, *in));
  const auto halves = [=](int threads) {
    bulk::sum_area(storages[0].code, *half, *out, on(threads));
  };
  add_pass(
      table, group, "half, binary32 sums", 0.75 * whole, halves,
      [=] {
        halves(2);
        return difference(*out, running(decoded(storages[0].code, *half)));
      },
      32, stored_limit);
  const auto codes = std::make_shared<image<std::uint16_t>>(coded(storages[1].code, *in));
  const auto sums = make_image<std::uint32_t>(size, size, channels);
  const auto modular = [=](int threads) { bulk::sum_area(*codes, *sums, on(threads)); };
  add_pass(
      table, group, "unorm16, uint32 sums", 0.75 * whole, modular,
      [=] {
        modular(2);
        image<std::uint32_t> wide(size, size, channels);
        std::copy(codes->texels.begin(), codes->texels.end(), wide.texels.begin());
        return difference(*sums, running(std::move(wide)));
      },
      32, stored_limit);
}

}  // namespace bench
