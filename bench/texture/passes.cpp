#include "texture/passes.hpp"

namespace bench {
namespace {

constexpr double scaling_limit = 1 / 0.9;
const std::string both = ", two cores";

/// What tells rows with cold caches from those that meet the other rows' leavings.
std::string kept(bool cold) { return cold ? ", cold" : ""; }

void add_both(table& table, const std::string& group, const std::string& name, std::size_t elements,
              const std::function<void(int)>& work) {
  for (const bool cold : {false, true}) {
    const std::string one = name + kept(cold);
    table.add({group, one, elements, [=] { work(1); }, {}, "", 0, {}, cold});
    table.add({group, one + both, elements, [=] { work(2); }, {}, one, 0, {}, cold});
  }
}

template <class T>
void add_copy_of_image(table& table, const std::string& group, int channels) {
  const auto from = make_image<T>(size, size, channels), to = make_image<T>(size, size, channels);
  const auto work = [=](int threads) {
    on_threads(threads, size, [&](int first, int last) {
      const auto n = static_cast<std::size_t>(last - first) * from->row_size() * sizeof(T);
      std::memcpy(to->row(first).data(), from->row(first).data(), n);
    });
  };
  add_both(table, group, copy_of(8 * sizeof(T)), from->texels.size(), work);
}

}  // namespace

bulk::execution on(int threads) {
  static bulk::workers two(2);
  return {.crew = threads == 1 ? nullptr : &two};
}

void on_threads(int threads, int n, const std::function<void(int, int)>& work) {
  if (threads == 1) return work(0, n);
  on(threads).crew->run(2, [&](unsigned k) { work(k == 0 ? 0 : n / 2, k == 0 ? n / 2 : n); });
}

void add_copies(table& table, const std::string& group, int channels) {
  add_copy_of_image<float>(table, group, channels);
  add_copy_of_image<std::uint16_t>(table, group, channels);
  constexpr std::size_t bytes = std::size_t{1} << 27;
  static const auto from = std::make_shared<std::vector<char>>(bytes, 'a'),
                    to = std::make_shared<std::vector<char>>(bytes);
  add_both(table, group, "copy of 128 MiB", bytes / 4, [](int threads) {
    constexpr int blocks = 128;
    on_threads(threads, blocks, [](int first, int last) {
      const std::size_t block = bytes / blocks, at = static_cast<std::size_t>(first) * block;
      std::memcpy(to->data() + at, from->data() + at,
                  static_cast<std::size_t>(last - first) * block);
    });
  });
}

void add_pass(table& table, const std::string& group, const std::string& name, double elements,
              const std::function<void(int)>& work, const std::function<std::string()>& check,
              std::size_t bits, double limit) {
  const auto n = static_cast<std::size_t>(elements);
  for (const bool cold : {false, true}) {
    const std::string one = name + kept(cold), copy = copy_of(bits) + kept(cold);
    table.add({group, one, n, [=] { work(1); }, check, copy, limit, {}, cold});
    table.add({group, one + both, n, [=] { work(2); }, check, one, scaling_limit, copy + both,
               cold});
  }
}

}  // namespace bench
