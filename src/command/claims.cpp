// `bitshade claims`: each claim of the sources measured, bounded, and given its verdict.
#include "claims/claim.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
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
#include "run/progress.hpp"

namespace bitshade::command {
namespace {

using namespace claims;

/// The scale of --quick: fewer random cases, smaller pictures.
constexpr double quick_scale = 0.1;

struct options {
  std::vector<std::string> ids;
  std::uint64_t seed = 1;
  int threads = 0;
  bool quick = false, json = false;
  std::string replay, markdown;
};

void replay(const options& given, const std::vector<claim>& chosen) {
  if (given.ids.size() != 1)
    throw usage_error("--replay evaluates a case of one claim: name it, as in claims C5 --replay");
  const claim& c = chosen.front();
  if (c.replayed == nullptr)
    throw usage_error(std::string("claim ") + c.id +
                      " is measured on pictures or times and has no single case to replay");
  const sample s = parse_sample(c.replayed->names, given.replay);
  const evaluation e = c.replayed->evaluate(library_method(), s);
  if (given.json)
    std::cout << json_of(s, e).dump(1) << '\n';
  else
    std::cout << text_of(s, e);
}

void run_claims(const options& given) {
  const std::vector<claim> chosen = claims_named(given.ids);
  if (!given.replay.empty()) return replay(given, chosen);

  laboratory lab(library_method(), {given.seed, given.quick ? quick_scale : 1, given.threads});
  std::string command = "bitshade claims";
  for (const std::string& id : given.ids) command += " " + id;
  if (given.seed != 1) command += " --seed " + std::to_string(given.seed);
  if (given.quick) command += " --quick";
  const report_origin origin{command, program_version(), machine_description()};

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
  if (!given.markdown.empty()) write_file(given.markdown, markdown_of(all, origin));
  if (given.json)
    std::cout << json_of(all, origin).dump(1) << '\n';
  else
    std::cout << summary_text(all) << "* a time or a ratio of times: differs from run to run\n";
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
  command->add_flag("--quick", given->quick, "A tenth of the cases and of the pictures' pixels");
  command->add_option("--markdown", given->markdown, "Also write all of it as a page")
      ->option_text("FILE");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Examples:\n"
      "  bitshade claims\n"
      "  bitshade claims C5 C12 --seed 7\n"
      "  bitshade claims C5 --replay \"x=0,1 t=2/3 splits=1/2\"");
  command->callback([given] { run_claims(*given); });
}

}  // namespace bitshade::command
