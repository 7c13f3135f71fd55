// Buffers of a staged run: native or exact, converted where a stage wants the other.
#pragma once

#include <type_traits>
#include <utility>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// What stands for exact arithmetic beside stages in a format.
using staged_exact = ball<3>;

/// A value for a stage's arithmetic: exact into enclosures, rounded to nearest out of them.
template <class To, class From>
To staged_value(const From& x) {
  if constexpr (std::is_same_v<To, From>) {
    return x;
  } else if constexpr (std::is_same_v<From, staged_exact>) {
    return static_cast<To>(x.nearest());
  } else {
    return To(static_cast<double>(x));
  }
}

/// A map between two stages.
template <class T>
struct staged_image {
  image<T> native;
  image<staged_exact> exact;
  bool in_format = true;

  int width() const { return in_format ? native.width : exact.width; }
  int height() const { return in_format ? native.height : exact.height; }
  const image<T>& as_native() {
    if (!in_format) convert(exact, native), in_format = true;
    return native;
  }
  const image<staged_exact>& as_exact() {
    if (in_format) convert(native, exact), in_format = false;
    return exact;
  }

 private:
  template <class From, class To>
  static void convert(image<From>& from, image<To>& to) {
    to = image<To>(from.width, from.height, from.channels);
    for (std::size_t i = 0; i < from.texels.size(); ++i) {
      to.texels[i] = staged_value<To>(from.texels[i]);
    }
    from = {};
  }
};

}  // namespace bitshade
