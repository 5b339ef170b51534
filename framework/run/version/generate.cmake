# Run at every build: writes the version and the commit into OUTPUT, touching it only when they changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "framework/run/version.hpp"

namespace lightloom::run {

std::string version() { return "@VERSION@"; }
std::string commit() { return "@commit@"; }

}  // namespace lightloom::run
]] @ONLY)
