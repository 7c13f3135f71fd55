// Hardware arithmetic under the name that emulated types have: the pass-through that costs nothing.
#pragma once

#include "bitshade/formats/contract.hpp"

namespace bitshade {

/// A stage that is native is the type itself: no wrapper, no byte, no instruction.
template <class T>
using native = T;

}  // namespace bitshade
