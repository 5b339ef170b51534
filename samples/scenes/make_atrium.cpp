// Writes the sample scene "atrium": make_atrium FOLDER. The same bytes every time.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "samples/scenes/generator/atrium.hpp"
#include "samples/scenes/generator/picture.hpp"

int main(int argc, char** argv) {
  namespace samples = lightloom::samples;
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_atrium FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    samples::write_png(samples::floor_tiles(), folder / "tiles.png");
    samples::write_png(samples::floor_tiles_surface(), folder / "tiles_surface.png");
    samples::write_png(samples::brick_colour(), folder / "brick.png");
    samples::write_png(samples::brick_normal(), folder / "brick_normal.png");
    samples::write_png(samples::palm_frond(), folder / "frond.png");
    samples::write_png(samples::iron_grille(), folder / "grille.png");
    samples::build_atrium().write(folder, "atrium");
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "make_atrium: %s\n", problem.what());
    return 1;
  }
  return 0;
}
