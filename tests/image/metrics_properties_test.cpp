#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/image/half.hpp"
#include "framework/image/metrics.hpp"
#include "tests/image/metric_images.hpp"

namespace lightloom::image {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

MetricOptions with(FlipKind kind) {
  MetricOptions options;
  options.flip = kind;
  return options;
}

/// All figures, for comparing bits.
std::vector<double> figures(const Metrics& m) {
  return {m.mse,
          m.rmse,
          m.psnr,
          m.relmse,
          m.mape,
          m.smape,
          m.ssim,
          m.flip,
          m.mean_error,
          m.max_error,
          m.bias,
          double(m.fireflies),
          double(m.non_finite),
          double(m.reference_non_finite)};
}

HostImage with_pixel(HostImage image, uint32_t x, uint32_t y, const Rgb& rgb) {
  const size_t offset = (size_t{y} * image.desc.extent.width + x) * 16;
  for (size_t c = 0; c < 3; ++c) {
    const auto value = float(rgb[c]);
    std::memcpy(image.texels.data() + offset + 4 * c, &value, 4);
  }
  return image;
}

HostImage blurred(const HostImage& image, int radius) {
  const auto size = image.desc.extent;
  return color_image(size.width, size.height, [&](uint32_t x, uint32_t y) {
    Rgb sum{};
    int count = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx, ++count)
        for (uint32_t c = 0; c < 3; ++c)
          sum[c] += image.at(uint32_t(std::clamp(int(x) + dx, 0, int(size.width) - 1)),
                             uint32_t(std::clamp(int(y) + dy, 0, int(size.height) - 1)), 0, c);
    for (double& channel : sum) channel /= count;
    return sum;
  });
}

TEST(Metrics, an_image_has_no_error_against_itself) {
  for (const FlipKind kind : {FlipKind::ldr, FlipKind::hdr}) {
    const HostImage image = test_picture(40, 30, kind == FlipKind::hdr ? 100 : 1, 0.2, 5);
    const Metrics metrics = compare(image, image, with(kind));
    EXPECT_EQ(metrics.psnr, kInfinity);
    EXPECT_EQ(metrics.ssim, 1);
    for (const double zero : {metrics.mse, metrics.rmse, metrics.relmse, metrics.mape, metrics.smape, metrics.flip,
                              metrics.mean_error, metrics.max_error, metrics.bias})
      EXPECT_EQ(zero, 0);
    EXPECT_EQ(metrics.fireflies + metrics.non_finite + metrics.clamped, 0u);
  }
}

TEST(Metrics, exchange_of_the_images_changes_only_what_is_relative_to_the_reference) {
  const HostImage a = test_picture(40, 30, 1, 0, 5);
  const HostImage b = test_picture(40, 30, 1, 0.2, 6);
  const Metrics there = compare(a, b, with(FlipKind::ldr));
  const Metrics back = compare(b, a, with(FlipKind::ldr));
  EXPECT_EQ(there.mse, back.mse);
  EXPECT_EQ(there.smape, back.smape);
  EXPECT_EQ(there.flip, back.flip);
  EXPECT_EQ(there.mean_error, back.mean_error);
  EXPECT_EQ(there.bias, -back.bias);
  EXPECT_EQ(there.max_error, back.max_error);
  EXPECT_NEAR(there.ssim, back.ssim, 1e-14);
  EXPECT_NE(there.relmse, back.relmse);
  EXPECT_NE(there.mape, back.mape);
}

TEST(Metrics, grow_with_noise_and_with_blur) {
  const HostImage clean = test_picture(64, 48, 1, 0, 1);
  const auto expect_worse = [](const Metrics& worse, const Metrics& better) {
    EXPECT_GT(worse.mse, better.mse);
    EXPECT_LT(worse.psnr, better.psnr);
    EXPECT_GT(worse.relmse, better.relmse);
    EXPECT_GT(worse.mape, better.mape);
    EXPECT_GT(worse.smape, better.smape);
    EXPECT_LT(worse.ssim, better.ssim);
    EXPECT_GT(worse.flip, better.flip);
    EXPECT_LE(worse.flip, 1);
    EXPECT_GE(better.flip, 0);
  };
  for (const FlipKind kind : {FlipKind::ldr, FlipKind::hdr}) {
    Metrics before = compare(clean, clean, with(kind));
    for (const double noise : {0.02, 0.05, 0.1, 0.2, 0.4}) {
      const Metrics after = compare(clean, test_picture(64, 48, 1, noise, 9), with(kind));
      expect_worse(after, before);
      before = after;
    }
    before = compare(clean, clean, with(kind));
    for (const int radius : {1, 2, 4, 8}) {
      const Metrics after = compare(clean, blurred(clean, radius), with(kind));
      expect_worse(after, before);
      before = after;
    }
  }
}

TEST(Metrics, have_the_same_bits_for_any_number_of_threads) {
  const HostImage a = test_picture(70, 45, 30, 0, 5);
  const HostImage b = with_pixel(test_picture(70, 45, 30, 0.2, 6), 11, 40, {kNan, 1, 1});
  MetricOptions options;
  options.threads = 1;
  const std::vector<double> expected = figures(compare(a, b, options));
  const std::vector<std::byte> map = flip_map(a, b, options).texels;
  for (const unsigned threads : {2u, 3u, 64u}) {
    options.threads = threads;
    EXPECT_EQ(figures(compare(a, b, options)), expected);
    const MetricsAndMap both = compare_with_flip_map(a, b, options);
    EXPECT_EQ(figures(both.metrics), expected);
    EXPECT_EQ(both.flip_map.texels, map);
  }
}

TEST(Metrics, one_channel_is_grey_and_alpha_counts_for_nothing) {
  const HostImage colored = grey_image(24, 20, [](uint32_t x, uint32_t y) { return ((x * 7 + y * 3) % 11) / 10.0; });
  HostImage single{{Format::r32_sfloat, Dimension::d2, {24, 20, 1}}, {}};
  HostImage half{{Format::rgba16_sfloat, Dimension::d2, {24, 20, 1}}, {}};
  for (uint32_t y = 0; y < 20; ++y)
    for (uint32_t x = 0; x < 24; ++x) {
      const auto value = float(colored.at(x, y, 0, 0));
      const auto* bytes = reinterpret_cast<const std::byte*>(&value);
      single.texels.insert(single.texels.end(), bytes, bytes + 4);
      for (uint32_t c = 0; c < 4; ++c) {
        const uint16_t bits = half_from_float(c < 3 ? value : 0.25f);
        half.texels.push_back(std::byte(bits & 0xff));
        half.texels.push_back(std::byte(bits >> 8));
      }
    }
  const HostImage other = test_picture(24, 20, 1, 0.1, 3);
  EXPECT_EQ(figures(compare(other, single)), figures(compare(other, colored)));
  EXPECT_NEAR(compare(other, half).mse, compare(other, colored).mse, 1e-4);
  EXPECT_EQ(compare(colored, single).mse, 0);
}

TEST(Metrics, eight_bits_stand_for_0_to_1) {
  HostImage bytes{{Format::rgba8_unorm, Dimension::d2, {2, 1, 1}}, {}};
  for (const int value : {0, 51, 255, 9, 102, 51, 0, 200}) bytes.texels.push_back(std::byte(value));
  const HostImage floats = color_image(2, 1, [](uint32_t x, uint32_t) {
    return x == 0 ? Rgb{0, 0.2, 1} : Rgb{0.4, 0.2, 0};
  });
  EXPECT_EQ(compare(floats, bytes).max_error, 0);
}

TEST(Metrics, non_finite_pixels_are_counted_and_touch_nothing_else) {
  const HostImage reference = test_picture(40, 30, 1, 0, 5);
  const HostImage test = test_picture(40, 30, 1, 0.1, 6);
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const HostImage broken = with_pixel(with_pixel(test, 20, 15, {0.1, bad, 0.1}), 0, 0, {bad, bad, bad});
    for (const FlipKind kind : {FlipKind::ldr, FlipKind::hdr}) {
      const Metrics metrics = compare(reference, broken, with(kind));
      EXPECT_EQ(metrics.non_finite, 2u);
      EXPECT_EQ(metrics.reference_non_finite, 0u);
      EXPECT_EQ(metrics.fireflies, 0u);
      for (const double figure : figures(metrics)) EXPECT_TRUE(std::isfinite(figure));
      // As if those pixels were right and had not been measured.
      HostImage mended = test;
      for (const auto& [x, y] : {std::pair(20u, 15u), std::pair(0u, 0u)})
        mended =
            with_pixel(mended, x, y, {reference.at(x, y, 0, 0), reference.at(x, y, 0, 1), reference.at(x, y, 0, 2)});
      const double scale = 1200.0 / 1198.0;
      EXPECT_NEAR(metrics.mse, compare(reference, mended, with(kind)).mse * scale, 1e-12);
      const HostImage map = flip_map(reference, mended, with(kind));
      const double rest =
          compare(reference, mended, with(kind)).flip * 1200 - map.at(20, 15, 0, 0) - map.at(0, 0, 0, 0);
      EXPECT_NEAR(metrics.flip, rest / 1198, 1e-9);
      EXPECT_EQ(flip_map(reference, broken, with(kind)).at(20, 15, 0, 0), 0);
    }
  }
  const Metrics swapped = compare(with_pixel(reference, 3, 3, {kNan, 0, 0}), test);
  EXPECT_EQ(swapped.non_finite, 0u);
  EXPECT_EQ(swapped.reference_non_finite, 1u);
  for (const double figure : figures(swapped)) EXPECT_TRUE(std::isfinite(figure));
}

TEST(Metrics, exposures_of_flip_depend_on_the_reference_alone) {
  // The brightest pixel of the reference sets the first exposure, also where the test is broken there.
  const HostImage reference = with_pixel(test_picture(40, 30, 1, 0, 5), 2, 2, {300, 300, 300});
  const HostImage test = with_pixel(test_picture(40, 30, 1, 0.2, 6), 2, 2, {300, 300, 300});
  const double rest = compare(reference, test).flip * 1200 - flip_map(reference, test).at(2, 2, 0, 0);
  const double broken = compare(reference, with_pixel(test, 2, 2, {kNan, 0, 0})).flip;
  EXPECT_NEAR(broken * 1199, rest, 1e-3);
}

TEST(Metrics, without_any_finite_pixel_nothing_is_claimed) {
  const HostImage nothing = constant_image(20, 15, {kNan, 0, 0});
  const Metrics metrics = compare(constant_image(20, 15, {1, 1, 1}), nothing);
  EXPECT_EQ(metrics.non_finite, 300u);
  for (const double figure : {metrics.mse, metrics.rmse, metrics.psnr, metrics.relmse, metrics.mape, metrics.smape,
                              metrics.ssim, metrics.flip, metrics.mean_error, metrics.max_error, metrics.bias})
    EXPECT_TRUE(std::isnan(figure));
}

TEST(Metrics, a_black_reference_gives_defined_values) {
  const HostImage black = constant_image(16, 16, {0, 0, 0});
  const HostImage bright = constant_image(16, 16, {50, 50, 50});
  const Metrics metrics = compare(black, bright);
  for (const double figure : figures(metrics)) EXPECT_TRUE(std::isfinite(figure));
  EXPECT_DOUBLE_EQ(metrics.relmse, 2500 / 0.01);
  EXPECT_DOUBLE_EQ(metrics.mape, 50 / 0.01);
  EXPECT_DOUBLE_EQ(metrics.smape, 2);
  EXPECT_EQ(metrics.fireflies, 256u);
  // There is no exposure to look at it, so it is looked at as display values: black and white.
  EXPECT_EQ(metrics.flip, compare(black, constant_image(16, 16, {1, 1, 1}), with(FlipKind::ldr)).flip);
  EXPECT_EQ(compare(black, black).flip, 0);
}

TEST(Metrics, where_most_of_the_reference_is_black_the_median_is_that_of_the_rest) {
  const HostImage black = constant_image(16, 16, {0, 0, 0});
  const HostImage lit = with_pixel(black, 5, 5, {1, 1, 1});
  const double flip = compare(lit, with_pixel(black, 5, 5, {2, 2, 2})).flip;
  EXPECT_GT(flip, 0);
  EXPECT_LT(flip, 0.1);
  // One exposure: that at which the lit pixel is tone mapped to 0.85 (start and stop 1.083297).
  EXPECT_EQ(compare(lit, lit).flip, 0);
}

TEST(Metrics, flip_of_radiance_does_not_depend_on_the_unit) {
  const HostImage a = test_picture(40, 30, 1, 0, 5), b = test_picture(40, 30, 1, 0.2, 6);
  const double flip = compare(a, b).flip;
  for (const double scale : {0x1p-60, 0x1p-8, 0x1p60})
    EXPECT_NEAR(compare(test_picture(40, 30, scale, 0, 5), test_picture(40, 30, scale, 0.2, 6)).flip, flip, 1e-4);
}

TEST(Metrics, huge_and_negative_values_stay_within_bounds) {
  const HostImage a = test_picture(40, 30, 1, 0, 5);
  const double most = double(std::numeric_limits<float>::max());
  const HostImage b = with_pixel(with_pixel(a, 7, 7, {most, most, most}), 30, 20, {-most, -1, -1});
  for (const auto& [reference, test] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const FlipKind kind : {FlipKind::ldr, FlipKind::hdr}) {
      const Metrics metrics = compare(*reference, *test, with(kind));
      for (const double figure : figures(metrics)) EXPECT_TRUE(std::isfinite(figure));
      EXPECT_GT(metrics.flip, 0);
      EXPECT_LE(metrics.flip, 1);
      EXPECT_EQ(metrics.clamped, kind == FlipKind::ldr ? 2u : 0u);
    }
  }
}

TEST(Metrics, fireflies_are_pixels_far_brighter_than_the_reference) {
  const HostImage reference = with_pixel(constant_image(8, 8, {0.5, 0.5, 0.5}), 2, 2, {0, 0, 0});
  const auto count = [&](uint32_t x, uint32_t y, double value, double factor) {
    MetricOptions options;
    options.firefly_factor = factor;
    return compare(reference, with_pixel(reference, x, y, {value, value, value}), options).fireflies;
  };
  EXPECT_EQ(count(1, 1, 5.01, 10), 1u);
  EXPECT_EQ(count(1, 1, 4.99, 10), 0u);
  EXPECT_EQ(count(1, 1, 4.99, 9), 1u);
  EXPECT_EQ(count(2, 2, 0.101, 10), 1u) << "a black pixel counts as one of epsilon";
  EXPECT_EQ(count(2, 2, 0.099, 10), 0u);
  EXPECT_EQ(count(1, 1, 0, 10), 0u);
}

TEST(Metrics, errors_keep_their_sign_in_the_bias) {
  const HostImage grey = constant_image(4, 4, {0.5, 0.5, 0.5});
  const Metrics metrics = compare(grey, with_pixel(grey, 1, 1, {0.5, 0.1, 0.7}));
  EXPECT_NEAR(metrics.bias, -0.2 / 48, 1e-9);
  EXPECT_NEAR(metrics.mean_error, 0.6 / 48, 1e-9);
  EXPECT_NEAR(metrics.max_error, 0.4, 1e-7);
}

TEST(Metrics, small_images_have_a_similarity_too) {
  MetricOptions options;
  options.with_flip = false;
  // Without variance only the means count: (2 a b + C1) / (a^2 + b^2 + C1).
  for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(4u, 3u), std::pair(1u, 30u), std::pair(30u, 10u)}) {
    const double ssim = compare(constant_image(width, height, {0.25, 0.25, 0.25}),
                                constant_image(width, height, {0.75, 0.75, 0.75}), options)
                            .ssim;
    EXPECT_NEAR(ssim, 0.3751 / 0.6251, 1e-9) << width << "x" << height;
  }
}

void expect_refused(const HostImage& reference, const HostImage& test, const std::string& sentence,
                    const MetricOptions& options = {}) {
  for (const auto& attempt : std::initializer_list<std::function<void()>>{
           [&] { (void)compare(reference, test, options); }, [&] { (void)flip_map(reference, test, options); },
           [&] { (void)relative_error_map(reference, test, options); }}) {
    try {
      attempt();
      ADD_FAILURE() << "no error: " << sentence;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      EXPECT_THAT(error.what(), ::testing::HasSubstr(sentence));
    }
  }
}

HostImage empty_image(Format format, Dimension dimension, const Extent3& extent) {
  HostImage image{{format, dimension, extent}, {}};
  image.texels.resize(byte_size(image.desc));
  return image;
}

TEST(Metrics, what_cannot_be_compared_is_refused_in_one_sentence) {
  const HostImage good = constant_image(8, 6, {1, 1, 1});
  expect_refused(good, constant_image(6, 8, {1, 1, 1}), "the reference has 8x6 pixels, the test image 6x8");
  expect_refused(empty_image(Format::rgba32_sfloat, Dimension::d2, {0, 6, 1}), good,
                 "the reference cannot be compared");
  expect_refused(good, empty_image(Format::rgba32_sfloat, Dimension::d3, {8, 6, 2}), "it is a volume");
  expect_refused(good, empty_image(Format::rg32_sfloat, Dimension::d2, {8, 6, 1}), "it has 2 channels");
  expect_refused(good, empty_image(Format::rgba32_uint, Dimension::d2, {8, 6, 1}), "it holds integers");
  HostImage cut = good;
  cut.texels.pop_back();
  expect_refused(good, cut, "the test image cannot be compared: it has 767 bytes");
}

TEST(Metrics, options_out_of_range_are_refused) {
  const HostImage good = constant_image(8, 6, {1, 1, 1});
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    MetricOptions options;
    options.epsilon = bad;
    expect_refused(good, good, "epsilon must be", options);
    options = {};
    options.pixels_per_degree = bad;
    expect_refused(good, good, "pixels_per_degree must be", options);
    options = {};
    options.firefly_factor = bad;
    expect_refused(good, good, "firefly_factor must be", options);
  }
}

TEST(Metrics, relative_error_map_is_the_mean_over_channels) {
  const HostImage reference = constant_image(3, 2, {0.5, 0, 1});
  const HostImage test = with_pixel(with_pixel(reference, 1, 0, {0.25, 0.01, 3}), 2, 1, {kNan, 0, 0});
  MetricOptions options;
  options.epsilon = 0.5;
  const HostImage map = relative_error_map(reference, test, options);
  EXPECT_EQ(map.desc.format, Format::r32_sfloat);
  EXPECT_EQ(map.at(0, 0, 0, 0), 0);
  EXPECT_NEAR(map.at(1, 0, 0, 0), (0.25 / 1 + 0.01 / 0.5 + 2 / 1.5) / 3, 1e-6);
  EXPECT_TRUE(std::isnan(map.at(2, 1, 0, 0)));
}

TEST(HeatMap, is_magma) {
  HostImage map = empty_image(Format::r32_sfloat, Dimension::d2, {7, 1, 1});
  const std::array<float, 7> values = {0, 2, 1, 5, 60.0f / 255 * 2, 101.0f / 255 * 2, std::nanf("")};
  std::memcpy(map.texels.data(), values.data(), sizeof values);
  const HostImage colors = heat_map(map, 2);
  const auto expect_color = [&](uint32_t x, const Rgb& expected) {
    for (uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(colors.at(x, 0, 0, c), expected[c], 1.5 / 255) << x << " " << c;
    EXPECT_EQ(colors.at(x, 0, 0, 3), 1);
  };
  expect_color(0, {0.001462, 0.000466, 0.013866});
  expect_color(1, {0.987053, 0.991438, 0.749504});
  expect_color(2, {0.716387, 0.214982, 0.475290});
  expect_color(3, {0.987053, 0.991438, 0.749504});
  expect_color(4, {0.291366, 0.064553, 0.475462});  // entries 60 and 101 of the published table
  expect_color(5, {0.544015, 0.159033, 0.506159});
  expect_color(6, {0, 1, 0});
  EXPECT_THROW((void)heat_map(map, 0), Error);
  EXPECT_THROW((void)heat_map(constant_image(2, 2, {1, 1, 1})), Error);
}

}  // namespace
}  // namespace lightloom::image
