#include "support/table.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>

namespace bench {
namespace {

/// Keeps the least time of every benchmark and prints nothing by itself.
class minimum_reporter : public benchmark::BenchmarkReporter {
 public:
  std::map<std::string, double> least;  // nanoseconds an iteration

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& r : runs) {
      if (r.run_type != Run::RT_Iteration) continue;
      const double time = r.real_accumulated_time / static_cast<double>(r.iterations) * 1e9;
      const auto [place, fresh] = least.try_emplace(r.run_name.function_name, time);
      if (!fresh && time < place->second) place->second = time;
    }
  }
};

/// Reads more than caches hold. Nothing is written: what they held has gone to memory when the next row begins.
void fill_caches() {
  static const std::vector<std::uint64_t> other(std::size_t{1} << 24, 1);  // 128 MiB
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < other.size(); i += 8) sum += other[i];  // a line
  benchmark::DoNotOptimize(sum);
}

}  // namespace

int table::run(int argc, char** argv) {
  bool strict = false;
  std::vector<char*> args{argv[0]};
  // Interleaved repetitions, so that noise meets every row alike; flags on the command line come later and win.
  static char interleave[] = "--benchmark_enable_random_interleaving=true";
  static char repetitions[] = "--benchmark_repetitions=50";
  static char least_time[] = "--benchmark_min_time=0.001";
  args.insert(args.end(), {interleave, repetitions, least_time});
  for (int j = 1; j < argc; ++j) {
    if (std::strcmp(argv[j], "--strict") == 0) strict = true;
    else args.push_back(argv[j]);
  }
  int count = static_cast<int>(args.size());
  benchmark::Initialize(&count, args.data());
  if (benchmark::ReportUnrecognizedArguments(count, args.data())) return 1;

  for (const row& r : rows_) {
    const std::string wrong = r.check ? r.check() : std::string();
    if (!wrong.empty()) {
      std::fprintf(stderr, "%s / %s: wrong result: %s\n", r.group.c_str(), r.name.c_str(), wrong.c_str());
      return 1;
    }
    benchmark::RegisterBenchmark((r.group + " / " + r.name).c_str(), [work = r.work, cold = r.cold](benchmark::State& state) {
      for (auto _ : state) {
        if (cold) {
          state.PauseTiming();
          fill_caches();
          state.ResumeTiming();
        }
        work();
        benchmark::ClobberMemory();
      }
    })->UseRealTime();
  }
  minimum_reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);

  const auto find = [&](const std::string& of, const std::string& name) -> const row* {
    for (const row& r : rows_) {
      if (r.group == of && r.name == name && reporter.least.count(of + " / " + name) != 0) return &r;
    }
    return nullptr;
  };
  const auto time = [&](const row& r) {
    return reporter.least.at(r.group + " / " + r.name) / static_cast<double>(r.elements);
  };
  int missed = 0;
  std::string group;
  for (const row& r : rows_) {
    if (find(r.group, r.name) == nullptr) continue;  // filtered out
    if (r.group != group) {
      group = r.group;
      std::printf("\n%-42s %10s %7s %7s\n", group.c_str(), "ns/element", "ratio", "limit");
    }
    std::printf("  %-40s %10.4g", r.name.c_str(), time(r));
    if (const row* base = find(r.group, r.base)) {
      double ratio = time(r) / time(*base);
      const row* beside = find(r.group, r.beside);
      const row* their_base = beside ? find(r.group, beside->base) : nullptr;
      if (their_base) ratio /= time(*beside) / time(*their_base);
      const int digits = ratio < 0.1 ? 5 : 2;
      std::printf(" %7.*f", digits, ratio);
      if (r.limit > 0) {
        const bool met = ratio <= r.limit;
        missed += met ? 0 : 1;
        std::printf(" %7.*f %s", digits, r.limit, met ? "met" : "MISSED");
      }
    }
    std::printf("\n");
  }
  std::printf("\nratio: to the first row of the group that the limit names; %d limits missed\n", missed);
  return strict && missed != 0 ? 2 : 0;
}

}  // namespace bench
