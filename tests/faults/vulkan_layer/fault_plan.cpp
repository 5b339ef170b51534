#include "tests/faults/vulkan_layer/fault_plan.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace lightloom::faults {
namespace {

constexpr std::array<std::pair<const char*, VkResult>, 10> kResults{{
    {"VK_TIMEOUT", VK_TIMEOUT},
    {"VK_INCOMPLETE", VK_INCOMPLETE},
    {"VK_ERROR_OUT_OF_HOST_MEMORY", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"VK_ERROR_OUT_OF_DEVICE_MEMORY", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"VK_ERROR_INITIALIZATION_FAILED", VK_ERROR_INITIALIZATION_FAILED},
    {"VK_ERROR_DEVICE_LOST", VK_ERROR_DEVICE_LOST},
    {"VK_ERROR_MEMORY_MAP_FAILED", VK_ERROR_MEMORY_MAP_FAILED},
    {"VK_ERROR_INCOMPATIBLE_DRIVER", VK_ERROR_INCOMPATIBLE_DRIVER},
    {"VK_ERROR_TOO_MANY_OBJECTS", VK_ERROR_TOO_MANY_OBJECTS},
    {"VK_ERROR_UNKNOWN", VK_ERROR_UNKNOWN},
}};

VkResult result_named(const std::string& name) {
  for (const auto& [known, result] : kResults)
    if (name == known) return result;
  throw std::invalid_argument("unknown result " + name);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

CallRule parse_call(const std::string& entry, const std::string& value, bool fails) {
  const std::vector<std::string> parts = split(value, ':');
  if (parts.size() != 3) throw std::invalid_argument(entry);
  CallRule rule{.function = parts[0], .first = std::stoull(parts[1]), .onwards = parts[1].back() == '+', .text = entry};
  if (fails)
    rule.result = result_named(parts[2]);
  else
    rule.milliseconds = static_cast<uint32_t>(std::stoul(parts[2]));
  return rule;
}

}  // namespace

Faults parse_faults(const std::string& text) {
  Faults faults;
  for (const std::string& entry : split(text, ';')) {
    const size_t equals = entry.find('=');
    if (equals == std::string::npos) throw std::invalid_argument(entry);
    const std::string key = entry.substr(0, equals);
    const std::string value = entry.substr(equals + 1);
    if (key == "fail" || key == "delay")
      faults.calls.push_back(parse_call(entry, value, key == "fail"));
    else if (key == "heap")
      faults.heap_bytes = std::stoull(value);
    else if (key == "api")
      faults.api_version = VK_MAKE_API_VERSION(0, std::stoul(value.substr(0, 1)), std::stoul(value.substr(2)), 0);
    else if (key == "type" && value == "discrete")
      faults.discrete = true;
    else if (key == "hide")
      faults.hidden.insert(value);
    else if (key == "mark")
      faults.mark = value;
    else if (key == "log")
      faults.log = value;
    else
      throw std::invalid_argument(entry);
  }
  return faults;
}

void FaultPlan::load() {
  const char* environment = std::getenv("LIGHTLOOM_FAULTS");
  const std::string text = environment == nullptr ? "" : environment;
  const std::lock_guard lock(mutex_);
  if (text == text_) return;
  faults_ = parse_faults(text);
  text_ = text;
  counts_.clear();
  struck_.clear();
}

std::optional<VkResult> FaultPlan::on_call(const std::string& function) {
  uint32_t milliseconds = 0;
  std::optional<VkResult> failure;
  {
    const std::lock_guard lock(mutex_);
    const uint64_t call = ++counts_[function];
    for (const CallRule& rule : faults_.calls) {
      if (rule.function != function || call < rule.first || (call > rule.first && !rule.onwards)) continue;
      struck_.insert(rule.text);
      milliseconds += rule.milliseconds;
      if (rule.result != VK_SUCCESS) failure = rule.result;
    }
    if (failure && !faults_.mark.empty()) std::ofstream(faults_.mark) << function << '\n';
  }
  if (milliseconds > 0) std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  return failure;
}

Faults FaultPlan::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

void FaultPlan::add(const std::string& name, uint64_t number) {
  const std::lock_guard lock(mutex_);
  counts_[name] += number;
}

void FaultPlan::write_log() const {
  const std::lock_guard lock(mutex_);
  if (faults_.log.empty()) return;
  std::ofstream file(faults_.log);
  for (const auto& [function, count] : counts_) file << function << ' ' << count << '\n';
  for (const std::string& entry : struck_) file << "struck " << entry << '\n';
  file << "bytes_left " << taken_ << '\n';
}

bool FaultPlan::take(VkDeviceMemory memory, uint64_t bytes, bool only_ask) {
  const std::lock_guard lock(mutex_);
  if (faults_.heap_bytes && taken_ + bytes > *faults_.heap_bytes) return false;
  if (only_ask) return true;
  memory_[memory] = bytes;
  taken_ += bytes;
  return true;
}

void FaultPlan::give_back(VkDeviceMemory memory) {
  const std::lock_guard lock(mutex_);
  const auto found = memory_.find(memory);
  if (found == memory_.end()) return;
  taken_ -= found->second;
  memory_.erase(found);
}

uint64_t FaultPlan::taken() const {
  const std::lock_guard lock(mutex_);
  return taken_;
}

FaultPlan& fault_plan() {
  static FaultPlan plan;
  return plan;
}

}  // namespace lightloom::faults
