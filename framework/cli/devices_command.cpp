#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/cli/commands.hpp"
#include "framework/cli/text_layout.hpp"
#include "framework/gpu/device.hpp"
#include "framework/run/provenance.hpp"

namespace lightloom::cli {
namespace {

void print_json(const std::vector<gpu::DeviceSummary>& devices, std::ostream& out) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const gpu::DeviceSummary& device : devices) {
    nlohmann::ordered_json entry = run::device_record(device.info);
    entry["usable"] = device.usable;
    entry["missing"] = device.missing;
    entry["ray_queries_missing"] = device.info.ray_query.missing;
    list.push_back(entry);
  }
  out << nlohmann::ordered_json{{"devices", list}}.dump(2) << '\n';
}

void print_table(const std::vector<gpu::DeviceSummary>& devices, std::ostream& out) {
  std::vector<std::vector<std::string>> rows = {{"INDEX", "NAME", "TYPE", "VULKAN", "DRIVER", "USABLE", "RAY QUERIES"}};
  for (size_t i = 0; i < devices.size(); ++i) {
    const gpu::DeviceInfo& info = devices[i].info;
    rows.push_back({std::to_string(i), info.name, gpu::to_string(info.type), info.api_version_text(),
                    info.driver + " " + info.driver_info, devices[i].usable ? "yes" : "no: " + devices[i].missing,
                    info.ray_query.available ? "yes" : "no: " + info.ray_query.missing});
  }
  out << align_columns(rows);
}

ExitCode list(bool json, const CommandContext& context) {
  const std::vector<gpu::DeviceSummary> devices = gpu::list_devices();
  if (json) {
    print_json(devices, context.out);
  } else if (!devices.empty()) {
    print_table(devices, context.out);
  }
  const bool usable = std::any_of(devices.begin(), devices.end(), [](const auto& device) { return device.usable; });
  if (usable) return ExitCode::done;
  throw Error(ExitCode::no_device, devices.empty() ? "there is no Vulkan device" : "no Vulkan device here is usable",
              "the Debian package mesa-vulkan-drivers brings one that runs on the CPU");
}

}  // namespace

void add_devices_command(Command& program, const CommandContext& context) {
  Command& command = program.command("devices", "List the Vulkan devices, and whether each is usable");
  command.description(
      "Exits with 4 if none is usable. Ray queries are what 'ray_query_path_trace' needs; all else runs without.");
  auto json = std::make_shared<bool>(false);
  command.flag("--json", *json, "Print JSON");
  command.action([json, &context] { return list(*json, context); });
}

}  // namespace lightloom::cli
