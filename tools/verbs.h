/// The verbs of the program. Each adds its options to the command line; when the user chose it, it runs while the line
/// is parsed and leaves its exit code.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace portrait::tools {

/// What the program was called with, for the history of what it writes.
struct Invocation {
  std::string command_line;
  int exit_code = 0;  ///< set by the verb that ran
};

/// A verb with its one line for the list of verbs and its help text, which leads with an example.
inline CLI::App* add_verb(CLI::App& app, const char* name, const char* line, const char* help) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->footer(line);
  return verb;
}

/// An option that may be given many times, one word each.
inline CLI::Option* add_many(CLI::App& verb, const char* name, std::vector<std::string>& words, const char* text) {
  return verb.add_option(name, words, text)->take_all()->expected(1)->allow_extra_args(false);
}

void add_sweep(CLI::App& app, Invocation& invocation);
void add_info(CLI::App& app, Invocation& invocation);
void add_merge(CLI::App& app, Invocation& invocation);
void add_verify(CLI::App& app, Invocation& invocation);
void add_export(CLI::App& app, Invocation& invocation);
void add_query(CLI::App& app, Invocation& invocation);
void add_simulate(CLI::App& app, Invocation& invocation);
void add_plot(CLI::App& app, Invocation& invocation);
void add_reproduce(CLI::App& app, Invocation& invocation);
void add_tune(CLI::App& app, Invocation& invocation);
void add_serve(CLI::App& app, Invocation& invocation);
void add_report(CLI::App& app, Invocation& invocation);
/// completion and man.
void add_shell_verbs(CLI::App& app, Invocation& invocation);

}  // namespace portrait::tools
