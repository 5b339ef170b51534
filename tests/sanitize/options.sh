# Run-time options of the sanitizers, to be sourced with `here` set to this folder.
# shellcheck shell=bash disable=SC2154 # here is set by who sources this
#
# detect_container_overflow: OpenImageIO and GoogleTest are not instrumented, and strings and vectors that they and we
# change in turn would be reported. max_allocation_size_mb: nothing may ask for more than a gibibyte at once.
# quarantine_size_mb: keeps the memory that tests measure near what they take.
export ASAN_OPTIONS=detect_container_overflow=0:max_allocation_size_mb=1024:quarantine_size_mb=16:abort_on_error=0
# Libraries have no frame pointers, and leaks.txt names who called them: slow, so only where pictures are decoded.
slow_unwind() { export ASAN_OPTIONS=$ASAN_OPTIONS:fast_unwind_on_malloc=0; }
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$here/leaks.txt:print_suppressions=0
