#!/usr/bin/env python3
"""includes.py ROOT: each source and header that names something of the standard library includes what declares it.

An include that a source lacks may stand, by chance, in a header of others that it includes, and be gone with their next
version. An include counts if the file has it or one of our headers that the file includes; what standard headers include
of others counts only where BRINGS says so."""

import functools
import os
import re
import sys

FOLDERS = ["framework", "passes", "samples", "tests"]

# Names in std by the header that declares them. Those that many headers declare (move, begin, size_t) are left out.
DECLARED = {
    "algorithm": "all_of any_of clamp copy copy_if copy_n count count_if equal fill fill_n find find_if for_each"
                 " generate is_sorted lower_bound max max_element min min_element minmax_element none_of nth_element"
                 " partition remove remove_if replace reverse rotate sort stable_sort transform unique upper_bound",
    "array": "array",
    "atomic": "atomic",
    "bit": "bit_cast bit_ceil bit_width countr_zero has_single_bit popcount",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": "acos asin atan2 cbrt ceil cos exp floor fmod hypot isfinite isinf isnan log log2 lround nextafter pow"
             " round sin sqrt tan",
    "cstdio": "fputs printf snprintf",
    "cstdlib": "getenv",
    "cstring": "memcmp memcpy memset strcmp strerror strlen",
    "deque": "deque",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream",
    "functional": "function",
    "future": "async future promise",
    "iostream": "cerr cout",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "lock_guard mutex scoped_lock unique_lock",
    "numbers": "numbers",
    "numeric": "accumulate gcd inner_product iota partial_sum reduce",
    "optional": "nullopt optional",
    "random": "mt19937 mt19937_64 uniform_int_distribution uniform_real_distribution",
    "regex": "regex",
    "set": "multiset set",
    "span": "as_bytes span",
    "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "invalid_argument logic_error out_of_range runtime_error",
    "string": "stod stoi string to_string",
    "string_view": "string_view",
    "system_error": "error_code",
    "thread": "jthread this_thread thread",
    "tuple": "make_tuple tie tuple",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "utility": "exchange pair",
    "variant": "get_if holds_alternative monostate variant visit",
    "vector": "vector",
}
HEADER_OF = {name: header for header, names in DECLARED.items() for name in names.split()}

# What else a header brings that nobody needs to name.
BRINGS = {header: {"string_view"} for header in ["string"]}
BRINGS.update({header: {"string", "string_view"} for header in ["fstream", "sstream", "stdexcept", "system_error"]})
BRINGS.update({header: {"utility"} for header in ["algorithm", "array", "map", "optional", "set", "tuple",
                                                  "unordered_map"]})
BRINGS["filesystem"] = {"string", "string_view", "system_error"}
BRINGS["thread"] = BRINGS["mutex"] = {"chrono"}
BRINGS["future"] = {"chrono", "mutex", "thread"}
BRINGS["span"] = {"array"}
BRINGS["gtest/gtest.h"] = BRINGS["gmock/gmock.h"] = {
    "functional", "iostream", "limits", "map", "memory", "set", "sstream", "string", "string_view", "tuple", "utility",
    "vector"}

INCLUDE = re.compile(r'^#include [<"](.*)[>"]', re.MULTILINE)
USED = re.compile(r"\bstd::(?:ranges::)?(\w+)")
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)
NO_CODE = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*')


@functools.lru_cache(maxsize=None)
def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def included_by(path, root, seen):
    """The headers of others that a file includes, itself or by ours."""
    found = set()
    for name in INCLUDE.findall(text_of(path)):
        ours = os.path.join(root, name)
        if not os.path.exists(ours):
            found |= {name} | BRINGS.get(name, set())
        elif ours not in seen:
            seen.add(ours)
            found |= included_by(ours, root, seen)
    return found


def lacking(path, root):
    """What a file lacks: (header, names it is needed for)."""
    code = NO_CODE.sub('""', RAW_STRING.sub('""', text_of(path)))
    has = included_by(path, root, {path})
    lacks = {}
    for name in set(USED.findall(code)) & HEADER_OF.keys():
        if HEADER_OF[name] not in has:
            lacks.setdefault(HEADER_OF[name], []).append(name)
    return sorted((header, sorted(names)) for header, names in lacks.items())


def main():
    root = os.path.realpath(sys.argv[1])
    looked_at = 0
    found = []
    for folder in FOLDERS:
        for inside, _, names in os.walk(os.path.join(root, folder)):
            for name in sorted(names):
                if name.endswith((".cpp", ".hpp")):
                    path = os.path.join(inside, name)
                    looked_at += 1
                    found += [f"{os.path.relpath(path, root)}: needs #include <{header}> for std::"
                              + ", std::".join(used) for header, used in lacking(path, root)]
    if looked_at == 0:
        sys.exit(f"no source in {root}")
    print("\n".join(found) or f"{looked_at} files include what they name")
    sys.exit(1 if found else 0)


main()
