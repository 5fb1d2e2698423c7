/// portrait completion, portrait man: what shells and `man` want to know, from the same texts as --help.

#include <fmt/format.h>

#include "engine/base/version.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kCompletionHelp =
    R"(Example:
  portrait completion bash > ~/.local/share/bash-completion/completions/portrait
  portrait completion zsh > "${fpath[1]}/_portrait"

Prints a completion of verbs, options and file names for bash or zsh.)";

constexpr const char* kManHelp =
    R"(Example:
  portrait man query | man -l -
  portrait man > /usr/local/share/man/man1/portrait.1

Prints a manual page, of the program or of one verb, from the texts of --help.)";

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string words(const std::vector<std::string>& list) { return fmt::format("{}", fmt::join(list, " ")); }

std::string names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return words(names);
}

/// "verb" or "verb kind" -> its options, for every command.
template <typename Use>
void for_each_command(const CLI::App& app, Use use) {
  for (const CLI::App* verb : commands_of(app)) {
    use(verb->get_name(), *verb);
    for (const CLI::App* kind : commands_of(*verb)) use(verb->get_name() + " " + kind->get_name(), *kind);
  }
}

std::string bash_completion(const CLI::App& app) {
  std::string text =
      "# bash completion for portrait\n_portrait() {\n  local cur=${COMP_WORDS[COMP_CWORD]} choices=\n"
      "  local command=${COMP_WORDS[1]}\n"
      "  if ((COMP_CWORD == 1)); then\n";
  text += fmt::format("    choices='{}'\n  else\n    case $command in\n", names_of(app));
  for (const CLI::App* verb : commands_of(app))
    if (!commands_of(*verb).empty())
      text += fmt::format(
          "      {}) if ((COMP_CWORD == 2)); then choices='{}'; else command+=\" ${{COMP_WORDS[2]}}\"; fi ;;\n",
          verb->get_name(), names_of(*verb));
  text += "    esac\n    if [[ $cur == -* ]]; then\n      case $command in\n";
  for_each_command(app, [&](const std::string& name, const CLI::App& command) {
    text += fmt::format("        '{}') choices='{}' ;;\n", name, words(options_of(command)));
  });
  text +=
      "      esac\n    fi\n  fi\n  if [[ -n $choices ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$choices\" -- \"$cur\"))\n  else\n"
      "    COMPREPLY=($(compgen -f -- \"$cur\"))\n  fi\n}\ncomplete -o filenames -F _portrait portrait\n";
  return text;
}

/// A word and what it means, in the quotes of zsh's _describe.
std::string zsh_entry(const std::string& word, const std::string& meaning) {
  std::string entry = "'" + word + ":";
  for (const char c : meaning)
    entry += c == '\'' ? std::string("'\\''") : c == ':' ? std::string("\\:") : std::string(1, c);
  return entry + "'";
}

std::string zsh_list(const CLI::App& app) {
  std::string list;
  for (const CLI::App* command : commands_of(app))
    list += " " + zsh_entry(command->get_name(), command->get_footer());
  return list;
}

std::string zsh_options(const CLI::App& app) {
  std::string list;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      list += " " + zsh_entry("--" + name, option->get_description());
  return list;
}

std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef portrait\n_portrait() {\n  local -a choices\n  local command=$words[2]\n"
      "  if ((CURRENT == 2)); then\n";
  text += fmt::format("    choices=({})\n    _describe verb choices\n    return\n  fi\n  case $command in\n",
                      zsh_list(app));
  for (const CLI::App* verb : commands_of(app))
    if (!commands_of(*verb).empty())
      text += fmt::format(
          "    {})\n      if ((CURRENT == 3)); then\n        choices=({})\n        _describe kind choices\n"
          "        return\n      fi\n      command+=\" $words[3]\" ;;\n",
          verb->get_name(), zsh_list(*verb));
  text += "  esac\n  if [[ $PREFIX == -* ]]; then\n    case $command in\n";
  for_each_command(app, [&](const std::string& name, const CLI::App& command) {
    text += fmt::format("      '{}') choices=({}) ;;\n", name, zsh_options(command));
  });
  text +=
      "    esac\n    _describe option choices\n  else\n    _files\n  fi\n}\n"
      "if [[ $funcstack[1] == _portrait ]]; then _portrait \"$@\"; else compdef _portrait portrait; fi\n";
  return text;
}

/// Text as roff shows it: a backslash, a dash, and a line that begins with a request's mark.
std::string roff(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) escaped += "\\&";
    escaped += text[i] == '\\' ? "\\e" : text[i] == '-' ? "\\-" : std::string(1, text[i]);
  }
  return escaped;
}

std::string man_page(const CLI::App& root, const CLI::App& command, const std::string& name) {
  const bool whole = &root == &command;
  std::string dashed = name;
  for (char& c : dashed) c = c == ' ' ? '-' : c;
  const std::string line = whole ? "performance portraits of control loops with dead time" : command.get_footer();
  std::string text = fmt::format(".TH {} 1 \"\" \"{}\"\n.SH NAME\n{} \\- {}\n", roff(dashed),
                                 roff(program_version()), roff(dashed), roff(line));
  text += fmt::format(".SH DESCRIPTION\n.nf\n{}\n.fi\n", roff(command.get_description()));
  if (!commands_of(command).empty()) text += ".SH COMMANDS\n";
  for (const CLI::App* one : commands_of(command))
    text += fmt::format(".TP\n.B {}\n{}\n", roff(one->get_name()), roff(one->get_footer()));
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : command.get_options())
    text += fmt::format(".TP\n.B {}\n{}\n", roff(option->get_name(true, true)), roff(option->get_description()));
  return text +
         ".SH EXIT STATUS\n0 done, 1 failure, 2 wrong usage or input, 3 no admissible setting, 4 a file's "
         "integrity is "
         "broken, 5 stopped with work left, 130 interrupted twice\n";
}

}  // namespace

void add_shell_verbs(CLI::App& app, Invocation& invocation) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      add_verb(app, "completion", "completion of this command line for bash or zsh", kCompletionHelp);
  completion->add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->callback([shell, &app, &invocation] {
    print_text(*shell == "bash" ? bash_completion(app) : zsh_completion(app));
    invocation.exit_code = kDone;
  });

  auto verb = std::make_shared<std::vector<std::string>>();
  CLI::App* man = add_verb(app, "man", "a manual page, of the program or of one verb", kManHelp);
  man->add_option("verb", *verb, "a verb, and a kind where it has some; none: the program");
  man->callback([verb, &app, &invocation] {
    const CLI::App* command = &app;
    std::string name = "portrait";
    for (const std::string& word : *verb) {
      command = command->get_subcommand(word);
      name += " " + word;
    }
    print_text(man_page(app, *command, name));
    invocation.exit_code = kDone;
  });
}

}  // namespace portrait::tools
