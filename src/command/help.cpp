#include "command/help.hpp"

#include <string_view>
#include <vector>

#include "io/nearest.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

constexpr std::size_t page = 80;

/// A term and its description side by side, the description below where the term is long.
std::string entry(const std::string& term, const std::string& description, std::size_t column) {
  std::string out = "  " + term;
  std::size_t at = columns(out);
  if (description.empty()) return out + '\n';
  if (at + 2 > column) {
    out += '\n';
    at = 0;
  }
  for (const std::string& line : wrap(description, page - column)) {
    out += std::string(column - at, ' ') + line + '\n';
    at = 0;
  }
  return out;
}

std::string paragraphs(const std::string& text) {
  std::string out;
  for (const std::string& given : split(text, '\n')) {
    // Lines that begin with blanks are examples: they stand as they are.
    if (given.starts_with(' ')) {
      out += given + '\n';
      continue;
    }
    for (const std::string& line : wrap(given, page)) out += line + '\n';
  }
  return out;
}

class formatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option), 26);
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (is_flag(option)) return "";
    return is_positional_only(option) ? "" : " " + value_name(option);
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    // One manner for all commands: descriptions begin small, unless with a name.
    if (text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' &&
        ((text[1] >= 'a' && text[1] <= 'z') || text[1] == ' '))
      text[0] = static_cast<char>(text[0] - 'A' + 'a');
    if (!is_flag(option) && !option->get_default_str().empty())
      text += " [" + option->get_default_str() + "]";
    return text;
  }
  std::string make_subcommand(const CLI::App* sub) const override {
    // The first sentence suffices in a list.
    const std::string text = sub->get_description();
    return entry(sub->get_name(), split(text, '\n').front(), 12);
  }
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;)
      text.erase(at, 1);
    return text;
  }
  std::string make_description(const CLI::App* app) const override {
    return app->get_description().empty() ? "" : paragraphs(app->get_description()) + '\n';
  }
  std::string make_footer(const CLI::App* app) const override {
    return app->get_footer().empty() ? "" : paragraphs(app->get_footer());
  }

 private:
  static bool is_flag(const CLI::Option* option) {
    return option->get_type_size() == 0 || option->get_expected_max() == 0;
  }
  static bool is_positional_only(const CLI::Option* option) { return !option->nonpositional(); }
  static std::string value_name(const CLI::Option* option) {
    if (!option->get_option_text().empty()) return option->get_option_text();
    const std::string type = option->get_type_name();
    if (type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT"))
      return "N";
    return type.starts_with("TEXT") || type.empty() ? "TEXT" : type;
  }
};

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string suggest_among(std::string_view word, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view best = nearest(word, views);
  return best.empty() ? "" : "; did you mean '" + std::string(best) + "'?";
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() { return std::make_shared<formatter>(); }

std::string explain(const CLI::App& app, int argc, const char* const* argv,
                    const CLI::ParseError& e) {
  const CLI::App* command = nullptr;
  std::vector<std::string> commands;
  for (const CLI::App* sub : app.get_subcommands({})) commands.push_back(sub->get_name());

  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--") break;
    const bool is_option = argument.size() > 1 && argument[0] == '-';
    if (!is_option && command == nullptr) {
      for (const CLI::App* sub : app.get_subcommands({}))
        if (sub->check_name(argument)) command = sub;
      if (command == nullptr) {
        const std::string near = suggest_among(argument, commands);
        return "there is no command '" + argument + "'" +
               (near.empty() ? "; 'bitshade --help' lists them" : near);
      }
    } else if (argument.starts_with("--")) {
      const CLI::App& where = command != nullptr ? *command : app;
      const std::string name = argument.substr(0, argument.find('='));
      if (where.get_option_no_throw(name) == nullptr) {
        const std::string page_name =
            command != nullptr ? "bitshade " + command->get_name() : "bitshade";
        const std::string near = suggest_among(name, option_names(where));
        return "'" + page_name + "' has no option " + name +
               (near.empty() ? "; '" + page_name + " --help' lists them" : near);
      }
    }
  }
  if (command == nullptr) return "no command was given; 'bitshade --help' lists them";
  std::string what = e.what();
  if (e.get_name() == "ConversionError") {
    // CLI11 says "Could not convert: --size = abc".
    const std::size_t colon = what.find(": "), equals = what.find(" = ");
    if (colon != std::string::npos && equals != std::string::npos && equals > colon)
      what = what.substr(colon + 2, equals - colon - 2) + ": '" + what.substr(equals + 3) +
             "' is not a number that it can take";
  }
  // CLI11 says "--size: At Most 1 required but received 2".
  constexpr std::string_view once = ": At Most 1 required but received ";
  if (const std::size_t at = what.find(once); at != std::string::npos)
    what.replace(at, once.size(), " may be given once, but stands there ") += " times";
  while (!what.empty() && (what.back() == '.' || what.back() == '\n')) what.pop_back();
  return what + "; see 'bitshade " + command->get_name() + " --help'";
}

}  // namespace bitshade::command
