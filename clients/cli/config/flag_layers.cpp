#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string_view>

#include "clients/cli/config/client_config.h"
#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

constexpr std::array<std::string_view, 4> kGroups{"Messages", "Picture", "Server", "Where"};
constexpr std::array<std::string_view, 2> kRequests{"--spec", "request"};

/// A flag, and the value that a layer gives it.
struct FlagSetting {
  CLI::Option* option = nullptr;
  std::vector<std::string> values;
  std::string key, place;
};

bool isSwitch(const CLI::Option& option) {
  return option.get_expected_min() == 0;
}

bool addsUp(const CLI::Option& option) {
  return option.check_lname("set");
}

bool hasRequest(const CLI::App& typed) {
  return std::any_of(kRequests.begin(), kRequests.end(), [&](std::string_view name) {
    const CLI::Option* option = typed.get_option_no_throw(std::string(name));
    return option != nullptr && option->count() > 0;
  });
}

bool isInEnvironment(const CLI::Option& option) {
  const char* value = option.get_envname().empty() ? nullptr : std::getenv(option.get_envname().c_str());
  return value != nullptr && value[0] != '\0';
}

bool isAnyOf(const std::set<CLI::Option*>& options, const std::set<CLI::Option*>& others) {
  return std::any_of(options.begin(), options.end(), [&](CLI::Option* option) { return others.contains(option); });
}

bool isNothing(const CLI::Option& option, const ConfigEntry& entry) {
  if (isSwitch(option)) return entry.values == std::vector<std::string>{"false"};
  return entry.values.empty() || (!entry.isList && entry.values[0].empty());
}

/// Chooses among the layers, from the strongest to the weakest.
class Choice {
 public:
  Choice(CLI::App& command, const CLI::App& typed, const std::string& file)
      : command_(command), file_(file), hasRequest_(hasRequest(typed)) {
    for (CLI::Option* option : command.get_options()) {
      const CLI::Option* same = typed.get_option_no_throw(option->get_name());
      if (same != nullptr && same->count() > 0) given_.insert(option);
    }
    decided_ = given_;
  }

  void add(const ConfigLayer& layer) {
    std::set<CLI::Option*> ours;
    for (const ConfigEntry& entry : layer.entries) {
      CLI::Option* option = command_.get_option_no_throw("--" + entry.key);
      if (option == nullptr || !isConfigurable(*option) || isOutranked(*option, layer)) continue;
      const std::string place = file_ + ":" + std::to_string(entry.line);
      if (isAnyOf(option->get_excludes(), ours)) {
        problems_.push_back(invalidValue(place, entry.key + " excludes another flag of the same section."));
        continue;
      }
      decided_.insert(option);
      if (isNothing(*option, entry)) continue;
      ours.insert(option);
      const std::string preset = layer.preset.empty() ? "" : "preset " + layer.preset + ", ";
      settings_.insert(settings_.begin(), {option, valuesOf(*option, entry), entry.key, preset + place});
      if (entry.isList && option->get_items_expected_max() <= 1) {
        problems_.push_back(invalidValue(place, entry.key + " takes one value, not a list."));
      }
    }
    given_.insert(ours.begin(), ours.end());
  }

  /// The weakest first.
  Result<std::vector<FlagSetting>> take() {
    if (!problems_.empty()) return std::move(problems_);
    std::size_t before = 0;
    do { // what needs something that was left out is left out, too
      before = settings_.size();
      std::erase_if(settings_, [&](const FlagSetting& setting) {
        const auto needs = setting.option->get_needs();
        const bool isMet =
            std::all_of(needs.begin(), needs.end(), [&](CLI::Option* need) { return given_.contains(need); });
        if (!isMet) given_.erase(setting.option);
        return !isMet;
      });
    } while (settings_.size() != before);
    return std::move(settings_);
  }

 private:
  bool isOutranked(CLI::Option& option, const ConfigLayer& layer) const {
    if (decided_.contains(&option) && !addsUp(option)) return true;
    if (isAnyOf(option.get_excludes(), given_)) return true;
    if (!layer.preset.empty()) return false;
    return isInEnvironment(option) || (hasRequest_ && option.get_group() == "Picture");
  }

  std::vector<std::string> valuesOf(const CLI::Option& option, const ConfigEntry& entry) const {
    std::vector<std::string> values = entry.values;
    const std::string type = option.get_type_name();
    const auto words = splitTrimmed(type, '|'); // FILE|sky|studio
    if (words.empty() || words[0] != "FILE") return values;
    std::transform(values.begin(), values.end(), values.begin(), [&](const std::string& name) {
      const bool isWord = name == "-" || std::find(words.begin() + 1, words.end(), name) != words.end();
      return isWord ? name : fileNamedIn(file_, name, std::getenv("HOME"));
    });
    return values;
  }

  CLI::App& command_;
  const std::string& file_;
  bool hasRequest_;
  std::set<CLI::Option*> given_;   ///< with a value
  std::set<CLI::Option*> decided_; ///< with a value or without, weaker layers say nothing to it
  std::vector<FlagSetting> settings_;
  Problems problems_;
};

/// What a switch says when it is given without a value.
std::string bareText(const CLI::Option& option) {
  return option.get_flag_value(option.get_single_name(), "");
}

/// What is wrong; empty = the flag has the value.
std::string setFlag(const FlagSetting& setting) {
  CLI::Option& option = *setting.option;
  const std::string bare = isSwitch(option) ? bareText(option) : "";
  if (bare == "true" && setting.values != std::vector<std::string>{"true"}) return "it is true or false";
  try {
    for (const std::string& value : setting.values) option.add_result(value == "true" && !bare.empty() ? bare : value);
    option.run_callback();
  } catch (const CLI::Error& error) {
    return error.what();
  }
  return {};
}

std::string pathOf(const std::string& set) {
  return set.substr(0, set.find('='));
}

/// Every spelling under which a problem may name the flag.
std::vector<std::string> spellingsOf(const FlagSetting& setting, const CLI::App& typed) {
  if (setting.key == "size") return {"--size", "--width", "--height"};
  std::vector<std::string> spellings{"--" + setting.key};
  if (!addsUp(*setting.option)) return spellings;
  const auto& given = typed.get_option("--set")->results();
  for (const std::string& value : setting.values) {
    const bool isTyped =
        std::any_of(given.begin(), given.end(), [&](const std::string& each) { return pathOf(each) == pathOf(value); });
    if (!isTyped) spellings.push_back("--set " + pathOf(value));
  }
  return spellings;
}

} // namespace

bool isConfigurable(const CLI::Option& option) {
  const bool isInGroup = std::find(kGroups.begin(), kGroups.end(), option.get_group()) != kGroups.end();
  return isInGroup && option.get_configurable() && !option.get_positional();
}

Result<FlagPlaces> setFlags(CLI::App& command, const CLI::App& typed, const std::string& file,
                            std::span<const ConfigLayer> layers) {
  Choice choice(command, typed, file);
  for (std::size_t i = layers.size(); i > 0; --i) choice.add(layers[i - 1]);
  auto settings = choice.take();
  if (!settings) return settings.problems();
  FlagPlaces places;
  Problems problems;
  for (const FlagSetting& setting : *settings) {
    const std::string fault = setFlag(setting);
    if (!fault.empty()) {
      const std::string flag = "--" + setting.key;
      const std::string detail = fault.starts_with(flag) ? fault.substr(2) : setting.key + ": " + fault;
      problems.push_back(invalidValue(setting.place, detail));
    }
    for (const std::string& spelling : spellingsOf(setting, typed)) places[spelling] = setting.place;
  }
  if (!problems.empty()) return problems;
  return places;
}

} // namespace gnomon::cli
