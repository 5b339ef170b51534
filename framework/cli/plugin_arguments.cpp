#include "framework/cli/plugin_arguments.hpp"

#include <sstream>

namespace lightloom::cli {

PluginArguments take_plugin_arguments(const std::vector<std::string>& arguments, const std::string& environment) {
  PluginArguments result;
  std::istringstream listed(environment);
  for (std::string file; std::getline(listed, file, ':');)
    if (!file.empty()) result.plugins.emplace_back(file);
  const std::string name = "--plugin";
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {
      result.rest.insert(result.rest.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
      break;
    }
    const bool has_next = i + 1 < arguments.size() && !arguments[i + 1].empty() && arguments[i + 1][0] != '-';
    if (argument == name && has_next) {
      result.plugins.emplace_back(arguments[++i]);
    } else if (argument.size() > name.size() + 1 && argument.compare(0, name.size() + 1, name + "=") == 0) {
      result.plugins.emplace_back(argument.substr(name.size() + 1));
    } else {
      result.rest.push_back(argument);
    }
  }
  return result;
}

}  // namespace lightloom::cli
