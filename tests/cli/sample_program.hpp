#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/cli/argument_parser.hpp"

namespace lightloom::cli {

/// A program with an option of every kind.
struct SampleProgram {
  Command program{"lightloom", "Declarative render graphs"};
  std::filesystem::path graph, scene;
  std::vector<std::string> graphs;
  std::optional<Size> size;
  uint32_t count = 1;
  uint32_t seed = 0;
  Range frames;
  double gain = 0;
  std::string mode = "slow", note = "none";
  std::vector<Assignment> sets;
  bool json = false;
  std::string shell;

  SampleProgram() {
    program.version("lightloom 1.2.3");
    Command& render = program.command("render", "Render frames of a graph");
    render.positional("GRAPH", graph, "Graph file").required();
    render.option("--scene", scene, "Scene file").required().group("Scene");
    render.option("--size", size, "View size").group("Scene");
    render
        .option("-n,--count", count,
                "How many of them there should be at the same time, which is a long explanation "
                "that does not fit on one line of a help text")
        .range(1, 16);
    render.option("--seed", seed, "Seed of all random numbers");
    render.option("--frames", frames, "Frames to render").group("Scene");
    render.option("--gain", gain, "Gain");
    render.option("--mode", mode, "Mode").choices({"slow", "fast"});
    render.option("--note", note, "Note");
    render.option("--set", sets, "Sets a parameter");
    render.flag("--json", json, "Print JSON");
    Command& check = program.command("check", "Check graphs");
    check.positional("GRAPH", graphs, "Graph files").required();
    check.flag("--json", json, "Print JSON");
    Command& completion = program.command("completion", "Print a completion script");
    completion.positional("SHELL", shell, "Shell").choices({"bash"}).required();
  }
};

}  // namespace lightloom::cli
