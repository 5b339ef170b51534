#pragma once

#include <cstdint>
#include <utility>

#include "framework/graph/pass_type.hpp"

namespace lightloom {

/// Raised when the meaning of what crosses between the program and a plug-in changes without a change of its layout.
constexpr uint64_t kPluginRevision = 2;

/// What both sides must agree on, as one number: the layout of the tables, the compiler's and the standard library's
/// binary interface. Made by who compiles, so it tells whether the two sides were compiled against the same headers.
constexpr uint64_t plugin_interface() {
  uint64_t hash = 0xCBF29CE484222325u;
  const auto mix = [&hash](uint64_t part) { hash = (hash ^ part) * 0x100000001B3u; };
  mix(kPluginRevision);
  mix(sizeof(PassType));
  mix(sizeof(Port));
  mix(sizeof(Param));
  mix(sizeof(ParamSet::Entry));
  mix(sizeof(Dispatch));
  mix(sizeof(Draw));
  mix(static_cast<uint64_t>(Access::frame_input_read));
  mix(static_cast<uint64_t>(Format::rgba32_uint));
  mix(__GXX_ABI_VERSION);
#ifdef _GLIBCXX_USE_CXX11_ABI
  mix(_GLIBCXX_USE_CXX11_ABI);
#endif
  return hash;
}

/// What a plug-in exports, with C linkage and under the name `lightloom_plugin`:
///
///     LIGHTLOOM_PLUGIN("my_passes", "1.0", make_my_pass(), make_another())
///
/// Its shaders lie in the folder `shaders` beside the library.
struct Plugin {
  uint64_t interface = 0;              ///< plugin_interface() of the headers it was compiled against
  const char* lightloom_version = "";  ///< that they came with; for messages
  const char* name = "";
  const char* version = "";
  void (*add_passes)(PassRegistry&) = nullptr;
};

template <class... Types>
void add_pass_types(PassRegistry& registry, Types... types) {
  (registry.add(std::move(types)), ...);
}

/// Exports a plug-in of this name and version with these pass types.
// A macro, since what it writes must be compiled as a part of the plug-in.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage)
#define LIGHTLOOM_PLUGIN(name, version, ...)                                                  \
  extern "C" __attribute__((visibility("default"))) const lightloom::Plugin lightloom_plugin{ \
      lightloom::plugin_interface(), LIGHTLOOM_VERSION, name, version,                        \
      [](lightloom::PassRegistry& registry) { lightloom::add_pass_types(registry, __VA_ARGS__); }};

}  // namespace lightloom
