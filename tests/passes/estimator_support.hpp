#pragma once

#include <string>
#include <vector>

#include "tests/support/graph_runner.hpp"

namespace lightloom::test {

/// An estimate and its standard error.
struct Estimate {
  double mean = 0;
  double error = 0;
};

/// Of the frames' values as independent samples.
Estimate estimate(const std::vector<double>& samples);

/// One channel of an output over frames of independent noise: blocks of 8 x 8 pixels, row by row, and all of it.
/// Pixels of alpha 0 count as nothing, blocks without any other are left out.
struct ImageEstimate {
  std::vector<Estimate> blocks;
  Estimate whole;
};
ImageEstimate image_estimate(const std::vector<Images>& frames, const std::string& output, uint32_t channel);

/// Expects that two estimates of the same image differ by chance alone: the whole by less than three standard errors,
/// blocks by about 0.8 of theirs on average and almost never by 3.3.
void expect_agreement(const ImageEstimate& a, const ImageEstimate& b, const std::string& what);

}  // namespace lightloom::test
