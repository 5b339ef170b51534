#include "framework/gpu/timestamps.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {

TimestampPool::TimestampPool(const Device& device, uint32_t count) : device_(device), count_(count) {
  if (device.timestamp_bits() == 0 || count == 0) return;
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = count;
  VkQueryPool pool = VK_NULL_HANDLE;
  check(vkCreateQueryPool(device.get(), &info, nullptr, &pool), "vkCreateQueryPool");
  pool_ = QueryPoolHandle(device.ref(), pool);
}

void TimestampPool::reset(VkCommandBuffer commands) const {
  if (available()) vkCmdResetQueryPool(commands, pool_.get(), 0, count_);
}

void TimestampPool::write(VkCommandBuffer commands, uint32_t index) const {
  if (index >= count_) throw Error(ExitCode::run_failed, "there is no timestamp " + std::to_string(index));
  if (available()) vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(), index);
}

std::vector<double> TimestampPool::nanoseconds(uint32_t written) const {
  if (!available() || written == 0) return {};
  std::vector<uint64_t> ticks(written);
  const VkResult result = vkGetQueryPoolResults(device_.get(), pool_.get(), 0, written, written * sizeof(uint64_t),
                                                ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
  check(result, "vkGetQueryPoolResults");
  if (result == VK_NOT_READY) throw Error(ExitCode::run_failed, "a timestamp was read that was not written");
  newest_ = *std::max_element(ticks.begin(), ticks.end());
  const uint32_t bits = device_.timestamp_bits();
  const uint64_t mask = bits >= 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  const double period = static_cast<double>(device_.info().limits.timestampPeriod);
  std::vector<double> times;
  for (uint64_t tick : ticks) times.push_back(static_cast<double>((tick - ticks.front()) & mask) * period);
  return times;
}

std::optional<std::vector<bool>> TimestampPool::written(uint32_t count) const {
  if (!available() || count == 0 || count > count_) return std::nullopt;
  struct Query {
    uint64_t ticks;
    uint64_t available;
  };
  std::vector<Query> queries(count);
  const VkResult result =
      vkGetQueryPoolResults(device_.get(), pool_.get(), 0, count, count * sizeof(Query), queries.data(), sizeof(Query),
                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT);
  if (result < 0) return std::nullopt;
  std::vector<bool> written;
  // Where the device was lost before it reset the queries, those of the last frame are still there.
  for (const Query& query : queries) written.push_back(query.available != 0 && query.ticks > newest_);
  return written;
}

}  // namespace lightloom::gpu
