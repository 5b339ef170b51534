#include "framework/gpu/pipeline_file.hpp"

#include <cstring>
#include <exception>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

namespace fs = std::filesystem;

/// What grew beyond it is thrown away as a whole and begun anew, so that the file cannot grow for ever.
constexpr uint64_t kMostBytes = uint64_t{256} << 20;

constexpr uint64_t kMagic = 0x3130'4550'4950'4C4C;  // "LLPIPE01"

/// What stands before the driver's data; the hash is of the other fields and of the data.
struct Header {
  uint64_t magic = kMagic;
  uint32_t vendor = 0;
  uint32_t device = 0;
  uint32_t driver_version = 0;
  uint32_t unused = 0;
  std::array<uint8_t, VK_UUID_SIZE> cache_uuid{};
  uint64_t size = 0;
  uint64_t hash = 0;
};
static_assert(sizeof(Header) == 56, "no padding, which would have any bytes");

Header header_for(const PipelineFileOwner& owner, std::string_view data) {
  Header header{.vendor = owner.vendor,
                .device = owner.device,
                .driver_version = owner.driver_version,
                .cache_uuid = owner.cache_uuid,
                .size = data.size()};
  Hasher hasher;
  hasher.bytes(&header, offsetof(Header, hash));
  hasher.bytes(data.data(), data.size());
  header.hash = hasher.value();
  return header;
}

[[noreturn]] void reject(const std::string& reason) {
  throw Error(ExitCode::invalid_input, "the pipelines on disk are not used: " + reason);
}

/// Drivers need not look at what they are given, and some do not.
void check_driver_header(std::string_view data, const PipelineFileOwner& owner) {
  VkPipelineCacheHeaderVersionOne header{};
  static_assert(sizeof(header) == 32);
  if (data.size() < sizeof(header)) reject("the driver's part is too short");
  std::memcpy(&header, data.data(), sizeof(header));
  if (header.headerSize < sizeof(header) || header.headerSize > data.size() ||
      header.headerVersion != VK_PIPELINE_CACHE_HEADER_VERSION_ONE)
    reject("the driver's part has a header that Vulkan does not know");
  if (header.vendorID != owner.vendor || header.deviceID != owner.device ||
      std::memcmp(header.pipelineCacheUUID, owner.cache_uuid.data(), VK_UUID_SIZE) != 0)
    reject("the driver's part is of another device");
}

}  // namespace

PipelineFileOwner pipeline_file_owner(const Device& device) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device.physical(), &properties);
  PipelineFileOwner owner{
      .vendor = properties.vendorID, .device = properties.deviceID, .driver_version = properties.driverVersion};
  std::memcpy(owner.cache_uuid.data(), properties.pipelineCacheUUID, VK_UUID_SIZE);
  return owner;
}

std::string encode_pipeline_file(const PipelineFileOwner& owner, std::string_view data) {
  const Header header = header_for(owner, data);
  std::string bytes(sizeof(header), '\0');
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes.append(data);
}

std::string_view decode_pipeline_file(std::string_view bytes, const PipelineFileOwner& owner) {
  Header header;
  if (bytes.size() < sizeof(header)) reject("the file is cut off");
  std::memcpy(&header, bytes.data(), sizeof(header));
  const std::string_view data = bytes.substr(sizeof(header));
  if (header.magic != kMagic) reject("the file is of another kind or version");
  if (header.vendor != owner.vendor || header.device != owner.device || header.driver_version != owner.driver_version ||
      header.cache_uuid != owner.cache_uuid)
    reject("the file is of another device or driver");
  if (header.size != data.size()) reject("the file has another length than it says");
  const Header expected = header_for(owner, data);
  if (std::memcmp(&header, &expected, sizeof(header)) != 0) reject("the file is damaged");
  check_driver_header(data, owner);
  return data;
}

PipelineFile::PipelineFile(const Device& device, const fs::path& directory) : device_(device.ref()) {
  if (directory.empty()) return;
  owner_ = pipeline_file_owner(device);
  Hasher name;
  for (const uint32_t number : {owner_.vendor, owner_.device, owner_.driver_version}) name.number(number);
  name.bytes(owner_.cache_uuid.data(), owner_.cache_uuid.size());
  file_ = directory / (hex(name.value()) + ".pipelines");
  std::error_code ignored;
  if (fs::exists(file_, ignored)) {
    try {
      const std::string bytes = read_text_file(file_, kMostBytes);
      create(decode_pipeline_file(bytes, owner_));
    } catch (const Error& error) {
      statistics_.rejected = error.what();
    }
  }
  if (cache_.get() != VK_NULL_HANDLE) return;
  try {
    create({});
  } catch (const Error& error) {
    // Pipelines can be made without it; where nothing at all can be, their own calls say so.
    statistics_.write_failure = error.what();
  }
}

void PipelineFile::create(std::string_view data) {
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(device_.device, &info, nullptr, &cache), "vkCreatePipelineCache");
  cache_ = PipelineCacheHandle(device_, cache);
  statistics_.loaded_bytes = data.size();
  hash_on_disk_ = data.empty() ? 0 : hash_text(data);
}

std::string PipelineFile::driver_data() const {
  size_t size = 0;
  check(vkGetPipelineCacheData(device_.device, cache_.get(), &size, nullptr), "vkGetPipelineCacheData");
  std::string data(size, '\0');
  const VkResult result = vkGetPipelineCacheData(device_.device, cache_.get(), &size, data.data());
  check(result, "vkGetPipelineCacheData");
  if (result == VK_INCOMPLETE) return {};
  data.resize(size);
  return data;
}

void PipelineFile::save() noexcept {
  if (cache_.get() == VK_NULL_HANDLE) return;
  try {
    const std::string data = driver_data();
    const uint64_t hash = hash_text(data);
    if (data.empty() || hash == hash_on_disk_) return;
    make_folder(file_.parent_path());
    write_file_atomically(file_, encode_pipeline_file(owner_, data));
    hash_on_disk_ = hash;
    ++statistics_.written;
    statistics_.write_failure.clear();
  } catch (const std::exception& failure) {
    // The pipelines are good; only the next start will be slower.
    statistics_.write_failure = failure.what();
  }
}

}  // namespace lightloom::gpu
