#include "framework/cli/comparison.hpp"

#include <algorithm>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/frame_files.hpp"
#include "framework/image/png.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;

constexpr size_t kFramesNamed = 8;  // of those that are missing

struct FramePair {
  uint32_t frame = 0;
  fs::path reference;
  fs::path test;
};

std::string missing_text(const std::vector<uint32_t>& missing) {
  std::vector<std::string> numbers;
  for (size_t k = 0; k < std::min(missing.size(), kFramesNamed); ++k) numbers.push_back(std::to_string(missing[k]));
  if (missing.size() > kFramesNamed) numbers.push_back("… (" + std::to_string(missing.size()) + " in all)");
  return (missing.size() == 1 ? "frame " : "frames ") + join(numbers, ", ");
}

void require_frames(const image::FrameFiles& there, const image::FrameFiles& here, const fs::path& place,
                    const std::string& hint) {
  std::vector<uint32_t> missing;
  for (const auto& [frame, file] : there.files)
    if (!here.files.contains(frame)) missing.push_back(frame);
  if (missing.empty()) return;
  throw Error(ExitCode::invalid_input,
              "'" + place.string() + "' lacks " + missing_text(missing) + ", which the other side has", hint);
}

std::vector<FramePair> pair_frames(const ComparisonRequest& request, bool& sequence) {
  const image::FrameFiles reference = image::find_frames(request.reference, request.output);
  const image::FrameFiles test = image::find_frames(request.test, request.output);
  sequence = !(reference.single && test.single);
  std::vector<FramePair> pairs;
  if (reference.single) {
    for (const auto& [frame, file] : test.files) pairs.push_back({frame, reference.files.begin()->second, file});
  } else if (test.single) {
    if (reference.files.size() > 1) {
      throw Error(ExitCode::invalid_input, "the reference '" + request.reference.string() + "' has " +
                                               std::to_string(reference.files.size()) +
                                               " frames, and the test image is one file");
    }
    pairs.push_back({reference.files.begin()->first, reference.files.begin()->second, test.files.begin()->second});
  } else {
    require_frames(test, reference, request.reference,
                   "to compare every frame with one image, name its file instead of its folder");
    require_frames(reference, test, request.test, "");
    for (const auto& [frame, file] : reference.files) pairs.push_back({frame, file, test.files.at(frame)});
  }
  return pairs;
}

void require_patterns(const ComparisonRequest& request, size_t frames) {
  for (const auto& [option, file] : {std::pair("--heat-map", &request.heat_map), {"--error-map", &request.error_map}}) {
    if (frames > 1 && !file->empty() && !image::has_frame_number(*file)) {
      throw Error(
          ExitCode::usage,
          std::string(option) + " '" + file->string() + "' is one file for " + std::to_string(frames) + " frames",
          "write #### where the frame number belongs, e.g. heat.####.png");
    }
  }
}

image::ReadImage load(const fs::path& file, const ComparisonRequest& request) {
  image::ReadImage loaded = image::read_image(file, request.read);
  if (!request.crop) return loaded;
  try {
    loaded.image = image::crop(loaded.image, *request.crop);
  } catch (const Error& error) {
    throw Error(error.code(), "'" + file.string() + "': " + error.what());
  }
  return loaded;
}

void write_map(const fs::path& pattern, uint32_t frame, const image::HostImage& map, std::string_view channel) {
  const fs::path file = image::with_frame_number(pattern, frame);
  std::error_code ignored;  // what is wrong with the folder, the writer says
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  if (file.extension() == ".exr") {
    image::write_exr(file, map, {std::string(channel)});
  } else {
    image::write_png(file, image::heat_map(map));
  }
}

/// Compares frame after frame.
class Comparer {
 public:
  explicit Comparer(const ComparisonRequest& request) : request_(request) {}

  void add(const FramePair& pair) {
    load_pair(pair);
    image::MetricOptions options = request_.metrics;
    options.flip = result_.flip;
    ComparedFrame compared{pair.frame, pair.reference, pair.test, {}};
    try {
      compared.metrics = measure(pair.frame, options);
      reference_meter_.add(reference_.image);
      test_meter_.add(test_.image);
    } catch (const Error& error) {
      if (error.code() != ExitCode::invalid_input) throw;
      throw Error(error.code(), "cannot compare '" + pair.test.string() + "' with '" + pair.reference.string() +
                                    "': " + error.what());
    }
    result_.frames.push_back(std::move(compared));
  }

  [[nodiscard]] Comparison finish(bool sequence) {
    result_.sequence = sequence;
    result_.flicker = test_meter_.result();
    result_.flicker_reference = reference_meter_.result();
    add_warnings();
    return std::move(result_);
  }

 private:
  void load_pair(const FramePair& pair) {
    if (result_.frames.empty() || result_.frames.back().reference != pair.reference)
      reference_ = load(pair.reference, request_);
    test_ = load(pair.test, request_);
    if (!result_.frames.empty()) return;
    const bool display = reference_.display && test_.display;
    result_.flip = request_.flip.value_or(display ? image::FlipKind::ldr : image::FlipKind::hdr);
    result_.extent = reference_.image.desc.extent;
    result_.reference_decoded = reference_.decoded;
    result_.test_decoded = test_.decoded;
    mixed_ = reference_.display != test_.display;
  }

  [[nodiscard]] image::Metrics measure(uint32_t frame, const image::MetricOptions& options) const {
    image::Metrics metrics;
    if (request_.heat_map.empty()) {
      metrics = image::compare(reference_.image, test_.image, options);
    } else {
      const image::MetricsAndMap both = image::compare_with_flip_map(reference_.image, test_.image, options);
      metrics = both.metrics;
      write_map(request_.heat_map, frame, both.flip_map, "flip");
    }
    if (!request_.error_map.empty()) {
      write_map(request_.error_map, frame, image::relative_error_map(reference_.image, test_.image, options), "error");
    }
    return metrics;
  }

  void add_warnings() {
    uint64_t clamped = 0, non_finite = 0;
    for (const ComparedFrame& frame : result_.frames) {
      clamped += frame.metrics.clamped;
      non_finite += frame.metrics.reference_non_finite;
    }
    if (mixed_) {
      result_.warnings.emplace_back(
          "one side has 8 or 16 bits a sample, the other floats: a tone-mapped picture differs from radiance");
    }
    if (clamped > 0) {
      result_.warnings.push_back("FLIP of display values clamped " + std::to_string(clamped) +
                                 " pixels with values outside 0..1; --flip hdr is for radiance");
    }
    if (non_finite > 0) {
      result_.warnings.push_back("the reference has " + std::to_string(non_finite) +
                                 " pixels with a NaN or an infinity, which are left out");
    }
  }

  const ComparisonRequest& request_;
  Comparison result_;
  image::ReadImage reference_;
  image::ReadImage test_;
  image::FlickerMeter reference_meter_;
  image::FlickerMeter test_meter_;
  bool mixed_ = false;
};

}  // namespace

Comparison compare_files(const ComparisonRequest& request, const ComparisonProgress& progress) {
  bool sequence = false;
  const std::vector<FramePair> pairs = pair_frames(request, sequence);
  require_patterns(request, pairs.size());
  Comparer comparer(request);
  for (size_t k = 0; k < pairs.size(); ++k) {
    comparer.add(pairs[k]);
    progress(static_cast<uint32_t>(k + 1), static_cast<uint32_t>(pairs.size()));
  }
  return comparer.finish(sequence);
}

}  // namespace lightloom::cli
