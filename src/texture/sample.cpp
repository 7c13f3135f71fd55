#include <limits>
#include <numeric>
#include <optional>

#include "bitshade/texture/bulk_sampling.hpp"
#include "bulk/float_environment.hpp"
#include "texture/dispatch.hpp"

namespace bitshade::bulk {

namespace {

using texture_kernels::axis_lookup;
using texture_kernels::blend;
using texture_kernels::certify_job;
using texture_kernels::grid;
using texture_kernels::sample_job;
using texture_kernels::texels;

struct sampling {
  const filter_model& model;
  const sampler_state& state;
};

/// The definition of an axis, for samples at an edge.
template <class T>
axis_lookup define(const sample_job& job, float coordinate, bool vertical) {
  const auto& how = *static_cast<const sampling*>(job.context);
  const auto at =
      locate_axis<T>(how.model, static_cast<T>(coordinate), vertical ? job.height : job.width,
                     vertical ? how.state.v : how.state.u);
  return {at.i0, at.i1, static_cast<double>(at.weight)};
}

/// What kernels there are for, or nothing.
std::optional<std::pair<grid, blend>> kernel_of(const filter_model& model) {
  const bool weights = model.weight_bits == 8 && model.weight_snap == snap::nearest;
  const bool snaps = model.grid_bits != 0 && model.grid_snap != snap::none;
  if (model.rounding == intermediate::result) {
    if (model.order == accumulation::four_products && weights && !snaps &&
        model.rounded_to == binary32::value) {
      return std::pair{grid::weights, blend::products};
    }
    return std::nullopt;
  }
  if (model.rounding != intermediate::none || (model.weight_bits > 0 && model.weight_snap != snap::none))
    return std::nullopt;
  if (model.order == accumulation::lerp_fma && !snaps) return std::pair{grid::none, blend::fma};
  if (model.order != accumulation::lerp_mul_add) return std::nullopt;
  if (!snaps) return std::pair{grid::none, blend::mul_add};
  if (model.grid_bits != 8 || model.snap_before_centring) return std::nullopt;
  return std::pair{model.grid_snap == snap::floor ? grid::floor : grid::nearest, blend::mul_add};
}

template <class Texel>
sample_job job_of(const image<Texel>& level, std::span<const float> u, std::span<const float> v,
                  std::span<float> out) {
  if (u.size() != v.size() || out.size() != u.size() * static_cast<std::size_t>(level.channels))
    throw std::invalid_argument("bitshade::bulk: the samples' spans do not fit each other");
  sample_job job{};
  job.in = level.texels.data();
  job.width = level.width;
  job.height = level.height;
  job.channels = level.channels;
  job.u = u.data();
  job.v = v.data();
  job.out = out.data();
  job.n = u.size();
  return job;
}

/// Places are 32-bit integers, and coordinates' texels exact in binary32.
bool fits(const sample_job& job) {
  constexpr std::size_t most = std::numeric_limits<int>::max() / 4;
  return (job.channels == 1 || job.channels == 2) && job.width < (1 << 19) &&
         job.height < (1 << 19) &&
         static_cast<std::size_t>(job.width) * static_cast<std::size_t>(job.height) * 2 < most;
}

template <class Texel>
bool run_kernel(const filter_model& model, texels kind, const image<Texel>& level,
                const sampler_state& state, sample_job job, instruction_set set) {
  const auto* kernels = kernels_of(set);
  const auto chosen = kernel_of(model);
  if (!kernels || !chosen || !state.linear || level.texels.empty() || !fits(job)) return false;
  const sampling context{model, state};
  job.kind = kind;
  job.snapped = chosen->first;
  job.order = chosen->second;
  job.border[0] = static_cast<float>(state.border[0]);
  job.border[1] = static_cast<float>(state.border[1]);
  const bool wide = chosen->second == blend::products;
  // Codes are filtered as integers there; a border is a number.
  const auto is_bordered = [](address mode) { return mode == address::border; };
  if (wide && (is_bordered(state.u) || is_bordered(state.v))) return false;
  job.define = wide ? define<double> : define<float>;
  job.context = &context;
  const float_environment environment(float_environment::direction::nearest);
  return kernels->sample(job);
}

/// binary64, and in it the end of intermediate::result, as device_sampler has them.
template <class T>
void run_template(const filter_model& model, const image<T>& level, const sampler_state& state,
                  std::span<const float> u, std::span<const float> v, std::span<float> out) {
  const auto channels = static_cast<std::size_t>(level.channels);
  const bool rounds = model.rounding == intermediate::result && model.rounded_to != binary32::value;
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      const T value = sample_level<T>(model, level, static_cast<T>(u[i]), static_cast<T>(v[i]),
                                      state, static_cast<int>(c));
      out[i * channels + c] = static_cast<float>(
          rounds ? static_cast<T>(round_to(model.rounded_to, static_cast<double>(value))) : value);
    }
  }
}

image<double> widened(const image<float>& level) {
  image<double> wide(level.width, level.height, level.channels);
  wide.texels.assign(level.texels.begin(), level.texels.end());
  return wide;
}

/// Both indices and an exact weight, or a NaN where binary64 has none.
axis_lookup define_exact(const sample_job& job, float coordinate, bool vertical) {
  const auto mode = *static_cast<const address*>(job.context);
  const auto at = certified_detail::locate_exactly(
      vertical ? 0.25f : coordinate, vertical ? coordinate : 0.25f, job.width, job.height, mode);
  const auto& taps = at.at;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  if (vertical) return {taps.y0, taps.y1, at.exact ? taps.fy : unknown};
  return {taps.x0, taps.x1, at.exact ? taps.fx : unknown};
}

}  // namespace

void sample(const filter_model& model, const image<float>& level, const sampler_state& state,
            std::span<const float> u, std::span<const float> v, std::span<float> out,
            instruction_set set) {
  const sample_job job = job_of(level, u, v, out);
  if (run_kernel(model, texels::binary32, level, state, job, set)) return;
  if (model.rounding == intermediate::none) return run_template(model, level, state, u, v, out);
  run_template(model, widened(level), state, u, v, out);
}

void sample(const filter_model& model, const texel_code& code, const image<std::uint16_t>& level,
            const sampler_state& state, std::span<const float> u, std::span<const float> v,
            std::span<float> out, instruction_set set) {
  const sample_job job = job_of(level, u, v, out);
  const bool half = is_plain_half(code);
  if ((half || is_plain_unorm16(code)) &&
      run_kernel(model, half ? texels::half : texels::unorm16, level, state, job, set)) {
    return;
  }
  const execution how{.set = set};
  const auto decoded = [&]<class T>(image<T> values) {
    decode(code.format, code.rule, level.texels, std::span(values.texels), how);
    return values;
  };
  const auto width = level.width, height = level.height, channels = level.channels;
  if (model.rounding == intermediate::result)
    return run_template(model, decoded(image<double>(width, height, channels)), state, u, v, out);
  const image<float> loaded = decoded(image<float>(width, height, channels));
  if (model.rounding == intermediate::none) return run_template(model, loaded, state, u, v, out);
  run_template(model, widened(loaded), state, u, v, out);
}

std::vector<std::uint32_t> sample_decided(const exact_source& in, address mode,
                                          std::span<const float> u, std::span<const float> v,
                                          std::span<float> out, instruction_set set) {
  certify_job job{};
  job.lookup = job_of(*in.texels, u, v, out);
  job.lookup.define = define_exact;
  job.lookup.context = &mode;
  job.divisor = in.divisor;
  // bilinear_bounded's, its division by a product with a rounded reciprocal, and the ends' own.
  job.relative_error = (bilinear_bounded_error + 3) * 0x1p-53 * 1.0000001 / in.divisor;
  const auto* kernels = kernels_of(set);
  std::vector<std::uint32_t> undecided(out.size());
  if (kernels && fits(job.lookup) && !in.texels->texels.empty()) {
    job.undecided = undecided.data();
    const float_environment environment(float_environment::direction::nearest);
    if (kernels->certify(job)) {
      undecided.resize(job.count);
      return undecided;
    }
  }
  std::iota(undecided.begin(), undecided.end(), 0u);
  return undecided;
}

}  // namespace bitshade::bulk
