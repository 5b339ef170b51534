// Sums of many numbers that stay exact to the rounding of the result.
#ifndef LIGHTLOOM_LIB_COMPENSATED_SUM
#define LIGHTLOOM_LIB_COMPENSATED_SUM

// sum + error, where `error` is at most half a unit in the last place of `sum`: 48 bits together (T. J. Dekker, "A
// floating-point technique for extending the available precision", Numerische Mathematik 18, 1971).
struct CompensatedSum {
  vec3 sum;
  vec3 error;
};

// Neumaier's sum (ZAMM 54, 1974) with the rounding error of each addition found without a branch on what is larger
// (D. E. Knuth, "The Art of Computer Programming" vol. 2, 4.2.2, theorem B). The errors alone would drift where all
// terms round to one side, so they move on into the sum as they grow. `precise`: an optimizer that takes this for
// algebra would find 0.
void add(inout CompensatedSum s, vec3 x) {
  precise vec3 total = s.sum + x;
  precise vec3 moved = total - s.sum;
  precise vec3 lost = (s.sum - (total - moved)) + (x - moved);
  precise vec3 error = s.error + lost;
  precise vec3 sum = total + error;
  precise vec3 rest = error - (sum - total);
  s = CompensatedSum(sum, rest);
}

vec3 value_of(CompensatedSum s) { return s.sum + s.error; }

#endif
