// SPDX-License-Identifier: MIT
// What a shell needs to complete a command line, from the options that this command line has.
#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"

namespace polhode::cli {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// The words between the braces in which CLI11 describes a set: "{json,keys,units}".
Words words_of_set(const std::string& text) {
  const std::size_t begin = text.find('{'), end = text.find('}', begin);
  if (end == std::string::npos) return {};
  Words words;
  std::size_t from = begin + 1;
  while (from < end) {
    const std::size_t to = std::min(text.find(',', from), end);
    words.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return words;
}

// What may stand for an option's value: these words, or else files, folders, or what nobody knows.
struct Value {
  Words words;
  bool files = false;
  bool folders = false;
};

Value value_of(const CLI::Option& option) {
  Value value;
  try {
    CLI::Validator first = *const_cast<CLI::Option&>(option).get_validator(0);
    value.words = words_of_set(first.active().get_description());
  } catch (const CLI::OptionNotFound&) {  // it has none
  }
  const std::string name = option.get_positional() ? option.get_name(true) : "";
  value.folders = name == "DIR" || option.get_type_name() == "DIR";
  value.files = value.words.empty() && (name == "FILE" || option.get_type_name() == "PATH");
  return value;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// "--out", "-o"
Words names_of(const CLI::Option& option) {
  Words names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

Words option_names(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options())
    for (std::string& name : names_of(*option)) names.push_back(std::move(name));
  return names;
}

// The function that completes a program, whatever its name.
std::string function_name(const std::string& program) {
  std::string name = "_" + program;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

std::string bash_assignments(const Value& value) {
  const std::string kind = value.files ? "default" : value.folders ? "dirnames" : "";
  if (!kind.empty()) return "paths=" + kind;
  return value.words.empty() ? ":" : "words='" + joined(value.words, " ") + "'";
}

// The cases of one command: after an option its values, elsewhere its options and its argument.
std::string bash_cases(const CLI::App& command) {
  const std::string before = "    *:" + command.get_name() + ":";
  std::string text;
  std::string argument;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      argument = " " + bash_assignments(value_of(*option));
    } else if (takes_value(*option)) {
      const std::string between = " | *:" + command.get_name() + ":";
      text += before + joined(names_of(*option), between) + ") " +
              bash_assignments(value_of(*option)) + " ;;\n";
    }
  }
  return text + before + "*) options='" + joined(option_names(command), " ") + "'" + argument +
         " ;;\n";
}

std::string bash_script(const CLI::App& app) {
  const std::string& program = app.get_name();
  const std::string function = function_name(program);
  Words first;
  std::string cases;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    first.push_back(command->get_name());
    cases += bash_cases(*command);
  }
  return "# Completion for bash, printed by: " + program + " completion bash\n" + function +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local options= words= paths=\n"
         "  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  [[ $word == = ]] && word=\n"
         "  COMPREPLY=()\n"
         "  case $COMP_CWORD:${COMP_WORDS[1]}:$before in\n"
         "    1:*) options='" +
         joined(option_names(app), " ") + "' words='" + joined(first, " ") + "' ;;\n" + cases +
         "  esac\n"
         "  if [[ $word == -* || -z $words$paths ]]; then\n"
         "    words=$options paths=\n"
         "  fi\n"
         "  if [[ $paths ]]; then\n"
         "    compopt -o \"$paths\"\n"
         "  else\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -F " +
         function + " " + program + "\n";
}

// A description between single quotes, in which these characters mean something to zsh.
std::string zsh_text(std::string_view text, std::string_view special) {
  std::string quoted;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '\'') {
      quoted += "'\\''";
      continue;
    }
    if (special.find(c) != std::string_view::npos) quoted += '\\';
    quoted += c;
  }
  return quoted;
}

std::string zsh_value(const CLI::Option& option) {
  const Value value = value_of(option);
  const std::string action = value.files           ? "_files"
                             : value.folders       ? "_files -/"
                             : value.words.empty() ? ""
                                                   : "(" + joined(value.words, " ") + ")";
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_type_name();
  return ":" + zsh_text(name.substr(0, name.find('{')), ":\\") + ":" + action;
}

// One argument of _arguments for each name of each option: '--out[Where to write]:PATH:_files'.
std::string zsh_arguments(const CLI::App& command) {
  std::string text;
  const auto add = [&text](const std::string& spec) { text += " \\\n        '" + spec + "'"; };
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      add("1" + zsh_value(*option));
      continue;
    }
    const Words names = names_of(*option);
    const bool repeated = takes_value(*option) && option->get_items_expected_max() > 1;
    for (const std::string& name : names)
      add((repeated ? "*" : "(" + joined(names, " ") + ")") + name + "[" +
          zsh_text(option->get_description(), "[]:\\") + "]" +
          (takes_value(*option) ? zsh_value(*option) : ""));
  }
  return text;
}

std::string zsh_script(const CLI::App& app) {
  const std::string& program = app.get_name();
  const std::string function = function_name(program);
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    commands += "        '" + command->get_name() + ":" +
                zsh_text(command->get_description(), ":\\") + "'\n";
    cases += "      " + command->get_name() + ") _arguments -s" + zsh_arguments(*command) + " ;;\n";
  }
  return "#compdef " + program + "\n# Completion for zsh, printed by: " + program +
         " completion zsh\n" + function +
         "() {\n"
         "  local curcontext=$curcontext state line\n"
         "  local -a commands\n"
         "  _arguments -C" +
         zsh_arguments(app) +
         " \\\n        '1: :->command' '*:: :->argument' && return\n"
         "  case $state in\n"
         "    command)\n"
         "      commands=(\n" +
         commands +
         "      )\n"
         "      _describe command commands ;;\n"
         "    argument) case $words[1] in\n" +
         cases +
         "    esac ;;\n"
         "  esac\n"
         "}\n"
         "if [[ $funcstack[1] == " +
         function + " ]]; then\n  " + function + " \"$@\"\nelse\n  compdef " + function + " " +
         program + "\nfi\n";
}

}  // namespace

void offer(CLI::Option& option, const std::vector<std::string>& words) {
  option.check(CLI::IsMember(words).active(false));
}

void add_completion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", "Print what makes a shell complete this command line");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash or zsh")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->required();
  command->footer("Example:\n  eval \"$(" + full_name(*command) + " bash)\"");
  command->callback(
      [shell, &app] { print(*shell == "bash" ? bash_script(app) : zsh_script(app)); });
}

}  // namespace polhode::cli
