// Multiple importance sampling of light: one sample of a light (next event estimation, NEE) and one of the BSDF at each
// vertex of a path; what both can find is shared between them (Veach 1997, section 9.2).
#ifndef LIGHTLOOM_LIB_MIS
#define LIGHTLOOM_LIB_MIS

#include "lib/bsdf.glsl"
#include "lib/sampling.glsl"

const uint kHeuristicBalance = 0u;
const uint kHeuristicPower = 1u;
layout(constant_id = 20) const uint heuristic = 0u;

const uint kStrategyMis = 0u;
const uint kStrategyNee = 1u;
const uint kStrategyBsdf = 2u;
layout(constant_id = 21) const uint strategy = 0u;

// Are lights sampled that the BSDF can find, too? Those without extent always are.
const bool kSampleLights = strategy != kStrategyBsdf;

float heuristic_weight(float pdf, float other) {
  return heuristic == kHeuristicPower ? power_weight(pdf, other) : balance_weight(pdf, other);
}

// Share of a sampled light over its density [sr]: what f cos L is multiplied by.
float light_sample_weight(float light_pdf, float bsdf_pdf) {
  if (!(light_pdf > 0.0) || strategy == kStrategyBsdf) return 0.0;
  if (strategy == kStrategyNee) return 1.0 / light_pdf;
  if (heuristic == kHeuristicBalance) return 1.0 / (light_pdf + bsdf_pdf);
  return heuristic_weight(light_pdf, bsdf_pdf) / light_pdf;
}

// Share of light that a scattered ray met. `light_pdf`: density with which that light is sampled in this direction; 0
// where it cannot be.
float light_hit_weight(BsdfSample scatter, float light_pdf) {
  if (scatter.mirror || !(light_pdf > 0.0) || strategy == kStrategyBsdf) return 1.0;
  return strategy == kStrategyNee ? 0.0 : heuristic_weight(scatter.pdf, light_pdf);
}

#endif
