#include "texture/blur_choose.hpp"
#include "texture/lanes_avx2.hpp"
#include "texture/mip_rows.hpp"
#include "texture/sample_rows.hpp"
#include "texture/sample_choose.hpp"
#include "texture/sat_bands.hpp"

namespace bitshade::texture_kernels::avx2 {

const kernels all{blur_in<lanes>, mip_in<lanes>, sat_in<lanes>, sample_in<lanes>, certify_in<lanes>};

}  // namespace bitshade::texture_kernels::avx2
