#include <CLI/CLI.hpp>
#include <iostream>

#include "command/commands.hpp"
#include "io/error.hpp"

namespace bitshade::command {

int run(int argc, const char* const* argv) {
  CLI::App app{"bitshade: number formats through the whole pipeline of moment shadow maps", "bitshade"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("bitshade ") + BITSHADE_VERSION);
  // (one call a line, in the order of --help)

  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForAllHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::cerr << "bitshade: " << e.what() << "; see 'bitshade --help'\n";
    return 2;
  } catch (const usage_error& e) {
    std::cerr << "bitshade: " << e.what() << '\n';
    return 2;
  } catch (const failure& e) {
    std::cerr << "bitshade: " << e.what() << '\n';
    return 1;
  } catch (const std::bad_alloc&) {
    std::cerr << "bitshade: out of memory: ask for a smaller --size or --view\n";
    return 1;
  } catch (const std::exception& e) {
    std::cerr << "bitshade: " << e.what() << '\n';
    return 1;
  }
}

}  // namespace bitshade::command
