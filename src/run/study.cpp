#include "run/study.hpp"

#include <bit>
#include <chrono>
#include <optional>

#include "io/build.hpp"
#include "io/digest.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/maps.hpp"
#include "run/device_cost.hpp"
#include "run/lookup.hpp"
#include "run/pipeline.hpp"
#include "run/timing.hpp"
#include "scene/limits.hpp"

namespace bitshade {
namespace {

using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point start) {
  return std::chrono::duration<double>(clock::now() - start).count();
}

configuration exact_twin(configuration c) {
  c.format = "exact";
  return c;
}

/// The part of a configuration that decides the truth: the kernel and the footprint.
std::string kernel_of(const configuration& c) {
  std::string text = shortest(c.blur_sigma);
  for (const int n :
       {c.blurred() ? c.blur_taps : 0, static_cast<int>(c.filtered.shape),
        static_cast<int>(c.filter), c.max_anisotropy, c.filtered.msaa, c.filtered.lookups})
    text += "/" + std::to_string(n);
  return text;
}

/// What cells are measured against, kept while neighbouring cells share it.
class references {
 public:
  references(const frame& input, int threads) : input_(input), threads_(threads) {}

  const std::vector<double>& geometric(const configuration& c) {
    prepare(c);
    return geometric_;
  }
  const std::vector<double>& pcf(const configuration& c) {
    prepare(c);
    return pcf_;
  }
  const cell& exact(const configuration& c) {
    const configuration twin = exact_twin(c);
    if (exact_key_ != twin.key()) {
      exact_ = run_pipeline(input_, twin, make_plan(input_, twin, threads_), threads_);
      exact_key_ = twin.key();
    }
    return exact_;
  }
  /// The picture of a single-layer VSM in binary32 with the configuration's filter.
  const std::vector<double>& vsm(const configuration& c) {
    const configuration reference = reference_of(c);
    if (vsm_key_ != reference.key()) {
      vsm_ = run_pipeline(input_, reference, make_plan(input_, reference, threads_), threads_)
                 .visibility;
      vsm_key_ = reference.key();
    }
    return vsm_;
  }

 private:
  void prepare(const configuration& c) {
    if (kernel_ == kernel_of(c)) return;
    // Every technique is held to the same truth, that of the kernel asked for; the hard test
    // is no exception, although it does not filter.
    configuration filtered = c;
    filtered.method = technique::pcf;
    geometric_ = truth_geometric(input_, filtered, threads_);
    pcf_ = truth_pcf(input_, filtered, threads_);
    kernel_ = kernel_of(c);
  }

  const frame& input_;
  int threads_;
  std::string kernel_, exact_key_, vsm_key_;
  std::vector<double> geometric_, pcf_, vsm_;
  cell exact_;
};

void demand_equal_bits(const configuration& c, const cell& planned, const cell& everything,
                       int width) {
  for (std::size_t i = 0; i < planned.visibility.size(); ++i) {
    const auto a = std::bit_cast<std::uint64_t>(planned.visibility[i]);
    const auto b = std::bit_cast<std::uint64_t>(everything.visibility[i]);
    if (a == b) continue;
    const auto x = i % static_cast<std::size_t>(width), y = i / static_cast<std::size_t>(width);
    throw failure("the plan for " + label_of(c) + " left out an effect that matters: pixel (" +
                  std::to_string(x) + ", " + std::to_string(y) + ") is " +
                  shortest(planned.visibility[i]) + " with the plan and " +
                  shortest(everything.visibility[i]) + " with everything; please report it");
  }
}

picture_files input_pictures(const frame& input, references& known, const configuration& c) {
  const int w = input.view_width, h = input.view_height;
  const auto geometric = without_gaps(known.geometric(c)), pcf = without_gaps(known.pcf(c));
  return {{"truth", encode_png(visibility_map(geometric, w, h))},
          {"truth-pcf", encode_png(visibility_map(pcf, w, h))},
          {"shaded", encode_png(shaded_map(input, geometric))},
          {"depth", encode_png(depth_map(input))}};
}

/// Whether a stored row was timed as often and in the way that the request asks for.
bool timed_enough(const row& r, const study_request& request, const configuration& c) {
  return r.repeats >= request.repeats &&
         (!request.natural || c.exact() || r.natural.repeats >= request.repeats);
}

/// The times of a cell whose first run is done; of exact arithmetic, which no device has, once.
void take_times(row& r, const frame& input, const configuration& c, const plan& effects,
                const cell& done, const study_request& request) {
  std::vector<double> map{done.map_seconds}, shade{done.shade_seconds},
      emulation{done.emulation_seconds};
  for (int i = 1; i < request.repeats && !c.exact(); ++i) {
    const cell again = run_pipeline(input, c, effects, request.threads);
    map.push_back(again.map_seconds);
    shade.push_back(again.shade_seconds);
    emulation.push_back(again.emulation_seconds);
  }
  r.repeats = c.exact() ? request.repeats : static_cast<int>(map.size());
  r.map = spread_of(map), r.shade = spread_of(shade), r.emulation = spread_of(emulation);
  r.map_seconds = r.map.median;
  r.shade_seconds = r.shade.median;
  r.emulation_seconds = r.emulation.median;
  if (request.natural && !c.exact())
    r.natural = time_naturally(input, c, effects, request.repeats, request.threads);
}

picture_files cell_pictures(const frame& input, const configuration& c, const cell& done,
                            const std::vector<double>& geometric, const cell& exact) {
  const int w = input.view_width, h = input.view_height;
  const auto seen = without_gaps(done.visibility);
  picture_files files{{"visibility", encode_png(visibility_map(seen, w, h))},
                      {"error", encode_png(error_map(seen, without_gaps(geometric), w, h))}};
  if (!c.exact())
    files["format-error"] = encode_png(error_map(seen, without_gaps(exact.visibility), w, h));
  return files;
}

}  // namespace

std::string digest_of(const frame& input) {
  sha256 d;
  const auto add = [&](const auto& values) {
    d.update_value(static_cast<std::uint64_t>(values.size()));
    d.update(std::as_bytes(std::span(values)));
  };
  for (const int size :
       {input.depth.width, input.depth.height, input.view_width, input.view_height})
    d.update_value(size);
  add(input.depth.texels);
  add(input.surface.texels);
  static_assert(sizeof(receiver) == 11 * 4, "padding would enter the digest");
  add(input.receivers);
  return d.finish();
}

std::string label_of(const configuration& c) {
  const std::string layers = c.method == technique::lvsm ? " " + std::to_string(c.layers) : "";
  return std::string(name_of(c.method)) + layers + " " + c.format;
}

std::string label_of(const row& r) {
  return r.technique + (r.technique == "lvsm" ? " " + std::to_string(r.layers) : "") + " " +
         r.format;
}

std::string cell_key(const std::string& input, const frame& scene, const configuration& c) {
  sha256 d;
  if (c.filtered.msaa > 1 && takes_samples(c.method)) {
    for (const image<float>* depth : depth_maps(scene, c.filtered.msaa))
      d.update(std::as_bytes(std::span(depth->texels)));
  }
  d.update(std::as_bytes(std::span<const char>(input + "\n" + c.key() + "\n" + kernel_of(c) + "\n" + program_version())));
  return d.finish().substr(0, 32);
}

void check_study_memory(const frame& input, const std::vector<configuration>& cells) {
  // Exact arithmetic holds each moment of a texel in 16 bytes, twice while it is blurred; samples
  // are held until they are resolved, in at most 8 bytes each.
  std::uint64_t bytes = 1;
  for (const configuration& c : cells) {
    const int samples = c.filtered.msaa > 1 ? 8 * c.filtered.msaa : 0;
    bytes = std::max(bytes, static_cast<std::uint64_t>(c.channels() * (32 + samples)));
  }
  const auto w = static_cast<std::uint64_t>(input.depth.width);
  const auto h = static_cast<std::uint64_t>(input.depth.height);
  check_memory(w * h * bytes,
               "a study of a map of " + std::to_string(w) + " x " + std::to_string(h) + " texels",
               "ask for a smaller --size");
}

study_result run_study(const frame& input, const study_request& request, database& results,
                       progress& bar) {
  study_result result;
  result.input = digest_of(input);
  references known(input, request.threads);
  bool described = false;
  for (const input_description& d : results.inputs()) described |= d.digest == result.input;

  for (const configuration& c : request.cells) {
    bar.at(input.name + ", " + label_of(c));
    const std::string key = cell_key(result.input, input, c);
    if (!request.verify_plan && described) {
      std::optional<row> stored = results.find(key);
      if (stored && timed_enough(*stored, request, c)) {
        stored->scene = input.name;
        result.rows.push_back(*stored);
        bar.step(false);
        continue;
      }
    }
    if (!described) {
      results.store_input({result.input, input.name, request.description},
                          request.pictures ? input_pictures(input, known, c) : picture_files{});
      described = true;
    }
    const plan effects = make_plan(input, c, request.threads);
    const auto start = clock::now();
    cell done = c.exact() && !request.verify_plan
                    ? known.exact(c)
                    : run_pipeline(input, c, effects, request.threads);
    const double planned_seconds = seconds_since(start);
    if (request.verify_plan) {
      const auto again = clock::now();
      const cell all = run_pipeline(input, c, effects.everything(), request.threads);
      result.verified.push_back({label_of(c), planned_seconds, seconds_since(again)});
      demand_equal_bits(c, done, all, input.view_width);
    }

    row r;
    r.key = key;
    r.scene = input.name;
    r.input = result.input;
    r.technique = name_of(c.method);
    r.format = c.format;
    r.layers = c.method == technique::lvsm ? c.layers : 1;
    r.configuration = c.key();
    r.version = program_version();
    const cell& exact = known.exact(c);
    const auto &geometric = known.geometric(c), &pcf = known.pcf(c);
    r.figures = measure(input, {done.visibility, exact.visibility, geometric, pcf, done.layer});
    r.vsm_difference = compare(done.visibility, known.vsm(c));
    r.bytes_per_texel = done.bytes_per_texel;
    r.samples = done.samples;
    r.threads = request.threads;
    r.device = device_cost_of(input, c, effects, done.bytes_per_texel);
    take_times(r, input, c, effects, done, request);
    r.splits = done.splits;
    r.effects = done.effects;
    r.notes = done.notes;

    // SQLite keeps no sign of zero: none may enter, or a resumed run would print another one.
    each_column(r, [](const std::string&, column_kind, auto& value) {
      if constexpr (std::is_same_v<decltype(value), double&>) value += 0.0;
    });

    picture_files files =
        request.pictures ? cell_pictures(input, c, done, geometric, exact) : picture_files{};
    if (request.shaded) {
      const auto seen = without_gaps(done.visibility);
      files["shaded"] = encode_png(shaded_map(input, seen));
      files["layers"] = encode_png(layer_map(input, seen, done.layer));
    }
    results.store_cell(r, files);
    result.rows.push_back(r);
    ++result.computed;
    bar.step(true);
  }
  return result;
}

}  // namespace bitshade
