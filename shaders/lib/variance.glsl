// Variance of weighted means, from the samples themselves.
#ifndef LIGHTLOOM_LIB_VARIANCE
#define LIGHTLOOM_LIB_VARIANCE

// What is written where no estimate can be made: the square of the brightest light that is traced (traced_light.glsl), so
// that filters take it for noise however bright the scene; sums of nine still fit into a float.
const float kUnknownVariance = 1e36;

// Running sums over samples of one quantity (West 1979, "Updating mean and variance estimates", CACM 22(9)): no
// difference of large numbers.
struct Moments {
  float weight;    // sum of the weights
  float squares;   // sum of their squares
  float mean;
  float spread;    // sum of weight * (sample - mean)^2
};

const Moments kNoMoments = Moments(0.0, 0.0, 0.0, 0.0);

void add_sample(inout Moments m, float value, float weight) {
  m.weight += weight;
  m.squares += weight * weight;
  float delta = value - m.mean;
  m.mean += delta * (weight / m.weight);
  m.spread += weight * delta * (value - m.mean);
}

// How many samples of equal weight have a mean with the same noise.
float effective_count(Moments m) { return m.squares > 0.0 ? m.weight * m.weight / m.squares : 0.0; }

// Variance of one sample, without bias for samples of equal variance: E[spread] = variance * (weight - squares/weight).
// At least two samples.
float sample_variance(Moments m) {
  float freedom = m.weight - m.squares / max(m.weight, 1e-30);
  return freedom > 0.0 ? max(m.spread, 0.0) / freedom : kUnknownVariance;
}

// Variance of the weighted mean of samples that each have `variance`.
float mean_variance(Moments m, float variance) { return variance / max(effective_count(m), 1.0); }

#endif
