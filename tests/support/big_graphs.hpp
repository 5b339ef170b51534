#pragma once

#include <cstdint>
#include <string>

namespace lightloom::toy {

/// Graph files of the toy pass types, larger than any that a person writes: `passes` passes, all of them needed.

/// Each pass reads the one before; most write one image of the view's size, some need scratch, histories or a param.
[[nodiscard]] std::string chain(uint32_t passes);

/// The same passes, the last one first in the file.
[[nodiscard]] std::string backward_chain(uint32_t passes);

/// Layers of 16 passes; each reads one to three values drawn from the four layers before, some of them as history.
[[nodiscard]] std::string layers(uint32_t passes, uint32_t seed);

/// All passes but two read the first; the last follows from the one before.
[[nodiscard]] std::string hub(uint32_t passes);

}  // namespace lightloom::toy
