#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>

#include "clients/cli/commands/commands.h"
#include "clients/cli/config/client_config.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/terminal/messages.h"

namespace gnomon::cli {
namespace {

constexpr const char* kFileVariable = "GNOMON_CLIENT_CONFIG"; // GNOMON_CONFIG is the server's
constexpr std::size_t kMostBytes = 1 << 20;

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Every key that a configuration may have.
std::vector<std::string> configKeys(const CLI::App& app) {
  std::set<std::string> keys;
  for (const CLI::App* command : commandsOf(app)) {
    for (const CLI::Option* option : command->get_options()) {
      if (isConfigurable(*option)) keys.insert(option->get_single_name());
    }
  }
  return {keys.begin(), keys.end()};
}

/// What a command line says about configurations.
struct ConfigOrder {
  std::string file; ///< empty = the usual one, which need not be there
  bool none = false;
  bool show = false;
  std::vector<std::string> presets;
};

ConfigOrder orderOf(const CLI::App& typed) {
  ConfigOrder order;
  order.none = typed.count("--no-config") > 0;
  order.show = typed.count("--show-config") > 0;
  order.presets = typed.get_option("--preset")->results();
  const auto& files = typed.get_option("--config")->results();
  const char* variable = std::getenv(kFileVariable);
  if (!files.empty()) order.file = files.back();
  if (files.empty() && !order.none && variable != nullptr) order.file = variable;
  return order;
}

Result<ClientConfig> readConfig(const ConfigOrder& order, const std::vector<std::string>& keys) {
  if (order.none && !order.file.empty()) {
    return invalidValue("--no-config", "This excludes --config.");
  }
  if (order.none) return ClientConfig{};
  const std::string file =
      order.file.empty() ? usualConfigFile(std::getenv("XDG_CONFIG_HOME"), std::getenv("HOME")) : order.file;
  std::error_code ignored; // a file that can't be looked at can't be read either
  if (order.file.empty() && (file.empty() || !std::filesystem::exists(file, ignored))) return ClientConfig{};
  const auto text = readText(file, kMostBytes);
  if (!text) return text.problems();
  return parseClientConfig(*text, file, keys);
}

std::string valueText(const CLI::Option& option) {
  if (option.get_expected_min() == 0 && option.count() > 0) return configValue(option.results().back());
  if (option.get_expected_min() == 0) return "";
  if (option.count() == 0) return option.get_default_str().empty() ? "" : configValue(option.get_default_str());
  return option.get_items_expected_max() > 1 ? configList(option.results()) : configValue(option.results().back());
}

/// Every flag with a value, that value, and where it comes from; in the form that a configuration has.
std::string inForce(const CLI::App& command, const CLI::App& typed, const ClientConfig& config,
                    const FlagPlaces& places) {
  std::string text = "# " + (config.file.empty() ? "There is no configuration." : "Configuration: " + config.file);
  for (const ConfigLayer& layer : config.layers) text += layer.preset.empty() ? "" : "\n# Preset: " + layer.preset;
  text += "\n";
  for (const CLI::Option* option : command.get_options()) {
    const std::string value = isConfigurable(*option) ? valueText(*option) : "";
    if (value.empty()) continue;
    const std::string flag = "--" + option->get_single_name();
    const auto place = places.find(flag);
    std::string origin = option->count() > 0 ? "environment, " + option->get_envname() : "default";
    if (place != places.end()) origin = place->second;
    if (typed.count(flag) > 0) origin = place == places.end() ? "command line" : "command line and " + place->second;
    text += option->get_single_name() + " = " + value + "  # " + origin + "\n";
  }
  return text;
}

/// The command line as it was typed: of the command that it names each option with what was given to it.
const CLI::App* parseTyped(CLI::App& typed, std::vector<std::string> arguments) {
  for (const CLI::App* command : commandsOf(typed)) {
    for (CLI::Option* option : const_cast<CLI::App*>(command)->get_options()) option->envname("");
  }
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
  try {
    typed.parse(std::move(arguments));
  } catch (const CLI::Error&) { // reported by the final parse
  }
  const auto chosen = typed.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

} // namespace

void addConfigFlags(CLI::App& command) {
  const auto options = static_cast<const CLI::App&>(command).get_options();
  const auto isWorthIt = [](const CLI::Option* option) {
    return isConfigurable(*option) && option->get_group() != "Messages";
  };
  if (std::none_of(options.begin(), options.end(), isWorthIt)) return;
  const auto ignore = [](const auto&) {}; // takeConfiguration has looked at them before
  command
      .add_option_function<std::vector<std::string>>(
          "--preset", ignore, "Flags that the configuration keeps under this name, as [preset.NAME]. Repeatable")
      ->type_name("NAME")
      ->take_all()
      ->allow_extra_args(false)
      ->group("Configuration");
  command
      .add_option_function<std::string>(
          "--config", ignore, "The configuration: flags as KEY = VALUE. Without it ~/.config/gnomon/config is read")
      ->type_name("FILE")
      ->envname(kFileVariable)
      ->group("Configuration");
  command.add_flag("--no-config")->description("Read no configuration")->group("Configuration");
  command.add_flag("--show-config")
      ->description("Print every flag's value and where it comes from, and exit")
      ->group("Configuration");
}

std::optional<int> takeConfiguration(CLI::App& app, const std::vector<std::string>& arguments) {
  const auto commands = commandsOf(app);
  const bool isOurs = std::any_of(commands.begin(), commands.end(), [&](const CLI::App* command) {
    return !arguments.empty() && command->get_name() == arguments.front() && command->get_option_no_throw("--preset");
  });
  if (!isOurs) return std::nullopt;
  const auto isAny = [&](const char* flag) { return std::count(arguments.begin(), arguments.end(), flag) > 0; };
  if (isAny("--help") || isAny("-h") || isAny("--fields")) return std::nullopt; // even with a faulty configuration
  CLI::App mirror;
  const auto kept = addClientCommands(mirror);
  const CLI::App* typed = parseTyped(mirror, arguments);
  if (typed == nullptr) return std::nullopt;
  const auto refused = [](const Problems& problems) {
    printProblems(problems);
    return kExitUsage;
  };
  const ConfigOrder order = orderOf(*typed);
  const auto config = readConfig(order, configKeys(mirror));
  if (!config) return refused(config.problems());
  const auto layers = layersOf(*config, order.presets);
  if (!layers) return refused(layers.problems());
  CLI::App& command = *app.get_subcommand(typed->get_name());
  const auto places = setFlags(command, *typed, config->file, *layers);
  if (!places) return refused(places.problems());
  setFlagOrigins(*places);
  if (!order.show) return std::nullopt;
  for (CLI::Option* option : command.get_options()) option->required(false);
  command.parse_complete_callback(nullptr); // asks for what is missing, too
  command.final_callback([&] {
    std::cout << inForce(command, *typed, *config, *places) << std::flush;
    throw CLI::Success();
  });
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  }
  return kExitOk;
}

} // namespace gnomon::cli
