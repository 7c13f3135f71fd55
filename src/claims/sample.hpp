// Cases of an experiment as a few named lists of exact numbers: drawn at random, written, read
// back.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "claims/number.hpp"
#include "scene/random.hpp"

namespace bitshade::claims {

/// What a number means, and so which values it may have and how it becomes simpler.
///
///   share   any rational in [0,1]: depths, coverages
///   grid    a multiple of 2^-24 in [0,1], which binary64 holds: splits, overlaps, floors
///   whole   a whole number from 1 to 16
enum class quantity { share, grid, whole };

/// One named list of numbers, `least` to `most` of them; equal ends make a fixed list.
struct parameter {
  std::string_view name;
  quantity what = quantity::share;
  std::size_t least = 1, most = 1;
};
using shape = std::vector<parameter>;

/// The numbers of one case, a list a parameter, in the shape's order.
class sample {
 public:
  explicit sample(const shape& names) : names_(&names), lists_(names.size()) {}

  const shape& names() const { return *names_; }
  const std::vector<number>& list(std::string_view name) const { return lists_[at(name)]; }
  std::vector<number>& list(std::string_view name) { return lists_[at(name)]; }
  const number& operator[](std::string_view name) const { return list(name).front(); }
  /// The number as binary64, which is exact for quantity::grid and whole.
  double real(std::string_view name) const { return static_cast<double>((*this)[name]); }
  std::vector<double> reals(std::string_view name) const;

  std::vector<number>& at_index(std::size_t i) { return lists_[i]; }
  const std::vector<number>& at_index(std::size_t i) const { return lists_[i]; }

  friend bool operator==(const sample& a, const sample& b) { return a.lists_ == b.lists_; }

 private:
  std::size_t at(std::string_view name) const;

  const shape* names_;
  std::vector<std::vector<number>> lists_;
};

/// A case at random: ends and ties are as likely as anything between.
sample draw(const shape& names, random_stream& random);

/// "2/3", "0", "1": how numbers are printed and given back.
std::string text_of(const number& x);
/// "x=0,1 t=2/3 splits=1/2".
std::string text_of(const sample& s);

/// The case that a text names; fractions and decimals are taken exactly.
///
/// Failure  usage_error that names the word and the cure.
sample parse_sample(const shape& names, std::string_view text);

}  // namespace bitshade::claims
