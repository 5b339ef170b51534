#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/includes.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::gpu {

/// Everything that decides the SPIR-V of a program, in two independent hashes: one names the file, both must fit.
struct CacheKey {
  uint64_t name = 0;
  uint64_t check = 0;
};
[[nodiscard]] CacheKey cache_key(std::span<const ShaderSource> stages, const ShaderDefines& defines,
                                 const IncludeTexts& includes, const std::string& compiler);

struct CacheLookup {
  std::optional<std::vector<SpirvModule>> modules;
  bool damaged = false;  ///< there was an entry, but not a whole one of this key
};
[[nodiscard]] CacheLookup read_cache(const std::filesystem::path& directory, const CacheKey& key,
                                     std::span<const ShaderSource> stages);

/// Makes the folder if needed. Throws Error(run_failed) if it cannot be written.
void write_cache(const std::filesystem::path& directory, const CacheKey& key, std::span<const SpirvModule> modules);

}  // namespace lightloom::gpu
