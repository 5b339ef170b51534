// Writes the reports that the browser test opens into a folder: full, one, many, hostile, empty.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "framework/base/atomic_file.hpp"
#include "framework/study/report.hpp"
#include "tests/study/sample_results.hpp"

int main(int argc, char** argv) {
  namespace study = lightloom::study;
  if (argc != 2) {
    std::fputs("usage: report_samples FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const auto write = [&](const char* name, const study::StudyResults& results) {
      lightloom::write_file_atomically(folder / name, study::make_report(results, folder));
    };
    write("full.html", study::sample_results(folder));
    write("one.html", study::many_rows(folder, 1));
    write("many.html", study::many_rows(folder, 100));
    write("hostile.html", study::hostile_results(folder));
    write("empty.html", study::StudyResults{});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
