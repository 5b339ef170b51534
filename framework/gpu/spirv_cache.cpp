#include "framework/gpu/spirv_cache.hpp"

#include <cstring>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom::gpu {
namespace {

// An entry is a row of 32-bit words: magic, key check (low, high), number of modules, for each its stage, its number of
// words and the words; at the end the hash of all before it (low, high).
constexpr uint32_t kMagic = 0x314C4C53;
constexpr uint32_t kSpirvMagic = 0x07230203;
constexpr uint64_t kMostEntryBytes = uint64_t{64} << 20;

uint32_t low(uint64_t value) {
  return static_cast<uint32_t>(value);
}
uint32_t high(uint64_t value) {
  return static_cast<uint32_t>(value >> 32);
}

std::filesystem::path entry_file(const std::filesystem::path& directory, const CacheKey& key) {
  return directory / (hex(key.name) + ".spvcache");
}

uint64_t hash_words(std::span<const uint32_t> words) {
  return hash_bytes(words.data(), words.size_bytes());
}

void hash_inputs(Hasher& hasher, std::span<const ShaderSource> stages, const ShaderDefines& defines,
                 const IncludeTexts& includes, const std::string& compiler) {
  hasher.text(compiler);
  hasher.number(defines.size());
  for (const auto& [name, value] : defines) {
    hasher.text(name);
    hasher.text(value);
  }
  hasher.number(stages.size());
  for (const ShaderSource& stage : stages) {
    hasher.number(static_cast<uint64_t>(stage.stage));
    hasher.text(stage.name);
    hasher.text(stage.text);
  }
  for (const auto& [name, text] : includes) {
    hasher.text(name);
    hasher.text(text);
  }
}

/// Words from the front of what is left; empty if there are not that many.
class WordReader {
 public:
  explicit WordReader(std::span<const uint32_t> words) : words_(words) {}
  [[nodiscard]] std::span<const uint32_t> take(size_t count) {
    if (count > words_.size()) return {};
    const auto taken = words_.first(count);
    words_ = words_.subspan(count);
    return taken;
  }
  [[nodiscard]] bool at_end() const { return words_.empty(); }

 private:
  std::span<const uint32_t> words_;
};

std::optional<std::vector<SpirvModule>> decode(std::span<const uint32_t> entry, const CacheKey& key,
                                               std::span<const ShaderSource> stages) {
  if (entry.size() < 6) return std::nullopt;
  const auto body = entry.first(entry.size() - 2);
  const uint64_t hash = hash_words(body);
  if (entry[entry.size() - 2] != low(hash) || entry.back() != high(hash)) return std::nullopt;
  WordReader reader(body);
  const auto header = reader.take(4);
  if (header[0] != kMagic || header[1] != low(key.check) || header[2] != high(key.check) ||
      header[3] != stages.size()) {
    return std::nullopt;
  }
  std::vector<SpirvModule> modules;
  for (const ShaderSource& stage : stages) {
    const auto head = reader.take(2);
    if (head.empty() || head[0] != static_cast<uint32_t>(stage.stage)) return std::nullopt;
    const auto words = reader.take(head[1]);
    if (words.empty() || words[0] != kSpirvMagic) return std::nullopt;
    modules.push_back({stage.name, stage.stage, {words.begin(), words.end()}});
  }
  if (!reader.at_end()) return std::nullopt;
  return modules;
}

}  // namespace

CacheKey cache_key(std::span<const ShaderSource> stages, const ShaderDefines& defines, const IncludeTexts& includes,
                   const std::string& compiler) {
  Hasher name;
  Hasher check;
  check.text("check");
  hash_inputs(name, stages, defines, includes, compiler);
  hash_inputs(check, stages, defines, includes, compiler);
  return {.name = name.value(), .check = check.value()};
}

CacheLookup read_cache(const std::filesystem::path& directory, const CacheKey& key,
                       std::span<const ShaderSource> stages) {
  std::error_code ignored;
  const std::filesystem::path file = entry_file(directory, key);
  if (!std::filesystem::exists(file, ignored)) return {};
  std::string bytes;
  try {
    bytes = read_text_file(file, kMostEntryBytes);
  } catch (const Error&) {
    return {.modules = std::nullopt, .damaged = true};
  }
  if (bytes.size() % sizeof(uint32_t) != 0) return {.modules = std::nullopt, .damaged = true};
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  CacheLookup lookup;
  lookup.modules = decode(words, key, stages);
  lookup.damaged = !lookup.modules.has_value();
  return lookup;
}

void write_cache(const std::filesystem::path& directory, const CacheKey& key, std::span<const SpirvModule> modules) {
  std::vector<uint32_t> words{kMagic, low(key.check), high(key.check), static_cast<uint32_t>(modules.size())};
  for (const SpirvModule& module : modules) {
    words.push_back(static_cast<uint32_t>(module.stage));
    words.push_back(static_cast<uint32_t>(module.words.size()));
    words.insert(words.end(), module.words.begin(), module.words.end());
  }
  const uint64_t hash = hash_words(words);
  words.push_back(low(hash));
  words.push_back(high(hash));
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) {
    throw Error(ExitCode::run_failed,
                "cannot make the shader cache '" + directory.string() + "': " + failure.message());
  }
  write_file_atomically(entry_file(directory, key), std::as_bytes(std::span<const uint32_t>(words)));
}

}  // namespace lightloom::gpu
