/// The program: one verb per task. Only this folder prints and exits.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/version.h"
#include "engine/base/words.h"
#include "tools/characteristic_verb.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Performance portraits of control loops with dead time: simulate once, ask for ever.

  portrait sweep grids/catalog/huba2022-43.toml -o huba.h5
  portrait query huba.h5 --minimize 'IAE_w + IAE_d' --where 'TV2_ud <= 0.1' --plant K=2,Td=0.5
)";

/// A verb's help leads with its example; in the list of verbs stands its one line, which is kept as its footer.
class VerbFormatter : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App* verb) const override {
    return fmt::format("  {:<16}{}\n", verb->get_name(), verb->get_footer());
  }
  std::string make_footer(const CLI::App*) const override { return "\n"; }
};

std::string command_line(int argc, char** argv) {
  std::string line = "portrait";
  for (int i = 1; i < argc; ++i) {
    const bool plain = std::strpbrk(argv[i], " '\"*<>|&;$()") == nullptr && argv[i][0] != '\0';
    line += plain ? fmt::format(" {}", argv[i]) : fmt::format(" '{}'", argv[i]);
  }
  return line;
}

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// What is wrong with a word, when it is none of the known ones.
std::optional<std::string> unknown(std::string_view kind, const std::string& word,
                                   const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return std::nullopt;
  return fmt::format("unknown {} \"{}\"{}", kind, word, suggestion(word, {known.begin(), known.end()}));
}

/// The first word on the line that the program does not know: a likelier cause than what the parser stumbled over.
std::optional<std::string> unknown_word(const CLI::App& app, std::vector<std::string> line) {
  if (line.empty() || line[0].starts_with("-")) return std::nullopt;
  if (const auto message = unknown("verb", line[0], verb_names(app))) return message;
  const CLI::App* verb = app.get_subcommand(line[0]);
  if (!verb_names(*verb).empty()) {  // portrait plot KIND: one level down
    line.erase(line.begin());
    if (line.empty() || line[0].starts_with("-"))
      return fmt::format("portrait {} needs to know what: {}", verb->get_name(),
                         fmt::join(verb_names(*verb), ", "));
    if (const auto message = unknown("kind of " + verb->get_name(), line[0], verb_names(*verb))) return message;
    verb = verb->get_subcommand(line[0]);
  }
  const std::vector<std::string> known = option_names(*verb);
  for (const std::string& word : line)
    if (word.size() > 2 && word.starts_with("--"))
      if (const auto message = unknown("option", word.substr(0, word.find('=')), known)) return message;
  return std::nullopt;
}

int usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& line) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
    return app.exit(error);  // --help, --version
  if (line.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return kWrongInput;
  }
  print_message(unknown_word(app, line).value_or(error.what()) + "\nTry portrait --help, or portrait VERB --help.");
  return kWrongInput;
}

int run(int argc, char** argv) {
  CLI::App app(kHelp, "portrait");
  app.formatter(std::make_shared<VerbFormatter>());
  app.require_subcommand(1);
  app.set_version_flag("--version", program_version());
  Invocation invocation{command_line(argc, argv)};
  add_sweep(app, invocation);
  add_info(app, invocation);
  add_verify(app, invocation);
  add_merge(app, invocation);
  add_query(app, invocation);
  add_export(app, invocation);
  add_simulate(app, invocation);
  add_characteristic(app, invocation);
  add_plot(app, invocation);
  add_tune(app, invocation);
  add_reproduce(app, invocation);
  add_serve(app, invocation);
  add_report(app, invocation);
  add_shell_verbs(app, invocation);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, {argv + 1, argv + argc});
  }
  return invocation.exit_code;
}

}  // namespace
}  // namespace portrait::tools

int main(int argc, char** argv) {
  using namespace portrait;
  using namespace portrait::tools;
  keep_freed_memory();
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    print_message(error.what());
    return kWrongInput;
  } catch (const IntegrityError& error) {
    print_message(error.what());
    return kBroken;
  } catch (const BrokenPromise& error) {
    print_message(fmt::format("this is a bug in Portrait: {}", error.what()));
    return kFailure;
  } catch (const std::exception& error) {
    print_message(error.what());
    return kFailure;
  }
}
