// `bitshade claims`: each claim of the sources measured, bounded, and given its verdict.
#include "claims/claim.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "claims/laboratory.hpp"
#include "claims/report.hpp"
#include "command/commands.hpp"
#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/html.hpp"
#include "run/progress.hpp"

namespace bitshade::command {
namespace {

using namespace claims;

/// What --quick leaves of the random cases. Pictures stay: their verdicts must not change.
constexpr double quick_cases = 0.1;

struct options {
  std::vector<std::string> ids;
  std::uint64_t seed = 1;
  int threads = 0;
  bool quick = false, json = false;
  std::string replay, out;
};

void replay(const options& given, const std::vector<claim>& chosen) {
  if (given.ids.size() != 1)
    throw usage_error("--replay evaluates a case of one claim: name it, as in claims C5 --replay");
  const auto all = claims::replay(chosen.front(), library_method(), given.replay);
  if (given.json)
    std::cout << json_of(all).dump(1) << '\n';
  else
    std::cout << text_of(all);
}

void write_pages(const std::filesystem::path& folder, std::span<const claim_report> all,
                 const report_origin& origin) {
  const report_head head{origin.command,
                         origin.version,
                         compiler_description(),
                         origin.machine,
                         origin.seed,
                         "What the sources of layered variance shadow maps claim, and what is so.",
                         "claims.json beside this page"};
  write_file(folder / "claims.md", markdown_of(all, origin));
  write_file(folder / "claims.json", json_of(all, origin).dump(1) + "\n");
  write_file(folder / "claims.html",
             html_page(head, "The claims of the sources, put to the test", html_of(all)));
}

void run_claims(const options& given) {
  const std::vector<claim> chosen = claims_named(given.ids);
  if (!given.replay.empty()) return replay(given, chosen);

  laboratory lab(library_method(), {given.seed, given.quick ? quick_cases : 1, 1, given.threads});
  std::string command = "bitshade claims";
  for (const std::string& id : given.ids) command += " " + id;
  if (given.seed != 1) command += " --seed " + std::to_string(given.seed);
  if (given.quick) command += " --quick";
  const report_origin origin{command, program_version(), machine_description(),
                             std::to_string(given.seed)};

  if (!given.out.empty()) make_output_folder(given.out);
  std::vector<claim_report> all;
  progress bar;
  bar.begin(chosen.size());
  for (const claim& c : chosen) {
    bar.at(std::string(c.id) + ", " + c.sentence);
    const auto start = std::chrono::steady_clock::now();
    outcome found = c.measure(lab);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    all.push_back({c, std::move(found), took.count()});
    bar.step(true);
    if (!given.json) {
      bar.end();
      std::cout << text_of(all.back()) << '\n' << std::flush;
    }
  }
  bar.end();
  if (!given.out.empty()) write_pages(given.out, all, origin);
  if (given.json)
    std::cout << json_of(all, origin).dump(1) << '\n';
  else
    std::cout << summary_text(all) << "* a time or a ratio of times: differs from run to run\n";
  if (!given.out.empty() && !given.json)
    std::cout << "The page is " << (std::filesystem::path(given.out) / "claims.html").string()
              << "; claims.md and claims.json lie beside it.\n";
}

}  // namespace

void add_claims(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "claims",
      "The sources' claims C1 to C29: measured, bounded, judged\n"
      "Puts each claim of the sources to the test and computes a verdict from the figures: holds, "
      "holds if (with the condition found), fails (with the smallest counterexample found), or "
      "undecidable here. Exact arithmetic separates what is true of the method from what a format "
      "adds.");
  command->add_option("CLAIM", given->ids, "Which claims, C1 to C29; all where none is named");
  command
      ->add_option("--replay", given->replay,
                   "Evaluate one case of one claim exactly, as a counterexample names it")
      ->option_text("NUMBERS");
  command->add_option("--seed", given->seed, "Seed of the random cases and scenes")
      ->capture_default_str()
      ->option_text("N");
  command
      ->add_option("--threads", given->threads,
                   "Threads to use, 0 for all cores (figures are the same, times are not)")
      ->capture_default_str()
      ->check(CLI::Range(0, 4096))
      ->option_text("N");
  command->add_flag("--quick", given->quick, "A tenth of the random cases; pictures as ever");
  command->add_option("--out", given->out, "Folder for claims.html, claims.md and claims.json")
      ->option_text("DIR");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Examples:\n"
      "  bitshade claims\n"
      "  bitshade claims C5 C12 --seed 7\n"
      "  bitshade claims C5 --replay \"x=0,1 t=2/3 splits=1/2\"");
  command->callback([given] { run_claims(*given); });
}

}  // namespace bitshade::command
