// Numbers that are some.
#ifndef LIGHTLOOM_LIB_FINITE
#define LIGHTLOOM_LIB_FINITE

// No bit pattern of infinity or NaN; a comparison could be optimised away.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7F800000u) != 0x7F800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

#endif
