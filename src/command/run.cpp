#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "command/commands.hpp"
#include "command/help.hpp"
#include "command/standard_output.hpp"
#include "io/error.hpp"

namespace bitshade::command {
namespace {

void declare(CLI::App& app) {
  app.formatter(help_formatter());
  app.require_subcommand(1);
  app.set_help_flag("-h,--help", "Print this help and leave");
  app.set_version_flag("--version", std::string("bitshade ") + BITSHADE_VERSION,
                       "Print the version and leave");
  app.footer(
      "'bitshade COMMAND --help' says more of each. Results go to standard output,\n"
      "everything else to standard error. Exit status: 0 done, 1 it could not be done,\n"
      "2 the arguments make no sense.");
  // (one call a line, in the order of --help)
  add_study(app);
  add_pareto(app);
  add_advise(app);
  add_merge(app);
  add_claims(app);
  add_render(app);
  add_plan(app);
  add_blame(app);
  add_certify(app);
  add_precision(app);
  add_depth(app);
  add_round(app);
  add_formats(app);
  add_sample(app);
  add_mipmap(app);
  add_convert(app);
}

int complain(int status, const std::string& sentence) {
  std::cerr << "bitshade: " << sentence << '\n';
  return status;
}

}  // namespace

int run(int argc, const char* const* argv) {
  standard_output output;
  CLI::App app{"bitshade says what number formats cost moment shadow maps, in error and in time.",
               "bitshade"};
  try {
    declare(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help and --version
      app.exit(e, std::cout, std::cerr);
    }
    output.finish();
    return 0;
  } catch (const CLI::ParseError& e) {
    return complain(2, explain(app, argc, argv, e));
  } catch (const usage_error& e) {
    return complain(2, e.what());
  } catch (const failure& e) {
    return complain(1, e.what());
  } catch (const std::bad_alloc&) {
    return complain(1, "out of memory: ask for a smaller --size or --view");
  } catch (const std::exception& e) {
    return complain(1, e.what());
  }
}

}  // namespace bitshade::command
